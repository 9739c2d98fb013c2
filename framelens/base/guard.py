"""A process of its own for somebody else's program, so that each way to fail ends in one line.

It can end what no exception ends: a loop inside a C function, which leaves Python no time for
signals; a crash of OpenGL, which has read past the end of an array; memory taken without bounds.
The process is a copy of the command's where that is possible; elsewhere the command is started
once more, and passes on what it says.
"""

import contextlib
import mmap
import os
import signal
import struct
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import NoReturn, Protocol

from framelens.base.errors import UNEXPECTED, InputError, say_unexpected
from framelens.base.isolated import started
from framelens.system import limits

GRACE = 2.0  # chosen: seconds that a program has to end by itself, once its time is over
MEMORY = 1 << 30  # chosen: bytes that a program may take
# Chosen: with a window on a screen. The driver of a graphics card takes its part of it.
MEMORY_ON_SCREEN = 4 << 30
RESERVE = 1 << 20  # chosen: bytes
PAUSE = 0.01  # chosen: seconds between two looks at the process
SOON = 0.3  # chosen: seconds in which a process ends that Ctrl-C has reached, too
SHORT_ARRAY = "where an array is shorter than it was told"  # how OpenGL crashes
# Tells a command that it was started as the program's own process: the parent's number, and the
# file that both share.
VARIABLE = "LANDSCAPE_GUARDED"
# The memory that both processes see: when the program's process will be ended if it has spent so
# many seconds of the processor, when in any case, and whether it ended by itself.
SHARED = struct.Struct("ddd?")

_now = time.monotonic  # the true clock, the same in both processes
_spent = time.thread_time


def _memory() -> mmap.mmap:
    """Return SHARED in memory that this process shares with its copies."""
    return mmap.mmap(-1, SHARED.size)


@dataclass
class _Process:
    """This process's side of the guard: the command's process, or the program's own."""

    shared: mmap.mmap = field(default_factory=_memory)  # SHARED, seen by both processes
    alone: bool = False  # whether it is the program's own
    reserve: bytes = b""  # memory for what is done when the program has none left
    most: int | None = None  # bytes that it may have while the program goes on
    program: int = MEMORY  # bytes that the program may take


_process = _Process()


def guarded(path: str, work: Callable[[], int]) -> int:
    """Return the exit status of ``work``, done by a process of its own.

    What it raises and does not foresee is told there. InputError if the process crashes or has to
    be ended.
    """
    if VARIABLE in os.environ:
        _join(os.environ.pop(VARIABLE))
        _work_alone(work)
    print(end="", flush=True)
    if sys.platform != "win32" and limits.FORKS:
        from framelens.system.copying import copy

        own = limits.children()
        limits.adopt_orphans()
        _process.shared = _memory()
        child = copy()
        if child is None:
            _work_alone(work)
        try:
            return _await(child, path)
        finally:
            limits.end_orphans(own)  # what the program has started
    with _started() as process:
        return _await(process, path)


def _work_alone(work: Callable[[], int]) -> NoReturn:
    """Do the work in the program's own process, and end that."""
    _process.alone = True
    limits.limit_memory(None)
    _print_apart()
    status = UNEXPECTED
    try:
        status = work()
        print(end="", flush=True)
    except SystemExit as end:
        status = end.code if isinstance(end.code, int) else 1
    except BaseException as error:
        say_unexpected(error)
    finally:
        _share(0.0, ended=True)
        # Threads or handlers that the program left behind must not keep the process alive.
        os._exit(status)


def go_on(seconds: float, memory: int = 0, wait: float = 0.0) -> None:
    """Say that the program goes on, for so many seconds at most.

    It may take so many bytes of memory; 0 is without limit. Where it may ``wait`` for longer, the
    seconds are those of the processor, for its main thread.
    """
    if not _process.alone:
        return
    first = _now() + seconds + GRACE
    _share(first, _spent() + seconds + GRACE, max(first, _now() + wait + GRACE))
    if memory:
        _process.reserve = _process.reserve or bytes(RESERVE)
        if _process.most is None:
            _process.most = limits.used() + memory
            _process.program = memory
        limits.limit_memory(_process.most)


def stand_by() -> None:
    """Say that the program waits or has ended: nothing is limited."""
    _process.reserve = b""
    if _process.alone:
        _share(0.0)
        limits.limit_memory(None)


def memory() -> str:
    """Return the limit in words, for a program that has run out of memory."""
    return f" (it may take {_process.program >> 20} MB)" if _process.alone else ""


def _share(deadline: float, spent: float = 0.0, last: float = 0.0, ended: bool = False) -> None:
    """Tell the other process when the program is to be ended, 0 for never; or that it has.

    From the deadline on it is if its main thread has spent so many seconds, and at ``last``.
    """
    _process.shared[:] = SHARED.pack(deadline, spent, last, ended)


def _print_apart() -> None:
    """Let only sys.stdout write to standard output: a program's own prints would be amid ours."""
    own = os.dup(1)
    os.dup2(2, 1)
    encoding = getattr(sys.stdout, "encoding", None) or "utf-8"
    # On Windows `open` knows a console, which wants no bytes.
    sys.stdout = open(own, "w", encoding=encoding, errors="backslashreplace")  # noqa: SIM115


@contextmanager
def _started() -> Iterator["subprocess.Popen[bytes]"]:
    """Start this command once more, as the program's own process."""
    with tempfile.TemporaryDirectory(prefix="landscape-") as folder:
        file = os.path.join(folder, "shared")
        _process.shared = _mapped(file)
        try:
            guarding = {VARIABLE: f"{os.getpid()} {file}"}
            with started(sys.orig_argv[1:], guarding) as process:
                yield process
        finally:
            _process.shared.close()  # Windows deletes no file that is mapped


def _mapped(file: str) -> mmap.mmap:
    """Return a file of SHARED in memory; it is written if it is not there."""
    number = os.open(file, os.O_RDWR | os.O_CREAT)
    try:
        os.truncate(number, SHARED.size)
        return mmap.mmap(number, SHARED.size)
    finally:
        os.close(number)


def _join(parent: str) -> None:
    """Let this process run the program; ``parent`` is the value of VARIABLE."""
    number, _, file = parent.partition(" ")
    limits.end_with(int(number))
    _process.shared = _mapped(file)


class _Child(Protocol):
    """The program's process, seen by its parent; a Popen is one."""

    pid: int

    def poll(self) -> int | None:
        """Return the exit status, or minus the signal that ended it; None while it runs."""

    def kill(self) -> None:
        """End it at once."""

    def terminate(self) -> None:
        """Ask it to end."""


def _await(child: _Child, path: str) -> int:
    """Return the exit status of the process."""
    # Ctrl-C reaches both, and the process says so; if nothing can interrupt it, it is ended.
    asked: list[float] = []  # when it came

    def interrupted(*_: object) -> None:
        asked.append(_now())
        _end_soon()

    before = signal.signal(signal.SIGINT, interrupted)
    try:
        status, late = _watch(child, asked)
    except SystemExit:  # we are to end
        child.terminate()
        _end_soon()
        _watch(child, asked)
        raise
    finally:
        signal.signal(signal.SIGINT, before)

    if late:
        raise InputError("{path}: was ended within one call that nothing can interrupt", path=path)
    if SHARED.unpack(_process.shared[:])[-1]:
        return status
    crash = limits.crash(status)
    if crash == limits.KILLED:
        raise InputError("{path}: was killed, as the system does where memory runs out", path=path)
    if not crash:
        raise InputError(
            "{path}: ended its own process (status {status})", path=path, status=status
        )
    if crash == limits.GAVE_UP:
        raise InputError(
            "{path}: was ended ({crash}) by a library of C that could not go on",
            path=path,
            crash=crash,
        )
    raise InputError(
        "{path}: crashed ({crash}), as OpenGL does {short_array}",
        path=path,
        crash=crash,
        short_array=SHORT_ARRAY,
    )


def _pass_on(child: _Child) -> None:
    """Interrupt the process, too: `kill -INT` sends the signal to one process alone, this one."""
    if sys.platform != "win32":
        with contextlib.suppress(ProcessLookupError):
            os.kill(child.pid, signal.SIGINT)


def _end_soon() -> None:
    _share(_now() + GRACE)


def _watch(child: _Child, asked: list[float]) -> tuple[int, bool]:
    """Return how the process ended, as its ``poll`` does, and whether it was too late.

    ``asked``: when Ctrl-C came. It is passed on if the process goes on after that.
    """
    late = False
    while True:
        status = child.poll()
        if status is not None:
            return status, late
        if asked and _now() > asked[0] + SOON:
            asked.clear()
            _pass_on(child)
        deadline, spent, last, _ = SHARED.unpack(_process.shared[:])
        due = deadline and _now() > deadline and not late
        if due and (_now() > last or limits.thread_time(child.pid) > spent):
            late = True
            child.kill()
        time.sleep(PAUSE)
