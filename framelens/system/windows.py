"""Windows."""

import ctypes
import errno
import io
import locale
import os
import queue
import signal
import stat
import subprocess
import sys
import threading
import time
from collections.abc import Generator, Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path

from framelens.system.beside import beside

assert sys.platform == "win32"

# Signals that end a program from outside; SIGBREAK: Ctrl-Break, and a console that closes.
ENDING_SIGNALS = (signal.SIGTERM, signal.SIGBREAK)

# Chosen: a virus scanner or a reader holds a file for less.
REPLACE_TRIES = 20
REPLACE_PAUSE_S = 0.05


def quoted(name: str) -> str:
    """Return a file's name as the user's shell reads it."""
    return subprocess.list2cmdline([name])


def replace(source: str, target: str) -> None:
    """Rename a file, in place of another; PermissionError if that is held open for too long.

    Windows replaces no file that somebody has open, unlike other systems.
    """
    for _ in range(REPLACE_TRIES - 1):
        try:
            return os.replace(source, target)
        except PermissionError:
            time.sleep(REPLACE_PAUSE_S)
    os.replace(source, target)


LOCK_S = 5.0  # chosen: who holds a lock for longer does not work
OLD_S = 3600.0  # chosen: nobody writes one file for longer without adding to it


@contextmanager
def locked(path: Path) -> Iterator[None]:
    """Let no other process into a block for the same file, which need not exist.

    TimeoutError if one is in there for long. The lock is a file beside it, which Windows deletes
    with the process.
    """
    lock, end = f"{path}.lock", time.monotonic() + LOCK_S
    while True:
        try:
            flags = os.O_CREAT | os.O_EXCL | os.O_RDWR | os.O_TEMPORARY | os.O_NOINHERIT
            number = os.open(lock, flags)
            break
        except (FileExistsError, PermissionError):
            if time.monotonic() > end:
                raise TimeoutError from None
        time.sleep(REPLACE_PAUSE_S)
    try:
        yield
    finally:
        os.close(number)


def claimed(number: int) -> bool:
    """Mark an open temporary file as in use until it is closed: so is any that is open."""
    return True


@contextmanager
def still_claimed(number: int) -> Iterator[None]:
    """Keep a file marked as in use inside the block, in which it may be closed: it is too new."""
    yield


def clear(path: str) -> None:
    """Delete a temporary file that no process has open and that is old; OSError."""
    if time.time() - os.stat(path).st_mtime > OLD_S:
        os.unlink(path)


def read_parts(path: Path, size: int, deadline: float) -> Generator[bytes, None, None]:
    """Yield the bytes of a file, a pipe or a device in parts of at most ``size`` bytes.

    OSError if it cannot be read; TimeoutError if a pipe or a device has not ended by ``deadline``,
    a time of time.monotonic().
    """
    try:
        file = io.FileIO(path)
    except PermissionError:
        if os.path.isdir(path):
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR)) from None
        raise
    if not stat.S_ISREG(os.fstat(file.fileno()).st_mode):
        yield from _read_apart(file, size, deadline)
        return
    with file:
        while part := file.read(size):
            yield part


def _read_apart(file: io.FileIO, size: int, deadline: float) -> Generator[bytes, None, None]:
    """Yield the bytes of a pipe or a device, such as CON, which a thread of its own waits for.

    If it is late, the thread is left behind with the file: nothing can interrupt or close it.
    """
    parts: queue.Queue[bytes | OSError] = queue.Queue(maxsize=1)

    def read() -> None:
        with file:
            part: bytes | OSError = b" "
            while part and not isinstance(part, OSError):
                try:
                    part = file.read(size)
                except OSError as error:
                    part = error
                parts.put(part)

    beside(read)
    while True:
        try:
            part = parts.get(timeout=max(deadline - time.monotonic(), 0))
        except queue.Empty:
            raise TimeoutError from None
        if isinstance(part, OSError):
            raise part
        if not part:
            return
        yield part


@contextmanager
def interrupts_held() -> Iterator[None]:
    """Hold back Ctrl-C inside the block; it reaches this thread after the block."""
    if threading.current_thread() is not threading.main_thread():
        yield  # Ctrl-C reaches the main thread alone
        return
    held: list[int] = []
    before = signal.signal(signal.SIGINT, lambda number, _: held.append(number))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
    if held:
        signal.raise_signal(signal.SIGINT)


@contextmanager
def starting_workers() -> Iterator[None]:
    """Let the processes that the block starts ignore Ctrl-C; so does this one inside the block."""
    kernel = ctypes.windll.kernel32
    kernel.SetConsoleCtrlHandler(None, True)  # processes inherit this
    try:
        yield
    finally:
        kernel.SetConsoleCtrlHandler(None, False)


def is_closed_pipe(error: OSError) -> bool:
    """Return whether something was written into a pipe that its reader has closed."""
    # The C library does not tell this from other wrong arguments, of which a file name is one.
    unnamed = error.errno == errno.EINVAL and error.filename is None
    return isinstance(error, BrokenPipeError) or unnamed


def processors() -> int:
    """Return how many processors this process may use."""
    return os.cpu_count() or 1


def is_running(pid: int) -> bool:
    """Return whether there is a process of this number."""
    synchronize, timeout = 0x00100000, 0x102
    handle = ctypes.windll.kernel32.OpenProcess(synchronize, False, pid)
    if not handle:
        return False
    try:
        waited: int = ctypes.windll.kernel32.WaitForSingleObject(handle, 0)
        return waited == timeout
    finally:
        ctypes.windll.kernel32.CloseHandle(handle)


def memory() -> int | None:
    """Return the bytes of memory of this machine; None if the system does not say."""
    status = _MemoryStatus(length=ctypes.sizeof(_MemoryStatus))
    if not ctypes.windll.kernel32.GlobalMemoryStatusEx(ctypes.byref(status)):
        return None
    return int(status.total_physical)


def give_back() -> None:
    """Give freed memory back to the system, which Windows' heap does by itself."""


class _MemoryStatus(ctypes.Structure):
    """MEMORYSTATUSEX of the Windows API."""

    _fields_ = [
        ("length", ctypes.c_uint32),
        ("load_percent", ctypes.c_uint32),
        ("total_physical", ctypes.c_uint64),
        ("available_physical", ctypes.c_uint64),
        ("total_page_file", ctypes.c_uint64),
        ("available_page_file", ctypes.c_uint64),
        ("total_virtual", ctypes.c_uint64),
        ("available_virtual", ctypes.c_uint64),
        ("available_extended_virtual", ctypes.c_uint64),
    ]


@cache
def user_language() -> str:
    """Return the language of the user's Windows, as "fr_FR"; "" if Python has no name for it."""
    return locale.windows_locale.get(ctypes.windll.kernel32.GetUserDefaultUILanguage(), "")
