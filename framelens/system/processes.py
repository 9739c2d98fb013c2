"""Starting worker processes, and ending with them: none outlives the command that started it."""

import multiprocessing
import os
import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager

from framelens import system
from framelens.system.beside import beside

LEAST_MEMORY = 1 << 30  # chosen: bytes of memory for each process; the largest scene takes 0.9 GB
# Environment of a new process, unless the user has set it: llvmpipe draws in the process's own
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

    beside(end_with_parent)


class Ending:
    """The signal that ended this process, if one did.

    Python raises an exception wherever the signal finds it. That exception may be lost: ctypes puts
    the words of any other into an ArgumentError when it is converting the arguments of a call.
    """

    def __init__(self) -> None:
        self.status = 0  # what the process ends with, by the shell's rule; 0 as no signal has come

    def end(self, number: int, _: object) -> None:
        """Handle a signal: raise KeyboardInterrupt for Ctrl-C, SystemExit for any other."""
        self.status = 128 + number
        if number == signal.SIGINT:
            raise KeyboardInterrupt
        raise SystemExit(self.status)


@contextmanager
def ending_tidily() -> Iterator[Ending]:
    """Let signals that end a process, as `kill` sends them, do so as an exception would.

    So a command that they end leaves no temporary file and no worker. A signal that somebody
    handles or ignores already, as nohup does, is left alone.
    """
    ending = Ending()
    former = {}
    if threading.current_thread() is threading.main_thread():  # no other may handle signals
        for number in (signal.SIGINT, *system.ENDING_SIGNALS):
            handler = signal.getsignal(number)
            if handler in (signal.SIG_DFL, signal.default_int_handler):
                former[number] = signal.signal(number, ending.end)
    try:
        yield ending
    finally:
        for number, handler in former.items():
            signal.signal(number, handler)
