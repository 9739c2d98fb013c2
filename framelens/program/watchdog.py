"""A limit for the time that someone else's code may take; it ends even a loop that does nothing.

Where the system tells the processor's time of a thread, that is what counts: on a busy machine
code gets as far as on another. Code that only waits takes none of it, and may wait WAITING times
as long.
"""

import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any

from framelens.base import guard
from framelens.system import limits

AGAIN = 0.25  # seconds until it raises once more, if the code swallowed what was raised; chosen
SOON = 0.01  # seconds between two looks at the time, at least; chosen
UNWATCHED = 1e6  # seconds: with more, the user watches the program
WAITING = 4  # chosen
# The true clocks, whatever the module holds later.
_now = time.monotonic
_spent = time.thread_time


class Watchdog:
    """``with Watchdog(seconds, late):`` raises what ``late()`` returns, in the block's thread.

    In the main thread a signal does it, which interrupts waiting too; elsewhere another thread.
    """

    def __init__(self, seconds: float, late: Callable[[], BaseException]) -> None:
        self._left = seconds
        self._wait = seconds * WAITING if limits.KNOWS_THREAD_TIME else seconds
        self._late = late
        self._spent = 0.0
        main = threading.current_thread() is threading.main_thread()
        self._by_signal = main and sys.platform != "win32"
        self._thread = threading.get_ident()
        self._timer: threading.Timer | None = None
        self._watching = False
        self._since = 0.0
        self._before: Any = None

    def __enter__(self) -> "Watchdog":
        if sys.platform != "win32" and self._by_signal:
            self._before = signal.signal(signal.SIGALRM, self._alarm)
        self._start()
        return self

    def __exit__(self, *_: object) -> None:
        self._stop()
        if sys.platform != "win32" and self._by_signal:
            signal.signal(signal.SIGALRM, self._before)

    @contextmanager
    def paused(self) -> Iterator[None]:
        """Do not count the time of the block."""
        if not self._watching:
            yield
            return
        self._stop()
        try:
            yield
        finally:
            self._start()

    def _start(self) -> None:
        self._since, self._watching = _now(), True
        self._spent = _spent()
        left, wait = max(self._left, 0.001), max(self._wait, 0.001)
        guard.go_on(left, guard.MEMORY if left < UNWATCHED else guard.MEMORY_ON_SCREEN, wait)
        if sys.platform != "win32" and self._by_signal:
            signal.setitimer(signal.ITIMER_REAL, left, AGAIN)
        else:
            self._timer = threading.Timer(left, self._from_outside)
            self._timer.daemon = True
            self._timer.start()

    def _stop(self) -> None:
        self._watching = False
        passed = _now() - self._since
        self._wait -= passed
        counted = self._by_signal and limits.KNOWS_THREAD_TIME
        self._left -= _spent() - self._spent if counted else passed
        guard.stand_by()
        if sys.platform != "win32" and self._by_signal:
            signal.setitimer(signal.ITIMER_REAL, 0)
        elif self._timer is not None:
            self._timer.cancel()
            self._timer.join()  # a thread that still runs would seem to be one of the program's

    def _alarm(self, number: int, frame: FrameType | None) -> None:
        if not self._watching:
            return
        left = min(
            self._left - (_spent() - self._spent),
            self._wait - (_now() - self._since),
        )
        if limits.KNOWS_THREAD_TIME and left > 0 and sys.platform != "win32":
            signal.setitimer(signal.ITIMER_REAL, max(left, SOON), AGAIN)
            return
        raise self._late()

    def _from_outside(self) -> None:
        while self._watching:
            limits.interrupt(self._thread, type(self._late()))
            threading.Event().wait(AGAIN)
