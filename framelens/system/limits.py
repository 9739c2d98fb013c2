"""Limits of a process that runs somebody else's work: its memory, its time, and its end.

``limits_posix.py`` and ``limits_windows.py`` define the same names; this chooses between them. A
process sets its own limits, but for ``end_group`` and ``crash``, which are for its parent.
"""

import ctypes
import sys
import threading

from framelens.system.beside import beside

if sys.platform == "win32":
    from framelens.system import limits_windows as system
    from framelens.system.limits_windows import (
        GAVE_UP,
        KILLED,
        KNOWS_THREAD_TIME,
        OUT_OF_TIME,
        OWN_GROUP,
        adopt_orphans,
        children,
        close_all_but,
        crash,
        end_group,
        end_orphans,
        end_with,
        leave_network,
        limit_addresses,
        limit_open_files,
        limit_work,
        thread_time,
        used,
    )
else:
    from framelens.system import limits_posix as system
    from framelens.system.limits_posix import (
        GAVE_UP,
        KILLED,
        KNOWS_THREAD_TIME,
        OUT_OF_TIME,
        OWN_GROUP,
        adopt_orphans,
        children,
        close_all_but,
        crash,
        end_group,
        end_orphans,
        end_with,
        leave_network,
        limit_addresses,
        limit_open_files,
        limit_work,
        thread_time,
        used,
    )

__all__ = [
    "FORKS",
    "GAVE_UP",
    "KILLED",
    "KNOWS_THREAD_TIME",
    "OUT_OF_TIME",
    "OWN_GROUP",
    "adopt_orphans",
    "children",
    "close_all_but",
    "crash",
    "end_group",
    "end_orphans",
    "end_with",
    "interrupt",
    "leave_network",
    "limit_addresses",
    "limit_memory",
    "limit_open_files",
    "limit_work",
    "thread_time",
    "used",
]

# Whether a process may be copied, which takes milliseconds. Windows has no fork, and on macOS a
# copy crashes in Cocoa.
FORKS = sys.platform == "linux"
PAUSE = 0.02  # seconds between two looks at the memory of a process, chosen
AGAIN = 0.25  # seconds until MemoryError is raised once more, if the work swallowed it; chosen


def limit_memory(most: int | None) -> None:
    """Let work that takes the process beyond ``most`` bytes end by MemoryError; None: no limit.

    ``used`` counts these bytes. The main thread does the work.
    """
    system.limit_memory(most)
    if not system.KEEPS_MEMORY:
        _watch.look_at(most)


def interrupt(thread: int, error: type[BaseException]) -> None:
    """Raise an exception in a thread, as soon as it is in no function of C."""
    ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(thread), ctypes.py_object(error))


class _MemoryWatch:
    """A thread that raises MemoryError in the main one, where the system limits no memory."""

    def __init__(self) -> None:
        self._most: int | None = None
        self._runs = False
        self._never = threading.Event()

    def look_at(self, most: int | None) -> None:
        """Limit the memory to so many bytes; None: no limit."""
        self._most = most
        if not self._runs:
            self._runs = True
            beside(self._look)

    def _look(self) -> None:
        while True:
            most = self._most
            over = most is not None and used() > most
            if over:
                interrupt(threading.main_thread().ident or 0, MemoryError)
            self._never.wait(AGAIN if over else PAUSE)


_watch = _MemoryWatch()
