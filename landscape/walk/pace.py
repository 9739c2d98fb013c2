"""How finely to draw the next frame of a walk, so that it keeps its frame rate. No OpenGL here.

A pace is a level on a ladder: level 0 draws everything, each further one draws less. The time that
frames take decides. Down it goes at once, by as many levels as the time asks for; up only when the
finer level would leave time to spare, and only after a wait, which doubles when a rise turned out
to be a mistake. So the picture neither pumps nor flickers, and a fast OpenGL stays at level 0.

The cost of a level is not the same everywhere: a part of each frame takes the same time however few
pixels and blades are drawn. How large that part is here, each change of the level tells.

The pixels become fewer, as a picture that is stretched a little differs least from a still. Blades
are left out only as a last resort, where frames would take more than three times their time. Each
frame of a walk has a mirror image of its own: to use one for several saved a millisecond or two,
and in views of the sea one pixel in thirty was wrong.

To one who stands still every pixel is shown, four frames to a picture (see stretch.py), or sixteen,
with all blades but as a last resort.
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
    """A rung of the ladder: the detail, and how much of what is not fixed it costs, 0..1.

    What is a last ``resort`` spoils the picture: it is for where a walk would become a slide show.
    """

    detail: Detail
    load: float
    resort: bool = False


def _level(
    load: float, scale: float, mirror: float, grass: float = 1.0, resort: bool = False
) -> Level:
    detail = Detail(scale=scale, coarser=1.0 / scale, grass=grass, mirror=mirror)
    return Level(detail, load, resort)


# Loads: from frames of figure 35 at 1280x720 on two cores (docs/performance.md).
WALKING = (
    Level(FULL, 1.0),
    _level(0.72, 0.85, 0.50),
    _level(0.56, 0.75, 0.45),
    _level(0.43, 0.66, 0.40),
    _level(0.35, 0.60, 0.36),
    _level(0.26, 0.52, 0.33),
    _level(0.20, 0.46, 0.30),
    _level(0.16, 0.42, 0.27),
    _level(0.13, 0.38, 0.24),
    _level(0.06, 0.34, 0.22, grass=0.50, resort=True),
    _level(0.03, 0.28, 0.20, grass=0.20, resort=True),
)


def _interlaced(
    load: float, scale: float, mirror_frames: int, grass: float = 1.0, resort: bool = False
) -> Level:
    return Level(Detail(scale=scale, grass=grass, mirror_frames=mirror_frames), load, resort)


# All pixels count here, as frames add up to a picture that has all of them.
STANDING = (
    Level(FULL, 1.0),
    _interlaced(0.50, 1 / 2, 1),
    _interlaced(0.42, 1 / 2, 2),
    _interlaced(0.36, 1 / 2, 4),
    _interlaced(0.24, 1 / 4, 4),
    _interlaced(0.15, 1 / 4, 4, grass=0.50, resort=True),
    _interlaced(0.08, 1 / 4, 4, grass=0.20, resort=True),
    _interlaced(0.04, 1 / 4, 6, grass=0.06, resort=True),
)

FIXED = 0.40  # of a full frame's time, that no level saves; measured as the loads
MOST_FIXED = 0.90  # chosen: what is learned stays between none and this
WARM = 3  # chosen: frames at the start that do not count: OpenGL prepares what it uses first
RECENT = 9  # chosen: frames whose median is judged
HURRY = 3  # chosen: frames that are enough where they take more than RUSH times the budget
RUSH = 1.4  # chosen
LIMIT = 0.90  # chosen: of the time per frame; if the usual frame takes more, draw less
AIM = 0.80  # chosen: of the time per frame, what a coarser level should take
ROOM = 0.75  # chosen: of the time per frame, what a finer level may be expected to take
RESORT = 3.0  # chosen: times the time per frame, which the other levels must take for a last resort
WAIT = 0.4  # chosen: seconds at a level before a finer one is tried
LONGEST_WAIT = 16.0  # chosen: seconds, after a rise that was taken back several times
REST = 0.25  # chosen: seconds without a motion after which a walker stands still


class Ladder:
    """Where on a ladder of levels one stands, and when to step."""

    def __init__(self, levels: Sequence[Level], budget: float) -> None:
        """Begin at the first level, which draws everything; ``budget`` is seconds per frame."""
        self._levels, self._budget = levels, budget
        self.level = 0
        self.fixed = FIXED  # part of a full frame's time that no level saves, as far as is known
        self.full = 0.0  # seconds that a full frame takes, as far as is known
        self._recent: deque[float] = deque(maxlen=RECENT)
        self._since = 0.0  # seconds at this level
        self._wait = WAIT
        self._risen = False
        self._left: tuple[int, float] | None = None  # the last level, and its seconds a frame

    def cost(self, level: int) -> float:
        """Return what a frame takes at a level, in times of a full frame."""
        return self.fixed + (1.0 - self.fixed) * self._levels[level].load

    @property
    def detail(self) -> Detail:
        """The detail of this level."""
        return self._levels[self.level].detail

    def stand(self, level: int) -> None:
        """Go to a level."""
        self.level, self._since = level, 0.0
        self._recent.clear()
        self._left = None

    def follow(self, other: "Ladder") -> None:
        """Begin where frames are fast enough, after those of another ladder."""
        self.fixed = other.fixed
        if other.level == 0:
            self.stand(0)
            return
        found = self._fitting(range(1, self._last_good), other.full, AIM)
        self.stand(self._last_good if found is None else found)

    def frame(self, spent: float, seconds: float) -> None:
        """Take note of a frame: seconds it took to draw, seconds since the one before."""
        self._since += seconds
        self._recent.append(spent)
        hurried = len(self._recent) >= HURRY and self._fastest() > RUSH * self._budget
        if len(self._recent) < RECENT and not hurried:
            return
        recent = list(self._recent)
        usual = median(recent[-HURRY:] if hurried else recent)
        self._learn(usual)
        self.full = usual / self.cost(self.level)
        level = self._wanted(usual)
        if level != self.level:
            self._risen = level < self.level
            left = self.level, usual
            self.stand(level)
            self._left = left

    def _fastest(self) -> float:
        """Return the seconds of the fastest of the last HURRY frames."""
        return min(list(self._recent)[-HURRY:])

    def _learn(self, usual: float) -> None:
        """Learn what part of a frame is fixed from what the last change of the level has saved."""
        if self._left is None:
            return
        (level, before), self._left = self._left, None
        then, now = self._levels[level].load, self._levels[self.level].load
        ratio = usual / before
        # ratio = (fixed + (1 - fixed) now) / (fixed + (1 - fixed) then)
        share = ratio * (1.0 - then) - (1.0 - now)
        if share:
            fixed = min(max((now - ratio * then) / share, 0.0), MOST_FIXED)
            self.fixed += (fixed - self.fixed) / 2.0

    def _wanted(self, usual: float) -> int:
        """Return the level for the next frame, where frames take ``usual`` seconds."""
        full = self.full
        if self.level > self._last_good and self._bearable(full, LIMIT):
            return self._last_good
        if usual > LIMIT * self._budget:
            if self._risen and self._since < 2 * self._wait:
                self._wait = min(2 * self._wait, LONGEST_WAIT)
            return self._coarser(full)
        if self._risen and self._since >= 2 * self._wait:
            self._wait, self._risen = WAIT, False
        if self._since < self._wait:
            return self.level
        finer = self._fitting(range(self.level), full, ROOM)
        return self.level if finer is None else finer

    def _coarser(self, full: float) -> int:
        """Return the next level that is fast enough, where a full frame takes ``full`` seconds.

        Where none is, it is the last one that is no last resort, unless that takes far too long.
        """
        coarser, last = range(self.level + 1, len(self._levels)), len(self._levels) - 1
        found = self._fitting(coarser, full, AIM)
        if found is not None and not self._levels[found].resort:
            return found
        # The cost of the last good level here is unknown until it has been tried.
        tried = self.level >= self._last_good
        if not tried or (self.level == self._last_good and self._bearable(full, 1.0)):
            return self._last_good
        bearable = self._fitting(coarser, full, RESORT)
        return next((n for n in (found, bearable) if n is not None), last)

    @property
    def _last_good(self) -> int:
        """The last level that is no last resort."""
        return max(n for n, level in enumerate(self._levels) if not level.resort)

    def _bearable(self, full: float, part: float) -> bool:
        """Return whether the last good level is fast enough to do without a last resort.

        Its frames may take ``part`` of RESORT times the budget; a full one takes ``full`` seconds.
        """
        return full * self.cost(self._last_good) <= part * RESORT * self._budget

    def _fitting(self, levels: range, full: float, part: float) -> int | None:
        """Return the first of some levels whose frames would take that part of the time at most.

        ``full`` is what a full frame takes, in seconds.
        """
        most = part * self._budget
        return next((n for n in levels if full * self.cost(n) <= most), None)


class Pace:
    """Chooses the detail of each frame; ``fps`` is the frame rate to keep, 0 to draw everything."""

    def __init__(self, fps: float = FPS) -> None:
        """Begin with all detail."""
        self.active = fps > 0
        budget = 1.0 / fps if self.active else math.inf
        self._walking, self._standing = Ladder(WALKING, budget), Ladder(STANDING, budget)
        self._still = 0.0  # seconds without a motion
        self._drawn = 0  # frames, up to WARM

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
        if self._drawn < WARM:
            self._drawn += 1
            return
        ladder = self._standing if self.still else self._walking
        ladder.frame(spent, seconds)
        was_still = self.still
        self._still = 0.0 if moved else self._still + seconds
        if self.still and not was_still:
            self._standing.follow(self._walking)
