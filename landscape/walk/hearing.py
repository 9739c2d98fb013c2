"""What a walker hears: at each frame from the walk to a score, and on to the speaker and the
captions.

Recordings contain no sound: it follows from the walk, as pictures do.
"""

import time
from collections.abc import Callable, Hashable
from contextlib import suppress
from threading import Event, Thread

import numpy as np

from landscape.scene.scene import SceneSettings
from landscape.sound.captions import Line, lines
from landscape.sound.mixer import mix
from landscape.sound.score import Heard, Score
from landscape.sound.signal import QUANTUM, RATE
from landscape.sound.soundscape import Ear
from landscape.walk import words
from landscape.walk.builder import Builder
from landscape.walk.caption_image import caption_image
from landscape.walk.place import Place
from landscape.walk.speaker import Speaker
from landscape.walk.walker import Walker

KEPT = 4.0  # chosen: seconds of the past that captions may need


def heard(place: Place, walker: Walker, kt: float, builder: Builder) -> Heard:
    """Return what there is to hear at a moment of a walk, in an open place."""
    return Heard(
        place.soundscape(),
        Ear(walker.x, walker.y, walker.z, walker.yaw, kt),
        walker.step,
        walker.stroke,
        builder.changed["dig"],
        builder.changed["place"],
        loudness(place.settings),
    )


def loudness(settings: SceneSettings) -> float:
    """Return how loud the sound is, 0 while it is muted."""
    sound = settings.sound
    return 0.0 if sound.muted else sound.volume


def captioned(settings: SceneSettings) -> bool:
    """Return whether what is heard is shown in words."""
    sound = settings.sound
    return sound.captions == "on" or (sound.captions == "muted" and sound.muted)


class Hearing:
    """The sound of a walk and its captions."""

    def __init__(self, open_speaker: Callable[[], Speaker] | None) -> None:
        """Open nothing yet; ``open_speaker`` opens a device, None is for a walk without one."""
        self._open = open_speaker
        self._frames = 0
        self._speaker: Speaker | None = None
        self._preparing: Thread | None = None
        self._released = Event()
        self._score = Score()
        self._played = 0  # quanta that were written to the speaker
        self._captions = Score()
        self._lines: tuple[Line, ...] = ()
        self._last = time.perf_counter()

    @property
    def lines(self) -> tuple[Line, ...]:
        """What is heard, in words."""
        return self._lines

    def plays(self, volume: float) -> bool:
        """Return whether there is a device; it is opened at the second frame with a ``volume``.

        The first frame does not wait for it, and a walk that begins muted opens none.
        """
        opens, self._frames = self._open, self._frames + 1
        if opens is not None and volume > 0.0 and self._frames > 1:
            self._open = None
            with suppress(OSError):
                self._speaker = opens()
        return self._speaker is not None

    def hear(self, now: Heard, seconds: float, captioned: bool) -> None:
        """Take note of a frame, ``seconds`` after the walk began; ``captioned``: in words, too."""
        last, self._last = self._last, time.perf_counter()
        speaker = self._ready(now)
        if speaker is not None and (wanted := speaker.wanted(self._last - last)):
            end = self._played + wanted
            self._score.add(end * QUANTUM / RATE, now)
            speaker.write(mix(self._score, self._played * QUANTUM, wanted * QUANTUM))
            self._played = end
            self._score.forget(end)
        if captioned:
            self._captions.add(seconds, now)
            self._captions.forget(round((seconds - KEPT) * RATE / QUANTUM))
            self._lines = lines(now, self._captions.events, seconds)
        else:
            self.forget()

    def forget(self) -> None:
        """Show nothing in words."""
        if self._lines or self._captions.keys:
            self._captions, self._lines = Score(), ()

    def _ready(self, now: Heard) -> Speaker | None:
        """Return the speaker, once the first sounds have been made or read, beside the walk.

        Without a device none are made.
        """
        if self._speaker is None:
            return None
        if self._preparing is None:
            stopped = (self._released.is_set,)
            self._preparing = Thread(target=now.soundscape.prepare, args=stopped, daemon=True)
            self._preparing.start()
        return None if self._preparing.is_alive() else self._speaker

    def picture(
        self, language: str, size: tuple[int, int], dpi: float
    ) -> tuple[Hashable, Callable[[], np.ndarray]] | None:
        """Return what the captions' picture depends on, and how to make it; None without any."""
        if not self._lines:
            return None
        texts = tuple(
            (words.text(language, f"sound.{line.name}"), line.arrow, line.opacity)
            for line in self._lines
        )
        return (texts, size, dpi), lambda: caption_image(texts, size, dpi)

    def release(self) -> None:
        """Close the speaker; may be called twice."""
        self._open = None
        self._released.set()
        if self._preparing is not None:
            self._preparing.join()
        if self._speaker is not None:
            self._speaker.close()
            self._speaker = None
