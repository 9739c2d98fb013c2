"""A camera's path from place to place: over the ground, around what stands there, evenly in time.

Technique: a Catmull-Rom spline with centripetal knots goes through the places (Yuksel and others
2011: it makes no loops, however unevenly they lie). Where it comes too near to an obstacle it is
moved aside, and where it is too low it is raised; each such move is spread over the path before and
after by a weighted mean, so that it makes no corner. Then the path is measured, and travelled by
its length: slower at the places, and with a start and an end that are eased. Orientations are
joined by SLERP, and blurred in time, for a camera that turns as smoothly as it flies. No OpenGL.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import SupportsFloat

import numpy as np

from landscape.geometry.obstacle_grid import ObstacleGrid, Obstacles
from landscape.geometry.obstacles import Obstacle, Tower
from landscape.geometry.quaternion import slerp

STEP = 0.03  # chosen: units between the points by which a path is known
FEWEST, MOST = 16, 1200  # chosen: of these points, between two places
CLEAR = 0.22  # chosen: units a camera keeps above the ground on its way
AROUND = 0.12  # chosen: units it keeps from obstacles
CROWN = 0.22  # chosen: units by which the crown of a tree is wider than its trunk
REACH = 1.5  # chosen: units before and after a place within which it may be as low as that place
SPREAD = 1.2  # chosen: units over which a move aside or up is spread, to each side
ROUNDS = 24  # chosen: moves aside; each uncovers obstacles beyond
# Chosen: a way longer than ARCH_FROM rises by ARCH for each unit beyond, ARCH_MOST at most.
ARCH = 0.09
ARCH_FROM = 3.0
ARCH_MOST = 1.3

SLOW = 0.3  # chosen: the speed at a place that is passed, times the mean
HOLD = 0.5  # chosen: seconds that the camera rests at both ends
BLUR = 0.3  # chosen: seconds, the standard deviation by which its motion is smoothed
TURN_BLUR = 0.5  # chosen: the same of its turning
TICKS = 120  # chosen: points in time per second
NEAR = 0.06  # chosen: units, a little more than to the near plane's corners
HIGH = 4.0  # chosen: units; what is higher is not flown over

Heights = Callable[[float, float], SupportsFloat]


def centripetal(places: np.ndarray) -> list[np.ndarray]:
    """Return the points (n, 3) of each span between two of the places (k, 3), its ends included."""
    knots = np.concatenate([[2 * places[0] - places[1]], places, [2 * places[-1] - places[-2]]])
    gaps = np.sqrt(np.maximum(np.linalg.norm(np.diff(knots, axis=0), axis=1), 1e-6))
    spans = []
    for k in range(1, len(knots) - 2):
        before, here, after = gaps[k - 1 : k + 2]
        a, b, c, d = knots[k - 1 : k + 3]
        # The tangents of Barry and Goldman's form, for a parameter that runs from 0 to 1.
        out = here * ((b - a) / before - (c - a) / (before + here)) + (c - b)
        into = here * ((d - c) / after - (d - b) / (here + after)) + (c - b)
        count = int(np.clip(np.linalg.norm(c - b) / STEP, FEWEST, MOST))
        t = np.linspace(0.0, 1.0, count + 1)[:, None]
        spans.append(
            (2 * t**3 - 3 * t**2 + 1) * b
            + (t**3 - 2 * t**2 + t) * out
            + (3 * t**2 - 2 * t**3) * c
            + (t**3 - t**2) * into
        )

    return spans


def around(ground: Heights, x: float, z: float) -> float:
    """Return the greatest height of the ground in the near plane's reach of x, z."""
    near = ((0.0, 0.0), (NEAR, 0.0), (-NEAR, 0.0), (0.0, NEAR), (0.0, -NEAR))
    return max(float(ground(x + dx, z + dz)) for dx, dz in near)


def spread(needs: np.ndarray, room: np.ndarray, most: int) -> np.ndarray:
    """Return a smooth curve (n,) nowhere under ``needs`` (n,), by moving maximum and moving means.

    They reach ``most`` points to each side, and less where ``room`` (n,), the points up to the next
    one that has to stay, is less: where that is 0, the curve is what is needed there.
    """
    low, high = _reach(np.minimum(most, room / 1.5))
    greatest = np.array([needs[i:k].max() for i, k in zip(low, high, strict=True)])
    return blurred(greatest, room, most)


def blurred(values: np.ndarray, room: np.ndarray, most: int) -> np.ndarray:
    """Return moving means of values (n, ...), two after each other; the reach as in spread()."""
    low, high = _reach(np.minimum(most / 2, room / 6))
    for _ in range(2):
        total = np.concatenate([np.zeros_like(values[:1]), np.cumsum(values, axis=0)])
        count = (high - low).reshape(-1, *[1] * (values.ndim - 1))
        values = (total[high] - total[low]) / count
    return values


def _reach(wide: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the first of the points (n,) so ``wide`` to each side of each, and the end of them."""
    at, whole = np.arange(len(wide)), wide.astype(int)
    return np.maximum(at - whole, 0), np.minimum(at + whole, len(at) - 1) + 1


def found(obstacles: Obstacles, at: np.ndarray, within: float) -> list[tuple[float, float, float]]:
    """Return gap and way out (x, z) of the obstacles nearer than ``within`` to a point (3,)."""
    return [each.gap(at[0], at[2]) for each in _standing(obstacles, at, within)]


def standing_near(obstacles: Obstacles, x: float, z: float, within: float) -> list[Obstacle]:
    """Return the obstacles nearer than ``within`` units to x, z, trees with their crowns."""
    if not isinstance(obstacles, ObstacleGrid):
        return [each for each in obstacles if each.gap(x, z)[0] < within]
    # A walker goes around trunks, a camera around crowns.
    near = [
        replace(each, radius=each.radius + CROWN) if isinstance(each, Tower) else each
        for each in obstacles.near(x, z, within + CROWN)
    ]
    return [each for each in near if each.gap(x, z)[0] < within]


def _standing(obstacles: Obstacles, at: np.ndarray, within: float) -> list[Obstacle]:
    """Return the obstacles nearer than ``within`` units whose heights those of a point meet."""
    x, y, z = at
    near = standing_near(obstacles, x, z, within)
    return [each for each in near if each.bottom - within < y < each.top + within]


@dataclass(frozen=True)
class CameraPath:
    """Points (n, 3) in units, how far along the path each is (n,), and which are places (k,)."""

    points: np.ndarray
    lengths: np.ndarray
    stops: np.ndarray

    def at(self, length: np.ndarray) -> np.ndarray:
        """Return the points (m, 3) so far along the path, (m,) in units."""
        return np.stack([np.interp(length, self.lengths, axis) for axis in self.points.T], axis=1)


def measured(points: np.ndarray, stops: np.ndarray) -> CameraPath:
    """Return a path of points (n, 3), with its lengths."""
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    return CameraPath(points, np.concatenate([[0.0], np.cumsum(steps)]), stops)


def through(places: np.ndarray, ground: Heights, obstacles: Obstacles = ()) -> CameraPath:
    """Return a path through two or more places (k, 3) in units, clear of ground and obstacles.

    It goes exactly through the places, over the ground everywhere else; an obstacle that it cannot
    go around is flown over where that has a top.
    """
    spans = centripetal(np.asarray(places, np.float64))
    for span in spans:
        u = np.linspace(0.0, 1.0, len(span))
        long = math.hypot(*(span[-1] - span[0])[::2])
        span[:, 1] += min(ARCH * max(long - ARCH_FROM, 0.0), ARCH_MOST) * 16 * (u * (1 - u)) ** 2
    points = np.concatenate([*(span[:-1] for span in spans), spans[-1][-1:]])
    stops = np.cumsum([0, *(len(span) - 1 for span in spans)])
    return measured(cleared(points, stops, ground, obstacles), stops)


def cleared(
    points: np.ndarray, stops: np.ndarray, ground: Heights, obstacles: Obstacles
) -> np.ndarray:
    """Return points (n, 3) moved aside and up; those at the indices ``stops`` stay."""
    at = np.arange(len(points))
    room = np.abs(at[:, None] - stops).min(axis=1)
    points = _beside(points, stops, room, obstacles)
    points = _above(points, stops, ground)
    over = np.zeros(len(points))
    for k in np.flatnonzero(room):
        tops = [
            each.top + CLEAR - points[k, 1]
            for each in _standing(obstacles, points[k], 0.0)
            if each.gap(points[k, 0], points[k, 2])[0] < NEAR
        ]
        over[k] = max((up for up in tops if up < HIGH), default=0.0)
    points[:, 1] += spread(over, room, round(SPREAD / STEP))
    return points


def _beside(
    points: np.ndarray, stops: np.ndarray, room: np.ndarray, obstacles: Obstacles
) -> np.ndarray:
    """Return the points moved to the side, away from obstacles as far as they keep from them."""
    keeps = np.full(len(points), AROUND)
    for stop in stops:
        own = min((gap for gap, *_ in found(obstacles, points[stop], AROUND)), default=AROUND)
        away = np.abs(np.arange(len(points)) - stop) * STEP
        near = max(own, 0.0)
        keeps = np.minimum(keeps, near + (AROUND - near) * away / (4 * AROUND))

    moved = np.zeros_like(points)
    for round_ in range(ROUNDS):
        here = points + moved
        way = np.gradient(here[:, ::2], axis=0)
        way /= np.maximum(np.linalg.norm(way, axis=1, keepdims=True), 1e-9)
        pushed = np.zeros_like(points)
        for k in np.flatnonzero(room):
            for gap, x, z in found(obstacles, here[k], keeps[k]):
                # Only across the path: along it, a point would be pushed into the next one.
                side = np.array([-way[k, 1], way[k, 0]])
                across = float(side @ (x, z))
                if abs(across) > 0.3:
                    pushed[k, ::2] += side * (keeps[k] - gap) / across
        if not pushed.any():
            break
        moved += pushed
        if round_ < ROUNDS - 1:
            moved = blurred(moved, room, round(SPREAD / 4 / STEP))

    return points + moved


def _above(points: np.ndarray, stops: np.ndarray, ground: Heights) -> np.ndarray:
    """Return the points raised to CLEAR above the ground, less near places that are lower."""
    floor = np.array([around(ground, x, z) for x, _, z in points])
    keeps = np.full(len(points), CLEAR)
    room = np.full(len(points), len(points))
    for stop in stops:
        away = np.abs(np.arange(len(points)) - stop)
        own, t = min(points[stop, 1] - floor[stop], CLEAR), np.minimum(away * STEP / REACH, 1.0)
        keeps = np.minimum(keeps, own + (CLEAR - own) * t * t * (3 - 2 * t))
        room = np.minimum(room, away)
    needs = np.maximum(floor + keeps - points[:, 1], 0.0)
    points[:, 1] += spread(needs, room, round(SPREAD / STEP))
    return points


class Travel:
    """A camera that travels a path: where it is, and how it is turned, at any time."""

    def __init__(self, path: CameraPath, turns: Sequence[np.ndarray], seconds: np.ndarray) -> None:
        """``turns`` are the orientations (4,) at the places, ``seconds`` (k - 1,) from each to the
        next; the camera rests HOLD seconds more at both ends."""
        self.seconds = float(seconds.sum()) + 2 * HOLD
        starts = np.concatenate([[0.0], np.cumsum(seconds)])
        t = np.arange(round(self.seconds * TICKS) + 1) / TICKS - HOLD
        span = np.clip(np.searchsorted(starts, t, side="right") - 1, 0, len(seconds) - 1)
        u = np.clip((t - starts[span]) / np.maximum(seconds[span], 1e-9), 0.0, 1.0)
        eased = SLOW * u + (1 - SLOW) * u * u * (3 - 2 * u)
        stops = path.lengths[path.stops]
        lengths = stops[span] + eased * np.diff(stops)[span]
        turns = _same_side(turns)
        self._turns = np.stack(
            [slerp(turns[k], turns[k + 1], f) for k, f in zip(span, eased, strict=True)]
        )
        self._turns = smoothed(self._turns, TURN_BLUR)
        self._turns /= np.linalg.norm(self._turns, axis=1, keepdims=True)
        self._places = path.at(smoothed(lengths[:, None], BLUR)[:, 0])

    def at(self, seconds: float) -> tuple[np.ndarray, np.ndarray]:
        """Return the camera's place (3,) and orientation (4,)."""
        tick = min(max(seconds, 0.0), self.seconds) * TICKS
        k = min(int(tick), len(self._places) - 2)
        place = (1 - (tick - k)) * self._places[k] + (tick - k) * self._places[k + 1]
        return place, slerp(self._turns[k], self._turns[k + 1], tick - k)


def _same_side(turns: Sequence[np.ndarray]) -> list[np.ndarray]:
    """Return orientations with the sign of each, which means nothing, that is nearer the last."""
    kept = [np.asarray(turns[0])]
    for turn in turns[1:]:
        kept.append(turn if kept[-1] @ turn >= 0.0 else -turn)
    return kept


def smoothed(values: np.ndarray, deviation: float) -> np.ndarray:
    """Return values (n, d), one per tick, as means over a few: a Gaussian of ``deviation`` seconds.

    Beyond the ends they go on as a mirror image through the last point, which so stays in place.
    """
    half = min(round(3 * deviation * TICKS), len(values) - 1)
    weights = np.exp(-0.5 * (np.arange(-half, half + 1) / (deviation * TICKS)) ** 2)
    weights /= weights.sum()
    before = 2 * values[0] - values[half:0:-1]
    after = 2 * values[-1] - values[-2 : -half - 2 : -1]
    wide = np.concatenate([before, values, after])
    return np.stack([np.convolve(column, weights, "valid") for column in wide.T], axis=1)
