"""The sound of a film: what its clips let one hear, faded as their pictures are, in a part of its
own.

It is the sound that the walk has (landscape/sound), from a function of seconds to what is heard, as
a picture is from a function of seconds. So the file is the same whoever makes it.
"""

import io
import math
import pickle
import zlib
from collections.abc import Callable, Iterator, Sequence
from typing import Protocol, runtime_checkable

import numpy as np

from landscape.film.cut import Film, Part
from landscape.film.encode import BITEXACT, pyav
from landscape.film.stage import Stage
from landscape.scene.scene import SCENES
from landscape.sound.mixer import limited, mix
from landscape.sound.score import KEYS_PER_SECOND, Heard, Score
from landscape.sound.signal import QUANTUM, RATE

CODECS = {".mp4": ("aac", 160_000), ".webm": ("libopus", 128_000)}  # chosen: bits a second
BLOCK = 1.0  # chosen: seconds that are mixed and encoded at a time

Listening = Callable[[float], Heard]
"""From seconds since a clip's start to what there is to hear."""


@runtime_checkable
class Audible(Protocol):
    """A clip that can be heard; it need not be one."""

    def listen(self, stage: Stage) -> Listening:
        """Return what there is to hear, on a stage that may open scenes for that."""


class Track:
    """The sound of a film's part, from its beginning on; what is over is forgotten."""

    def __init__(self, part: Part, begin: float, stage: Stage) -> None:
        """Begin ``begin`` seconds after the film; nothing is opened before it is heard."""
        self._part, self._stage = part, stage
        self._first = round(begin * RATE / QUANTUM) * QUANTUM
        self._listening: Listening | None = None
        self._score, self._keys = Score(), 0

    def mixed(self, begin: int, samples: int) -> np.ndarray:
        """Return the film's samples from ``begin`` on, as far as they are this part's."""
        clip = self._part.clip
        since, last = begin - self._first, round(clip.seconds * RATE)
        if not isinstance(clip, Audible) or since + samples <= 0 or since >= last:
            return np.zeros((samples, 2), np.float32)
        if self._listening is None:
            self._listening = clip.listen(self._stage)
        while self._keys * RATE <= (since + samples) * KEYS_PER_SECOND:
            at = self._keys / KEYS_PER_SECOND
            self._score.add(at, self._listening(min(at, clip.seconds)))
            self._keys += 1
        lead = max(-since, 0)
        sound = mix(self._score, since + lead, samples - lead)
        self._score.forget((since + samples) // QUANTUM)
        sound[max(last - since - lead, 0) :] = 0.0
        return np.concatenate([np.zeros((lead, 2), np.float32), sound])


def _loud(film: Film, k: int, seconds: np.ndarray, starts: Sequence[float]) -> np.ndarray:
    """Return how loud part ``k`` is at times of the film: it fades in, and out under the next."""
    after = film.parts[k + 1].fade if k + 1 < len(film.parts) else 0.0
    loud = fading(seconds - starts[k], film.parts[k].fade, k == 0)
    loud *= faded_out(seconds - starts[k + 1], after)
    return loud


def blocks(film: Film, stage: Stage) -> Iterator[np.ndarray]:
    """Yield the sound of a film block by block, float32 (n, 2) in -1..1."""
    starts = film.starts()
    tracks = [
        Track(part, start, stage) for part, start in zip(film.parts, starts[:-1], strict=True)
    ]
    total = round(film.frames / float(film.fps) * RATE)
    step = round(BLOCK * RATE)
    for begin in range(0, total, step):
        samples = min(step, total - begin)
        seconds = (begin + np.arange(samples)) / RATE
        sound = np.zeros((samples, 2), np.float32)
        for k, track in enumerate(tracks):
            loud = _loud(film, k, seconds, starts)
            if loud.any():
                sound += loud[:, None] * track.mixed(begin, samples)
        if film.ending > 0.0:
            sound *= eased((starts[-1] - seconds) / film.ending)[:, None]
        yield limited(sound)


def fading(since: np.ndarray, fade: float, first: bool) -> np.ndarray:
    """Return the amplitudes, float32 (n,), of a part that comes in ``since`` its start.

    Two parts that cross have equal power; the first one comes in from silence, as from black.
    """
    share = eased(since / fade) if fade > 0.0 else (since >= 0.0).astype(np.float32)
    return share if first else np.sin(share * np.float32(math.pi / 2))


def faded_out(since: np.ndarray, fade: float) -> np.ndarray:
    """Return the amplitudes, float32 (n,), of a part after which the next one comes in."""
    if fade <= 0.0:
        return np.ones(len(since), np.float32)
    return np.cos(eased(since / fade) * np.float32(math.pi / 2))


def eased(t: np.ndarray) -> np.ndarray:
    """Return t (n,) in 0..1, eased at both ends, as pictures are faded: cut.smooth."""
    t = np.clip(t, 0.0, 1.0)
    return (t * t * (3 - 2 * t)).astype(np.float32)


def sound_part(packed: bytes, ending: str) -> bytes:
    """Return the sound of a film, encoded for a file of this ending: a task for any executor."""
    film: Film = pickle.loads(zlib.decompress(packed))
    SCENES.update(film.drawing.scenes)
    with Stage(film.drawing) as stage:
        return encoded(blocks(film, stage), ending)


def encoded(sound: Iterator[np.ndarray], ending: str) -> bytes:
    """Return blocks of sound (n, 2) as the content of a file of sound alone."""
    av = pyav(ending)
    codec, bits = CODECS[ending]
    data = io.BytesIO()
    container = av.open(data, "w", ending[1:], BITEXACT)
    stream = container.add_stream(codec, rate=RATE, layout="stereo")
    stream.bit_rate = bits
    stream.codec_context.thread_count = 1
    done = 0
    for block in sound:
        planes = np.ascontiguousarray(block.T)
        frame = av.AudioFrame.from_ndarray(planes, format="fltp", layout="stereo")
        frame.sample_rate = RATE
        frame.pts = done
        done += len(block)
        container.mux(stream.encode(frame))
    container.mux(stream.encode())
    container.close()
    return data.getvalue()
