"""A cache of arrays that are slow to make, such as decoded images. Losing it costs time only.

A file is named by a hash of all that its arrays were made from, the program's own code included, so
it is never out of date. It holds a checksum, so damage is noticed and the arrays are made anew. It
appears whole under its name or not at all, so processes that start together do not disturb each
other. The folder is ``LANDSCAPE_CACHE``, or the system's own place for caches; set to nothing, the
variable turns the cache off. What has lain longest goes when all take more than MOST_BYTES.
"""

import contextlib
import functools
import hashlib
import json
import os
import sys
import tempfile
import zlib
from collections.abc import Callable, Iterable
from pathlib import Path

import numpy as np

MAGIC = b"landscape cache 1\n"
MOST_BYTES = 400 << 20  # chosen: some five times what the shipped island takes
ALIGNED = 16  # bytes
Arrays = tuple[np.ndarray, ...]


def folder() -> Path | None:
    """Return where cached arrays lie; None if there is to be no cache."""
    given = os.environ.get("LANDSCAPE_CACHE")
    if given is not None:
        return Path(given) if given else None
    if sys.platform == "win32":
        base = os.environ.get("LOCALAPPDATA")
    else:
        base = os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache")
    return Path(base) / "landscape" if base and os.path.isabs(base) else None


def recall(parts: Iterable[bytes | str], make: Callable[[], Arrays]) -> Arrays:
    """Return what ``make`` returns, from the cache if it was made before.

    ``parts``, with the code of this program, must determine it. A folder that cannot be used is as
    good as none. The arrays may be written to.
    """
    place = folder()
    if place is None:
        return make()
    digest = hashlib.blake2b(code(), digest_size=20)
    for part in parts:
        data = part.encode() if isinstance(part, str) else part
        digest.update(len(data).to_bytes(8, "little") + data)
    path = place / f"{digest.hexdigest()}.arrays"
    found = _read(path)
    if found is None:
        found = make()
        with contextlib.suppress(OSError):
            _write(path, found)
    return found


@functools.lru_cache(maxsize=1)
def code() -> bytes:
    """Return a hash of the program's own modules: changed code makes other arrays."""
    digest = hashlib.blake2b(np.__version__.encode(), digest_size=20)
    root = Path(__file__).parents[1]
    for path in sorted(root.rglob("*.py")):
        digest.update(path.read_bytes())
    return digest.digest()


def content(path: Path) -> bytes:
    """Return a hash of what is in a file; nothing if it cannot be read: who reads it will say."""
    try:
        stat = path.stat()
        return _content(str(path), stat.st_mtime_ns, stat.st_size)
    except OSError:
        return b""


@functools.lru_cache(maxsize=256)
def _content(path: str, changed: int, size: int) -> bytes:
    return hashlib.blake2b(Path(path).read_bytes(), digest_size=20).digest()


def _read(path: Path) -> Arrays | None:
    """Return the arrays in a file; None if there is none or it is damaged."""
    try:
        data = np.fromfile(path, np.uint8)
        os.utime(path)  # used now: others go first
    except OSError:
        return None
    try:
        start = len(MAGIC) + 8
        head = data[:start].tobytes()
        if not head.startswith(MAGIC):
            return None
        length, checksum = np.frombuffer(head[len(MAGIC) :], "<u4").tolist()
        if zlib.crc32(data[start:].data) != checksum:
            return None
        arrays, at = [], start + length
        for kind, shape in json.loads(data[start:at].tobytes()):
            size = np.dtype(kind).itemsize * int(np.prod(shape))
            arrays.append(data[at : at + size].view(kind).reshape(shape))
            at += size + -size % ALIGNED
    except (ValueError, TypeError):
        return None
    return tuple(arrays)


def _write(path: Path, arrays: Arrays) -> None:
    """Write arrays under another name and rename the file."""
    header = json.dumps([(array.dtype.str, array.shape) for array in arrays]).encode()
    # Each array begins where its numbers may lie in memory: it is read to where it will be used.
    body = [header + b" " * (-(len(MAGIC) + 8 + len(header)) % ALIGNED)]
    body += [part.tobytes() + bytes(-part.nbytes % ALIGNED) for part in arrays]
    checksum = functools.reduce(lambda total, part: zlib.crc32(part, total), body, 0)
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=".new.")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(MAGIC + np.array([len(body[0]), checksum], "<u4").tobytes())
            file.writelines(body)
        os.replace(temporary, path)
    finally:
        with contextlib.suppress(OSError):
            os.unlink(temporary)
    _shrink(path.parent)


def _shrink(place: Path) -> None:
    """Remove what was used longest ago while all takes more than MOST_BYTES."""
    files = []
    for path in place.glob("*.arrays"):
        with contextlib.suppress(OSError):
            stat = path.stat()
            files.append((stat.st_mtime_ns, stat.st_size, path))
    total = sum(size for _, size, _ in files)
    for _, size, path in sorted(files):
        if total <= MOST_BYTES:
            break
        with contextlib.suppress(OSError):
            path.unlink()
            total -= size
