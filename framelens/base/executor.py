"""Work done side by side: our executor of processes, and results in order from any executor.

A function that works side by side takes ``executor=``, any ``concurrent.futures.Executor``: ours,
or one of a cluster. Its tasks are functions of a module with plain arguments, which are pickled;
their results are values. A worker may keep what is slow to open for its next task (:class:`Kept`),
but a result depends on the task's arguments alone.
"""

import multiprocessing
import os
import threading
import time
from collections import deque
from collections.abc import Callable, Generator, Iterable, Iterator
from concurrent.futures import BrokenExecutor, Executor, Future, ProcessPoolExecutor
from contextlib import contextmanager
from itertools import islice
from multiprocessing.context import SpawnProcess
from typing import Generic, Protocol, TypeVar

from framelens.base.errors import InputError
from framelens.system import starting_workers
from framelens.system.beside import beside
from framelens.system.processes import begin_worker, one_core

Item = TypeVar("Item")
Result = TypeVar("Result")

EACH = 4  # chosen: results of each worker that may wait for an earlier one
GRACE = 0.1  # chosen: seconds in which a worker that is to end has sent its last result
KILLED = "a process was killed (perhaps out of memory)"


class PipeEnd(Protocol):
    """The end of a pipe, of which each system has a class of its own."""

    def poll(self, timeout: float | None, /) -> bool:
        """Wait until there is something to read, or the other end is closed."""


class WorkerKilled(InputError):
    """A process of an executor has ended before its work was done."""


class Here(Executor):
    """An executor in this process: a task is done when it is submitted."""

    def submit(
        self, function: Callable[..., Result], /, *arguments: object, **named: object
    ) -> "Future[Result]":
        future: Future[Result] = Future()
        try:
            future.set_result(function(*arguments, **named))
        except Exception as error:
            future.set_exception(error)
        return future


class Processes(ProcessPoolExecutor):
    """An executor of processes, each on one core. None outlives the block or the parent.

    They are started anew, not forked: a fork of a process that has used OpenGL may hang. Where the
    ``with`` is left by an exception, they end at once, whatever they do.
    """

    def __init__(self, count: int) -> None:
        spawn = multiprocessing.get_context("spawn")
        # Whoever reads finds the pipe's end when this process closes it.
        self._theirs, self._ours = spawn.Pipe(duplex=False)
        super().__init__(count, spawn, _begin, (self._theirs,))

    def submit(
        self, function: Callable[..., Result], /, *arguments: object, **named: object
    ) -> "Future[Result]":
        with one_core(), starting_workers():
            return super().submit(_work, function, arguments, named)

    def __exit__(self, kind: object, error: object, traceback: object) -> bool | None:
        if kind is None:
            self.shutdown()
        else:
            self.end()
        self._theirs.close()
        self._ours.close()
        return None

    def end(self) -> None:
        """End the processes, and cancel what they have not done."""
        processes = list((self._processes or {}).values())
        # In this order: a pool whose processes end before it is told reports that as a fault.
        self.shutdown(wait=False, cancel_futures=True)
        self._ours.close()
        for process in processes:
            process.join()


# Held while a worker runs a task. A worker may end inside a task or between two, but not while it
# sends a result: its parent would then wait for ever.
_task = threading.Lock()
_at_work = False


def _begin(parent: PipeEnd) -> None:
    """Initialise a worker process."""
    begin_worker()
    beside(_end_with, parent)


def _end_with(parent: PipeEnd) -> None:
    """End this process once the parent has closed its end of a pipe."""
    parent.poll(None)
    until = time.monotonic() + GRACE
    while time.monotonic() < until:
        with _task:
            if _at_work:
                os._exit(1)
        time.sleep(GRACE / 10)
    os._exit(1)


def _work(
    function: Callable[..., Result], arguments: tuple[object, ...], named: dict[str, object]
) -> Result:
    """Do a task in a worker process."""
    global _at_work
    with _task:
        _at_work = True
    try:
        return function(*arguments, **named)
    finally:
        with _task:
            _at_work = False


def companion(work: Callable[..., None], *arguments: object) -> SpawnProcess:
    """Start a process that does one thing beside this one, for as long as this one wants.

    It is started anew, on one core, leaves Ctrl-C to this process and ends with it. For work that
    is asked for many times a second; all other goes through an executor.
    """
    process = multiprocessing.get_context("spawn").Process(
        target=_accompany, args=(work, *arguments), daemon=True
    )
    with one_core(), starting_workers():
        process.start()
    return process


def _accompany(work: Callable[..., None], *arguments: object) -> None:
    begin_worker()
    work(*arguments)


def executor(jobs: int) -> Executor:
    """Return an executor of ``jobs`` processes; of one, the same in this process."""
    return Processes(jobs) if jobs > 1 else Here()


@contextmanager
def lent_or_own(lent: Executor | None, jobs: int) -> Iterator[Executor]:
    """Provide the executor that the caller lends, or else an own one for the block."""
    if lent is not None:
        yield lent
        return
    with executor(jobs) as own:
        yield own


def ahead(jobs: int) -> int:
    """Return how many results may exist at a time if ``jobs`` workers are to be kept busy."""
    return EACH * jobs if jobs > 1 else 1


def in_order(
    executor: Executor, function: Callable[[Item], Result], items: Iterable[Item], ahead: int
) -> Generator[Result, None, None]:
    """Yield ``function(item)`` for each item, in order; at most ``ahead`` results exist at a time.

    When the generator is closed, or a result raises, what has not begun is cancelled. WorkerKilled
    if a process was killed.
    """
    rest = iter(items)
    waiting: deque[Future[Result]] = deque()
    try:
        waiting.extend(executor.submit(function, item) for item in islice(rest, ahead))
        while waiting:
            yield waiting.popleft().result()
            waiting.extend(executor.submit(function, item) for item in islice(rest, 1))
    except BrokenExecutor:
        raise WorkerKilled(KILLED) from None
    finally:
        for future in waiting:
            future.cancel()


class Kept(Generic[Result]):
    """A worker's cache from one task to the next: it keeps one thing open, the last asked for.

    Each thread has its own, as an OpenGL context belongs to one. One thread of a process works at
    a time.
    """

    def __init__(self) -> None:
        self._here = threading.local()

    @contextmanager
    def opened(self, key: bytes, open: Callable[[], Result]) -> Iterator[Result]:
        """Provide for the block what ``open`` returned when it was last called with this key."""
        with _one_at_a_time:
            if getattr(self._here, "key", None) != key:
                self.close()
                self._here.thing = open()
                self._here.key = key
            yield self._here.thing

    def close(self) -> None:
        """Close what this thread keeps, if anything."""
        thing = self._here.__dict__.pop("thing", None)
        self._here.__dict__.pop("key", None)
        if thing is not None:
            thing.close()


_one_at_a_time = threading.RLock()
