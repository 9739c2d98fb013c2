"""What is noted about an OpenGL call: its name, arguments, element, pass and source line."""

import os
from collections.abc import Sequence
from dataclasses import dataclass
from types import FrameType
from typing import Any

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__)) + os.sep
PACKAGE = os.path.dirname(os.path.dirname(HERE)) + os.sep
LIBRARIES = os.path.dirname(os.path.abspath(os.__file__)) + os.sep

MASKED = ("glClear", "glPushAttrib")
BITS = (
    *("CURRENT", "POINT", "LINE", "POLYGON", "LIGHTING", "FOG", "DEPTH_BUFFER", "STENCIL_BUFFER"),
    *("VIEWPORT", "TRANSFORM", "ENABLE", "COLOR_BUFFER", "HINT", "LIST", "TEXTURE"),
)
FIRST = 64  # chosen: values of an array that a trace shows


@dataclass(slots=True)
class Call:
    """One call.

    ``args`` are the arguments as OpenGL received them. ``shared_by`` names the element that draws,
    or several that share the call; ``listed`` holds the calls that a glCallList executes.
    """

    name: str
    args: tuple[Any, ...]
    shared_by: tuple[str, ...]
    pass_: str
    file: str
    line: int
    kept: list[Any] | None = None  # ``shown``, where it had to be made at the time of the call
    listed: "Sequence[Call]" = ()

    @property
    def element(self) -> str:
        """The element that draws, the first of those that share the call."""
        return self.shared_by[0]

    @property
    def source(self) -> str:
        """The line of code that made the call, as "file:line"."""
        return f"{self.file}:{self.line}"

    @property
    def shown(self) -> list[Any]:
        """The arguments as JSON: enumerants by name, long arrays by their first values."""
        return shown(self.name, self.args) if self.kept is None else self.kept

    def as_json(self) -> dict[str, Any]:
        """Return the call in the form that `landscape trace --json` prints."""
        entry: dict[str, Any] = {
            "name": self.name,
            "args": self.shown,
            "element": self.element,
            "source": self.source,
            "pass": self.pass_,
        }
        if len(self.shared_by) > 1:
            entry["shared_by"] = list(self.shared_by)
        if self.listed:
            entry["list"] = [call.as_json() for call in self.listed]
        return entry


def shown(name: str, args: tuple[Any, ...]) -> list[Any]:
    """Return the arguments of a call as JSON."""
    return [mask(args[0])] if name in MASKED else [plain(value) for value in args]


def mask(value: int) -> str:
    """Write an attribute or buffer mask as its bits' names."""
    import OpenGL.GL

    names = (f"GL_{bit}_BIT" for bit in BITS)
    return " | ".join(name for name in names if value & getattr(OpenGL.GL, name))


def plain(value: Any) -> Any:
    """Turn an argument into JSON: enumerants by name, numbers as numbers, arrays described."""
    if isinstance(value, int) and hasattr(value, "name"):
        return value.name
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, (list, tuple, np.ndarray)):
        array = np.asarray(value)
        first = array.flat[:FIRST].tolist()
        return {"shape": list(array.shape), "dtype": str(array.dtype), "values": first}
    if value is None or isinstance(value, (bool, int, float, str)):
        return value
    return getattr(value, "value", type(value).__name__)


_files: dict[str, str] = {}  # source path to name in a trace, or ""


def caller(frame: FrameType) -> tuple[str, int]:
    """Return file and line of the nearest caller that is neither a gl module nor a library."""
    at: FrameType | None = frame
    while at is not None:
        path = at.f_code.co_filename
        file = _files.get(path)
        if file is None:
            file = _files[path] = traced_file(path)
        if file:
            return file, at.f_lineno
        at = at.f_back
    return os.path.basename(frame.f_code.co_filename), frame.f_lineno


def traced_file(path: str) -> str:
    """Return a source file's name in a trace: its path from the package on, or its last part.

    "" for the modules of ``landscape/gl`` and for libraries, whose callers are shown instead.
    """
    if path.startswith((HERE, LIBRARIES, "<frozen")):
        return ""
    if path.startswith(PACKAGE):
        return "landscape/" + path[len(PACKAGE) :].replace(os.sep, "/")
    return os.path.basename(path)
