"""Limits on Linux, macOS and other systems with POSIX calls."""

import contextlib
import ctypes
import math
import os
import resource
import signal
import sys
import time
from collections.abc import Collection
from pathlib import Path
from typing import Any

from framelens.system.beside import beside

assert sys.platform != "win32"

# Whether the system sees to ``limit_memory``. macOS refuses or ignores the limits of memory.
KEEPS_MEMORY = sys.platform == "linux"
OUT_OF_TIME = "SIGXCPU"  # what ends a process that has used up its processor time
KILLED = "SIGKILL"  # what ends a process where the system runs out of memory
# Whether thread_time() knows the processor's time of another process.
KNOWS_THREAD_TIME = sys.platform == "linux"
GAVE_UP: str | None = "SIGABRT"  # what ends a process that calls C's abort()
OWN_GROUP: dict[str, Any] = {
    "start_new_session": True
}  # for Popen: Ctrl-C does not reach the process
DEATH_SIGNAL = 1  # PR_SET_PDEATHSIG of prctl(2)
NAMESPACES = (0x40000000, 0x50000000)  # CLONE_NEWNET; for users other than root with CLONE_NEWUSER
ADOPT = 36  # PR_SET_CHILD_SUBREAPER
MOST_FILES = 1 << 20  # the highest number of an open file, as systems have it
MOST_ROUNDS = 100  # chosen: of ending orphans, whose own children then are orphans
LIBRARIES = 512 << 20  # chosen: bytes of addresses
PAUSE = 0.5  # seconds between two looks for the parent, chosen


def limit_work(seconds: int, file_bytes: int | None = None) -> None:
    """Limit the processor's seconds and the size of files; a crash writes no core file."""
    _limit(resource.RLIMIT_CORE, 0)
    _limit(resource.RLIMIT_CPU, seconds)
    if file_bytes is not None:
        _limit(resource.RLIMIT_FSIZE, file_bytes)


def limit_open_files(most: int) -> None:
    """Limit how many files are open at once, pipes among them, which take the system's memory."""
    _limit(resource.RLIMIT_NOFILE, most)


def limit_memory(most: int | None) -> None:
    """Limit the bytes that ``used`` counts; None: no limit. Only Linux does so."""
    if KEEPS_MEMORY:
        _limit(resource.RLIMIT_DATA, most)


def limit_addresses(more: int) -> None:
    """Limit the addresses that the process may take, memory that is shared included.

    There may be ``more`` bytes than now, and some for libraries. Only Linux does so.
    """
    if KEEPS_MEMORY:
        pages = int(Path("/proc/self/statm").read_text().split()[0])
        _limit(resource.RLIMIT_AS, pages * resource.getpagesize() + more + LIBRARIES)


def _limit(kind: int, most: int | None) -> None:
    """Set a limit that the process itself can lift; None: as high as it may be."""
    hard = resource.getrlimit(kind)[1]
    if most is None or (hard != resource.RLIM_INFINITY and most > hard):
        most = hard
    resource.setrlimit(kind, (most, hard))


def used() -> int:
    """Return the bytes of memory that the process has for its data; but for Linux, the most yet."""
    if sys.platform == "linux":
        return int(Path("/proc/self/statm").read_text().split()[5]) * resource.getpagesize()
    most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return most if sys.platform == "darwin" else most << 10


def thread_time(process: int) -> float:
    """Return the seconds of the processor that a process's main thread has spent.

    Without end where the system does not tell, or the process has gone.
    """
    try:
        text = Path(f"/proc/{process}/task/{process}/stat").read_text()
    except OSError:
        return math.inf
    # The name, in parentheses, may hold anything.
    user, system = text.rpartition(")")[2].split()[11:13]
    return (int(user) + int(system)) / os.sysconf("SC_CLK_TCK")


def end_with(parent: int) -> None:
    """Let this process end when its parent, the process of that number, has ended."""
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(DEATH_SIGNAL, int(signal.SIGKILL), 0, 0, 0)
        if os.getppid() != parent:
            os._exit(1)
        return
    leave, sleep = os._exit, time.sleep  # a program may be given others

    def look() -> None:
        while os.getppid() == parent:
            sleep(PAUSE)
        leave(1)

    beside(look)


def end_group(process: int) -> None:
    """End a process that was started with OWN_GROUP, and its own children."""
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process, signal.SIGKILL)


def adopt_orphans() -> None:
    """Let processes whose parent ends, among those that come from this one, become its children.

    Only Linux does so.
    """
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(ADOPT, 1, 0, 0, 0)


def children() -> set[int]:
    """Return the numbers of this process's children; none where the system does not tell."""
    found = set()
    for folder in Path("/proc").glob("[0-9]*"):
        with contextlib.suppress(OSError, ValueError):
            # The name, in parentheses, may hold anything.
            parent = (folder / "stat").read_text(errors="replace").rpartition(")")[2].split()[1]
            if int(parent) == os.getpid():
                found.add(int(folder.name))
    return found


def _has_children() -> bool:
    """Return whether this process may have children, even if they have ended."""
    if sys.platform == "darwin":
        return True  # before Python 3.13 nothing tells there
    try:
        os.waitid(os.P_ALL, 0, os.WEXITED | os.WNOHANG | os.WNOWAIT)
    except ChildProcessError:
        return False
    return True


def end_orphans(own: Collection[int]) -> None:
    """End all children of this process but its ``own``, and then theirs, which become its children.

    It adopts orphans: so what remains of a program goes, whatever session it has moved to.
    """
    if sys.platform != "linux":
        return
    for _ in range(MOST_ROUNDS):
        # To look through all processes of the system takes milliseconds.
        if not own and not _has_children():
            return
        orphans = children().difference(own)
        if not orphans:
            return
        for orphan in orphans:
            with contextlib.suppress(ProcessLookupError):
                os.kill(orphan, signal.SIGKILL)
        for orphan in orphans:
            with contextlib.suppress(ChildProcessError):
                os.waitpid(orphan, 0)


def close_all_but(*files: int) -> None:
    """Close all open files but standard input, output and error, and those."""
    first = 3
    for file in sorted(files):
        os.closerange(first, file)
        first = file + 1
    os.closerange(first, MOST_FILES)


def crash(status: int) -> str:
    """Return the name of the signal that ended a process; "" if it ended by itself."""
    if status >= 0:
        return ""
    try:
        return signal.Signals(-status).name
    except ValueError:
        return f"signal {-status}"


def leave_network() -> None:
    """Take the network from this process, where the system allows that."""
    if sys.platform == "linux":
        libc = ctypes.CDLL(None)
        any(libc.unshare(flags) == 0 for flags in NAMESPACES)
