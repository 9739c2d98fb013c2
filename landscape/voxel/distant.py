"""Regions far away: their blocks joined by eight, so that there are a third as many faces.

A cell of 2 x 2 x 2 blocks is solid if any of them is, so that no distant region is lower than it is
drawn from nearby; and it has walls all around, so that no gap shows where a region that is drawn
finely is lower than its distant neighbour. From afar a block measures two pixels.
"""

import numpy as np

from landscape.voxel.blocks import AIR, SOLID, block
from landscape.voxel.faces import EDGE
from landscape.voxel.mesh import Look, RegionMesh, region_mesh


def halved(blocks: np.ndarray) -> np.ndarray:
    """Return blocks [x, z, y] joined by eight: each of the uppermost that is solid, or else air.

    The sides need not be even: beyond them is air.
    """
    odd = [(0, side % 2) for side in blocks.shape]
    solid = np.pad(np.where(SOLID[blocks], blocks, AIR), odd)
    found = np.zeros([side // 2 for side in solid.shape], np.uint8)
    for y in (1, 0):
        for x, z in ((0, 0), (1, 0), (0, 1), (1, 1)):
            found = np.where(found == AIR, solid[x::2, z::2, y::2], found)
    return found


def distant_mesh(
    blocks: np.ndarray, origin: tuple[int, int, int], look: Look, merge: str
) -> RegionMesh:
    """Return the mesh of a region far away; blocks and ``origin`` are those of its other meshes.

    Plants are left out, and corners are not darker.
    """
    x, z, low = origin
    inner = blocks[EDGE:-EDGE, EDGE:-EDGE]
    bottom = low - EDGE
    if bottom % 2:  # cells of all regions begin at even levels
        inner = np.concatenate([inner[:, :, :1], inner], axis=2)
        bottom -= 1
    cells = np.pad(halved(inner), EDGE)
    cells[:, :, 0] = block("rock")
    steps = 2 * np.arange(cells.shape[0])
    across, along = (np.minimum(at + steps, len(look.tint) - 1) for at in (x, z))
    tint = look.tint[np.ix_(across, along)]
    mesh = region_mesh(
        cells, (0, 0, 0), Look(look.light, tint, look.overlap), merge, False, plants=False
    )
    mesh.vertices["position"] *= 2
    mesh.vertices["position"] += np.array([x, bottom, z], np.float32)
    mesh.vertices["coordinate"] *= 2
    return mesh
