"""A solution as the calls that it makes, where its program is not installed.

The file beside an exercise, compressed, is in the form of stream.py, with

- "source": a checksum of the program and of what was drawn;
- "calls": each call once, as [function, argument, ...]; an argument is a number, null, a list of
  arguments, {"bytes": blob} or {"array": blob, "type", "shape"};
- "takes": what was drawn: {"size": of the window at first, "frames": those that are looked at,
  "events", "presses": those of a trial (trial.py), "made": for each frame a blob of 32-bit indices
  of the calls that it makes}. The first take is that of the exercise's own frames.

A frame that nobody looks at lacks what draws and does nothing else.
"""

import lzma
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from framelens.base.errors import InputError
from framelens.base.input import read_bounded
from framelens.spec import spec
from landscape.course.grader import stream
from landscape.course.grader.trial import Trial

FILE = "solution.calls"
PLAYER = Path(__file__).resolve().parent / "player.py"
MOST_FILE = 4 << 20  # bytes, chosen: the largest of ours has a few tenths of a million
MOST_BYTES = 64 << 20  # chosen: without compression
MOST_SIDE = 4096  # pixels, chosen: of a window

Call = tuple[str, tuple[Any, ...]]


@dataclass(frozen=True)
class Take:
    """What a solution did in a run: the size of its window at first, and each frame's calls.

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


def packed(recorded: Recorded) -> bytes:
    """Return the bytes of the file."""
    blobs = stream.Blobs()
    numbers: dict[str, int] = {}
    calls: list[Any] = []
    takes = []
    for take in recorded.takes:
        made = []
        for frame in take.frames:
            indices = []
            for name, args in frame:
                call = [name, *(_plain(each, blobs) for each in args)]
                key = repr(call)
                if key not in numbers:
                    numbers[key] = len(calls)
                    calls.append(call)
                indices.append(numbers[key])
            made.append(blobs.add(np.array(indices, np.int32).tobytes()))
        takes.append(
            {
                "size": list(take.size),
                "frames": list(take.trial.frames),
                "events": list(take.trial.events),
                "presses": take.trial.presses,
                "made": made,
            }
        )

    answer = {"source": recorded.source, "calls": calls, "takes": takes}
    return lzma.compress(b"".join(stream.parts(answer, blobs.all)))


def _plain(value: Any, blobs: stream.Blobs) -> Any:
    """Return an argument as JSON."""
    if hasattr(value, "_length_"):
        value = np.ctypeslib.as_array(value)
    if isinstance(value, np.ndarray):
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
        return int(value)
    return float(value)


def read(path: Path) -> Recorded:
    """Read a file; InputError if it cannot be read, or is not in this form."""
    data = read_bounded(path, MOST_FILE)
    try:
        answer = stream.received(_unpacked(data))
        if answer is not None:
            return _recorded(*answer)
    except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError, lzma.LZMAError):
        pass
    raise InputError("{path}: expected the calls of a solution", path=path)


def _unpacked(data: bytes) -> bytes:
    """Return what was compressed; ValueError if there is more than MOST_BYTES."""
    reader = lzma.LZMADecompressor()
    found = reader.decompress(data, MOST_BYTES)
    if not reader.eof:
        raise ValueError("too much")
    return found


def _recorded(answer: Mapping[str, Any], blobs: Sequence[memoryview]) -> Recorded:
    calls = [_call(each, blobs) for each in answer["calls"]]
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


def _call(said: Sequence[Any], blobs: Sequence[memoryview]) -> Call:
    name, *args = said
    if spec.function(name) is None:
        raise ValueError(f"no function of OpenGL: {name}")
    return name, tuple(_value(each, blobs) for each in args)


def _value(said: Any, blobs: Sequence[memoryview]) -> Any:
    """Return an argument from its form in JSON."""
    if isinstance(said, list):
        return [_value(each, blobs) for each in said]
    if not isinstance(said, dict):
        return said
    if "bytes" in said:
        return bytes(blobs[said["bytes"]])
    return np.frombuffer(blobs[said["array"]], said["type"]).reshape(said["shape"])


# The take that player.py plays: it is read before the process is contained.
playing: list[Take] = []


def play(path: Path, take: int) -> None:
    """Let player.py play a take in this process."""
    playing[:] = [read(path).takes[take]]
