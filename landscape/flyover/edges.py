"""The lines of a grid of triangles.

Each quad is divided by the diagonal from its first corner to its last into two triangles
(figure 4).
"""

import numpy as np


def of_triangles(code: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the three edges of each triangle, as vertices a and b, (n,) int64.

    ``code`` (tiles, rows, columns), uint8, are the vertices' codes of :mod:`.clipping`. Edges that
    are off the screen are left out.
    """
    place = np.arange(code.size).reshape(code.shape)
    corner, right = place[:, :-1, :-1], place[:, :-1, 1:]
    below, across = place[:, 1:, :-1], place[:, 1:, 1:]
    pairs = (
        (corner, right),
        (right, across),
        (corner, across),
        (corner, across),
        (across, below),
        (below, corner),
    )
    flat = code.ravel()
    starts, ends = [], []
    for a, b in pairs:
        seen = (flat[a] & flat[b]) == 0
        starts.append(a[seen])
        ends.append(b[seen])
    return np.concatenate(starts), np.concatenate(ends)
