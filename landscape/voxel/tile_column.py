"""All tiles in one texture, one above the other, so that one glMultiDrawArrays draws all land.

Faces with a texture of their own for each tile would need a call for each tile, and could not be
sent from near to far. GL_REPEAT repeats a texture as a whole: in a column it repeats a tile along
s, and each tile is there several times along t, once for each block that a merged face may be wide.
Half a tile more above and below keeps neighbours apart: even in the mip level in which a tile is
one texel, linear filtering reads only texels of the same tile.
"""

import numpy as np

from landscape.voxel.blocks import TILES
from landscape.voxel.tiles import SIDE

ROWS = 256  # tiles one above the other, chosen: 8192 texels, which is as many as most allow
PLACES = ROWS // len(TILES)  # in the column, for each tile
WIDEST = PLACES - 1  # blocks: how wide a face may be; half a tile more is above it and below


def first_row(tile: np.ndarray) -> np.ndarray:
    """Return where the first of the repeated tiles begins, in tiles from the column's top."""
    return np.asarray(PLACES * tile + 0.5)


def column(pictures: list[np.ndarray]) -> np.ndarray:
    """Return the column, uint8 (ROWS * SIDE, SIDE, 4), of the pictures of TILES.

    They are (SIDE, SIDE, 3), or 4 if they have holes.
    """
    found = np.full((ROWS, SIDE, SIDE, 4), 255, np.uint8)
    for tile, picture in enumerate(pictures):
        found[tile * PLACES : (tile + 1) * PLACES, ..., : picture.shape[2]] = np.roll(
            picture, SIDE // 2, axis=0
        )
    return found.reshape(-1, SIDE, 4)
