"""The lines of a grid of triangles: all edges of each, or each edge once (section 2.3).

A quad is divided by the diagonal from its first corner to its last (figure 4), into the triangles
corner, right, across and corner, across, below. Drawn triangle by triangle, that is six lines a
quad, but inside the grid all edges have two triangles. A triangle strip names each vertex of a row
of triangles once; lines are saved in the same way, by three families of edges, along the rows,
along the columns and the diagonals: three lines a quad. A tile has the edges on its first row and
column; those on its last belong to the next tile.
"""

from collections.abc import Iterable

import numpy as np

Facing = tuple[np.ndarray, np.ndarray]
Pairs = tuple[np.ndarray, np.ndarray]


def of_triangles(code: np.ndarray, facing: Facing | None = None) -> tuple[Pairs, int]:
    """Return the three edges of each triangle as vertices a and b, (n,) int64.

    ``code`` (tiles, s, s), uint8, are the vertices' codes of :mod:`.clipping`; edges that are off
    the screen are left out. ``facing`` (tiles, s - 1, s - 1) twice, bool, says which triangles are
    drawn, see :mod:`.culling`; None means all. The second result is the number of edges on the
    screen, facing or not.
    """
    corner, right = code[:, :-1, :-1], code[:, :-1, 1:]
    below, across = code[:, 1:, :-1], code[:, 1:, 1:]
    step = code.shape[2]
    places = np.arange(code.size).reshape(code.shape)[:, :-1, :-1]
    families = (
        (0, 1, corner & right, 0),
        (1, step + 1, right & across, 0),
        (0, step + 1, corner & across, 0),
        (0, step + 1, corner & across, 1),
        (step, step + 1, across & below, 1),
        (0, step, corner & below, 1),
    )
    return _collected((places + a, b - a, off, facing and facing[t]) for a, b, off, t in families)


def of_strips(code: np.ndarray, facing: Facing | None = None) -> tuple[Pairs, int]:
    """Return each edge once, as :func:`of_triangles` does; one with one triangle facing is drawn.

    With ``facing``, the grid must have one row and one column before the tile's own, which tell
    whether the triangles beyond its first edges face the camera.
    """
    before = int(facing is not None)
    own = (slice(None), slice(before, -1), slice(before, -1))
    step = code.shape[2]
    corner = code[own]
    right, below = code[:, before:-1, before + 1 :], code[:, before + 1 :, before:-1]
    across = code[:, before + 1 :, before + 1 :]
    seen: list[np.ndarray | None] = [None] * 3
    if facing is not None:
        first, second = facing
        seen = [
            first[:, 1:, 1:] | second[:, :-1, 1:],
            second[:, 1:, 1:] | first[:, 1:, :-1],
            first[:, 1:, 1:] | second[:, 1:, 1:],
        ]
    places = np.arange(code.size).reshape(code.shape)[own]
    off = corner & right, corner & below, corner & across
    return _collected(zip((places,) * 3, (1, step, step + 1), off, seen, strict=True))


def _collected(
    families: Iterable[tuple[np.ndarray, int, np.ndarray, np.ndarray | None]],
) -> tuple[Pairs, int]:
    """Join families of edges: the first vertices, the way to the second, ``off`` and ``facing``."""
    starts, ends, on_screen = [], [], 0
    for places, way, off, facing in families:
        drawn = off == 0
        on_screen += int(np.count_nonzero(drawn))
        if facing is not None:
            drawn &= facing
        start = places[drawn]
        starts.append(start)
        ends.append(start + way)
    return (np.concatenate(starts), np.concatenate(ends)), on_screen
