"""The speaker: sound from the walk to the device, by miniaudio (the extra ``sound``).

The device asks for samples in a thread of its own, which must not wait: for Python's lock it waits
at most a few milliseconds, and there it only copies what lies ready in a ring. The walk fills the
ring, at each frame as far ahead as the last frame was long and AHEAD more. Where a frame took
longer than that, the sound fades out and in again, without a click.

No device is a normal state: a computer without a sound card, or without miniaudio, walks in
silence, and nothing is said about it.
"""

import importlib.util
import os
import sys
from collections.abc import Generator, Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np

from landscape.sound.signal import QUANTUM, RATE
from landscape.sound.wave_file import pcm16

AHEAD = 0.1  # chosen: seconds that lie ready in the ring
MOST_AHEAD = 0.5  # chosen: however long a frame takes, what one hears must not lag behind more
PERIOD_MS = 20  # chosen: of the device's own buffers
FADE = RATE // 200  # chosen: samples in which sound ends where nothing lies ready: 5 ms


class Ring:
    """Samples between two threads: one writes, the other takes. Neither waits for the other.

    Each only writes its own counter, and reads the other's once, so there is nothing to lock.
    """

    def __init__(self, samples: int = RATE) -> None:
        """Hold at most ``samples``, int16 (samples, 2)."""
        self._samples = np.zeros((samples, 2), np.int16)
        self.written = 0
        self.taken = 0
        self._last = np.zeros(2)  # the sample that was taken last
        self._starved = True

    @property
    def ready(self) -> int:
        """How many samples lie ready."""
        return self.written - self.taken

    def write(self, samples: np.ndarray) -> None:
        """Add int16 samples (n, 2); those for which there is no place are dropped."""
        count = min(len(samples), len(self._samples) - self.ready)
        places = (self.written + np.arange(count)) % len(self._samples)
        self._samples[places] = samples[:count]
        self.written += count

    def take(self, count: int) -> np.ndarray:
        """Return ``count`` samples, int16 (count, 2); where too few lie ready, the sound fades."""
        found = min(count, self.ready)
        places = (self.taken + np.arange(found)) % len(self._samples)
        out = np.zeros((count, 2), np.int16)
        out[:found] = self._samples[places]
        self.taken += found
        if self._starved and found:
            rise = np.minimum(np.arange(1, found + 1) / FADE, 1.0)[:, None]
            out[:found] = np.rint(out[:found] * rise)
        if found:
            self._last = out[found - 1].astype(np.float64)
        if found < count:
            fall = np.maximum(1.0 - np.arange(1, count - found + 1) / FADE, 0.0)[:, None]
            out[found:] = np.rint(self._last * fall)
            self._last = out[-1].astype(np.float64)
        self._starved = found < count
        return out


def is_installed() -> bool:
    """Return whether miniaudio is installed: without it, no sound need be made."""
    return importlib.util.find_spec("miniaudio") is not None


class Speaker:
    """A device that plays what is written; use :meth:`close` at the end."""

    def __init__(self, null: bool = False) -> None:
        """Open the device; ``null`` opens one that plays nothing. OSError where there is none."""
        try:
            import miniaudio
        except ImportError as error:
            raise OSError("miniaudio is not installed") from error

        self.ring = Ring()
        self._device: Any = None
        backends = [miniaudio.Backend.NULL] if null else None
        try:
            with quiet():
                self._device = miniaudio.PlaybackDevice(
                    output_format=miniaudio.SampleFormat.SIGNED16,
                    nchannels=2,
                    sample_rate=RATE,
                    buffersize_msec=PERIOD_MS,
                    backends=backends,
                    app_name="landscape",
                )
                if not null and self._device.backend.lower() == "null":
                    raise OSError("no sound device")
                generator = self._played()
                next(generator)
                self._device.start(generator)
        except (miniaudio.MiniaudioError, OSError) as error:
            self.close()
            raise OSError(str(error)) from None

    def _played(self) -> Generator[np.ndarray, int, None]:
        """Take what the device asks for; it runs in the device's thread."""
        count = yield np.zeros((0, 2), np.int16)
        while True:
            count = yield self.ring.take(count)

    def wanted(self, frame_seconds: float) -> int:
        """Return how many quanta are to be written, when a frame takes so many seconds."""
        ahead = min(AHEAD + frame_seconds, MOST_AHEAD)
        missing = round(ahead * RATE) - self.ring.ready
        return max(-(-missing // QUANTUM), 0)

    def write(self, samples: np.ndarray) -> None:
        """Add samples, float32 (n, 2) in -1..1."""
        self.ring.write(pcm16(samples))

    def close(self) -> None:
        """Stop; may be called twice."""
        if self._device is not None:
            with quiet():
                self._device.close()
            self._device = None


@contextmanager
def quiet() -> Iterator[None]:
    """Keep the libraries of sound systems from listing on standard error what is missing.

    They write to the file descriptor itself, past Python.
    """
    sys.stderr.flush()
    try:
        kept = os.dup(2)
    except OSError:  # there is no standard error
        yield
        return
    try:
        with open(os.devnull, "w") as nowhere:
            os.dup2(nowhere.fileno(), 2)
        yield
    finally:
        os.dup2(kept, 2)
        os.close(kept)
