"""The wet band along the shore: sand and rock that the waves have just left are darker.

Water in the pores of sand and rock bends light into them, where it is lost. The band reaches as
high as the waves run up: farther on a beach, which is flat, but higher on a rock, where they break.
It is painted into the large texture of the ground. No OpenGL here.
"""

import numpy as np
from PIL import Image

from landscape.geometry.height_field import HeightField

RUN_UP = 0.016  # chosen: units above the water that waves wet on a beach
SPLASH = 0.02  # chosen: and in addition on a rock, by the slope, rise over run, up to 1
SOFT = 0.5  # chosen: fraction of its height over which the band fades out
RAGGED = 0.7  # chosen: by which fraction the height varies along the shore
PATCH = 0.3  # chosen: units, size of the tongues of its edge
DARKER = np.array([0.66, 0.65, 0.66])  # chosen: factor on the colour where it is wet
DEEPEST = 0.5  # chosen: units of depth below which no bed is seen
BLOCKS = 512  # per side of the map, by which the neighbourhood of the shore is found
SEED = 2006  # chosen


def noise(side: int, size: float) -> np.ndarray:
    """Return smooth noise over a map of ``size`` units, float32 (side, side), about -1..1."""
    knots = max(int(size / PATCH), 2)
    coarse = np.random.default_rng(SEED).uniform(-1.0, 1.0, (knots, knots)).astype(np.float32)
    fine = Image.fromarray(coarse).resize((side, side), Image.Resampling.BICUBIC)
    return np.asarray(fine)


def wetness(above: np.ndarray, slope: np.ndarray, ragged: np.ndarray) -> np.ndarray:
    """Return how wet the ground is, 0..1, by its height above the water in units, and its slope.

    ``ragged`` is noise of -1..1, of the same shape.
    """
    top = (RUN_UP + SPLASH * np.minimum(slope, 1.0)) * (1.0 + RAGGED * ragged)
    return np.asarray(np.clip((1.0 - above / top) / SOFT, 0.0, 1.0))


def wet_texels(field: HeightField, side: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the texels that are wet, int32 (m,) in row order, and how wet, uint8 (m,)."""
    block = (np.arange(BLOCKS) + 0.5) / BLOCKS * field.size
    top = field.water_level + (RUN_UP + SPLASH) * (1 + RAGGED)
    heights = field.terrain_height(block[None, :], block[:, None])
    near = (heights < top) & (heights > field.water_level - DEEPEST)
    wide = np.pad(near, 1)
    near = wide[:-2, 1:-1] | near | wide[2:, 1:-1] | wide[1:-1, :-2] | wide[1:-1, 2:]
    at = np.minimum(np.arange(side) * BLOCKS // side, BLOCKS - 1)
    rows, columns = np.nonzero(near[at][:, at])
    x, z = ((a + 0.5) / side * field.size for a in (columns, rows))
    above = field.terrain_height(x, z) - field.water_level
    found = wetness(above, field.slope(x, z), noise(side, field.size)[rows, columns])
    wet = np.rint(found * 255).astype(np.uint8)
    kept = wet > 0
    return (rows * side + columns)[kept].astype(np.int32), wet[kept]


def dampened(painted: np.ndarray, texels: np.ndarray, wet: np.ndarray) -> np.ndarray:
    """Return colours, uint8 (n, n, 3 or 4), darker at the texels (m,) by how wet they are (m,)."""
    out = painted.copy()
    flat = out.reshape(-1, painted.shape[2])
    factor = 1.0 + (DARKER.astype(np.float32) - 1.0) * (wet[:, None] / np.float32(255))
    flat[texels, :3] = np.rint(flat[texels, :3] * factor).astype(np.uint8)
    return out
