"""The lines of a grid of triangles: all edges of each, or each edge once (section 2.3).

A quad is divided by the diagonal from its first corner to its last (figure 4), into the triangles
corner, right, across and corner, across, below. Drawn triangle by triangle, that is six lines a
quad, but inside the grid all edges have two triangles. A triangle strip names each vertex of a row
of triangles once; lines are saved in the same way, by three families of edges, along the rows,
along the columns and the diagonals: three lines a quad. A tile has the edges on its first row and
column; those on its last belong to the next tile.

On the way to the next level of detail (see :mod:`.levels`) every second row and column of edges
comes ever closer to the one before it, and dark bands of double lines would lie around the camera.
So those edges vanish on the way: each is drawn the shorter the farther its vertices have glided.
But one that is an outline, with one triangle that faces the camera, stays whole: the edge that it
glides to need not be one.
"""

from dataclasses import dataclass

import numpy as np

Facing = tuple[np.ndarray, np.ndarray]
FAMILIES = ((0, 1), (1, 0), (1, 1))  # rows and columns from an edge's first vertex to its second


@dataclass(frozen=True)
class Edges:
    """Edges to draw, between vertices ``a`` and ``b``, (n,) int64.

    ``fading`` (n,) is the part that is missing at b's end, or if negative at a's; None if no edge
    fades. ``on_screen`` is the number of edges on the screen, also those that do not face the
    camera.
    """

    a: np.ndarray
    b: np.ndarray
    fading: np.ndarray | None = None
    on_screen: int = 0


def of_triangles(code: np.ndarray, facing: Facing | None = None) -> Edges:
    """Return the three edges of each triangle.

    ``code`` (tiles, s, s), uint8, are the vertices' codes of :mod:`.clipping`; edges that are off
    the screen are left out. ``facing`` (tiles, s - 1, s - 1) twice, bool, says which triangles are
    drawn, see :mod:`.culling`; None means all.
    """
    corner, right = code[:, :-1, :-1], code[:, :-1, 1:]
    below, across = code[:, 1:, :-1], code[:, 1:, 1:]
    row = code.shape[2]
    places = np.arange(code.size).reshape(code.shape)[:, :-1, :-1]
    sides = (
        (0, 1, corner & right, 0),
        (1, row + 1, right & across, 0),
        (0, row + 1, corner & across, 0),
        (0, row + 1, corner & across, 1),
        (row, row + 1, across & below, 1),
        (0, row, corner & below, 1),
    )
    starts = []
    ends = []
    on_screen = 0
    for first, second, off, triangle in sides:
        drawn = off == 0
        on_screen += int(np.count_nonzero(drawn))
        if facing is not None:
            drawn &= facing[triangle]
        start = places[drawn]
        starts.append(start + first)
        ends.append(start + second)

    return Edges(np.concatenate(starts), np.concatenate(ends), None, on_screen)


def of_strips(
    code: np.ndarray, facing: Facing | None = None, part: np.ndarray | None = None
) -> Edges:
    """Return each edge once, of the same grids; one with one triangle that faces the camera counts.

    With ``facing``, the grid must have one row and one column before the tile's own, which tell
    whether the triangles beyond its first edges face the camera. ``part`` (tiles, s, s) is how far
    the vertices have glided, from 0 to 1; with None no edge fades.
    """
    before = int(facing is not None)
    count = code.shape[1] - 1 - before  # quads on a side

    def moved(grid: np.ndarray, down: int, right: int) -> np.ndarray:
        down, right = down + before, right + before
        return grid[:, down : down + count, right : right + count]

    odd = np.arange(count) % 2 == 1
    row, column = np.broadcast_arrays(odd[:, None], odd)
    shape = (len(code), count, count)
    both = [np.broadcast_to(each, shape) for each in (row, column, row ^ column)]
    either: list[np.ndarray] = []
    if facing is not None:
        first, second = facing
        beside = moved(second, -1, 0), moved(first, 0, -1), moved(second, 0, 0)
        own = moved(first, 0, 0), moved(second, 0, 0), moved(first, 0, 0)
        either = [a | b for a, b in zip(own, beside, strict=True)]
        both = [a & b & c for a, b, c in zip(both, own, beside, strict=True)]
    # As large as the grid, so that an edge's place there is that of its first vertex.
    drawn = np.zeros(code.shape, bool)
    corner = moved(code, 0, 0)
    starts = []
    ends = []
    vanishing = []
    on_screen = 0
    for family, way in enumerate(FAMILIES):
        seen = (corner & moved(code, *way)) == 0
        on_screen += int(np.count_nonzero(seen))
        moved(drawn, 0, 0)[:] = seen & either[family] if either else seen
        starts.append(np.flatnonzero(drawn))
        ends.append(starts[-1] + way[0] * code.shape[2] + way[1])
        if part is not None:
            moved(drawn, 0, 0)[:] = both[family]
            vanishing.append(drawn.take(starts[-1]))
    edges = Edges(np.concatenate(starts), np.concatenate(ends), None, on_screen)
    if part is None:
        return edges
    return faded(edges, np.flatnonzero(np.concatenate(vanishing)), part, before)


def faded(edges: Edges, at: np.ndarray, part: np.ndarray, before: int) -> Edges:
    """Return edges with their fading, of which those ``at`` fade; those that are gone are left out.

    ``part`` (tiles, s, s) and ``before`` are those of :func:`of_strips`.
    """
    a, b = edges.a[at], edges.b[at]
    missing = np.maximum(part.take(a), part.take(b))
    # The end stays that is on an edge of the next level.
    side = part.shape[2]
    odd = (np.arange(side) - before) % 2 == 1
    sign = np.where(odd[:, None] & odd, -1.0, 1.0).take(a % (side * side))
    fading = np.zeros(len(edges.a))
    fading[at] = missing * sign
    kept = np.ones(len(edges.a), bool)
    kept[at] = missing < 1.0
    return Edges(edges.a[kept], edges.b[kept], fading[kept], edges.on_screen)
