"""Paths of cubic Bezier curves, travelled at constant speed. No OpenGL.

A cubic is given by four control points: it starts at the first and ends at the fourth, and its
tangents there point at the second and from the third. Its parameter t in 0..1 is no distance: equal
steps of t are short where the control points are close together, so a camera moved by t would crawl
and rush. The distance along the curve has no closed form. So the curve is sampled, the lengths of
the chords are summed up, and the place at a distance is found in that table.
"""

from collections.abc import Sequence

import numpy as np

# Chosen: on a curve 512 pixels long a chord is 2 pixels long, and where the curve bends with a
# radius of 20 pixels the chord is off by 0.03.
CHORDS = 256
# The control points' weights are (1, t, t^2, t^3) times this (Bernstein's polynomials).
BERNSTEIN = np.array([[1, 0, 0, 0], [-3, 3, 0, 0], [3, -6, 3, 0], [-1, 3, -3, 1]], np.float64)
CLOSED = 1e-6  # chosen: the ends of a closed path are this near, as a fraction of its extent


def evaluate(curve: np.ndarray, t: np.ndarray | float) -> np.ndarray:
    """Return the points (..., d) of a cubic, control points (4, d), at parameters t (...)."""
    powers = np.asarray(t, np.float64)[..., None] ** np.arange(4)
    return np.asarray(powers @ BERNSTEIN @ np.asarray(curve, np.float64))


def through(points: np.ndarray, closed: bool) -> np.ndarray:
    """Return cubics (n, 4, d) of a smooth path through points (m, d): a Catmull-Rom spline.

    Its tangent at a point is parallel to the line from the point before to the one after.
    """
    ends = (points[-1:], points[:2]) if closed else (points[:1], points[-1:])
    row = np.concatenate([ends[0], points, ends[1]])
    before = row[:-3]
    start = row[1:-2]
    end = row[2:-1]
    after = row[3:]
    return np.stack([start, start + (end - before) / 6, end - (after - start) / 6, end], axis=1)


class BezierPath:
    """Sub-paths that are travelled one after the other; from one to the next the place jumps.

    Distances count from the start of the first one, in the unit of the control points. Those of
    sub-path k are from ``starts[k]`` to ``starts[k + 1]``, where the next begins; ``starts[-1]`` is
    the length of them all. ``closed[k]`` says whether its end meets its start.
    """

    def __init__(self, subpaths: Sequence[np.ndarray]) -> None:
        """Sample sub-paths, each (n, 4, d): n >= 1 cubics of which each starts where one ends."""
        parts = [_sampled(curves) for curves in subpaths]
        self._points = np.concatenate(parts)
        chords = np.linalg.norm(np.diff(self._points, axis=0), axis=1)
        first = np.cumsum([0] + [len(each) for each in parts])  # each sub-path's first point
        chords[first[1:-1] - 1] = 0.0  # a jump takes no distance
        self._distances = np.concatenate([[0.0], np.cumsum(chords)])
        self.starts = np.append(self._distances[first[:-1]], self._distances[-1])
        near = CLOSED * float(np.ptp(self._points, axis=0).max())
        self.closed = tuple(bool(np.linalg.norm(each[-1] - each[0]) <= near) for each in parts)

    @property
    def length(self) -> float:
        """The length of all sub-paths together."""
        return float(self._distances[-1])

    def part(self, distance: np.ndarray | float) -> np.ndarray:
        """Return the number of the sub-path (...) that is travelled at distances (...)."""
        found = np.searchsorted(self.starts, distance, side="right") - 1
        return np.clip(found, 0, len(self.closed) - 1)

    def at(self, distance: np.ndarray | float) -> np.ndarray:
        """Return the places (..., d) at distances (...), which are bounded to 0..length.

        The places lie on the chords, so that equal distances are equal steps even where a curve
        stands still in t.
        """
        columns = [np.interp(distance, self._distances, column) for column in self._points.T]
        return np.stack(columns, axis=-1)


def _sampled(curves: np.ndarray) -> np.ndarray:
    """Return points (m, d) along a sub-path (n, 4, d), CHORDS to a curve and one for its end."""
    t = np.linspace(0, 1, CHORDS + 1)
    sampled = np.stack([evaluate(curve, t) for curve in curves])
    # The end of a curve is the start of the next, and is kept once.
    inner = sampled[:, :-1].reshape(-1, sampled.shape[2])
    return np.concatenate([inner, sampled[-1, -1:]])
