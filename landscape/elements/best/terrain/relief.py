"""The sun's light on the relief, for times of day other than the one painted into the ground.

The ground's large texture is painted in the light of noon. With ``sun.relit`` it is multiplied by
the colour of another sun: warm on slopes that face it, the sky's colour on those that face away and
in the shadow of hills. Computed at the vertices of the height field. No OpenGL here.
"""

import numpy as np
from PIL import Image

from landscape.elements.settings import Sun
from landscape.elements.sun import direction, painted
from landscape.geometry.height_field import HeightField

REACH = 14.0  # chosen: units, how far a hill's shadow falls
LOWEST = 0.22  # chosen: least rise over run of the sun's rays; lower, all land would be in shadow
SOFT = 0.12  # chosen: units by which the sunlight's edge is blurred in height


def facing(field: HeightField, towards: np.ndarray) -> np.ndarray:
    """Return the cosine of the angle between ground and sun, (n, n); ``towards`` (3,) is the sun.

    Row along z and column along x, as the heights.
    """
    step = field.size / (len(field.heights) - 1)
    rise_z, rise_x = np.gradient(field.heights.astype(np.float64), step)
    length = np.sqrt(1.0 + rise_x * rise_x + rise_z * rise_z)
    return np.asarray((towards[1] - rise_x * towards[0] - rise_z * towards[2]) / length)


def hidden(field: HeightField, towards: np.ndarray) -> np.ndarray:
    """Return 0..1, (n, n): how far hills hide the sun from each vertex; ``towards`` (3,)."""
    count = len(field.heights)
    level, step = float(np.hypot(towards[0], towards[2])), field.size / (count - 1)
    ground = np.maximum(field.heights, field.water_level).astype(np.float64)
    above = np.full((count, count), -np.inf)
    if level > 1e-6:
        at = np.arange(count) * step
        for away in np.arange(1.0, REACH / step) * step:
            x, z = (at + away * towards[axis] / level for axis in (0, 2))
            ray = ground + away * max(towards[1] / level, LOWEST)
            above = np.maximum(above, field.height(x[None, :], z[:, None]) - ray)
    return np.asarray(np.clip(0.5 + above / SOFT, 0.0, 1.0))


def relief_light(field: HeightField, sun: Sun, side: int) -> np.ndarray:
    """Return the colour of the light on open ground: (side, side, 3), or (3,) if it is one.

    Row along z and column along x.
    """
    if not sun.relit:
        return np.array(sun.tint, np.float32)
    towards = direction(sun)
    lit, shade = painted(sun, facing(field, towards)), np.array(sun.shade)
    lit += (shade - lit) * hidden(field, towards)[..., None]
    size = (side, side)
    channels = [Image.fromarray(part.astype(np.float32)) for part in np.moveaxis(lit, 2, 0)]
    enlarged = [np.asarray(c.resize(size, Image.Resampling.BILINEAR)) for c in channels]
    return np.stack(enlarged, axis=2)
