"""Detail that the height image lacks: unevenness where the land is gentle, ledges where steep.

The image is so smooth that the steps between levels would be contour lines, and steep rock a
regular staircase. Ledges as of layers of rock, hard and soft in turn, make cliffs of it, with
treads wide enough for grass and snow.
"""

from dataclasses import replace

import numpy as np

from landscape.voxel.heights import Heights
from landscape.voxel.materials import variation

# All chosen: how much, in blocks, and how finely in columns. Each rise over run is that of the land
# that Heights compares with.
ROUGH, ROUGH_SIZE = 0.55, 9.0
# On level land so much of it that there are no pits, and all of it from this rise over run.
LEAST_ROUGH, UNEVEN = 0.25, 0.3
CRAG, CRAG_SIZE = 1.1, 6.0  # the same on rock
LEDGE = 8.0  # blocks from one ledge to the next
BENT, BENT_SIZE = 5.0, 42.0  # blocks by which the layers are bent, over how many columns
SHARP = 0.72  # how much of a ledge is made level; 1 is steps
GENTLE, STEEP = 0.7, 1.25  # rise over run from where, and to where, ledges set in


def roughened(smooth: Heights) -> Heights:
    """Return heights (n, n) with unevenness, ledges and crags, the same ones every time."""
    field, side = smooth.field, len(smooth.field)
    rng = np.random.default_rng(0)
    steep = smooth.steepness / np.float32(smooth.grade)
    even = np.clip(steep / UNEVEN, LEAST_ROUGH, 1.0)
    rough = ROUGH * even * variation(side, ROUGH_SIZE, rng)
    rocky = np.clip((steep - GENTLE) / (STEEP - GENTLE), 0.0, 1.0)
    bent = BENT * variation(side, BENT_SIZE, rng)
    crag = CRAG * variation(side, CRAG_SIZE, rng)
    layer = (field + bent) / LEDGE
    within = layer - np.floor(layer)
    # 0 to 1 within each layer, level at both ends (Perlin 2002).
    eased = within**3 * (within * (within * 6 - 15) + 10)
    ledges = LEDGE * SHARP * (eased - within)
    return replace(smooth, field=(field + rough + rocky * (ledges + crag)).astype(np.float32))
