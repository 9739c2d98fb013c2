"""Occlusion by hills: how high a region's faces must reach to be seen over the ground before them.

Technique: from where the eye is, the ground is looked up along lines in all directions. In each
direction the steepest line of sight that the ground has blocked so far, the horizon, only rises
with distance, so that what lies behind must reach above it. Within a region faces are sorted by
height, and those that the horizon hides are not sent.
Nothing visible may be left out, so heights are the lowest ones around each point: as wide as lines
are apart, and as far as the eye may move within a cell, for which the horizon is kept. The ground
is what is solid from the bottom up; leaves have holes. No OpenGL.
What is wrong without: nothing can be seen of it, but ``voxel.horizon`` counts in a measurement.
"""

import math
from itertools import pairwise

import numpy as np

from landscape.voxel.blocks import LEAFY, SOLID, looked_up
from landscape.voxel.faces import AT_ONCE

AZIMUTHS = 256  # chosen: directions in which lines go
CELL = 1  # blocks, chosen: side of the cells of the eye for which a horizon is kept
NEAREST, FARTHEST = 3.0, 350.0  # blocks, chosen: where lines begin and end
STEP, GROWTH = 1.5, 1 / 24  # blocks, and of the distance, chosen: how far points are apart
# Blocks: within so many of a point its ground is the lowest. Each holds up to the distance at which
# half the gap between two lines and the way of the eye within its cell are as much.
REACHES = (1, 2, 3, 6)
BORDER = 2 * REACHES[-1]  # columns of air around the map
ASIDE = CELL / math.sqrt(2)  # blocks: from the middle of a cell to its corner
CLEAR = 0.25  # blocks, chosen: air around the eye: what the near plane cuts off hides nothing
MARGIN = 0.1  # blocks, chosen: faces are drawn a little larger than they are
OPAQUE = SOLID & ~LEAFY


def solid_heights(blocks: np.ndarray) -> np.ndarray:
    """Return how many blocks of each column [x, z, y] are opaque from the bottom up.

    They are uint8 if that is enough, since a large map has four million columns, and there are five
    such arrays.
    """
    found = np.empty(blocks.shape[:2], np.min_scalar_type(blocks.shape[2]))
    many = max(1, AT_ONCE // blocks[0].size)
    for start in range(0, len(blocks), many):
        opaque = looked_up(OPAQUE, blocks[start : start + many])
        height = opaque.argmin(axis=2)
        found[start : start + many] = np.where(
            (height == 0) & opaque[:, :, 0], opaque.shape[2], height
        )
    return found


def lowest(heights: np.ndarray, reach: int) -> np.ndarray:
    """Return the lowest of heights (n, m) within ``reach`` of those not so near a border."""
    found = heights
    for axis in (0, 1):
        size = found.shape[axis] - 2 * reach
        parts = [(slice(None),) * axis + (slice(k, k + size),) for k in range(2 * reach + 1)]
        least = found[parts[0]].copy()
        for part in parts[1:]:  # one by one: all at once would be an array many times as large
            np.minimum(least, found[part], out=least)
        found = least
    return found


def distances_along() -> np.ndarray:
    """Return the distances (m,) in blocks of the points of a line."""
    found = [NEAREST]
    while found[-1] < FARTHEST:
        found.append(found[-1] + max(STEP, GROWTH * found[-1]))
    return np.array(found, np.float32)


ALONG = distances_along()
GAPS = ALONG * math.sin(math.pi / AZIMUTHS) + ASIDE
ROWS = [slice(*np.searchsorted(GAPS, ends)) for ends in pairwise((0, *REACHES))]
ANGLES = (np.arange(AZIMUTHS) + 0.5) * (2 * math.pi / AZIMUTHS)
# The columns (2, m, AZIMUTHS) of the points of all lines from the middle of the first cell on.
LINES = np.stack([np.cos(ANGLES), np.sin(ANGLES)])[:, None] * ALONG[:, None] + CELL / 2
LINES = np.floor(LINES).astype(np.int32)


class Horizon:
    """The ground, and what of the regions it hides from the cell of the eye."""

    def __init__(self, heights: np.ndarray, region_size: int) -> None:
        """Note the solid heights (n, n) of the columns, and the size of regions in columns."""
        # Beyond the border nothing hides anything.
        self._padded = np.pad(heights, BORDER)
        self._lowest = [self._around(reach, 0, 0, len(heights)) for reach in REACHES]
        starts = np.arange(len(heights) // region_size) * float(region_size)
        # The corners (2, 4, regions) of the regions along x and z.
        low = np.stack(np.meshgrid(starts, starts, indexing="ij")).reshape(2, -1)
        ends = low, low + region_size
        self._corners = np.stack(
            [np.stack([ends[i][0], ends[k][1]]) for i in (0, 1) for k in (0, 1)], axis=1
        )
        self._cell: tuple[int, int, int] | None = None
        self._hidden = np.zeros(low.shape[1])

    def change(self, x: int, z: int, column: np.ndarray) -> None:
        """Note that the blocks of a column have changed."""
        opaque = OPAQUE[column]
        height = len(column) if opaque.all() else int(opaque.argmin())
        if height == self._padded[x + BORDER, z + BORDER]:
            return
        self._padded[x + BORDER, z + BORDER] = height
        self._cell = None
        for reach, found in zip(REACHES, self._lowest, strict=True):
            x0, z0 = x - reach, z - reach
            part = self._around(reach, x0, z0, 2 * reach + 1)
            a, b = max(x0, 0), max(z0, 0)
            part = part[a - x0 : len(found) - x0, b - z0 : len(found) - z0]
            found[a:, b:][: part.shape[0], : part.shape[1]] = part

    def _around(self, reach: int, x: int, z: int, size: int) -> np.ndarray:
        """Return the lowest heights within ``reach`` of the columns of a square from x, z on."""
        x, z = x + BORDER - reach, z + BORDER - reach
        return lowest(self._padded[x : x + size + 2 * reach, z : z + size + 2 * reach], reach)

    def hidden(self, x: float, z: float, y: float) -> np.ndarray:
        """Return up to which height in blocks nothing of each region can be seen, (regions,).

        ``x``, ``z`` and ``y`` are where the eye is, in blocks; it must be in the air, with CLEAR
        blocks of it on all sides.
        """
        cell = math.floor(x / CELL), math.floor(z / CELL), math.floor(y / CELL)
        if cell != self._cell:
            self._cell = cell
            x0, z0, y0 = (at * CELL for at in cell)
            self._hidden = self._of_regions(x0, z0, y0 + CELL)
        return self._hidden

    def _of_regions(self, x0: int, z0: int, top: int) -> np.ndarray:
        """Return the same for any eye at most as high as ``top`` in the cell that begins there."""
        x, z = self._corners[0] - (x0 + CELL / 2), self._corners[1] - (z0 + CELL / 2)
        size = x[3] - x[0]
        # The nearest point of each region, and its farthest corner.
        near = np.hypot(*(np.maximum(np.maximum(at[0], -at[3]), 0) for at in (x, z)))
        far = np.sqrt(np.maximum(x[0] ** 2, x[3] ** 2) + np.maximum(z[0] ** 2, z[3] ** 2))
        # Between which lines it lies: its corners' directions as seen from those of its middle.
        mx, mz = x[0] + size / 2, z[0] + size / 2
        towards = np.arctan2(mz, mx)
        aside = np.arctan2(mx * z - mz * x, mx * x + mz * z)
        per_line = AZIMUTHS / (2 * math.pi)
        first = np.floor((towards + aside.min(axis=0)) * per_line).astype(np.intp)
        last = np.floor((towards + aside.max(axis=0)) * per_line).astype(np.intp)
        at = np.searchsorted(ALONG, near) - 1  # the last point before it
        many = np.minimum(last - first + 1, AZIMUTHS)
        slope = least(self._horizon(x0, z0, top), np.maximum(at, 0), first, many)
        found = top + slope * np.where(slope > 0, near, far) - MARGIN
        return np.where(at < 0, 0.0, found)

    def _horizon(self, x0: int, z0: int, top: int) -> np.ndarray:
        """Return how steep lines of sight are blocked up to each point of each line, (m, lines)."""
        last = len(self._lowest[0]) - 1
        x, z = (
            np.minimum(np.maximum(line + at, 0), last)
            for at, line in zip((x0, z0), LINES, strict=True)
        )
        at = x * (last + 1) + z
        slope = np.empty(x.shape, np.float32)
        for rows, lowest_there in zip(ROWS, self._lowest, strict=True):
            slope[rows] = lowest_there.ravel()[at[rows]]
        slope -= top
        slope /= ALONG[:, None]
        return np.asarray(np.maximum.accumulate(slope, axis=0))


def least(values: np.ndarray, rows: np.ndarray, first: np.ndarray, many: np.ndarray) -> np.ndarray:
    """Return the least of ``many`` values (k,) from ``first`` on in rows (k,) of values (m, n).

    A row begins again where it ends; at most n values are asked for.
    """
    n = values.shape[1]
    twice = np.concatenate([values, values], axis=1).ravel()
    begin = rows * (2 * n) + first % n
    # Parts are given by where they begin and end. From the last one on each begins before the one
    # before it ends, so that nothing is looked at between two of them.
    order = np.argsort(-begin)
    ends = np.stack([begin, np.minimum(begin + many, len(twice) - 1)], axis=1)[order]
    found = np.empty(len(rows), values.dtype)
    found[order] = np.minimum.reduceat(twice, ends.ravel())[::2]
    return found
