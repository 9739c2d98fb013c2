"""Sprites in the light of a low sun (``sun.relit``): their sunny side warm, the other in the sky's.

With ``transparent.sunward`` trees and deer are brighter towards the sun by day, too.
A sprite's picture has the light of noon painted in. Here the colours of its quad's corners multiply
it: as if the quad were a quarter of a cylinder that bulges towards the viewer. All upright quads
face the viewer, so one frame has the same four colours for all of them. No OpenGL here.
"""

import numpy as np

from landscape.elements.settings import Sun
from landscape.elements.sun import direction, painted
from landscape.frame import Frame

BULGE = np.sqrt(0.5)  # chosen: the cylinder's normals at a quad's sides are 45 degrees from its own
# Chosen, by day: the colours that multiply a side in the shade, under the sky and against the sun,
# where leaves let through yellow-green light; how sunny a side is that the sun grazes, and how much
# sunnier one that faces it; and how much less the foot is lit.
UNDER_SKY, AGAINST = np.array([0.44, 0.52, 0.64]), np.array([0.70, 0.74, 0.46])
GRAZED = 0.66
FACED = 0.95
LOW_BY_DAY = 0.16
LOW = 0.35  # chosen: how much less the foot faces the sun, in the long shadows around it


def changes(sun: Sun) -> bool:
    """Return whether the light differs from the one that is painted in."""
    return sun.relit or sun.tint != Sun().tint


def towards_sun(sun: Sun, frame: Frame) -> tuple[float, float]:
    """Return how much the front and the right side of an upright quad face the sun, -1..1."""
    towards = direction(sun)
    level = np.array([frame.back[0], 0.0, frame.back[2]])
    if not level.any():  # the camera looks straight down: its up vector is level
        level = -np.array([frame.up[0], 0.0, frame.up[2]])
    front = BULGE * float(towards @ level) / float(np.linalg.norm(level))
    return front, BULGE * float(towards @ frame.right)


def by_day(sun: Sun, frame: Frame, strength: float) -> np.ndarray:
    """Return the light (4, 3) at the corners of a quad by day, ``strength`` 0..1 from even."""
    front, side = towards_sun(sun, frame)
    facing = np.array([front - side - LOW_BY_DAY, front + side - LOW_BY_DAY])
    facing = np.append(facing, [front + side, front - side])
    sunny = np.clip(GRAZED + FACED * facing, 0.0, 1.0)[:, None]
    against = np.clip(-front / BULGE, 0.0, 1.0)
    shade = UNDER_SKY + (AGAINST - UNDER_SKY) * against
    return np.asarray(1.0 - strength * (1.0 - shade) * (1.0 - sunny))


def corner_light(sun: Sun, frame: Frame, sunward: float = 0.0) -> np.ndarray | None:
    """Return the light (4, 3) at the corners of an upright quad, in a billboard's order.

    None if it is the one that is painted in.
    """
    if not changes(sun):
        return by_day(sun, frame, sunward) if sunward else None
    front, side = towards_sun(sun, frame)
    return painted(
        sun, np.array([front - side - LOW, front + side - LOW, front + side, front - side])
    )


def light_at(corners: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Return the light (n, k, 3) at points s, t (n, k, 2) of quads with corners' light (4, 3).

    s runs from left to right and t from top to bottom, 0..1.
    """
    s, t = points[..., :1], points[..., 1:]
    foot, top = (corners[a] + (corners[b] - corners[a]) * s for a, b in ((0, 1), (3, 2)))
    return np.asarray(top + (foot - top) * t)


def lit(colours: np.ndarray, light: np.ndarray) -> np.ndarray:
    """Return colours, uint8 (..., 4), with their RGB times ``light`` (..., 3); alpha is kept."""
    out = np.broadcast_to(colours, (*np.broadcast_shapes(colours.shape[:-1], light.shape[:-1]), 4))
    out = out.copy()
    out[..., :3] = out[..., :3] * light
    return out
