"""A film: clips one after another, cut or cross-faded, with captions over them."""

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from landscape.film.captions import Caption
from landscape.film.clip import Clip, Pictures
from landscape.film.stage import Drawing, Stage


@dataclass(frozen=True)
class Part:
    """A clip, and how it comes in: over ``fade`` seconds, while the one before it still runs.

    The first part of a film comes in from black. ``captions`` are timed by the clip's own seconds.
    """

    clip: Clip
    fade: float = 0.0
    captions: tuple[Caption, ...] = ()


@dataclass(frozen=True)
class Film:
    """Parts in their order, and ``ending`` seconds in which the last one goes to black.

    ``sound`` says that it is to be heard, too.
    """

    parts: tuple[Part, ...]
    drawing: Drawing
    fps: Fraction = Fraction(30)
    ending: float = 0.0
    sound: bool = False

    def starts(self) -> list[float]:
        """Return when each part begins, in seconds; the last number is when the film ends."""
        starts = [0.0]
        for part, following in zip(self.parts, (*self.parts[1:], None), strict=True):
            fade = following.fade if following is not None else 0.0
            starts.append(starts[-1] + max(part.clip.seconds - fade, 0.0))
        return starts

    @property
    def frames(self) -> int:
        """How many pictures it has, at least one."""
        return max(round(self.starts()[-1] * float(self.fps)), 1)

    @property
    def needs_opengl(self) -> bool:
        """Whether any clip is drawn by OpenGL."""
        return any(part.clip.needs_opengl for part in self.parts)

    def open(self, stage: Stage) -> Callable[[int], np.ndarray]:
        """Return the function that draws a frame, by its number from 0."""
        return Projector(self, stage).picture


class Projector:
    """Draws the frames of a film on a stage; only the clips in use are open."""

    def __init__(self, film: Film, stage: Stage) -> None:
        """Open nothing yet."""
        self._film, self._stage = film, stage
        self._starts = film.starts()
        self._open: dict[int, Pictures] = {}

    def _of_part(self, k: int, since: float) -> np.ndarray:
        """Return the picture of a part, so many seconds after it began, with its captions."""
        part = self._film.parts[k]
        if k not in self._open:
            self._open[k] = part.clip.open(self._stage)
        own = self._open[k](since)
        for caption in part.captions:
            own = caption.over(own, since)
        return own

    def _running(self, now: float) -> list[int]:
        """Return the numbers of the parts that are seen at a time, in seconds."""
        parts = self._film.parts
        running = [
            k
            for k, part in enumerate(parts)
            if self._starts[k] <= now < self._starts[k] + part.clip.seconds
        ]
        # Rounding may leave the last frame just after the end.
        return running or [len(parts) - 1]

    def picture(self, number: int) -> np.ndarray:
        """Return a frame, uint8 (h, w, 3), top row first."""
        film, now = self._film, float(number / self._film.fps)
        running = self._running(now)
        self._open = {k: v for k, v in self._open.items() if k in running}
        pixels: np.ndarray | None = None
        for k in running:
            part, since = film.parts[k], now - self._starts[k]
            share = smooth(since / part.fade) if part.fade > 0.0 else 1.0
            own = self._of_part(k, since)
            if k == 0 or pixels is None:
                pixels = own if share == 1.0 else mixed(np.zeros_like(own), own, share)
            else:
                pixels = mixed(pixels, own, share)

        assert pixels is not None
        left = self._starts[-1] - now
        if film.ending > 0.0 and left < film.ending:
            pixels = mixed(np.zeros_like(pixels), pixels, smooth(left / film.ending))
        return pixels


def smooth(t: float) -> float:
    """Return t in 0..1, eased at both ends; 0 and 1 beyond."""
    t = min(max(t, 0.0), 1.0)
    return t * t * (3 - 2 * t)


def mixed(here: np.ndarray, there: np.ndarray, share: float) -> np.ndarray:
    """Return two pictures (h, w, 3) mixed, with a ``share`` of 0 to 1 of the second."""
    part = round(256 * min(max(share, 0.0), 1.0))
    if part in (0, 256):
        return there if part else here
    total = here.astype(np.uint16) * (256 - part) + there.astype(np.uint16) * part
    return ((total + 128) >> 8).astype(np.uint8)
