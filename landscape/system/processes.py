"""Starting worker processes, and ending with them: none outlives the command that started it."""

import multiprocessing
import os
import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager

from landscape import system

LEAST_MEMORY = 1 << 30  # chosen: bytes of memory for each process; the largest scene takes 0.9 GB
# What a process is started with, unless the user has set it: llvmpipe draws in the process's own
# thread, and numpy's library starts none.
ONE_CORE = {"LP_NUM_THREADS": "0", "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}


def cores() -> int:
    """Return how many processes draw if nobody says: one for each core that has enough memory."""
    count = system.processors()
    memory = system.memory()
    if memory is None:
        return 1
    return max(min(count, memory // LEAST_MEMORY), 1)


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
    """Let signals that end a process, as `kill` sends them, do so as an exception would.

    So a command that they end leaves no temporary file and no worker. A signal that somebody
    handles or ignores already, as nohup does, is left alone.
    """
    if threading.current_thread() is not threading.main_thread():
        return  # only the main thread may handle signals

    def end(number: int, _: object) -> None:
        raise SystemExit(128 + number)

    for number in system.ENDING_SIGNALS:
        if signal.getsignal(number) is signal.SIG_DFL:
            signal.signal(number, end)
