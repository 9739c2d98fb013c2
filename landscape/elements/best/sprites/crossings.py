"""Trees and deer cut where they cross, so that a sort can order the pieces (section 5.1.1).

A sort gives each billboard one place, which is wrong where two of them cross: a part of each is in
front of the other. The report suggests to cut quads into parts and to sort these. Here each of two
that cross is cut along a side of its own that is nearest to the line in which they meet: upright
billboards exactly along that line. Which billboards may cross does not depend on the eye: they
turn, but their places stay. Billboards that are all parallel, as those of 2006, never cross.
No OpenGL here.
"""

from dataclasses import dataclass

import numpy as np

CELL_MARGIN = 1.001  # a cell is at least as wide as the widest billboard
INSIDE = 0.02  # chosen: of the side; a cut nearer to an edge would leave a sliver


@dataclass(frozen=True)
class Pieces:
    """Parts of billboards: whose they are (m,), and their boxes s0, t0, s1, t1 (m, 4) in 0..1.

    s runs from left to right and t from top to bottom, as in a billboard's texture coordinates.
    """

    owner: np.ndarray
    boxes: np.ndarray


def neighbours(positions: np.ndarray, widths: np.ndarray) -> np.ndarray:
    """Return the pairs (m, 2) of indices of billboards that may cross, whichever way they turn.

    ``positions`` (n, 3) are their feet's middles, ``widths`` (n,) the widths. They may if their
    middles are nearer to each other than the half widths together, in x and z.
    """
    if len(positions) < 2:
        return np.empty((0, 2), int)
    x, z = positions[:, 0], positions[:, 2]
    side = float(widths.max()) * CELL_MARGIN
    column, row = (np.floor((a - a.min()) / side).astype(int) for a in (x, z))
    across = int(column.max()) + 3
    cell = (row + 1) * across + column + 1
    order = np.argsort(cell, kind="stable")
    sorted_cells = cell[order]
    found = []

    # Each pair is found once: in the same cell, or in one of four of the eight around it.
    for step in (0, 1, across - 1, across, across + 1):
        first = np.searchsorted(sorted_cells, cell + step, "left")
        count = np.searchsorted(sorted_cells, cell + step, "right") - first
        one = np.repeat(np.arange(len(cell)), count)
        nth = np.arange(len(one)) - np.repeat(np.cumsum(count) - count, count)
        other = order[np.repeat(first, count) + nth]
        kept = one < other if step == 0 else np.ones(len(one), bool)
        found.append(np.stack([one[kept], other[kept]], axis=1))

    pairs = np.concatenate(found)
    one, other = pairs.T
    near = np.hypot(x[one] - x[other], z[one] - z[other]) < 0.5 * (widths[one] + widths[other])
    return np.asarray(pairs[near])


def cuts(quads: np.ndarray, pairs: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the cuts of billboards ``quads`` (n, 4, 3) of which ``pairs`` (m, 2) may cross.

    These are, for each cut, the billboard, whether it is at one s (or else at one t), and where.
    """
    one = np.concatenate([pairs[:, 0], pairs[:, 1]])
    other = np.concatenate([pairs[:, 1], pairs[:, 0]])
    # What all cuts have of a coordinate is in one row, as are the corners of all billboards.
    corners = quads.transpose(1, 2, 0)
    spans = np.stack([corners[0], corners[1] - corners[0], corners[3] - corners[0]])
    low, across, rise = spans.take(one, axis=2)
    low_b, across_b, rise_b = spans.take(other, axis=2)
    normal = _across(across_b, rise_b)
    start = _along(low - low_b, normal)
    by_s, by_u = _along(across, normal), _along(rise, normal)
    at_s = np.abs(by_s) >= np.abs(by_u)
    slope = np.where(at_s, by_s, by_u)
    steady = np.abs(slope) > 1e-9 * np.sqrt(_along(normal, normal))
    at = -(start + 0.5 * np.where(at_s, by_u, by_s)) / np.where(steady, slope, 1.0)

    # The two meet only where that line is on the other one, too.
    s, u = np.where(at_s, at, 0.5), np.where(at_s, 0.5, at)
    point = low + s * across + u * rise - low_b
    there_s = _along(point, across_b) / _along(across_b, across_b)
    there_u = _along(point, rise_b) / _along(rise_b, rise_b)
    meets = (np.abs(there_s - 0.5) < 0.5) & (np.abs(there_u - 0.5) < 0.5)
    meets &= steady & (np.abs(at - 0.5) < 0.5 - INSIDE)
    return one[meets], at_s[meets], np.where(at_s, at, 1.0 - at)[meets]


def _across(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Return the cross products of vectors (3, n)."""
    x = a[1] * b[2] - a[2] * b[1]
    y = a[2] * b[0] - a[0] * b[2]
    z = a[0] * b[1] - a[1] * b[0]
    return np.stack([x, y, z])


def _along(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Return the dot products (n,) of vectors (3, n)."""
    return np.asarray(a[0] * b[0] + a[1] * b[1] + a[2] * b[2])


def cut(owner: np.ndarray, at_s: np.ndarray, at: np.ndarray) -> Pieces:
    """Return the pieces of all billboards that have a cut; each may have several."""
    whole = np.unique(owner)
    pieces = Pieces(whole, np.tile([0.0, 0.0, 1.0, 1.0], (len(whole), 1)))
    # The k-th cut of every billboard at once: the rounds are as many as a billboard has cuts.
    order = np.argsort(owner, kind="stable")
    first = np.searchsorted(owner[order], owner[order], "left")
    nth = np.arange(len(order)) - first
    for k in range(int(nth.max()) + 1 if len(nth) else 0):
        chosen = order[nth == k]
        where = np.full(int(whole.max()) + 1, np.nan)
        along = np.zeros(len(where), int)
        where[owner[chosen]] = at[chosen]
        along[owner[chosen]] = np.where(at_s[chosen], 0, 1)
        pieces = _halved(pieces, where[pieces.owner], along[pieces.owner])
    return pieces


def _halved(pieces: Pieces, at: np.ndarray, axis: np.ndarray) -> Pieces:
    """Return pieces, of which those that contain ``at`` on their ``axis`` (0 s, 1 t) are two."""
    rows = np.arange(len(axis))
    # A comparison with nan, of a billboard without another cut, is false.
    inside = (at > pieces.boxes[rows, axis]) & (at < pieces.boxes[rows, axis + 2])
    more = pieces.boxes[inside].copy()
    boxes = pieces.boxes.copy()
    boxes[rows[inside], axis[inside] + 2] = at[inside]
    more[np.arange(len(more)), axis[inside]] = at[inside]
    return Pieces(
        np.concatenate([pieces.owner, pieces.owner[inside]]), np.concatenate([boxes, more])
    )
