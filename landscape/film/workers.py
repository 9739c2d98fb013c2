"""The pictures of a film in their order, drawn by several processes.

Each process opens the film for itself, and draws the frames whose numbers it is sent, one after
another; it is always a picture ahead, so that it need not wait. Only a few pictures exist at a
time, however long the film is. Each process draws on one core: on several, the threads of a
software renderer would only get in each other's way.
"""

import multiprocessing
import traceback
from collections import deque
from collections.abc import Generator, Sequence
from contextlib import suppress
from multiprocessing.connection import Connection, wait
from typing import Any

import numpy as np

from framelens.base.errors import InputError, NoOpenGLError, UnexpectedError, located
from framelens.system import starting_workers
from framelens.system.processes import begin_worker, one_core
from landscape.film.cut import Film
from landscape.film.stage import Stage
from landscape.scene.scene import SCENES

AHEAD = 2  # pictures that a process has been asked for and that have not come yet
EARLY = 3  # times the number of processes: pictures that may wait for an earlier one
DIED = "film: a process that draws was killed (perhaps out of memory; --jobs 1 takes the least)"


def drawn(
    film: Film, jobs: int, numbers: Sequence[int] | None = None
) -> Generator[np.ndarray, None, None]:
    """Yield the film's pictures in their order, uint8 (h, w, 3), drawn by ``jobs`` processes.

    With ``numbers``, only these frames. InputError and NoOpenGLError as they are raised there;
    InputError if a process dies. When the generator is closed, the processes end.
    """
    frames = range(film.frames) if numbers is None else numbers
    count = len(frames)
    crew = [_Worker(film) for _ in range(min(jobs, count))]

    try:
        with one_core(), starting_workers():
            for worker in crew:
                worker.start()
        waiting: dict[int, np.ndarray] = {}
        shown = asked = 0
        while shown < count:
            for worker in sorted(crew, key=lambda each: len(each.asked)):
                while (
                    asked < count
                    and len(worker.asked) < AHEAD
                    and asked < shown + (AHEAD + EARLY) * len(crew)
                ):
                    worker.ask(asked, frames[asked])
                    asked += 1
            ready = wait([worker.pipe for worker in crew if worker.asked])
            for worker in crew:
                if worker.pipe in ready:
                    number, pixels = worker.answer(film.drawing.size)
                    waiting[number] = pixels
            while shown in waiting:
                yield waiting.pop(shown)
                shown += 1
    finally:
        for worker in crew:
            worker.end()


class _Worker:
    """One process: its pipe, and the frames it has been asked for."""

    def __init__(self, film: Film) -> None:
        self._film = film
        self.asked: deque[int] = deque()
        self._process: Any = None

    def start(self) -> None:
        """Start the process."""
        # Spawned, not forked: a fork of a process that has used OpenGL may hang.
        spawn = multiprocessing.get_context("spawn")
        self.pipe, theirs = spawn.Pipe()
        self._process = spawn.Process(target=_work, args=(theirs, self._film), daemon=True)
        self._process.start()
        theirs.close()

    def ask(self, place: int, number: int) -> None:
        """Ask for a frame by its number; ``place`` is which one it is of those that are drawn."""
        try:
            self.pipe.send(number)
        except OSError:
            raise InputError(DIED) from None
        self.asked.append(place)

    def answer(self, size: tuple[int, int]) -> tuple[int, np.ndarray]:
        """Return the place of the frame asked for first, and its picture."""
        try:
            error = self.pipe.recv()
            if error is None:
                data = self.pipe.recv_bytes()
        except (EOFError, OSError):
            raise InputError(DIED) from None
        if error is not None:
            raise error
        return self.asked.popleft(), np.frombuffer(data, np.uint8).reshape(size[1], size[0], 3)

    def end(self) -> None:
        """End the process, whatever it does."""
        if self._process is None:
            return
        self.pipe.close()
        self._process.terminate()
        self._process.join()
        self._process.close()


def _work(pipe: Connection, film: Film) -> None:
    """Draw the frames that are asked for, until the pipe is closed."""
    with suppress(EOFError, OSError):
        try:
            begin_worker()
            SCENES.update(film.drawing.scenes)
            with Stage(film.drawing) as stage:
                picture = film.open(stage)
                while True:
                    pixels = picture(pipe.recv())
                    pipe.send(None)
                    pipe.send_bytes(np.ascontiguousarray(pixels).reshape(-1).data)
        except (InputError, NoOpenGLError) as error:
            pipe.send(error)
        except MemoryError:
            pipe.send(InputError("not enough memory: expected a smaller --size or fewer --jobs"))
        except (EOFError, OSError):
            raise
        except Exception as error:
            pipe.send(UnexpectedError(located(error), traceback.format_exc()))
