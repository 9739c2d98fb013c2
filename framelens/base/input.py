"""Reading a user's files: no more than fits into memory, and never for ever."""

import errno
import os
import stat
import time
from collections.abc import Iterable, Iterator
from contextlib import closing
from pathlib import Path

from framelens.base.errors import InputError, reason
from framelens.system import read_parts

WAIT_S = 15.0  # chosen: what comes through a pipe must be there by then
PART = 1 << 20  # bytes, chosen: read at once


def read_bounded(path: Path, most: int, name: str = "") -> bytes:
    """Return the bytes of a file, a pipe or a device; ``name`` stands for it in messages.

    InputError if it cannot be read, has more than ``most`` bytes, or does not end in WAIT_S.
    """
    name = name or str(path)
    try:
        with closing(read_parts(path, PART, time.monotonic() + WAIT_S)) as parts:
            return b"".join(_bounded(parts, most, name))
    except TimeoutError:
        raise InputError(
            "{name}: expected all of it within {wait_s:g} seconds", name=name, wait_s=WAIT_S
        ) from None
    except OSError as error:
        raise InputError(
            "{name}: cannot be read ({reason})", name=name, reason=reason(error)
        ) from None


def _bounded(parts: Iterable[bytes], most: int, name: str) -> Iterator[bytes]:
    """Yield parts; InputError once they have more than ``most`` bytes."""
    count = 0
    for part in parts:
        count += len(part)
        if count > most:
            raise InputError(
                "{name}: too large, expected at most {amount}", name=name, amount=amount(most)
            )
        yield part


def check_plain(path: Path, most: int) -> None:
    """Raise InputError unless ``path`` is a plain file of at most ``most`` bytes.

    For what is read more than once, which a pipe cannot be. OSError where it cannot be found or is
    a folder.
    """
    found = os.stat(path)
    if stat.S_ISDIR(found.st_mode):
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
    if not stat.S_ISREG(found.st_mode):
        raise InputError("{path}: expected a file, found a pipe or a device", path=path)
    if found.st_size > most:
        raise InputError(
            "{path}: too large, expected at most {amount}", path=path, amount=amount(most)
        )


def amount(count: int) -> str:
    """Return a number of bytes as text."""
    return f"{count >> 20} MB" if count >= 1 << 20 else f"{count >> 10} kB"
