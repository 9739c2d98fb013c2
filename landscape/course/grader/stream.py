"""The one way from a program's process to the grader: a pipe, read within limits.

What comes is 8 bytes, the length of a text of JSON; that text; and the blobs, whose lengths are its
"blobs", one after the other. In the JSON a blob is named by its number.
"""

import contextlib
import json
import os
import struct
import sys
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

if sys.platform == "linux":
    import fcntl

MOST_BYTES = 256 << 20  # chosen: of all that a program's process sends
MOST_TEXT = 32 << 20  # chosen: of its JSON, which takes far more memory once it is read
MOST_READ = 512 << 20  # bytes, chosen: that the objects of a JSON may take
# About what Python takes for what begins or ends with these: a dictionary, a list, an item.
BYTES = {b"{": 232, b"[": 64, b",": 40}
PART = 1 << 20  # bytes that are written or read at once
LENGTH = struct.Struct(">Q")

Answer = tuple[dict[str, Any], Sequence[memoryview]]


class Blobs:
    """Bytes that are sent beside the JSON; the same ones once."""

    def __init__(self) -> None:
        self.all: list[bytes] = []
        self._numbers: dict[bytes, int] = {}

    def add(self, data: bytes) -> int:
        """Return the number by which the JSON names them."""
        if data not in self._numbers:
            self._numbers[data] = len(self.all)
            self.all.append(data)
        return self._numbers[data]


def parts(answer: Mapping[str, object], blobs: Sequence[bytes] = ()) -> Iterator[bytes]:
    """Yield the bytes of an answer and its blobs."""
    text = json.dumps({**answer, "blobs": [len(each) for each in blobs]}).encode()
    yield LENGTH.pack(len(text))
    yield text
    yield from blobs


def widen(pipe: int) -> None:
    """Let a pipe hold a whole part, where the system can: so both ends wait less often."""
    if sys.platform == "linux":
        with contextlib.suppress(OSError):  # a user may have so many large pipes
            fcntl.fcntl(pipe, fcntl.F_SETPIPE_SZ, PART)


def send(file: int, answer: Mapping[str, object], blobs: Sequence[bytes] = ()) -> None:
    """Write an answer and its blobs into a pipe."""
    for data in parts(answer, blobs):
        rest = memoryview(data)
        while rest:
            rest = rest[os.write(file, rest[:PART]) :]


def received(data: bytes) -> Answer | None:
    """Return what was sent; None if it has another form, as what a program itself has written."""
    try:
        (length,) = LENGTH.unpack_from(data)
        if length > MOST_TEXT:
            return None
        end = LENGTH.size + length
        text = data[LENGTH.size : end]
        if sum(text.count(mark) * each for mark, each in BYTES.items()) > MOST_READ:
            return None
        answer = json.loads(text)
        if not isinstance(answer, dict):
            return None
        return answer, _parted(memoryview(data)[end:], answer["blobs"])
    except (KeyError, RecursionError, TypeError, ValueError, struct.error):
        return None


def _parted(data: memoryview, sizes: Sequence[int]) -> list[memoryview]:
    """Cut bytes into blobs; ValueError unless they are exactly as many."""
    if any(type(size) is not int or size < 0 for size in sizes) or sum(sizes) != len(data):
        raise ValueError("blobs of other sizes")
    blobs, begin = [], 0
    for size in sizes:
        blobs.append(data[begin : begin + size])
        begin += size
    return blobs
