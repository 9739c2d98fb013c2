"""Starting worker processes, and ending with them: none outlives the command that started it."""

import multiprocessing
import os
import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager


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
