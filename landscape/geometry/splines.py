"""Bicubic patches: a smoother surface over the same grid of heights (R14, section 11.2.6).

A cubic spline is a weighted mean of the four knots around a point. The same weights along z and
then along x make a bicubic patch of every cell.
"""

import numpy as np

# Between the middle two of four knots a cubic is (t^3, t^2, t, 1) x one of these x the knots.
SPLINES = {
    "catmull_rom": np.array([[-1, 3, -3, 1], [2, -5, 4, -1], [-1, 0, 1, 0], [0, 2, 0, 0]]) / 2.0,
    "b_spline": np.array([[-1, 3, -3, 1], [3, -6, 3, 0], [-3, 0, 3, 0], [1, 4, 1, 0]]) / 6.0,
}


def spline_weights(count: int, parts: int, kind: str) -> np.ndarray:
    """Return the weights ((count - 1) * parts + 1, count) of a cubic over ``count`` knots.

    Each span between two knots is cut into ``parts``. "catmull_rom" goes through the knots;
    "b_spline" passes near them and bends more evenly. Beyond each end a knot is added in line with
    the last two, so that both curves begin and end in a knot.
    """
    at = np.arange((count - 1) * parts + 1) / parts
    span = np.minimum(at.astype(int), count - 2)
    t = (at - span)[:, None] ** np.arange(3, -1, -1)  # t^3, t^2, t, 1
    weights = t @ SPLINES[kind]

    # The added knots, -1 and count, are 2 p[0] - p[1] and 2 p[count-1] - p[count-2].
    wide = np.zeros((len(at), count + 2))
    for k in range(4):
        wide[np.arange(len(at)), span + k] += weights[:, k]
    matrix = wide[:, 1:-1].copy()
    for end, first, second in ((wide[:, 0], 0, 1), (wide[:, -1], -1, -2)):
        matrix[:, first] += 2 * end
        matrix[:, second] -= end
    return matrix


def smoothed(heights: np.ndarray, parts: int, kind: str) -> np.ndarray:
    """Return heights (n, n) as bicubic patches, each cell cut into ``parts`` x ``parts``.

    A patch is a cubic along x of cubics along z: weights times heights times weights.
    """
    weights = spline_weights(len(heights), parts, kind)
    return np.ascontiguousarray(weights @ heights @ weights.T)
