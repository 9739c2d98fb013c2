"""A process of its own for somebody else's program, so that each way to fail ends in one line.

It can end what no exception ends: a loop inside a C function, which leaves Python no time for
signals; a crash of OpenGL, which has read past the end of an array; memory taken without bounds.
"""

import ctypes
import io
import mmap
import os
import signal
import struct
import sys
import time
import warnings
from collections.abc import Callable

from landscape.errors import InputError

GRACE = 2.0  # chosen: seconds that a program has to end by itself, once its time is over
MEMORY = 1 << 30  # chosen: bytes that a program may take
# Chosen: with a window on a screen. The driver of a graphics card takes its part of it.
MEMORY_ON_SCREEN = 4 << 30
RESERVE = 1 << 20  # chosen: bytes
PAUSE = 0.01  # chosen: seconds between two looks at the process
PR_SET_PDEATHSIG = 1  # from sys/prctl.h

_now = time.monotonic  # the true clock, the same in both processes
_deadline: mmap.mmap = mmap.mmap(-1, 8)  # when the process will be ended; both processes see it
_alone = False  # whether this process is the program's own
_reserve = b""  # memory for what is done when the program has none left
_most: int | None = None  # bytes that the process may have while the program goes on
_given = MEMORY  # bytes that the program may take


def guarded(path: str, work: Callable[[], int]) -> int:
    """Return the exit status of ``work``, done by a new process; but for Linux, by this one.

    ``work`` raises nothing. InputError if the process crashes or has to be ended.
    """
    global _alone
    if not sys.platform.startswith("linux"):
        return work()
    print(end="", flush=True)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)  # the threads of numpy only wait
        child = os.fork()
    if child:
        return _await(child, path)
    _alone = True
    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
    _print_apart()
    status = 1
    try:
        status = work()
        print(end="", flush=True)
    except SystemExit as end:
        status = end.code if isinstance(end.code, int) else 1
    finally:
        # What the program has left behind must not keep the process from its end.
        os._exit(status)


def go_on(seconds: float, memory: int = 0) -> None:
    """Say that the program goes on, for so many seconds at most.

    It may take so many bytes of memory; 0 is without limit.
    """
    global _given, _most, _reserve
    if not _alone:
        return
    _deadline[:] = struct.pack("d", _now() + seconds + GRACE)
    if memory:
        _reserve = _reserve or bytes(RESERVE)
        if _most is None:
            with open("/proc/self/statm") as file:
                _most = int(file.read().split()[5]) * mmap.PAGESIZE + memory
            _given = memory
        _limit(_most)


def stand_by() -> None:
    """Say that the program waits or has ended: nothing is limited."""
    global _reserve
    _reserve = b""
    if _alone:
        _deadline[:] = bytes(8)
        _limit(None)


def memory() -> str:
    """Return the limit in words, for a program that has run out of memory."""
    return f" (it may take {_given >> 20} MB)" if _alone else ""


def _limit(most: int | None) -> None:
    import resource

    hard = resource.getrlimit(resource.RLIMIT_DATA)[1]
    soft = hard if most is None else most
    if hard == resource.RLIM_INFINITY or soft <= hard:
        resource.setrlimit(resource.RLIMIT_DATA, (soft, hard))


def _print_apart() -> None:
    """Let only sys.stdout write to standard output: a program's own prints would be amid ours."""
    own = os.dup(1)
    os.dup2(2, 1)
    encoding = getattr(sys.stdout, "encoding", None) or "utf-8"
    sys.stdout = io.TextIOWrapper(io.FileIO(own, "w"), encoding, errors="backslashreplace")


def _await(child: int, path: str) -> int:
    """Return the exit status of the process."""
    # Ctrl-C reaches both, and the process says so; if nothing can interrupt it, it is ended.
    before = signal.signal(signal.SIGINT, lambda *_: _end_soon())
    try:
        ended, late = _watch(child)
    except SystemExit:  # we are to end
        os.kill(child, signal.SIGTERM)
        _end_soon()
        _watch(child)
        raise
    finally:
        signal.signal(signal.SIGINT, before)
    if late:
        raise InputError(f"{path}: was ended within one call that nothing can interrupt")
    if ended >= 0:
        return ended
    if -ended == signal.SIGKILL:
        raise InputError(f"{path}: was killed, as the system does where memory runs out")
    raise InputError(
        f"{path}: crashed ({signal.Signals(-ended).name}), as OpenGL does where an array is "
        "shorter than it was told"
    )


def _end_soon() -> None:
    _deadline[:] = struct.pack("d", _now() + GRACE)


def _watch(child: int) -> tuple[int, bool]:
    """Return the exit status of a process, or minus its signal, and whether it was too late."""
    late = False
    while True:
        done, status = os.waitpid(child, os.WNOHANG)
        if done:
            return os.waitstatus_to_exitcode(status), late
        (deadline,) = struct.unpack("d", _deadline[:])
        if deadline and _now() > deadline and not late:
            late = True
            os.kill(child, signal.SIGKILL)
        time.sleep(PAUSE)
