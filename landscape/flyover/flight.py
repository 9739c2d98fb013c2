"""The flight: a camera along a path, a fixed distance above the ground (section 2.3).

The camera goes along Bezier curves at constant speed and turns to the nearest of some points, at a
set rate: when another point becomes the nearest, it turns there, the short way around. Where the
camera is follows from the time alone, but where it looks follows from where it looked before. So
the angles are computed once for the whole flight, in small steps, and read from that table: the
camera at any moment is the same, whatever moments were asked for before.

Section 2.3 has the camera turn at one rate, which starts and stops it with a jerk; ``flyover.ease``
gives it time to. A fixed distance above rough ground jolts the camera; with ``flyover.smooth`` it
follows a smooth curve over the ground's highest places around it. Past a point, the camera would
keep looking back at it until another is nearer; with ``flyover.ahead`` only points ahead of it
count, and where there is none it looks along its path.
"""

import math
from collections.abc import Callable

import numpy as np

from landscape.flyover.camera import Camera
from landscape.flyover.settings import Flyover
from landscape.geometry.bezier import BezierPath

STEPS_PER_SECOND = 60  # chosen: of the table
MOST_STEPS = 100_000  # chosen: in a flight of more than half an hour they are longer
AHEAD = 12.0  # units, chosen: how far ahead on its path it looks where there is no target
# Chosen: with flyover.ahead, how far from its way targets count, and how far from it they are
# looked at. So the eye is turned away little from where it flies.
SEEN, ASIDE = math.radians(60), math.radians(35)
STEEPEST = math.radians(40)  # chosen: over a target the camera would look straight down
BATCH = 4096  # steps whose nearest targets are computed at once, chosen: they take 30 MB
Ground = Callable[[np.ndarray, np.ndarray], np.ndarray]


class Flight:
    """A camera as a function of time. A flight without end begins anew after ``duration`` seconds.

    Between sub-paths the camera jumps, and looks at the nearest target at once.
    """

    def __init__(
        self, path: BezierPath, targets: np.ndarray, ground: Ground, settings: Flyover
    ) -> None:
        """Plan a flight along ``path`` over heights ``ground(x, y)``; all lengths are in units.

        ``targets`` (m, 2) are places on the ground to look at; without any the camera looks ahead.
        """
        self._path = path
        self._ground = ground
        self._settings = settings
        self.duration = path.length / settings.speed
        # A path of one closed part goes on where it began, and the camera turns on.
        self._endless = path.closed == (True,)
        self._parts = [
            self._table(first, last, targets)
            for first, last in zip(path.starts[:-1], path.starts[1:], strict=True)
        ]

    def camera(self, time_s: float) -> Camera:
        """Return the camera at a time in seconds."""
        distance = time_s % self.duration * self._settings.speed
        at, z, theta_y, theta_z = self._parts[int(self._path.part(distance))]
        x, y = self._path.at(distance)
        if self._settings.smooth:
            height = np.interp(distance, at, z)
        else:
            height = self._ground(x, y) + self._settings.height
        pitch, yaw = np.interp(distance, at, theta_y), np.interp(distance, at, theta_z)
        return Camera(float(x), float(y), float(height), 0.0, float(pitch), float(yaw))

    def _table(self, first: float, last: float, targets: np.ndarray) -> tuple[np.ndarray, ...]:
        """Return distances, heights and angles theta_y, theta_z (n,) along a sub-path."""
        settings = self._settings
        steps = math.ceil(min((last - first) / settings.speed * STEPS_PER_SECOND, MOST_STEPS))
        at = np.linspace(first, last, max(steps, 1) + 1)
        inside = np.minimum(at, np.nextafter(last, first))  # the end belongs to this part, too
        places = self._path.at(inside)
        z = self._ground(*places.T) + settings.height
        step = (at[1] - at[0]) / settings.speed
        if settings.smooth:
            z = smoothed(z, round(settings.smooth / (at[1] - at[0])), self._endless)

        # Near the end it keeps looking in the direction that it has.
        start = inside if self._endless else np.maximum(np.minimum(inside, last - AHEAD), first)
        ahead = (start + AHEAD) % last if self._endless else np.minimum(start + AHEAD, last)
        away = self._path.at(ahead) - self._path.at(start)
        theta_z = np.arctan2(away[:, 1], away[:, 0])

        # Up and down it looks farther ahead: else it would nod at each bump.
        far = (start + 3 * AHEAD) % last if self._endless else np.minimum(start + 3 * AHEAD, last)
        apart = (far - start) % last if self._endless else far - start
        below = np.interp(start, at, z) - np.interp(far, at, z)
        if len(targets):
            found = nearest(places, targets, away if settings.ahead else None)
            some = np.isfinite(found[:, 0])
            away[some] = (found - places)[some]
            apart[some] = np.hypot(*away[some].T)
            below[some] = z[some] - self._ground(*found[some].T)
            aside = np.arctan2(away[:, 1], away[:, 0]) - theta_z
            if settings.ahead:
                aside = np.clip((aside + math.pi) % math.tau - math.pi, -ASIDE, ASIDE)
            theta_z = theta_z + aside

        theta_y = np.clip(np.arctan2(below, apart), -STEEPEST, STEEPEST)
        rate = math.radians(settings.turn)
        angles = []
        for wanted in (theta_y, theta_z):
            turned = follow(wanted, step, rate, settings.ease, (float(wanted[0]), 0.0))
            if self._endless:  # the second round begins as the first one ends
                speed = float(turned[-1] - turned[-2]) / step
                turned = follow(wanted, step, rate, settings.ease, (float(turned[-1]), speed))
            angles.append(turned)

        return at, z, *angles


def nearest(places: np.ndarray, targets: np.ndarray, along: np.ndarray | None = None) -> np.ndarray:
    """Return for each place (n, 2) the nearest target (n, 2) of all (m, 2).

    If directions ``along`` (n, 2) are given, only targets count that are less than SEEN from them;
    NaN stands for none.
    """
    found = []
    for first in range(0, len(places), BATCH):
        part = slice(first, first + BATCH)
        x, y = targets.T[:, None] - places[part].T[..., None]
        away = x * x + y * y
        if along is not None:
            u, v = along[part].T[..., None]
            seen = x * u + y * v > math.cos(SEEN) * np.sqrt(away * (u * u + v * v))
            away = np.where(seen, away, np.inf)
        which = np.argmin(away, axis=1)
        none = np.isinf(away[np.arange(len(away)), which])
        found.append(np.where(none[:, None], np.nan, targets[which]))
    return np.concatenate(found)


def follow(
    wanted: np.ndarray, step: float, rate: float, ease: float, start: tuple[float, float]
) -> np.ndarray:
    """Return angles (n,) that turn after ``wanted`` ones (n,), by at most ``rate`` a second.

    All in radians. They begin with the angle and the speed ``start``; ``step`` seconds are between
    two of them. They take the short way around, and are not wrapped. To reach the full rate, and to
    stop, takes ``ease`` seconds.
    """
    angle, speed = start
    change = rate / ease * step if ease else math.inf  # of the speed, in one step
    turned = [angle]
    for goal in wanted[1:].tolist():
        left = math.remainder(goal - angle, math.tau)
        fastest = min(rate, abs(left) / step)
        if ease:
            # From this speed, less by `change` in each step, it stops there.
            stops = math.sqrt(change**2 / 4 + 2 * rate / ease * abs(left)) - change / 2
            fastest = min(fastest, stops)
        aim = math.copysign(fastest, left)
        speed += min(max(aim - speed, -change), change)
        angle += speed * step
        turned.append(angle)

    return np.array(turned)


def smoothed(heights: np.ndarray, reach: int, around: bool) -> np.ndarray:
    """Return a smooth curve (n,) over heights (n,), never below one of them.

    It is the mean, over ``reach`` heights to either side, of the highest within that reach of each:
    every one of these is at least as high as the height in the middle. ``around`` continues the
    heights at their ends with those of the other end.
    """
    reach = max(min(reach, len(heights) - 1), 1)
    # In a closed path the last height is the first one again.
    if around:
        padded = np.pad(heights[:-1], 2 * reach, mode="wrap")
    else:
        padded = np.pad(heights, 2 * reach, mode="edge")
    highest = np.lib.stride_tricks.sliding_window_view(padded, 2 * reach + 1).max(axis=1)
    summed = np.concatenate([[0.0], np.cumsum(highest)])
    mean = (summed[2 * reach + 1 :] - summed[: -2 * reach - 1]) / (2 * reach + 1)
    return np.append(mean, mean[0]) if around else mean
