"""The shadows of clouds on the land (``ground.clouds``): broad patches with soft edges.

They are painted into the light map and stay where they are: to move them, a further texture unit
would be needed on all that stands on the ground. No OpenGL here.
"""

import numpy as np
from PIL import Image

from landscape.elements.settings import Settings
from landscape.geometry.height_field import HeightField, lookup

# All chosen.
ACROSS = 2.6  # units: how far apart clouds are
FROM, TO = 0.05, 1.05  # values of the noise between which a shadow begins and is full
SHORE, INLAND = 0.06, 0.34  # units above the water between which shadows become full
MAP = 512  # texels a side, of the heights and of the shadows on trees
FINE = 0.35  # how much smaller lobes add to its edge
SEED = 798  # of which the castle on its hill and the rabbit stand in the sun


def clouds_shade(settings: Settings) -> bool:
    """Return whether clouds shade the land: by day alone, where shadows are baked."""
    ground = settings.ground
    return ground.clouds > 0.0 and ground.shadows and not settings.sun.relit


def octave(number: int, cells: int) -> np.ndarray:
    """Return smooth noise of deviation 1, ``cells`` + 3 knots a side; no two numbers are alike."""
    values = np.random.default_rng([SEED, number]).standard_normal((cells + 3,) * 2)
    return np.asarray(values / max(float(values.std()), 1e-3), np.float32)


def cloud_cover(field: HeightField, side: int) -> np.ndarray:
    """Return 0..1, float32 (side, side): how far clouds hide the sun, which shines on beaches."""
    size = field.size
    total = np.zeros((side, side), np.float32)
    for number, (weight, each) in enumerate(((1.0, ACROSS), (FINE, ACROSS / 3))):
        cells = max(round(size / each), 1)
        image = Image.fromarray(octave(number, cells))
        part = image.resize((side, side), Image.Resampling.BICUBIC, (1, 1, cells + 1, cells + 1))
        total += weight * np.asarray(part)
    along = np.clip((total - FROM) / (TO - FROM), 0.0, 1.0)
    at = (np.arange(MAP) + 0.5) / MAP * size
    above = field.terrain_height(at[None, :], at[:, None]) - field.water_level
    inland = np.clip((above - SHORE) / (INLAND - SHORE), 0.0, 1.0).astype(np.float32)
    wide = Image.fromarray(inland).resize((side, side), Image.Resampling.BILINEAR)
    return np.asarray(along * along * (3.0 - 2.0 * along) * np.asarray(wide))


def cloud_light(settings: Settings, field: HeightField, x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Return the light that clouds leave at x, z in units: factors (n, 3) on colours."""
    hidden = settings.ground.clouds * lookup(
        cloud_cover(field, MAP)[..., None], *(np.asarray(each) / field.size for each in (x, z))
    )
    return np.asarray(1.0 - hidden * (1.0 - np.array(settings.sun.shade)))
