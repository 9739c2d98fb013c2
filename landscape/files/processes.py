"""Starting worker processes, and ending with them: none outlives the command that started it."""

import multiprocessing
import os
import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager

LEAST_MEMORY = 1 << 30  # chosen: bytes of memory for each process; the largest scene takes 0.9 GB
# What a process is started with, unless the user has set it: llvmpipe draws in the process's own
# thread, and numpy's library starts none.
ONE_CORE = {"LP_NUM_THREADS": "0", "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}


def cores() -> int:
    """Return how many processes draw if nobody says: one for each core that has enough memory."""
    count = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    try:
        memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    except (AttributeError, ValueError, OSError):
        memory = LEAST_MEMORY
    return max(min(count or 1, memory // LEAST_MEMORY), 1)


@contextmanager
def one_core() -> Iterator[None]:
    """Let the processes that the block starts work on one core each."""
    own = {name: value for name, value in ONE_CORE.items() if name not in os.environ}
    os.environ.update(own)
    try:
        yield
    finally:
        for name in own:
            del os.environ[name]


@contextmanager
def interrupts_held() -> Iterator[None]:
    """Hold back Ctrl-C inside the block, for this thread and the processes it starts.

    A worker ignores Ctrl-C once its initializer has run; without this, one that comes earlier
    ends the worker with a traceback on the user's screen. It reaches this thread after the block.
    """
    held = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, held)


def begin_worker() -> None:
    """Initialise a worker process: it leaves Ctrl-C to its parent, and ends when its parent does.

    A parent that is killed cannot tell its workers, which would wait for work for ever.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = multiprocessing.parent_process()

    def end_with_parent() -> None:
        if parent is not None:
            parent.join()
            os._exit(1)

    threading.Thread(target=end_with_parent, daemon=True).start()


def end_tidily() -> None:
    """Let `kill`, and a terminal that closes, end this process as an exception would.

    So a command that they end leaves no temporary file and no worker. A signal that somebody
    handles or ignores already, as nohup does, is left alone.
    """
    if threading.current_thread() is not threading.main_thread():
        return  # only the main thread may handle signals

    def end(number: int, _: object) -> None:
        raise SystemExit(128 + number)

    for number in (signal.SIGTERM, signal.SIGHUP):
        if signal.getsignal(number) is signal.SIG_DFL:
            signal.signal(number, end)
