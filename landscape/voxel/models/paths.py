"""Paths that feet have worn: from the castle's gate to all that one may want to reach.

Each is the easiest way over the land (Dijkstra 1959), and all that begin alike share their first
part. No OpenGL.
"""

import heapq

import numpy as np

from landscape.voxel.materials import variation

# All chosen. Ways are looked for on a grid of so many columns a side at most, of STEP or more each.
GRID, STEP = 125, 4
CLIMB = 3.0  # how much longer a way seems for each unit of rise over run, squared
WET = 40.0  # and under water
WIDE, UNEVEN = 1.25, 0.75  # columns: half the width, and by how much it varies
FINE = 0.5  # columns between the points of a way
SMOOTH = 5  # points of the grid that a bend is drawn out over
Place = tuple[int, int]


def ways(tops: np.ndarray, sea: int, start: Place, ends: list[Place]) -> list[np.ndarray]:
    """Return the easiest way from one column x, z to each of others, each float64 (m, 2)."""
    step = max(STEP, -(-len(tops) // GRID))
    ground = tops[step // 2 :: step, step // 2 :: step].astype(np.float64)
    last = len(ground) - 1
    before = _tree(ground, step, sea, (min(start[0] // step, last), min(start[1] // step, last)))
    found = []
    for end in ends:
        cell = min(end[0] // step, last) * len(ground) + min(end[1] // step, last)
        cells = []
        while cell >= 0:
            cells.append(divmod(cell, len(ground)))
            cell = int(before[cell])
        points = (np.array(cells[::-1]) + 0.5) * step
        points[0], points[-1] = start, end
        found.append(_drawn_out(points))
    return found


def _tree(ground: np.ndarray, step: int, sea: int, start: Place) -> np.ndarray:
    """Return from which cell of a grid of heights (n, n) one comes to each; -1 at the start."""
    side = len(ground)
    flat = ground.ravel().tolist()
    cost, before = [np.inf] * len(flat), np.full(len(flat), -1)
    first = start[0] * side + start[1]
    cost[first] = 0.0
    queue = [(0.0, first)]
    around = [(i, k, float(np.hypot(i, k))) for i in (-1, 0, 1) for k in (-1, 0, 1) if i or k]
    while queue:
        so_far, cell = heapq.heappop(queue)
        if so_far > cost[cell]:
            continue
        x, z = divmod(cell, side)
        for i, k, far in around:
            if not (0 <= x + i < side and 0 <= z + k < side):
                continue
            other = (x + i) * side + z + k
            slope = (flat[other] - flat[cell]) / (step * far)
            total = so_far + far * (1.0 + CLIMB * slope**2 + WET * (flat[other] < sea))
            if total < cost[other]:
                cost[other], before[other] = total, cell
                heapq.heappush(queue, (total, other))

    return before


def _drawn_out(points: np.ndarray) -> np.ndarray:
    """Return a way (m, 2) through points (n, 2) of a grid, without their corners."""
    padded = np.pad(points, ((SMOOTH // 2, SMOOTH // 2), (0, 0)), mode="edge")
    mean = np.ones(SMOOTH) / SMOOTH
    even = np.stack([np.convolve(axis, mean, "valid") for axis in padded.T], axis=1)
    even[0], even[-1] = points[0], points[-1]
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(even, axis=0).T))])
    at = np.arange(0.0, along[-1] + FINE, FINE)
    return np.stack([np.interp(at, along, axis) for axis in even.T], axis=1)


def worn(side: int, lines: list[np.ndarray], rng: np.random.Generator) -> np.ndarray:
    """Return which columns (side, side) lie on ways, of uneven width, bool."""
    found = np.zeros((side, side), bool)
    wide = WIDE + UNEVEN * variation(side, 6.0, rng)
    reach = int(np.ceil(WIDE + 2 * UNEVEN))
    offsets = np.arange(-reach, reach + 1)
    for line in lines:
        x, z = np.rint(line).astype(int).T
        for i in offsets:
            for k in offsets:
                a, b = x + i, z + k
                inside = (np.minimum(a, b) >= 0) & (np.maximum(a, b) < side)
                a, b = a[inside], b[inside]
                away = np.hypot(a + 0.5 - line[inside, 0], b + 0.5 - line[inside, 1])
                near = away <= wide[a, b]
                found[a[near], b[near]] = True
    return found
