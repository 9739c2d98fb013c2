"""Linux, macOS and other systems with POSIX calls."""

import contextlib
import fcntl
import os
import select
import shlex
import signal
import stat
import sys
import time
from collections.abc import Callable, Generator, Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path

assert sys.platform != "win32"

# Signals that end a program from outside: `kill`, and a terminal that closes.
ENDING_SIGNALS = (signal.SIGTERM, signal.SIGHUP)


def quoted(name: str) -> str:
    """Return a file's name as the user's shell reads it."""
    return shlex.quote(name)


def replace(source: str, target: str) -> None:
    """Rename a file, in place of another even while that is being read."""
    os.replace(source, target)


LOCK_S = 5.0  # chosen: who holds a lock for longer does not work, as after Ctrl-Z
LOCK_PAUSE_S = 0.01


@contextmanager
def locked(path: Path) -> Iterator[None]:
    """Let no other process into a block for the same file, which need not exist.

    TimeoutError if one is in there for long. The lock is the folder's, so that nothing is left
    behind; a file system without locks has none.
    """
    number = os.open(path.parent, os.O_RDONLY | os.O_CLOEXEC)
    try:
        _lock(number)
        yield
    finally:
        os.close(number)


def _lock(number: int) -> None:
    end = time.monotonic() + LOCK_S
    while True:
        try:
            return fcntl.flock(number, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            if time.monotonic() > end:
                raise TimeoutError from None
        except OSError:
            return None
        time.sleep(LOCK_PAUSE_S)


def claimed(number: int) -> bool:
    """Mark an open temporary file as in use until it is closed; False if it has been deleted."""
    with contextlib.suppress(OSError):
        fcntl.flock(number, fcntl.LOCK_EX)
    return os.fstat(number).st_nlink > 0


@contextmanager
def still_claimed(number: int) -> Iterator[None]:
    """Keep a file marked as in use inside the block, in which it may be closed."""
    other = os.dup(number)
    try:
        yield
    finally:
        os.close(other)


def clear(path: str) -> None:
    """Delete a temporary file that no process has marked as in use; OSError."""
    number = os.open(path, os.O_RDWR | os.O_NONBLOCK | os.O_NOFOLLOW | os.O_CLOEXEC)
    try:
        fcntl.flock(number, fcntl.LOCK_EX | fcntl.LOCK_NB)
        os.unlink(path)
    finally:
        os.close(number)


def read_parts(path: Path, size: int, deadline: float) -> Generator[bytes, None, None]:
    """Yield the bytes of a file, a pipe or a device in parts of at most ``size`` bytes.

    OSError if it cannot be read; TimeoutError if a pipe or a device has not ended by ``deadline``,
    a time of time.monotonic().
    """
    # Without O_NONBLOCK, opening a pipe would wait for somebody to write into it.
    with open(os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC), "rb", 0) as file:
        plain = stat.S_ISREG(os.fstat(file.fileno()).st_mode)
        ready = select.poll()
        ready.register(file, select.POLLIN)
        while True:
            left = deadline - time.monotonic()
            if not plain and (left <= 0 or not ready.poll(left * 1e3)):
                raise TimeoutError
            part = file.read(size)
            if part == b"":
                return
            if part:  # None: nothing is there yet after all
                yield part


@contextmanager
def interrupts_held() -> Iterator[None]:
    """Hold back Ctrl-C inside the block; it reaches this thread after the block."""
    held = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, held)


@contextmanager
def starting_workers() -> Iterator[None]:
    """Hold back Ctrl-C from the processes that the block starts, and from this one inside it."""
    from multiprocessing import resource_tracker

    # multiprocessing starts it with the first process, and then lets Ctrl-C through.
    resource_tracker.ensure_running()
    with interrupts_held():  # processes inherit what their parent holds back
        yield


def is_closed_pipe(error: OSError) -> bool:
    """Return whether something was written into a pipe that its reader has closed."""
    return isinstance(error, BrokenPipeError)


def processors() -> int:
    """Return how many processors this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def is_running(pid: int) -> bool:
    """Return whether there is a process of this number."""
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    except OSError:
        return True
    return True


def memory() -> int | None:
    """Return the bytes of memory of this machine; None if the system does not say."""
    try:
        return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    except (ValueError, OSError):
        return None


def give_back() -> None:
    """Give freed memory back to the system, where the C library keeps it for itself.

    glibc returns only what lies at the end of its heap: after a large structure has been replaced
    by another one, both are there.
    """
    trim = _trim()
    if trim is not None:
        trim(0)


@cache
def _trim() -> Callable[[int], int] | None:
    """Return glibc's function; other C libraries have none."""
    if not sys.platform.startswith("linux"):
        return None
    import ctypes

    found: Callable[[int], int] | None = getattr(ctypes.CDLL(None), "malloc_trim", None)
    return found


@cache
def user_language() -> str:
    """Return the language in the user's settings, as "fr_FR"; "" if they do not say.

    Only macOS has it there; elsewhere it is in the environment.
    """
    if sys.platform != "darwin":
        return ""
    return _language_in(Path("~/Library/Preferences/.GlobalPreferences.plist").expanduser())


def _language_in(preferences: Path) -> str:
    """Return the language in macOS' file of preferences; "" if it cannot be read, or has none."""
    import plistlib  # elsewhere nothing needs it
    from xml.parsers.expat import ExpatError

    try:
        return str(plistlib.loads(preferences.read_bytes()).get("AppleLocale", ""))
    except (OSError, ValueError, AttributeError, ExpatError):  # AttributeError: it is no table
        return ""
