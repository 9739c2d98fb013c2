"""Starting worker processes."""

import signal
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
