"""How the evidence of a program is written, in its process, and read by the grader.

It is JSON with blobs beside it (stream.py):

- "frames": number to {"size", "pixels" (a blob: rows of RGB, top row first), "calls"};
- "setup": the calls before the first that draws;
- "sites": what the calls of one line have in common, as [name, line, function, own, count]: "own"
  says whether the line is the program's, not that of a module it imports, "count" is that of the
  arguments;
- "numbers": {"of", "values"}: the calls that only give numbers, in their order: blobs, the index of
  the site of each, 32 bits, and the arguments of all, doubles;
- "lists": the calls of display lists that were executed;
- "pointers": the pointer calls of vertex arrays that are drawn, each [name, arguments];
- "states": OpenGL's state at the calls that draw, by the names of framelens/state/state.py; the
  first is whole, the others are what differs from it;
- "early": null, or the first function that was called without a context, in vain, and the line;
- "made": null, or a blob: all frames as recorded.py writes them, to be drawn again.

Calls are [first, each, ...]: a number stands for so many calls that only give numbers, of which
``first`` is the first, and [site, arguments, more] for another call. "more" may have "way", the
lines of the program that lead to the call, from the outermost, each with the function that it
calls; "state", an index of "states"; "inside", an index of "lists" for each display list that it
executes; "arrays", an index of "pointers" for each array that a draw call reads.
"""

import hashlib
from array import array
from collections import ChainMap, Counter
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from framelens.gl import notes
from framelens.gl.notes import Brief, plain, shown
from framelens.spec import spec
from landscape.course.grader.calls import KINDS, NO_LINE, Call, Item, Numbers, State, base
from landscape.course.grader.evidence import Evidence, Frame
from landscape.course.grader.recorded import MOST_SIDE
from landscape.course.grader.stream import Answer, Blobs

MOST_CALLS = 4_000_000  # chosen: those of display lists counted each time that they are executed
# Chosen: of them those that are objects of their own, which take some seconds to make.
MOST_OBJECTS = 500_000
LONGEST = 30_000  # chosen: numbers of an array that are kept
Block = list[Any]
"""The calls of a frame, of the setup or of a display list, as they are written."""


@cache
def only_gives_numbers(name: str) -> bool:
    """Return whether each argument of a function is a number of what it gives: glVertex3f."""
    return base(name) in KINDS and name != base(name) and not name.endswith("v")


def _is_brief(call: notes.Call) -> bool:
    return only_gives_numbers(call.name) and all(type(each) in (float, int) for each in call.args)


class Writer:
    """Makes blocks of calls that a recording has; ``program`` is the path of the program."""

    def __init__(self, program: str) -> None:
        self._program = program
        self.blobs = Blobs()
        self._sites: dict[object, int] = {}
        self._written_sites: list[object] = []
        self._of = array("i")
        self._values = array("d")
        self._lists: list[Block] = []
        # A list's index, and the list: by its identity.
        self._of_list: dict[int, tuple[int, object]] = {}
        self._pointers: list[object] = []
        self._of_pointer: dict[object, int] = {}  # its index, by its name and what it points to

    def block(
        self,
        calls: Sequence[notes.Call],
        more: Mapping[int, Mapping[str, object]],
        brief: Sequence[Brief] = (),
        before: int = 0,
    ) -> Block:
        """Return calls as they are written, with short notes of others among them.

        ``more``: what else there is to say of a call, by its identity. ``before``: how many calls
        the recorder had when the first of them was made.
        """
        inside = [self._executed(call, more) for call in calls]
        found: Block = [len(self._of)]
        counts = Counter(note[0] for note in brief)
        begin = run = 0
        for place, call in enumerate(calls, before):
            if place in counts:
                run += self._take(brief[begin : begin + counts[place]])
                begin += counts[place]
            if id(call) not in more and _is_brief(call):
                self._give(self._site_of(call), call.args)
                run += 1
                continue
            if run:
                found.append(run)
                run = 0
            found.append(self._written(call, more, inside[place - before]))

        run += self._take(brief[begin:])
        return [*found, run] if run else found

    def _take(self, brief: Sequence[Brief]) -> int:
        """Take calls of which there is a short note; return how many there are."""
        for _, name, code, instruction, args in brief:
            key = name, id(code), instruction, len(args)
            site = self._sites.get(key)
            if site is None:
                own, function = code.co_filename == self._program, notes.qualified(code)
                site = self._site(
                    key, name, notes.line_of(code, instruction), function, own, len(args)
                )
            self._give(site, args)
        return len(brief)

    def _give(self, site: int, args: Sequence[Any]) -> None:
        self._of.append(site)
        self._values.extend(args)

    def _executed(self, call: notes.Call, more: Mapping[int, Mapping[str, object]]) -> list[int]:
        """Return the indices of the display lists that a call executes."""
        found = []
        for each in call.executed:
            if id(each) not in self._of_list:
                block = self.block(each.calls(), more)
                self._of_list[id(each)] = len(self._lists), each
                self._lists.append(block)
            found.append(self._of_list[id(each)][0])
        return found

    def _site_of(self, call: notes.Call) -> int:
        at = call.site
        key = call.name, id(at), len(call.args)
        if key in self._sites:
            return self._sites[key]
        own = at.path == self._program
        return self._site(key, call.name, at.line, at.function, own, len(call.args))

    def _site(self, key: object, name: str, *others: object) -> int:
        self._sites[key] = len(self._written_sites)
        self._written_sites.append([name, *others])
        return self._sites[key]

    def _written(
        self, call: notes.Call, more: Mapping[int, Mapping[str, object]], inside: list[int]
    ) -> list[object]:
        site, args = self._site_of(call), _arguments(call.name, call.args) if call.args else []
        found = dict(more.get(id(call), ()))
        # Not for each glArrayElement: thousands of them would write the arrays thousands of times.
        if call.arrays and spec.draws(call.name):
            found["arrays"] = [self._pointer(name, args) for name, args in call.arrays]
        if inside:
            found["inside"] = inside
        return [site, args, found] if found else [site, args]

    def _pointer(self, name: str, args: tuple[object, ...]) -> int:
        """Return the index of a pointer call; an array of one content is written once."""
        key = name, *map(_content, args)
        if key not in self._of_pointer:
            self._of_pointer[key] = len(self._pointers)
            self._pointers.append([name, _arguments(name, args)])
        return self._of_pointer[key]

    def written(self) -> dict[str, object]:
        """Return what is not in blocks."""
        numbers = {
            "of": self.blobs.add(self._of.tobytes()),
            "values": self.blobs.add(self._values.tobytes()),
        }
        return {
            "sites": self._written_sites,
            "numbers": numbers,
            "lists": self._lists,
            "pointers": self._pointers,
        }


def _arguments(name: str, args: tuple[object, ...]) -> list[object]:
    """Return the arguments as JSON: enumerants by name, arrays whole if they are not too long."""
    if name in ("glClear", "glPushAttrib"):
        return shown(name, args)
    return [_argument(name, index, args) for index in range(len(args))]


def _content(value: object) -> object:
    """Return a key of an argument; copies of one array have the same."""
    if isinstance(value, np.ndarray):
        return value.dtype.str, value.shape, hashlib.blake2b(value.tobytes()).digest()
    return repr(value)


def _argument(name: str, index: int, args: tuple[Any, ...]) -> Any:
    value = args[index]
    if type(value) is float:
        return value
    if type(value) is int:  # or an enumerant by its number: 12288 is GL_CLIP_PLANE0
        return spec.enumerant(name, index, args) or value
    if isinstance(value, (bytes, bytearray)):
        return {"bytes": len(value)}
    if hasattr(value, "_length_") and hasattr(value, "_type_"):
        value = list(value)
    if isinstance(value, (list, tuple, np.ndarray)):
        try:
            array = np.asarray(value)
        except ValueError:
            return plain(str(type(value)))
        if array.dtype.kind in "biuf" and array.size <= LONGEST:
            return array.tolist()
        return {"shape": list(array.shape)}
    return plain(value)


class TooLarge(ValueError):
    """A picture larger than an exercise needs: comparing it would take gigabytes."""


def load(path: Path, answer: Answer, wanted: Sequence[int]) -> Evidence:
    """Return the evidence of a program from what its process sent.

    If it is not in that form, or a wanted frame is not there, an error of Python is raised;
    TooLarge for pictures that are.
    """
    said, blobs = answer
    reader = _Reader(said, blobs)
    setup = reader.calls(said["setup"])
    frames = {}
    for number in wanted:
        found = said["frames"][str(number)]
        width, height = found["size"]
        if min(width, height) < 1:
            raise ValueError(f"a picture of {width} x {height} pixels")
        if max(width, height) > MOST_SIDE:
            raise TooLarge(f"a picture of {width} x {height} pixels")
        pixels = np.frombuffer(blobs[found["pixels"]], np.uint8)
        picture = pixels.reshape(height, width, 3)
        calls = reader.calls(found["calls"])
        frames[number] = Frame(number, picture, setup, calls, reader.numbers)

    source = path.read_text(encoding="utf-8", errors="replace").splitlines()
    early, made = said.get("early"), said.get("made")
    return Evidence(
        path,
        source,
        frames,
        (str(early[0]), int(early[1])) if early else None,
        bytes(blobs[made]) if made is not None else None,
    )


class _Reader:
    def __init__(self, answer: Mapping[str, Any], blobs: Sequence[memoryview]) -> None:
        first, *others = answer["states"] or [{}]
        self._states: list[State] = [first]
        # Not merged: a forged first state may be large, and the others many.
        self._states += [ChainMap(each, first) for each in others]
        self._count = self._objects = 0  # of calls so far
        self._lists = answer["lists"]
        self._pointers = answer["pointers"]
        sites = [
            (str(name), int(number) if own else NO_LINE, str(function), int(count))
            for name, number, function, own, count in answer["sites"]
        ]
        self._sites = sites
        of = np.frombuffer(blobs[answer["numbers"]["of"]], np.int32)
        values = np.frombuffer(blobs[answer["numbers"]["values"]], float)
        self.numbers = Numbers(sites, of, values)
        self.numbers.check()

    def calls(self, block: Sequence[Any]) -> list[Item]:
        """Return the calls of a block, those of display lists inside them."""
        first, *rest = block
        found: list[Item] = []
        for each in rest:
            self._count += each if isinstance(each, int) else 1
            self._objects += 1
            if self._count > MOST_CALLS or self._objects > MOST_OBJECTS:
                raise ValueError("more calls than a program is allowed")
            if isinstance(each, int):
                found.append(self.numbers.some(first, each))
                first += each
            else:
                found.append(self._call(each))
        return found

    def _call(self, found: Sequence[Any]) -> Call:
        name, number, function, _ = self._sites[found[0]]
        if len(found) == 2:  # as most
            return Call(name, list(found[1]), number, function)
        more = found[2]
        index = more.get("state")
        inside = [self._lists[each] for each in more.get("inside", ())]
        return Call(
            name,
            list(found[1]),
            number,
            function,
            self._states[index] if index is not None else {},
            [self._pointers[each] for each in more.get("arrays", ())],
            [call for block in inside for call in self.calls(block)],
            [(int(at), str(called)) for at, called in more.get("way", ())],
        )
