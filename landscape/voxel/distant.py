"""Regions far away: their blocks joined by eight, so that there are a third as many faces.

A cell of 2 x 2 x 2 blocks is solid if any of them is, so that no distant region is lower than it is
drawn from nearby. Its sides have walls wherever blocks of its neighbours leave them free, so that
no gap shows where a region that is drawn finely is lower than its distant neighbour. From afar a
block measures two pixels.
"""

from dataclasses import replace

import numpy as np

from landscape.voxel.blocks import AIR, SOLID, block, looked_up
from landscape.voxel.faces import AT_ONCE, EDGE
from landscape.voxel.mesh import Look, RegionMesh, region_meshes

SOLID_KIND = np.where(SOLID, np.arange(len(SOLID)), AIR).astype(np.uint8)  # the others are air


def halved(blocks: np.ndarray) -> np.ndarray:
    """Return blocks [x, z, y] joined by eight: each of the uppermost that is solid, or else air.

    The sides need not be even: beyond them is air.
    """
    found = np.zeros([-(-side // 2) for side in blocks.shape], np.uint8)
    _, deep, tall = blocks.shape
    odd = (deep % 2, tall % 2)
    many = max(2, AT_ONCE // (deep * tall) // 2 * 2)
    for start in range(0, len(blocks), many):
        solid = looked_up(SOLID_KIND, blocks[start : start + many])
        solid = np.pad(solid, [(0, len(solid) % 2), *((0, more) for more in odd)])
        # Of four columns to one; both levels are still side by side, which is faster.
        kinds = solid[0::2, 0::2]
        for x, z in ((1, 0), (0, 1), (1, 1)):
            kinds = np.where(kinds == AIR, solid[x::2, z::2], kinds)
        lower, upper = kinds[:, :, 0::2], kinds[:, :, 1::2]
        found[start // 2 :][: len(kinds)] = np.where(upper == AIR, lower, upper)
    return found


def closed(columns: np.ndarray) -> np.ndarray:
    """Return what closes the sides of cells, (n, h): rock, or air where a wall is needed.

    ``columns`` (2 n, 2 h) are the blocks in front of those sides. Four of them close one.
    """
    solid = np.pad(looked_up(SOLID, columns), [(0, side % 2) for side in columns.shape])
    every = solid[::2, ::2] & solid[1::2, ::2] & solid[::2, 1::2] & solid[1::2, 1::2]
    return np.where(every, block("rock"), AIR)


def cells_of(blocks: np.ndarray) -> np.ndarray:
    """Return the cells of one region's blocks, both with an edge all around, but not in height.

    The edge of the cells is solid only where no wall is needed. If the sides are odd, the last
    cells reach into the next region, and there are always walls.
    """
    found = np.pad(halved(blocks[EDGE:-EDGE, EDGE:-EDGE]), [(EDGE, EDGE), (EDGE, EDGE), (0, 0)])
    deep, side = (each - 2 * EDGE for each in blocks.shape[:2])
    found[0, EDGE:-EDGE] = closed(blocks[0, EDGE:-EDGE])
    found[EDGE:-EDGE, 0] = closed(blocks[EDGE:-EDGE, 0])
    if deep % 2 == 0:
        found[-1, EDGE:-EDGE] = closed(blocks[-1, EDGE:-EDGE])
    if side % 2 == 0:
        found[EDGE:-EDGE, -1] = closed(blocks[EDGE:-EDGE, -1])
    return found


def distant_meshes(
    blocks: np.ndarray, size: int, origin: tuple[int, int, int], look: Look, merge: str
) -> list[RegionMesh]:
    """Return the meshes of far away regions of ``size`` columns, one after the other along z.

    ``blocks`` have an edge all around, and ``origin`` is the place [x, z, y] of the first within.
    Plants are left out, and corners are not darker.
    """
    x, z, low = origin
    bottom = low - EDGE
    if bottom % 2:  # cells of all regions begin at even levels
        blocks = np.concatenate([blocks[:, :, :1], blocks], axis=2)
        bottom -= 1
    starts = range(0, blocks.shape[1] - 2 * EDGE, size)
    parts = [cells_of(blocks[:, start : start + size + 2 * EDGE]) for start in starts]
    cells = np.pad(np.concatenate(parts, axis=1), [(0, 0), (0, 0), (EDGE, EDGE)])
    cells[:, :, 0] = block("rock")
    deep, side = parts[0].shape[:2]
    last = len(look.tint) - 1
    across = np.minimum(x + 2 * np.arange(deep), last)
    along = [np.minimum(z + start + 2 * np.arange(side), last) for start in starts]
    tint = look.tint[np.ix_(across, np.concatenate(along))]
    shore = (look.shore[0] - bottom) / 2, (look.shore[1] - bottom) / 2
    of_cells = replace(look, tint=tint, shore=shore, band=look.band / 2, repeat=2)
    meshes = region_meshes(cells, side, (0, 0, 0), of_cells, merge, occlusion=False, plants=False)
    for k, (start, mesh) in enumerate(zip(starts, meshes, strict=True)):
        mesh.vertices["position"] *= 2
        mesh.vertices["position"] += np.array([x, bottom, z + start - 2 * k * side], np.float32)
    return meshes


def distant_mesh(
    blocks: np.ndarray, origin: tuple[int, int, int], look: Look, merge: str
) -> RegionMesh:
    """Return the mesh of one region far away."""
    return distant_meshes(blocks, blocks.shape[1] - 2 * EDGE, origin, look, merge)[0]
