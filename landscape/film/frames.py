"""The pictures of a film in their order, drawn side by side.

A task is one frame. The worker that draws it opens the film for itself and keeps it open for its
next frame. Only a few pictures exist at a time, however long the film is.
"""

import pickle
import zlib
from collections.abc import Callable, Generator, Sequence
from concurrent.futures import Executor
from functools import partial

import numpy as np

from framelens.base.errors import InputError
from framelens.base.executor import Kept, WorkerKilled, ahead, in_order
from landscape.film.cut import Film
from landscape.film.stage import Stage
from landscape.scene.scene import SCENES

DIED = "film: a process that draws was killed (perhaps out of memory; --jobs 1 takes the least)"
TOO_LARGE = "not enough memory: expected a smaller --size or fewer --jobs"


def drawn(
    film: Film, executor: Executor, jobs: int, numbers: Sequence[int] | None = None
) -> Generator[np.ndarray, None, None]:
    """Yield the film's pictures in their order, uint8 (h, w, 3), drawn by ``jobs`` workers.

    With ``numbers``, only these frames. InputError and NoOpenGLError as they are raised there;
    InputError if a worker dies.
    """
    frames = range(film.frames) if numbers is None else numbers
    packed = zlib.compress(pickle.dumps(film))
    try:
        yield from in_order(executor, partial(frame, packed), frames, ahead(jobs))
    except WorkerKilled:
        raise InputError(DIED) from None
    finally:
        _open.close()  # where the executor is one in this process


def frame(packed: bytes, number: int) -> np.ndarray:
    """Return a frame of a film, uint8 (h, w, 3): a task for any executor."""
    try:
        with _open.opened(packed, lambda: _Opened(packed)) as film:
            return np.ascontiguousarray(film.picture(number))
    except MemoryError:
        raise InputError(TOO_LARGE) from None


class _Opened:
    """A film with the stage on which it is drawn."""

    def __init__(self, packed: bytes) -> None:
        film: Film = pickle.loads(zlib.decompress(packed))
        SCENES.update(film.drawing.scenes)
        self.stage = Stage(film.drawing)
        self.picture: Callable[[int], np.ndarray] = film.open(self.stage)

    def close(self) -> None:
        """Release what is open."""
        self.stage.close()


_open: Kept[_Opened] = Kept()
