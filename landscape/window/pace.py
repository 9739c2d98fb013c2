"""How finely to draw the next frame of a walk, so that it keeps its frame rate. No OpenGL here.

A pace is a level on a ladder: level 0 draws everything, each further one draws less. The time that
frames take decides. Down it goes at once, by as many levels as the time asks for; up only when the
finer level, by its known cost, would leave time to spare, and only after a wait, which doubles when
a rise turned out to be a mistake. So the picture neither pumps nor flickers, and on a fast OpenGL
it stays at level 0.

To one who stands still every pixel is shown, four frames to a picture (see stretch.py), with less
grass if need be.
"""

import math
from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass
from statistics import median

from landscape.frame import FULL, Detail

FPS = 30.0  # chosen: frames per second that a walk keeps


@dataclass(frozen=True)
class Level:
    """A rung of the ladder: the detail, and its cost as a fraction of a full frame's."""

    detail: Detail
    cost: float


def _level(cost: float, scale: float, grass: float, mirror: float, mirror_frames: int) -> Level:
    detail = Detail(
        scale=scale,
        coarser=1.0 / scale,
        grass=grass,
        mirror=mirror,
        mirror_frames=mirror_frames,
    )
    return Level(detail, cost)


# Costs: medians over the nine views of figure 35, at 1280x720 on two cores (docs/performance.md).
WALKING = (
    Level(FULL, 1.0),
    _level(0.85, 0.85, 0.8, 0.42, 1),
    _level(0.72, 0.72, 0.6, 0.36, 1),
    _level(0.60, 0.62, 0.42, 0.30, 2),
    _level(0.50, 0.54, 0.30, 0.27, 2),
    _level(0.42, 0.46, 0.20, 0.23, 3),
    _level(0.37, 0.40, 0.14, 0.20, 3),
    _level(0.33, 0.34, 0.10, 0.17, 3),
    _level(0.30, 0.28, 0.07, 0.14, 4),
)


def _interlaced(cost: float, scale: float, grass: float, mirror_frames: int) -> Level:
    return Level(Detail(scale=scale, grass=grass, mirror_frames=mirror_frames), cost)


# All pixels count here, as frames add up to a picture that has all of them.
STANDING = (
    Level(FULL, 1.0),
    _interlaced(0.70, 1 / 2, 0.80, 1),
    _interlaced(0.62, 1 / 2, 0.50, 2),
    _interlaced(0.54, 1 / 2, 0.30, 3),
    _interlaced(0.46, 1 / 2, 0.16, 4),
    _interlaced(0.38, 1 / 4, 0.30, 4),
    _interlaced(0.32, 1 / 4, 0.16, 4),
    _interlaced(0.28, 1 / 4, 0.10, 4),
    _interlaced(0.24, 1 / 4, 0.06, 6),
)

RECENT = 9  # chosen: frames whose median is judged
HURRY = 3  # chosen: frames that are enough where they take more than RUSH times the budget
RUSH = 1.4  # chosen
LIMIT = 0.90  # chosen: of the time per frame; if the usual frame takes more, draw less
AIM = 0.80  # chosen: of the time per frame, what a coarser level should take
ROOM = 0.70  # chosen: of the time per frame, what a finer level may be expected to take
WAIT = 1.0  # chosen: seconds at a level before a finer one is tried
LONGEST_WAIT = 16.0  # chosen: seconds, after a rise that was taken back several times
REST = 0.25  # chosen: seconds without a motion after which a walker stands still


class Ladder:
    """Where on a ladder of levels one stands, and when to step."""

    def __init__(self, levels: Sequence[Level], budget: float) -> None:
        """Begin at the first level, which draws everything; ``budget`` is seconds per frame."""
        self._levels, self._budget = levels, budget
        self.level = 0
        self._recent: deque[float] = deque(maxlen=RECENT)
        self._since = 0.0  # seconds at this level
        self._wait = WAIT
        self._risen = False

    @property
    def detail(self) -> Detail:
        """The detail of this level."""
        return self._levels[self.level].detail

    def stand(self, level: int) -> None:
        """Go to a level."""
        self.level, self._since = level, 0.0
        self._recent.clear()

    def frame(self, spent: float, seconds: float) -> None:
        """Take note of a frame: seconds it took to draw, seconds since the one before."""
        self._since += seconds
        self._recent.append(spent)
        level = self._wanted()
        if level != self.level:
            self._risen = level < self.level
            self.stand(level)

    def _wanted(self) -> int:
        """Return the level for the next frame."""
        times = list(self._recent)
        hurried = len(times) >= HURRY and min(times[-HURRY:]) > RUSH * self._budget
        if len(times) < RECENT and not hurried:
            return self.level
        usual = median(times[-HURRY:] if hurried else times)
        full = usual / self._levels[self.level].cost
        if usual > LIMIT * self._budget:
            if self._risen and self._since < 2 * self._wait:
                self._wait = min(2 * self._wait, LONGEST_WAIT)
            coarser = range(self.level + 1, len(self._levels))
            fitting = (n for n in coarser if full * self._levels[n].cost <= AIM * self._budget)
            return next(fitting, len(self._levels) - 1)
        if self._risen and self._since >= 2 * self._wait:
            self._wait, self._risen = WAIT, False
        rested = self.level > 0 and self._since >= self._wait
        if rested and full * self._levels[self.level - 1].cost <= ROOM * self._budget:
            return self.level - 1
        return self.level


class Pace:
    """Chooses the detail of each frame; ``fps`` is the frame rate to keep, 0 to draw everything."""

    def __init__(self, fps: float = FPS) -> None:
        """Begin with all detail."""
        self.active = fps > 0
        budget = 1.0 / fps if self.active else math.inf
        self._walking, self._standing = Ladder(WALKING, budget), Ladder(STANDING, budget)
        self._still = 0.0  # seconds without a motion

    @property
    def still(self) -> bool:
        """Whether the viewer stands still."""
        return self._still >= REST

    @property
    def level(self) -> int:
        """The level of the next frame; 0 draws everything."""
        return (self._standing if self.still else self._walking).level

    @property
    def detail(self) -> Detail:
        """The detail of the next frame."""
        return (self._standing if self.still else self._walking).detail

    @property
    def interlaced(self) -> bool:
        """Whether the next frame is one of those that add up to a picture of full size."""
        return self.still and self.level > 0

    def frame(self, spent: float, seconds: float, moved: bool) -> None:
        """Take note of a frame: seconds it took to draw, seconds since the last, eye moved."""
        ladder = self._standing if self.still else self._walking
        ladder.frame(spent, seconds)
        was_still = self.still
        self._still = 0.0 if moved else self._still + seconds
        if self.still and not was_still:
            self._standing.stand(self._walking.level)
