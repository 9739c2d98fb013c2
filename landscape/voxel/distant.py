"""Regions far away: their blocks joined by eight, so that there are a third as many faces.

A cell of 2 x 2 x 2 blocks is solid if any of them is, so that no distant region is lower than it is
drawn from nearby. Its sides have walls wherever blocks of its neighbours leave them free, so that
no gap shows where a region that is drawn finely is lower than its distant neighbour. From afar a
block measures two pixels.
"""

from dataclasses import replace

import numpy as np

from landscape.voxel.blocks import AIR, SOLID, block, looked_up
from landscape.voxel.faces import AT_ONCE, DIRECTIONS, EDGE, Faces, shown_in, visible_faces
from landscape.voxel.mesh import Look, RegionMesh, assembled, part_of
from landscape.voxel.tile_column import WIDEST

CELL = 2  # blocks: side of a cell
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
    """Return what closes the sides of cells, (..., n, h): rock, or air where a wall is needed.

    ``columns`` (..., 2 n, 2 h) are the blocks in front of those sides. Four of them close one.
    """
    odd = [(0, 0)] * (columns.ndim - 2) + [(0, side % 2) for side in columns.shape[-2:]]
    solid = np.pad(looked_up(SOLID, columns), odd)
    lower, upper = solid[..., 0::2], solid[..., 1::2]
    both = lower & upper
    return np.where(both[..., 0::2, :] & both[..., 1::2, :], block("rock"), AIR)


def _with_even_sides(inner: np.ndarray, rows: int, number: int, size: int) -> np.ndarray:
    """Return blocks of rows x number regions, of one column more on each side, which is empty."""
    apart = inner.reshape(rows, size, number, size, -1)
    apart = np.pad(apart, [(0, 0), (0, 1), (0, 0), (0, 1), (0, 0)])
    return apart.reshape(rows * (size + 1), number * (size + 1), -1)


def cells_of(blocks: np.ndarray, size: int) -> np.ndarray:
    """Return the cells of regions of ``size`` columns a side: (rows, n, number, n, h).

    ``blocks`` [x, z, y] have an edge all around. The cells of each region have one of their own,
    but not in height, which is solid only where no wall is needed. If the regions' sides are odd,
    their last cells reach into the next region, and there are always walls.
    """
    rows, number = ((side - 2 * EDGE) // size for side in blocks.shape[:2])
    inner, odd = blocks[EDGE:-EDGE, EDGE:-EDGE], size % 2
    if odd:
        inner = _with_even_sides(inner, rows, number, size)
    halves = halved(inner)
    half, tall = (size + 1) // 2, halves.shape[2]
    side = half + 2 * EDGE
    found = np.zeros((rows, side, number, side, tall), np.uint8)
    within = slice(EDGE, -EDGE)
    found[:, within, :, within] = halves.reshape(rows, half, number, half, tall)

    # The blocks in front of a region: before its first and, if it ends with a whole cell, after its
    # last.
    for end in (0,) if odd else (0, -1):
        first = 0 if end == 0 else size + EDGE
        across = blocks[first::size, within][:rows].reshape(rows, number, size, -1)
        along = blocks[within, first::size][:, :number].reshape(rows, size, number, -1)
        found[:, end, :, within] = closed(across)
        found[:, within, :, end] = closed(along.swapaxes(1, 2)).swapaxes(1, 2)

    return found


def distant_meshes(
    blocks: np.ndarray, size: int, origin: tuple[int, int, int], look: Look, merge: str
) -> list[RegionMesh]:
    """Return the meshes of far away regions of ``size`` columns a side, in rows along z.

    ``blocks`` have an edge all around, and ``origin`` is the place [x, z, y] of the first within.
    Plants are left out, and corners are not darker.
    """
    x, z, low = origin
    bottom = low - EDGE
    if bottom % 2:  # cells of all regions begin at even levels
        blocks = np.concatenate([blocks[:, :, :1], blocks], axis=2)
        bottom -= 1
    own = cells_of(blocks, size)
    rows, side, number, _, tall = own.shape
    whole = np.zeros((*own.shape[:-1], tall + 2 * EDGE), np.uint8)
    whole[..., 0] = block("rock")
    whole[..., EDGE:-EDGE] = own
    cells = whole.reshape(rows * side, number * side, -1)

    # Nothing is drawn of the regions' edges, where their neighbours begin.
    within = np.zeros(whole.shape, bool)
    within[:, EDGE:-EDGE, :, EDGE:-EDGE] = True
    shown = shown_in(cells)
    shown = shown._replace(places=[at[within.ravel()[at]] for at in shown.places])
    look = replace(look, overlap=CELL * look.overlap, firm=CELL * look.firm)
    parts = []
    for direction in DIRECTIONS:
        faces = visible_faces(cells, direction, merge, False, shown, side, WIDEST // CELL)
        row, column = faces.low[:, 0] // side, faces.low[:, 1] // side
        faces = in_blocks(faces)
        # Where the region is, and not where it would be if all had their edges between them.
        faces.low[:, 0] += row * (size - CELL * side)
        faces.low[:, 1] += column * (size - CELL * side)
        parts.append(part_of(faces, row * number + column, (x, z, bottom), look))

    return assembled(parts, rows * number)


def in_blocks(faces: Faces) -> Faces:
    """Return faces of cells as faces of blocks."""
    low = CELL * faces.low
    long = CELL * faces.long
    wide = CELL * faces.wide
    return Faces(faces.direction, low, long, wide, faces.block, faces.shade, CELL, faces.firm)


def distant_mesh(
    blocks: np.ndarray, origin: tuple[int, int, int], look: Look, merge: str
) -> RegionMesh:
    """Return the mesh of one region far away."""
    return distant_meshes(blocks, blocks.shape[1] - 2 * EDGE, origin, look, merge)[0]
