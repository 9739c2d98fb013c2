"""What is noted about an OpenGL call: its name, arguments, element, pass and source line."""

import linecache
import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from types import CodeType, FrameType
from typing import Any, Protocol, runtime_checkable

import numpy as np

from framelens.base.packages import PACKAGES

LIBRARIES = os.path.dirname(os.path.abspath(os.__file__)) + os.sep

INSTALLED = ("site-packages", "dist-packages")

MASKED = ("glClear", "glPushAttrib")
BITS = (
    *("CURRENT", "POINT", "LINE", "POLYGON", "LIGHTING", "FOG", "DEPTH_BUFFER", "STENCIL_BUFFER"),
    *("VIEWPORT", "TRANSFORM", "ENABLE", "COLOR_BUFFER", "HINT", "LIST", "TEXTURE"),
)
NUMBERS = (bool, int, float)
FARTHEST = 2  # chosen: folders up from a program's own, for files named by the way to them
FIRST = 64  # chosen: values of an array that a trace shows


@dataclass(frozen=True, slots=True)
class Site:
    """A line of code that calls OpenGL: the file as a trace names it, line, function and path.

    ``function`` is the qualified name, as in "Water.draw"; ``path`` is where the file can be read.
    """

    file: str
    line: int
    function: str
    path: str

    @property
    def text(self) -> str:
        """The line's text without the space around it; empty where the source is not at hand."""
        return linecache.getline(self.path, self.line).strip()


class Compiled(Protocol):
    """A display list, as a recording knows it; ``glu`` are the calls of GLU that compiled it."""

    glu: "list[GluCall]"

    def calls(self) -> "list[Call]":
        """Return the calls that it was compiled from."""


@dataclass(slots=True)
class Call:
    """One call.

    ``args`` are the arguments as OpenGL received them, ``given`` those of the program where an edit
    changed them; a call that an edit left out is ``skipped``. ``shared_by`` names the element that
    draws, or several that share the call; ``executed`` are the lists that a glCallList executes.
    ``number`` counts the calls of a recording from 0.

    A complete recording copies arrays. In it ``arrays`` are the calls (name, arguments) that give a
    draw call its client arrays, and ``compiled`` is the list that a glNewList began.
    """

    name: str
    args: tuple[Any, ...]
    shared_by: tuple[str, ...]
    pass_: str
    site: Site
    kept: list[object] | None = None  # ``shown``, where it had to be made at the time of the call
    given: tuple[object, ...] | None = None
    skipped: bool = False
    arrays: "Sequence[tuple[str, tuple[Any, ...]]]" = ()
    executed: "Sequence[Compiled]" = ()
    compiled: "Compiled | None" = None
    number: int = 0

    @property
    def listed(self) -> "list[Call]":
        """The calls of the display lists that this one executes."""
        return [inner for each in self.executed for inner in each.calls()]

    @property
    def element(self) -> str:
        """The element that draws, the first of those that share the call."""
        return self.shared_by[0]

    @property
    def source(self) -> str:
        """The line of code that made the call, as "file:line"."""
        return f"{self.site.file}:{self.site.line}"

    @property
    def shown(self) -> list[object]:
        """The arguments as JSON: enumerants by name, long arrays by their first values."""
        return shown(self.name, self.args) if self.kept is None else self.kept

    def as_json(self, inside: str = "") -> dict[str, object]:
        """Return the call in the form that `landscape trace --json` prints.

        ``inside`` is the place of a call that a display list executes, as in "12.3".
        """
        place = inside or str(self.number)
        entry: dict[str, object] = {
            "call": int(place.partition(".")[0]),
            "name": self.name,
            "args": self.shown,
            "element": self.element,
            "source": self.source,
            "function": self.site.function,
            "text": self.site.text,
            "pass": self.pass_,
        }

        if inside:
            entry["inside"] = inside
        if self.skipped:
            entry["skipped"] = True
        if len(self.shared_by) > 1:
            entry["shared_by"] = list(self.shared_by)
        if listed := self.listed:
            entry["list"] = [call.as_json(f"{place}.{index}") for index, call in enumerate(listed)]
        return entry


@dataclass(slots=True)
class GluCall:
    """A call of GLU, and which calls of OpenGL it made: those from ``begin`` up to ``end``.

    They count the calls of the recording, or of the display list that is being compiled.
    """

    name: str
    args: tuple[Any, ...]
    site: Site
    pass_: str
    begin: int
    end: int

    @property
    def source(self) -> str:
        """The line of code that made the call, as "file:line"."""
        return f"{self.site.file}:{self.site.line}"


Brief = tuple[int, str, CodeType, int, tuple[object, ...]]
"""A short note of a call: how many calls the recorder had, the name, the code and the instruction
that calls, and the arguments."""


@runtime_checkable
class Edits(Protocol):
    """Changes calls as they are made (see framelens/tape/edits.py)."""

    def begin(self) -> None:
        """A frame begins, or the setup."""

    def begin_list(self, listing: Any) -> None:
        """The compiling of a display list begins."""

    def end_list(self) -> None:
        """The compiling of a display list ends."""

    def change(
        self, name: str, args: tuple[object, ...], elements: tuple[str, ...], pass_: str, site: Site
    ) -> tuple[object, ...] | None:
        """Return the arguments to use for a call, ``args`` itself for most; None leaves it out."""


def shown(name: str, args: tuple[Any, ...]) -> list[Any]:
    """Return the arguments of a call as JSON."""
    return [mask(args[0])] if name in MASKED else [plain(value) for value in args]


def mask(value: int) -> str:
    """Write an attribute or buffer mask as its bits' names."""
    import OpenGL.GL

    names = (f"GL_{bit}_BIT" for bit in BITS)
    return " | ".join(name for name in names if value & getattr(OpenGL.GL, name))


def plain(value: object) -> object:
    """Turn an argument into JSON: enumerants by name, numbers as numbers, arrays described."""
    if isinstance(value, int) and hasattr(value, "name"):
        return value.name
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, (list, tuple, np.ndarray)):
        array = np.asarray(value)
        first = [v if isinstance(v, NUMBERS) else plain(v) for v in _first(array)]
        return {"shape": list(array.shape), "dtype": str(array.dtype), "values": first}
    if value is None or isinstance(value, (bool, int, float, str)):
        return value
    return getattr(value, "value", type(value).__name__)


def _first(array: np.ndarray) -> list[object]:
    """Return the first values of an array; of a structured one, its numbers field by field."""
    if array.dtype.names is None:
        return list(array.flat[:FIRST].tolist())
    return [
        number
        for record in array.flat[:FIRST]
        for name in array.dtype.names
        for number in _first(np.asarray(record[name]))
    ][:FIRST]


known_files: dict[str, str] = {}  # source path to name in a trace, or ""
# By code, file and line: the same lines in two files are the same code to Python.
_sites: dict[tuple[CodeType, str, int], Site] = {}
_folders: tuple[str, ...] = ()  # of a program: its own, as it was named and as it is


@contextmanager
def files_beside(program: Path) -> Iterator[None]:
    """Inside the block, name files by their way from the folder of a program."""
    global _folders
    before, _folders = _folders, (str(program.absolute().parent), str(program.resolve().parent))
    known_files.clear()
    _sites.clear()
    try:
        yield
    finally:
        _folders = before
        known_files.clear()
        _sites.clear()


def caller(frame: FrameType) -> Site:
    """Return the line of the nearest caller that is neither a gl module nor a library."""
    at: FrameType | None = frame
    while at is not None:
        path = at.f_code.co_filename
        file = known_files.get(path)
        if file is None:
            file = known_files[path] = traced_file(path)
        if file:
            return _site(file, at)
        at = at.f_back
    return _site(os.path.basename(frame.f_code.co_filename), frame)


def _site(file: str, frame: FrameType) -> Site:
    code, line = frame.f_code, frame.f_lineno
    place = (code, code.co_filename, line)
    site = _sites.get(place)
    if site is None:
        site = _sites[place] = Site(file, line, qualified(code), code.co_filename)
    return site


def qualified(code: CodeType) -> str:
    """Return the qualified name of a function, as in "Water.draw"."""
    return code.co_qualname.replace("<locals>.", "")


def line_of(code: CodeType, instruction: int) -> int:
    """Return the line of an instruction, a frame's ``f_lasti``."""
    found = (number for begin, end, number in code.co_lines() if begin <= instruction < end)
    return next(found, None) or code.co_firstlineno


def traced_file(path: str) -> str:
    """Return a source file's name in a trace: its path from the package on, or from the program on.

    It is the last part alone of a file far away from the program. "" for the packages' wrappers of
    OpenGL and for libraries, whose callers are shown instead.
    """
    for package in PACKAGES:
        name = package.traced(path)
        if name is not None:
            return name

    installed = any(f"{os.sep}{name}{os.sep}" in path for name in INSTALLED)
    if installed or path.startswith((LIBRARIES, "<frozen")):
        return ""
    return _from_program(path)


def _from_program(path: str) -> str:
    """Return the way to a file from the program's folder, with slashes on every system."""
    name = os.path.basename(path)
    # The program itself may have been named without its folder.
    ways = [way for folder in _folders if os.path.isabs(path) and (way := _way(path, folder))]
    return min(ways, key=len, default=name)


def _way(path: str, folder: str) -> str:
    """Return the way to a file from a folder; "" if it leads up more than FARTHEST folders."""
    try:
        way = os.path.relpath(path, folder).replace(os.sep, "/")
    except ValueError:  # on another drive
        return ""
    return "" if way.startswith("../" * (FARTHEST + 1)) else way
