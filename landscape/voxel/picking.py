"""Which block is under the cross-hair: a walk along the line of sight from cell to cell.

Technique: "A Fast Voxel Traversal Algorithm for Ray Tracing" (Amanatides and Woo 1987). Along each
axis it is known how far along the ray the next boundary between cells is; the nearest of the three
says into which cell the ray goes next. No cell is missed, and none is visited twice.
"""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from landscape.voxel.blocks import AIR
from landscape.voxel.world import Cell


class Hit(NamedTuple):
    """The block that a ray meets, and the empty cell before it, both [x, z, y].

    They are the same if the ray begins in the block.
    """

    block: Cell
    before: Cell


def picked_through_water(
    blocks: np.ndarray,
    eye: Sequence[float],
    way: Sequence[float],
    reach: float,
    level: float,
    flatter: float,
) -> Hit | None:
    """Return the same as :func:`picked` for a line of sight that the water at ``level`` bends.

    What lies under it is seen at ``flatter`` times its depth, and from under it what lies above at
    so much more than its height. So beyond the surface the line is steeper, or less steep.
    """
    under = eye[2] < level
    gone = (level - eye[2]) / way[2] if way[2] else math.inf
    if not 0.0 < gone < reach:
        return picked(blocks, eye, way, reach)
    if (hit := picked(blocks, eye, way, gone)) is not None:
        return hit
    met = [at + gone * each for at, each in zip(eye, way, strict=True)]
    met[2] = level
    bent = way[0], way[1], way[2] * (flatter if under else 1.0 / flatter)
    return picked(blocks, met, bent, reach - gone)


def picked(
    blocks: np.ndarray, eye: Sequence[float], way: Sequence[float], reach: float
) -> Hit | None:
    """Return the first block that is not air on a ray from ``eye``, at most ``reach`` blocks away.

    ``blocks`` is [x, z, y], and so are ``eye``, in blocks, and the vector ``way``: ``reach`` counts
    how often it is gone.
    """
    cell = [math.floor(each) for each in eye]
    step = [1 if each > 0 else -1 for each in way]

    # Per axis: how far along the ray its next boundary is, and how far apart its boundaries are.
    apart = [1 / abs(each) if each else math.inf for each in way]
    next_ = [
        (at + 1 - p if s > 0 else p - at) * far if math.isfinite(far) else math.inf
        for at, p, s, far in zip(cell, eye, step, apart, strict=True)
    ]
    before = cell[0], cell[1], cell[2]
    gone = 0.0
    while gone <= reach:
        here = cell[0], cell[1], cell[2]
        inside = all(0 <= at < end for at, end in zip(here, blocks.shape, strict=True))
        if inside and blocks[here] != AIR:
            return Hit(here, before)
        before = here
        axis = next_.index(min(next_))
        gone = next_[axis]
        cell[axis] += step[axis]
        next_[axis] += apart[axis]

    return None
