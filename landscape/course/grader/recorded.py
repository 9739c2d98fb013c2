"""A program as the calls that it makes: a solution that is not installed, or what is drawn again.

The file beside an exercise, compressed, is in the form of stream.py, with

- "source": a checksum of the program and of what was drawn;
- "calls": each call once, as [function, argument, ...]; an argument is a number, null, a list of
  arguments, {"bytes": blob}, {"array": blob, "type", "shape"} or {"offset": number} in a buffer;
- "takes": what was drawn: {"size": of the window at first, "frames": those that are looked at,
  "events", "presses": those of a trial (trial.py), "made": for each frame a blob of 32-bit indices
  of the calls that it makes}. The first take is that of the exercise's own frames.

A frame that nobody looks at lacks what draws and does nothing else.

The process of a program that is checked sends the same of its frames, with all that they draw, so
that the grader can see whether its calls give the picture that it sends.
"""

import ctypes
import lzma
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from framelens.base.errors import InputError
from framelens.base.input import read_bounded
from framelens.gl.client import READS_ARRAYS, buffer_offset, concerns_arrays
from framelens.spec import spec
from landscape.course.grader import stream
from landscape.course.grader.trial import Trial

FILE = "solution.calls"
PLAYER = Path(__file__).resolve().parent / "player.py"
COMPRESSED = b"\xfd7zXZ"  # how a compressed file begins
MOST_BYTES = 64 << 20  # chosen: of a file, and of what was compressed
MOST_CALLS = 300_000  # chosen: different ones
MOST_MADE = 4_000_000  # chosen: calls in all frames
OFFSETS = 1 << 22  # chosen: bytes of a buffer; no address of memory is so low
MOST_SIDE = 4096  # pixels, chosen: of a window
KINDS = "biuf"  # of numbers in an array, as numpy names them

Call = tuple[str, tuple[object, ...]]


@dataclass(frozen=True)
class Take:
    """A solution's run: the initial size of its window, and each frame's calls.

    ``trial`` is empty of presses in the first take, which is no trial.
    """

    size: tuple[int, int]
    trial: Trial
    frames: Sequence[Sequence[Call]]


@dataclass(frozen=True)
class Recorded:
    """A solution's takes; ``source`` is a checksum of what they were recorded from."""

    source: str
    takes: Sequence[Take]


class Unrecorded(ValueError):
    """A call that cannot be made again from its name and arguments alone."""


class Writer:
    """Collects calls, each once, and which of them each frame makes."""

    def __init__(self) -> None:
        self.blobs = stream.Blobs()
        self.calls: list[object] = []
        self._numbers: dict[object, int] = {}
        self._pointing: list[int] = []  # the calls that say where client arrays lie, if known

    def frame(self, calls: Iterable[Call | Sequence[Call]]) -> int:
        """Return the number of the blob that says which calls a frame makes.

        Calls that belong together say where client arrays lie; they are left out where the last
        ones said the same.
        """
        indices: list[int] = []
        for each in calls:
            if isinstance(each, tuple):
                indices.append(self._number(*each))
                if concerns_arrays(each[0]) and each[0] not in READS_ARRAYS:
                    self._pointing = []
                continue
            pointing = [self._number(*call) for call in each]
            if pointing != self._pointing:
                indices += pointing
                self._pointing = pointing
        return self.blobs.add(np.array(indices, np.int32).tobytes())

    def _number(self, name: str, args: tuple[object, ...]) -> int:
        """Return the index of a call; Unrecorded if it cannot be made again."""
        if all(type(each) in (int, float) for each in args):
            key: object = name, args, *map(type, args)
        else:
            key = repr((name, [_plain(each, self.blobs) for each in args]))
        number = self._numbers.get(key)
        if number is None:
            if not _can_be_made(name) or len(self.calls) >= MOST_CALLS:
                raise Unrecorded(name)
            number = self._numbers[key] = len(self.calls)
            self.calls.append([name, *(_plain(each, self.blobs) for each in args)])
        return number

    def written(self, source: str, takes: Sequence[Mapping[str, object]]) -> bytes:
        """Return the bytes of a file, without compression."""
        answer = {"source": source, "calls": self.calls, "takes": takes}
        return b"".join(stream.parts(answer, self.blobs.all))


def _can_be_made(name: str) -> bool:
    """Return whether a function of OpenGL may be called again; one that opens memory may not."""
    return spec.function(name) is not None and not name.startswith("glMapBuffer")


def said(size: Sequence[int], trial: Trial, made: Sequence[int]) -> dict[str, object]:
    """Return a take as it is written; ``made`` are the blobs of its frames."""
    return {
        "size": list(size),
        "frames": list(trial.frames),
        "events": list(trial.events),
        "presses": trial.presses,
        "made": list(made),
    }


def packed(recorded: Recorded) -> bytes:
    """Return the bytes of a file, compressed."""
    writer = Writer()
    takes = [
        said(take.size, take.trial, [writer.frame(each) for each in take.frames])
        for take in recorded.takes
    ]
    return lzma.compress(writer.written(recorded.source, takes))


def _plain(value: object, blobs: stream.Blobs) -> object:
    """Return an argument as JSON; Unrecorded for an address, or what is unknown."""
    if (offset := buffer_offset(value)) is not None:
        if not 0 <= offset < OFFSETS:
            raise Unrecorded("an address")
        return {"offset": offset}

    if hasattr(value, "_length_"):
        value = np.ctypeslib.as_array(value)
    if isinstance(value, np.ndarray):
        if value.dtype.kind not in KINDS:
            raise Unrecorded(value.dtype.str)
        data = np.ascontiguousarray(value)
        shape = list(value.shape)
        return {"array": blobs.add(data.tobytes()), "type": value.dtype.str, "shape": shape}

    if isinstance(value, bytes):
        return {"bytes": blobs.add(value)}
    if isinstance(value, list | tuple):
        return [_plain(each, blobs) for each in value]

    if value is None or isinstance(value, bool):
        return value
    if isinstance(value, int | np.integer):
        if not -(1 << 31) <= value < 1 << 32:
            raise Unrecorded("an address")
        return int(value)
    if isinstance(value, float | np.floating):
        return float(value)
    raise Unrecorded(type(value).__name__)


def read(path: Path) -> Recorded:
    """Read a file; InputError if it cannot be read, or is not in this form."""
    found = parsed(read_bounded(path, MOST_BYTES))
    if found is None:
        raise InputError("{path}: expected the calls of a solution", path=path)
    return found


def parsed(data: bytes) -> Recorded | None:
    """Return what the bytes of a file say; None if they are not in this form."""
    try:
        whole = _unpacked(data) if data.startswith(COMPRESSED) else data
        answer = stream.received(whole)
        return _recorded(*answer) if answer is not None else None
    except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError, lzma.LZMAError):
        return None


def _unpacked(data: bytes) -> bytes:
    """Return what was compressed; ValueError if there is more than MOST_BYTES."""
    reader = lzma.LZMADecompressor()
    found = reader.decompress(data, MOST_BYTES)
    if not reader.eof:
        raise ValueError("too much")
    return found


def _recorded(answer: Mapping[str, Any], blobs: Sequence[memoryview]) -> Recorded:
    made = sum(len(blobs[each]) // 4 for take in answer["takes"] for each in take["made"])
    if max(made, len(answer["calls"])) > MOST_MADE:
        raise ValueError("more calls than a program is allowed")
    reader = _Reader(blobs)
    calls = [reader.call(each) for each in answer["calls"]]
    return Recorded(str(answer["source"]), [_take(each, calls, blobs) for each in answer["takes"]])


def _take(said: Mapping[str, Any], calls: Sequence[Call], blobs: Sequence[memoryview]) -> Take:
    width, height = map(int, said["size"])
    if not (0 < width <= MOST_SIDE and 0 < height <= MOST_SIDE):
        raise ValueError(f"a window of {width} x {height} pixels")
    presses = {
        int(frame): {str(key): int(count) for key, count in keys.items()}
        for frame, keys in said["presses"].items()
    }
    trial = Trial([int(each) for each in said["frames"]], list(said["events"]), presses)
    made = [np.frombuffer(blobs[each], np.int32).tolist() for each in said["made"]]
    return Take((width, height), trial, [_made(each, calls) for each in made])


def _made(indices: Iterable[int], calls: Sequence[Call]) -> list[Call]:
    return [calls[index] for index in indices]


class _Reader:
    """Reads calls; bytes that several of them have are copied once."""

    def __init__(self, blobs: Sequence[memoryview]) -> None:
        self._blobs = blobs
        self._bytes: dict[int, bytes] = {}

    def call(self, said: Sequence[Any]) -> Call:
        """Return a call from its form in JSON."""
        name, *args = said
        if not _can_be_made(name):
            raise ValueError(f"no function of OpenGL: {name}")
        return name, tuple(map(self._value, args))

    def _value(self, said: object) -> object:
        """Return an argument from its form in JSON."""
        if isinstance(said, list):
            return [self._value(each) for each in said]
        if not isinstance(said, dict):
            return said
        if "bytes" in said:
            number = said["bytes"]
            if number not in self._bytes:
                self._bytes[number] = bytes(self._blobs[number])
            return self._bytes[number]
        if "offset" in said:
            if not 0 <= said["offset"] < OFFSETS:
                raise ValueError("no offset in a buffer")
            return ctypes.c_void_p(said["offset"])
        if np.dtype(said["type"]).kind not in KINDS:
            raise ValueError("no array of numbers")
        return np.frombuffer(self._blobs[said["array"]], said["type"]).reshape(said["shape"])


# The take that player.py plays: it is read before the process is contained.
playing: list[Take] = []


def play(path: Path, take: int) -> None:
    """Let player.py play a take in this process."""
    playing[:] = [read(path).takes[take]]
