"""Pictures drawn by several processes, each some of their columns.

Threads would share the work badly: numpy releases Python's lock inside its loops only, and a frame
is some thousand short ones. So each further core has a process of its own. It has the terrain, is
sent a camera, and draws its columns into the picture, whose memory all processes share. The first
columns are drawn by the process that asks. Where the picture is divided follows from how long each
took for the last one; the picture is the same, wherever that is.

Processes are started anew, not forked from one that may have used OpenGL. That takes a moment:
until they are ready, pictures are drawn by this process alone, and so are they after one has ended.
"""

import contextlib
import multiprocessing
import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass
from multiprocessing.connection import wait
from multiprocessing.context import SpawnProcess

import numpy as np

from framelens.base import arguments
from framelens.base.executor import companion
from framelens.system.processes import cores
from framelens.system.sharing import Bell, Pipe, SharedMemory
from landscape.flyover import frame
from landscape.flyover.camera import Camera
from landscape.flyover.height_field import HeightField
from landscape.flyover.look import look
from landscape.flyover.settings import MOST_PROCESSES, Settings, check

DAMPING = 0.7  # how far cuts go towards where they should have been, chosen
READY_WITHIN = 60.0  # seconds, chosen
ENDED = "landscape: flyover: a process that draws has ended (%s); from now on one draws alone"


def processes(asked: int | None = None) -> int:
    """Return how many processes draw: as many as asked for, or one for each of the first cores."""
    return asked or min(cores(), MOST_PROCESSES)


@dataclass(frozen=True)
class Task:
    """A process's task: a picture to draw; settings are None where they stay as before."""

    camera: Camera
    settings: Settings | None
    size: tuple[int, int]
    columns: range


Answer = bool | str | tuple[float, dict[str, int]]
"""What a process sends: that it is ready, why it failed, or how long it drew, and its counts."""


class Crew:
    """Draws pictures of a terrain with some processes; use as ``with Crew(...) as crew``."""

    def __init__(self, terrain: HeightField, count: int) -> None:
        """Start all of ``count`` processes but this one; if that fails, say so on stderr."""
        self.terrain = terrain
        self._workers: list[_Worker] = []
        self._ready = False
        self._settings: Settings | None = None
        self._cuts: dict[object, list[int]] = {}
        self._picture: np.ndarray | None = None
        # Kept until all processes have opened it, which they do by its name on Windows.
        self._heights: SharedMemory | None = None
        self._canvas: frame.Canvas | None = None
        if count > 1:
            try:
                self._start(count - 1)
            except OSError as error:
                self._give_up(str(error))

    def _start(self, count: int) -> None:
        """Start processes, which share the terrain and the picture with this one."""
        self._heights = heights = SharedMemory(self.terrain.values.nbytes)
        picture = SharedMemory(4 * arguments.MAX_PIXELS)
        try:
            _heights(heights, self.terrain.values.size)[:] = self.terrain.values
            self._picture = _pixels(picture)
            given = self.terrain.side, self.terrain.unit, self.terrain.name
            for _ in range(count):
                worker = _Worker()
                self._workers.append(worker)
                worker.start(heights, picture, self.terrain.values.size, given)
        finally:
            heights.close()
            picture.close()

    @property
    def processes(self) -> int:
        """How many processes draw the next picture, this one included."""
        if not self._ready and self._workers:
            try:
                self._ready = all([worker.is_ready() for worker in self._workers])
            except (EOFError, OSError) as error:
                self._give_up(_reason(error))
        return 1 + len(self._workers) * self._ready

    def wait(self) -> int:
        """Wait until all processes are ready; return how many draw."""
        until = time.monotonic() + READY_WITHIN
        while self._workers and self.processes == 1:
            late = [worker.pipe for worker in self._workers if not worker.ready]
            if not wait(late, max(until - time.monotonic(), 0)):
                self._give_up("it was not ready in time")
        return self.processes

    def draw(self, camera: Camera, settings: Settings, size: tuple[int, int]) -> frame.Frame:
        """Draw a picture, see :func:`.frame.draw`; its memory is that of the next one.

        Lines that two processes draw are counted twice.
        """
        check(settings)
        size = arguments.size(size)
        if self._canvas is None or self._canvas.picture.shape != size[::-1]:
            shape, count = size[::-1], size[0] * size[1]
            flat = np.empty(count, np.uint32) if self._picture is None else self._picture[:count]
            self._canvas = frame.Canvas(flat.reshape(shape))
        if self.processes == 1:
            return frame.draw(self.terrain, camera, settings, size, None, self._canvas)
        try:
            return self._divided(camera, settings, size, self._canvas)
        except BaseException:
            self.close()  # what the others have still to say belongs to no later picture
            raise

    def _divided(
        self, camera: Camera, settings: Settings, size: tuple[int, int], canvas: frame.Canvas
    ) -> frame.Frame:
        """Draw a picture together with the workers."""
        if settings.flyover.mode == "filled":
            look(self.terrain, settings)  # the others find it in the cache
        key = size[0], settings.flyover.mode
        cuts = self._cuts.get(key) or even(size[0], self.processes)
        parts = [range(*ends) for ends in zip(cuts[:-1], cuts[1:], strict=True)]
        new = settings if settings != self._settings else None
        started = time.perf_counter()
        failed = []
        for worker, columns in zip(self._workers, parts[1:], strict=True):
            try:
                worker.ask(Task(camera, new, size, columns))
            except OSError as error:
                failed.append((columns, _reason(error)))

        self._settings = settings
        drawn = frame.draw(self.terrain, camera, settings, size, parts[0], canvas)
        times, counts = [time.perf_counter() - started], [drawn.counts]
        for worker, columns in zip(self._workers, parts[1:], strict=True):
            if any(columns is each for each, _ in failed):
                continue
            try:
                seconds, found = worker.answer()
            except (EOFError, OSError, _Failed) as error:
                failed.append((columns, _reason(error)))
                continue
            times.append(seconds)
            counts.append(found)

        for columns, _ in failed:
            alone = frame.draw(self.terrain, camera, settings, size, columns, canvas)
            counts.append(alone.counts)
        if failed:
            self._give_up(failed[0][1])
        else:
            self._cuts[key] = balanced(cuts, times)

        total = {name: sum(each[name] for each in counts) for name in drawn.counts}
        return frame.Frame(drawn.rgba, total)

    def _give_up(self, reason: str) -> None:
        """End the other processes, and say why."""
        self.close()
        if sys.stderr is not None:
            print(ENDED % reason, file=sys.stderr)

    def close(self) -> None:
        """End the other processes; may be called twice. Pictures can still be drawn."""
        workers = self._workers
        self._workers = []
        self._ready = False
        for worker in workers:
            worker.end()

    def __enter__(self) -> "Crew":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def even(width: int, count: int) -> list[int]:
    """Return where a picture is divided into parts of equal width: count + 1 columns."""
    return _rounded(np.linspace(0, width, count + 1))


def balanced(cuts: Sequence[int], seconds: Sequence[float]) -> list[int]:
    """Return where to divide the next picture, from how long each part of the last one took.

    Within each part, all columns are taken to be equal.
    """
    done = np.concatenate([[0.0], np.cumsum(seconds)])
    aim = np.interp(np.linspace(0, done[-1], len(cuts)), done, cuts)
    return _rounded(np.array(cuts) + DAMPING * (aim - np.array(cuts)))


def _rounded(cuts: np.ndarray) -> list[int]:
    """Return cuts at multiples of CUT, no part without a column as long as there are enough."""
    inner = np.rint(cuts[1:-1] / frame.CUT).astype(int)
    most = int(cuts[-1] - 1) // frame.CUT
    for k in range(len(inner)):
        before = inner[k - 1] if k else 0
        inner[k] = min(max(inner[k], before + 1), max(most - (len(inner) - 1 - k), 0))
    return [0, *(inner * frame.CUT).tolist(), int(cuts[-1])]


class _Failed(Exception):
    """A process could not draw."""


class _Worker:
    """A process that draws parts of pictures."""

    def __init__(self) -> None:
        self._process: SpawnProcess | None = None
        self.ready = False
        self.pipe: Pipe[Task, Answer]
        self._bell: Bell

    def start(
        self,
        heights: SharedMemory,
        picture: SharedMemory,
        count: int,
        given: tuple[int, float, str],
    ) -> None:
        """Start the process; ``given`` is what describes ``count`` heights as a terrain."""
        self.pipe, theirs = multiprocessing.get_context("spawn").Pipe()
        self._bell = Bell()
        task = _Given(theirs, self._bell, heights, picture, count, given)
        try:
            self._process = companion(_work, task)
        except BaseException:
            self._hang_up()
            raise
        finally:
            theirs.close()

    def is_ready(self) -> bool:
        """Return whether the process can draw; EOFError if it has ended."""
        if not self.ready and self.pipe.poll():
            self.ready = bool(self.pipe.recv())
        return self.ready

    def ask(self, task: Task) -> None:
        """Ask for a part; OSError if the process has ended."""
        self.pipe.send(task)
        self._bell.ring()

    def answer(self) -> tuple[float, dict[str, int]]:
        """Wait until a part is drawn; return how long it took, and its counts."""
        found = self.pipe.recv()
        if not isinstance(found, tuple):
            raise _Failed(str(found))
        return found

    def end(self) -> None:
        """End the process, whatever it does."""
        if self._process is None:
            return
        self._hang_up()
        self._process.terminate()
        self._process.join()
        self._process.close()
        self._process = None

    def _hang_up(self) -> None:
        self.pipe.close()
        self._bell.close()


@dataclass(frozen=True)
class _Given:
    """The arguments that a process is started with."""

    pipe: "Pipe[Answer, Task]"
    bell: Bell
    heights: SharedMemory
    picture: SharedMemory
    count: int  # of the heights
    given: tuple[int, float, str]  # side, unit and name of the terrain


def _work(given: _Given) -> None:
    """Draw the parts that are asked for, until the pipe is closed."""
    terrain = HeightField(_heights(given.heights, given.count), *given.given)
    memory = _pixels(given.picture)
    canvas = frame.Canvas(np.empty((0, 0), np.uint32))
    settings = Settings()
    pipe = given.pipe

    with contextlib.suppress(EOFError, OSError):
        pipe.send(True)
        while True:
            given.bell.wait()
            task = pipe.recv()
            started = time.perf_counter()
            settings = task.settings or settings
            width, height = task.size
            if canvas.picture.shape != (height, width):
                canvas = frame.Canvas(memory[: width * height].reshape(height, width))
            try:
                drawn = frame.draw(terrain, task.camera, settings, task.size, task.columns, canvas)
            except Exception as error:
                pipe.send(_reason(error))
                return
            pipe.send((time.perf_counter() - started, drawn.counts))


def _reason(error: BaseException) -> str:
    """Return an error in one line."""
    if isinstance(error, (EOFError, ConnectionError)):
        return "it was killed"
    return " ".join(str(error).split()) or type(error).__name__


def _heights(shared: SharedMemory, count: int) -> np.ndarray:
    """Return the heights in shared memory, float32 (count,)."""
    return np.frombuffer(shared.memory, np.float32, count)


def _pixels(shared: SharedMemory) -> np.ndarray:
    """Return the pixels in shared memory, uint32, as many as the largest picture has."""
    return np.frombuffer(shared.memory, np.uint32)
