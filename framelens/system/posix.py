"""Linux, macOS and other systems with POSIX calls."""

import os
import select
import shlex
import signal
import stat
import subprocess
import sys
import time
from collections.abc import Generator, Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path

assert sys.platform != "win32"

# What ends a program from outside: `kill`, and a terminal that closes.
ENDING_SIGNALS = (signal.SIGTERM, signal.SIGHUP)


def quoted(name: str) -> str:
    """Return a file's name as the user's shell reads it."""
    return shlex.quote(name)


def replace(source: str, target: str) -> None:
    """Rename a file, in place of another even while that is being read."""
    os.replace(source, target)


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


def memory() -> int | None:
    """Return the bytes of memory of this machine; None if the system does not say."""
    try:
        return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    except (ValueError, OSError):
        return None


@cache
def user_language() -> str:
    """Return the language in the user's settings, as "fr_FR"; "" if they do not say.

    Only macOS has it there; elsewhere it is in the environment.
    """
    if sys.platform != "darwin":
        return ""
    command = ["defaults", "read", "-g", "AppleLocale"]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=5)
    except (OSError, subprocess.SubprocessError):
        return ""
    return done.stdout.strip()
