"""The pictures of a film in their order, drawn side by side; or its parts, drawn and encoded.

A task is one frame, or a part. The worker that draws it opens the film for itself and keeps it open
for its next one. Only a few pictures or parts exist at a time, however long the film is.
"""

import pickle
import zlib
from collections.abc import Callable, Generator, Sequence
from concurrent.futures import BrokenExecutor, Executor
from functools import partial

import numpy as np

from framelens.base.errors import InputError
from framelens.base.executor import Kept, Result, WorkerKilled, ahead, in_order
from landscape.film.cut import Film
from landscape.film.encode import Format, part_encoder
from landscape.film.stage import Stage
from landscape.scene.scene import SCENES

DIED = "film: a process that draws was killed (perhaps out of memory; --jobs 1 takes the least)"
SAMPLED = 12  # chosen: how many frames the palette of a GIF is made from
TOO_LARGE = "not enough memory: expected a smaller --size or fewer --jobs"


class TooLarge(InputError):
    """There is not enough memory for a frame, on the computer that draws it."""


def drawn(
    film: Film, executor: Executor, jobs: int, numbers: Sequence[int] | None = None
) -> Generator[np.ndarray, None, None]:
    """Yield the film's pictures in their order, uint8 (h, w, 3), drawn by ``jobs`` workers.

    With ``numbers``, only these frames. InputError and NoOpenGLError as they are raised there;
    InputError if a worker dies.
    """
    frames = range(film.frames) if numbers is None else numbers
    try:
        yield from in_order(executor, partial(frame, packed(film)), frames, ahead(jobs))
    except WorkerKilled:
        raise InputError(DIED) from None
    finally:
        close()


def frame(packed: bytes, number: int) -> np.ndarray:
    """Return a frame of a film, uint8 (h, w, 3): a task for any executor."""
    try:
        with _open.opened(packed, lambda: _Opened(packed)) as film:
            return np.ascontiguousarray(film.picture(number))
    except MemoryError:
        raise TooLarge(TOO_LARGE) from None


def parts(
    film: Film, format: Format, executor: Executor, jobs: int
) -> Generator[bytes, None, None]:
    """Yield the film's parts in their order, encoded by ``jobs`` workers; errors as of drawn."""
    task = partial(part, packed(film), format)
    try:
        yield from in_order(executor, task, range(part_count(film, format)), ahead(jobs))
    except WorkerKilled:
        raise InputError(DIED) from None
    finally:
        close()


def samples(film: Film, executor: Executor, jobs: int) -> list[np.ndarray]:
    """Return some of the film's pictures, small, from all over it."""
    count = min(SAMPLED, film.frames)
    numbers = [(2 * k + 1) * film.frames // (2 * count) for k in range(count)]
    return [pixels[::2, ::2] for pixels in drawn(film, executor, jobs, numbers)]


def part_count(film: Film, format: Format) -> int:
    """Return how many parts a film has."""
    return -(-film.frames // format.length)


def part_frames(film: Film, format: Format, number: int) -> range:
    """Return the numbers of the frames of a part."""
    first = number * format.length
    return range(first, min(first + format.length, film.frames))


def part(packed: bytes, format: Format, number: int) -> bytes:
    """Return a part of a film, encoded: a task for any executor."""
    first = number * format.length
    try:
        with _open.opened(packed, lambda: _Opened(packed)) as film:
            encoder = part_encoder(format, first)
            for each in range(first, min(first + format.length, film.frames)):
                encoder.add(np.ascontiguousarray(film.picture(each)))
            return encoder.finish()
    except MemoryError:
        raise TooLarge(TOO_LARGE) from None


def single(
    executor: Executor, function: Callable[..., Result], /, *arguments: object, times: int = 1
) -> Result:
    """Return the result of a task that is not repeated; InputError if its worker dies.

    It is asked for so many times: of each worker, where all of them are to start.
    """
    try:
        asked = [executor.submit(function, *arguments) for _ in range(times)]
        return asked[0].result()
    except (BrokenExecutor, WorkerKilled):
        raise InputError(DIED) from None


def packed(film: Film) -> bytes:
    """Return a film as the tasks take it."""
    return zlib.compress(pickle.dumps(film))


def close() -> None:
    """Close the film that this process has open, where an executor works in this process."""
    _open.close()


class _Opened:
    """A film with the stage on which it is drawn."""

    def __init__(self, packed: bytes) -> None:
        film: Film = pickle.loads(zlib.decompress(packed))
        SCENES.update(film.drawing.scenes)
        self.frames = film.frames
        self.stage = Stage(film.drawing)
        self.picture: Callable[[int], np.ndarray] = film.open(self.stage)

    def close(self) -> None:
        """Release what is open."""
        self.stage.close()


_open: Kept[_Opened] = Kept()
