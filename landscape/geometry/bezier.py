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


class BezierPath:
    """Sub-paths that are travelled one after the other; from one to the next the place jumps.

    Distances count from the start of the first one, in the unit of the control points. Those of
    sub-path k are from ``starts[k]`` to ``starts[k + 1]``, where the next begins; ``starts[-1]`` is
    the length of them all. ``closed[k]`` says whether its end meets its start.
    """

    def __init__(self, subpaths: Sequence[np.ndarray]) -> None:
        """Sample sub-paths, each (n, 4, d): n >= 1 cubics of which each starts where one ends."""
        t = np.linspace(0, 1, CHORDS + 1)
        parts = []
        for curves in subpaths:
            sampled = np.stack([evaluate(curve, t) for curve in curves])
            # The end of a curve is the start of the next, and is kept once.
            inner = sampled[:, :-1].reshape(-1, sampled.shape[2])
            parts.append(np.concatenate([inner, sampled[-1, -1:]]))
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

    def direction(self, distance: np.ndarray | float, reach: float) -> np.ndarray:
        """Return unit vectors (..., d) along the path at distances (...).

        Each points from the place ``reach`` before to the place ``reach`` after, on the same
        sub-path: a corner is rounded over that distance. On a closed one the two may lie on either
        side of its start. 0 where a sub-path has no length.
        """
        k = self.part(distance)
        first, last = self.starts[k], np.nextafter(self.starts[k + 1], -np.inf)
        closed, span = np.array(self.closed)[k], np.maximum(last - first, 1e-300)
        ends = np.stack([np.subtract(distance, reach), np.add(distance, reach)])
        ends = np.where(closed, first + (ends - first) % span, np.clip(ends, first, last))
        step = np.subtract(*self.at(ends)[::-1])
        return np.asarray(step / np.maximum(np.linalg.norm(step, axis=-1, keepdims=True), 1e-300))
