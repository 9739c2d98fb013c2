"""Which trunks may be solid so that a walker can get everywhere. No OpenGL.

Trunks too close together to pass between form walls, and a ring of them would be a prison. Each
trunk widened by the walker's radius is a disc that his centre cannot enter. A trunk stays passable
if its disc would close a ring: then the discs have no holes, and the rest of the map is connected.
"""

import math
from collections.abc import Iterable, Sequence
from itertools import islice

import numpy as np

from landscape.files.cache import recall
from landscape.geometry.obstacle_grid import ObstacleGrid, Obstacles
from landscape.geometry.obstacles import MARGIN, RADIUS, Obstacle

SLACK = 0.002  # chosen: units to spare in the narrowest gap that counts as passable
CROWD = 4  # chosen: a trunk that overlaps more than these stands in a thicket, and is left out

Disc = tuple[float, float, float]  # x, z, radius


def passable(few: Sequence[Obstacle], many: Sequence[np.ndarray], size: float) -> Obstacles:
    """Return the obstacles ``few`` and those of ``many`` towers, (n, 4) each, that may be solid."""
    if not many:
        return few
    towers = np.concatenate(many)
    what = "solid towers", repr((few, size)), towers.tobytes()
    (passed,) = recall(what, lambda: (without_pockets(towers, size, few),))
    return ObstacleGrid(few, towers[passed])


def without_pockets(towers: np.ndarray, size: float, others: Iterable[Obstacle] = ()) -> np.ndarray:
    """Return which of ``towers`` (n, 4) = x, z, radius, top may be solid, bool (n,).

    Not those that would enclose a place with each other, with one of the ``others``, or with the
    border of the map of ``size`` units.
    """
    discs = np.stack([towers[:, 0], towers[:, 1], towers[:, 2] + RADIUS + SLACK], axis=1)
    x, z, radius = discs.T
    free = np.asarray(np.minimum.reduce([x, z, size - x, size - z]) > MARGIN + radius)
    for other in others:
        away = np.hypot(x - other.x, z - other.z) - radius
        for k in np.flatnonzero(free & (away < other.extent + RADIUS + SLACK)):
            free[k] = other.gap(x[k], z[k])[0] > radius[k] + RADIUS + SLACK
    return _without_holes(discs, free)


def _without_holes(discs: np.ndarray, candidates: np.ndarray) -> np.ndarray:
    """Return the ``candidates`` (n,) among discs (n, 3), added in order while no hole appears.

    A disc makes no hole if it meets each connected group of the discs before it in one piece.
    """
    side = 2.0 * float(discs[:, 2].max(initial=RADIUS))
    cells: dict[tuple[int, int], list[int]] = {}
    group = list(range(len(discs)))
    solid = np.zeros(len(discs), bool)
    rows: list[Disc] = [tuple(row) for row in discs.tolist()]
    for k in np.flatnonzero(candidates).tolist():
        x, z, radius = rows[k]
        column, row = int(x // side), int(z // side)
        meeting = (
            other
            for i in (column, column - 1, column + 1)
            for j in (row, row - 1, row + 1)
            for other in cells.get((i, j), ())
            if math.hypot(rows[other][0] - x, rows[other][1] - z) < radius + rows[other][2]
        )
        near = list(islice(meeting, CROWD + 1))
        if len(near) > CROWD:
            continue
        groups: dict[int, list[int]] = {}
        for other in near:
            groups.setdefault(_root(group, other), []).append(other)
        if all(_in_one_piece(rows, k, members) for members in groups.values()):
            solid[k] = True
            cells.setdefault((column, row), []).append(k)
            for root in groups:
                group[root] = k

    return solid


def _root(group: list[int], k: int) -> int:
    """Return the disc that stands for the group of disc ``k``."""
    while group[k] != k:
        group[k] = group[group[k]]
        k = group[k]
    return k


def _in_one_piece(discs: list[Disc], k: int, others: list[int]) -> bool:
    """Return whether what disc ``k`` shares with ``others``, which it meets, is connected."""
    reached, waiting = others[:1], others[1:]
    for one in reached:
        for other in [o for o in waiting if _have_common_point(discs[k], discs[one], discs[o])]:
            reached.append(other)
            waiting.remove(other)
    return not waiting


def _have_common_point(a: Disc, b: Disc, c: Disc) -> bool:
    """Return whether three discs share a point; a meets b and c."""
    if math.hypot(b[0] - c[0], b[1] - c[1]) >= b[2] + c[2]:
        return False
    for first, second, third in ((a, b, c), (b, c, a), (c, a, b)):
        dx, dz = second[0] - first[0], second[1] - first[1]
        apart = math.hypot(dx, dz)
        if apart <= abs(first[2] - second[2]):
            return True  # one contains the other, which meets the third
        # The corners of what the two share.
        along = (apart * apart + first[2] ** 2 - second[2] ** 2) / (2.0 * apart)
        across = math.sqrt(max(first[2] ** 2 - along * along, 0.0))
        for side in (-across, across):
            x = first[0] + (along * dx - side * dz) / apart
            z = first[1] + (along * dz + side * dx) / apart
            if math.hypot(x - third[0], z - third[1]) <= third[2]:
                return True
    return False
