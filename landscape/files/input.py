"""Reading a user's files: no more than fits into memory, and never for ever."""

import os
import select
import stat
import time
from pathlib import Path

from landscape.errors import InputError

WAIT_S = 15.0  # chosen: what comes through a pipe must be there by then


def read_bounded(path: Path, most: int, name: str = "") -> bytes:
    """Return the bytes of a file, a pipe or a device; ``name`` stands for it in messages.

    InputError if it cannot be read, has more than ``most`` bytes, or does not end in WAIT_S.
    """
    name = name or str(path)
    try:
        # Otherwise opening a pipe would wait for somebody to write into it.
        with open(os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC), "rb", 0) as file:
            plain = stat.S_ISREG(os.fstat(file.fileno()).st_mode)
            parts: list[bytes] = []
            count, deadline = 0, time.monotonic() + WAIT_S
            ready = select.poll()
            ready.register(file, select.POLLIN)
            while count <= most:
                left = deadline - time.monotonic()
                if not plain and (left <= 0 or not ready.poll(left * 1e3)):
                    raise InputError(f"{name}: expected all of it within {WAIT_S:g} seconds")
                part = file.read(1 << 20)
                if part == b"":
                    return b"".join(parts)
                if part:  # None: nothing is there yet after all
                    parts.append(part)
                    count += len(part)
    except OSError as error:
        raise InputError(f"{name}: cannot be read ({error.strerror})") from None
    raise InputError(f"{name}: too large, expected at most {amount(most)}")


def check_plain(path: Path, most: int) -> None:
    """Raise InputError unless ``path`` is a plain file of at most ``most`` bytes, or a folder.

    For what is read more than once, which a pipe cannot be. OSError where it cannot be found; that
    a folder is no file is left to the reader to say.
    """
    found = os.stat(path)
    if stat.S_ISDIR(found.st_mode):
        return
    if not stat.S_ISREG(found.st_mode):
        raise InputError(f"{path}: expected a file, found a pipe or a device")
    if found.st_size > most:
        raise InputError(f"{path}: too large, expected at most {amount(most)}")


def amount(count: int) -> str:
    """Return a number of bytes as text."""
    return f"{count >> 20} MB" if count >= 1 << 20 else f"{count >> 10} kB"
