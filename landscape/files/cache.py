"""A cache of arrays that are slow to make, such as decoded images. Losing it costs only time.

The name of a file is a hash of everything its arrays were made from, code included, so a file is
never out of date. The file holds its own name and a checksum of all its bytes: one that is damaged,
or has taken another's name, is noticed, and its arrays are made again. It appears complete or not
at all, so processes that start together do not disturb each other. The
folder is ``LANDSCAPE_CACHE``, or the system's folder for caches; an empty LANDSCAPE_CACHE turns the
cache off. The files used longest ago are deleted when all together exceed MOST_BYTES.
"""

import contextlib
import functools
import hashlib
import inspect
import json
import math
import os
import stat
import zlib
from collections.abc import Callable, Iterable
from pathlib import Path

import numpy as np

from framelens.base.errors import InputError
from framelens.base.output import write_whole

MAGIC = b"landscape cache 2\n"
NAME_BYTES = 20  # of the hash that names a file
# A file: MAGIC, its name, the length of the table that follows and the checksum of all the rest,
# both 4 bytes; the table of types and shapes as JSON; the arrays.
HEAD_BYTES = len(MAGIC) + NAME_BYTES + 8
MOST_BYTES = 1 << 30  # chosen: about five times what the island takes in the preset best
MOST_HASHED = 1 << 30  # bytes of a file, chosen: what reads it accepts no larger one
ALIGNED = 16  # bytes
PACKAGE = Path(__file__).resolve().parents[1]
Arrays = tuple[np.ndarray, ...]


def folder() -> Path | None:
    """Return the folder of the cache; None if there is to be no cache."""
    given = os.environ.get("LANDSCAPE_CACHE")
    if given is not None:
        return Path(given) if given else None
    import platformdirs

    found = platformdirs.user_cache_path("landscape", appauthor=False)
    return found if found.is_absolute() else None


def trouble() -> str:
    """Return why nothing is cached; "" if the cache can be used. A cache that is off is no trouble.

    The folder is made where it is missing.
    """
    if os.environ.get("LANDSCAPE_CACHE") == "":
        return ""
    place = folder()
    if place is None:
        return "there is no home folder to put it in; LANDSCAPE_CACHE may name another"
    try:
        place.mkdir(parents=True, exist_ok=True)
        if os.access(place, os.R_OK | os.W_OK | os.X_OK):
            return ""
        reason = "Permission denied"
    except OSError as error:
        reason = str(error.strerror)
    return f"{place} cannot be used ({reason}); LANDSCAPE_CACHE may name another folder"


def recall(parts: Iterable[bytes | str], make: Callable[[], Arrays], fresh: bool = False) -> Arrays:
    """Return what ``make`` returns, from the cache if it was made before and need not be ``fresh``.

    The result must depend only on ``parts`` and on code: this package's, or that of the file which
    defines ``make``. A cache that cannot be used is not an error. The arrays may be written to.
    """
    theirs = code_outside(make)
    path = None if theirs is None else _path(parts, theirs)
    if path is None:
        return make()
    found = None if fresh else _read(path)
    if found is None:
        found = make()
        with contextlib.suppress(InputError):
            _write(path, found)

    return found


def recalled(parts: Iterable[bytes | str]) -> Arrays | None:
    """Return what :func:`recall` would without making it; None if it is not there.

    For what is made by code of this package.
    """
    path = _path(parts, b"")
    return None if path is None else _read(path)


def _path(parts: Iterable[bytes | str], theirs: bytes) -> Path | None:
    """Return the file for what is made from ``parts``, by code of the hash ``theirs`` as well."""
    place = folder()
    if place is None:
        return None
    digest = hashlib.blake2b(code() + theirs, digest_size=NAME_BYTES)
    for part in parts:
        data = part.encode() if isinstance(part, str) else part
        digest.update(len(data).to_bytes(8, "little") + data)
    return place / f"{digest.hexdigest()}.arrays"


@functools.lru_cache(maxsize=1)
def code() -> bytes:
    """Return a hash of this package's modules: changed code makes other arrays."""
    return np.__version__.encode() + code_below(PACKAGE)


def code_below(folder: Path) -> bytes:
    """Return a hash of all modules in a folder and its sub-folders, their names included."""
    digest = hashlib.blake2b(digest_size=20)
    for path in sorted(folder.rglob("*.py")):
        for part in (str(path.relative_to(folder)).encode(), path.read_bytes()):
            digest.update(len(part).to_bytes(8, "little") + part)
    return digest.digest()


def code_outside(make: Callable[..., object]) -> bytes | None:
    """Return a hash of the file that defines ``make``; nothing if it belongs to this package.

    None where the code cannot be read, for example if it was typed into an interpreter.
    """
    while isinstance(make, functools.partial):
        make = make.func
    make = inspect.unwrap(make)
    # A function or a method, or else a callable object.
    body = getattr(make, "__code__", None) or getattr(type(make).__call__, "__code__", None)
    if body is None:
        return None
    path = Path(body.co_filename)
    return b"" if path.is_relative_to(PACKAGE) else content(path) or None


def content(path: Path) -> bytes:
    """Return a hash of a file's bytes; nothing if it cannot be read, which its reader reports.

    Nothing, too, for a pipe or a device, which would be consumed, or never end.
    """
    try:
        found = path.stat()
        if not stat.S_ISREG(found.st_mode) or found.st_size > MOST_HASHED:
            return b""
        return _content(str(path), found.st_mtime_ns, found.st_size)
    except OSError:
        return b""


@functools.lru_cache(maxsize=256)
def _content(path: str, changed: int, size: int) -> bytes:
    with open(path, "rb") as file:
        hashed = hashlib.file_digest(file, lambda: hashlib.blake2b(digest_size=20))
    return hashed.digest()


def _read(path: Path) -> Arrays | None:
    """Return the arrays in a file; None if there is none, or it is damaged or another's."""
    try:
        if not _plain(path):
            return None
        data = np.fromfile(path, np.uint8)
        os.utime(path)  # the time of its last use: older files are deleted first
    except OSError:
        return None

    begin = _begin(path)
    head, body = data[:HEAD_BYTES].tobytes(), data[HEAD_BYTES:]
    if len(head) < HEAD_BYTES or not head.startswith(begin):
        return None
    length, checksum = np.frombuffer(head[len(begin) :], "<u4").tolist()
    if _checksum([head[:-4], body.data]) != checksum:
        return None
    try:
        arrays, at = [], length
        for kind, shape in json.loads(body[:length].tobytes()):
            size = np.dtype(kind).itemsize * math.prod(shape)
            arrays.append(body[at : at + size].view(kind).reshape(shape))
            at += size + -size % ALIGNED
    except (ValueError, TypeError, OverflowError, RecursionError):
        return None

    return tuple(arrays)


def _plain(path: Path) -> bool:
    """Return whether a path leads to a file of a size that is written here; OSError."""
    found = path.stat()
    return stat.S_ISREG(found.st_mode) and found.st_size <= MOST_BYTES


def _begin(path: Path) -> bytes:
    """Return the bytes a file of this name begins with."""
    return MAGIC + bytes.fromhex(path.stem)


def _checksum(parts: Iterable[bytes | memoryview]) -> int:
    return functools.reduce(lambda total, part: zlib.crc32(part, total), parts, 0)


def _write(path: Path, arrays: Arrays) -> None:
    """Write arrays to a file, and delete old files if there are too many."""
    table = json.dumps([(array.dtype.str, array.shape) for array in arrays]).encode()
    # Each array begins at an aligned offset, so that it can be used in place, without a copy.
    table += b" " * (-(HEAD_BYTES + len(table)) % ALIGNED)
    body = [table, *(part.tobytes() + bytes(-part.nbytes % ALIGNED) for part in arrays)]
    with contextlib.suppress(OSError):
        if not _plain(path):
            path.unlink()  # a pipe or a device, into which it would be written
    begin = _begin(path) + len(table).to_bytes(4, "little")
    write_whole(path, [begin + _checksum([begin, *body]).to_bytes(4, "little"), *body])
    _shrink(path.parent)


def _shrink(place: Path) -> None:
    """Delete the files used longest ago while all together exceed MOST_BYTES."""
    files = []
    for path in place.glob("*.arrays"):
        with contextlib.suppress(OSError):
            found = path.stat()
            files.append((found.st_mtime_ns, found.st_size, path))
    total = sum(size for _, size, _ in files)
    for _, size, path in sorted(files):
        if total <= MOST_BYTES:
            break
        with contextlib.suppress(OSError):
            path.unlink()
            total -= size
