"""The seam: every OpenGL call of the program goes through the namespace :data:`gl`.

Off, it costs nothing: once looked up, an attribute of ``gl`` is PyOpenGL's function itself. On
(:func:`recording`), each call is noted with its arguments, the element and the source line it comes
from, and may have its arguments changed. Tests, ``landscape trace`` and the lessons stand on it.
"""

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from types import FrameType
from typing import Any

import numpy as np

PACKAGE = Path(__file__).resolve().parents[1]

Override = Callable[[str, tuple[Any, ...]], tuple[Any, ...]]


class Calls:
    """OpenGL's functions and enumerants as attributes; PyOpenGL is imported at the first use."""

    def __getattr__(self, name: str) -> Any:
        # Whoever looks an object over (pytest does) must not load OpenGL before a platform is set.
        if not name.startswith(("gl", "GL")):
            raise AttributeError(name)
        import OpenGL.GL

        value = getattr(OpenGL.GL, name)
        if _recorder is not None and callable(value) and name.startswith("gl"):
            value = _recorder.wrap(name, value)
        self.__dict__[name] = value
        return value


gl: Any = Calls()


@dataclass
class Call:
    """One call: ``args`` as given, ``shown`` as JSON, ``listed`` what a glCallList runs."""

    name: str
    args: tuple[Any, ...]
    shown: list[Any]
    element: str
    shared_by: tuple[str, ...]
    source: str
    pass_: str
    listed: "list[Call]" = field(default_factory=list)

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


class Recorder:
    """Collects calls; calls made while a display list is compiled are kept under that list."""

    def __init__(self, override: Override | None = None) -> None:
        self.calls: list[Call] = []
        self.lists: dict[int, list[Call]] = {}
        self._open: list[Call] | None = None
        self._override = override

    def wrap(self, name: str, function: Callable[..., Any]) -> Callable[..., Any]:
        """Return ``function`` with a note taken before each call."""

        def recorded(*args: Any) -> Any:
            if self._override is not None:
                args = self._override(name, args)
            self._note(name, args)
            return function(*args)

        return recorded

    def _note(self, name: str, args: tuple[Any, ...]) -> None:
        source, elements = _where(sys._getframe(2))
        shown = [_mask(args[0])] if name in MASKED else [plain(a) for a in args]
        call = Call(name, args, shown, elements[0], elements, source, current_pass)
        target = self.calls if self._open is None else self._open
        target.append(call)
        if name == "glNewList":
            self._open = self.lists[int(args[0])] = []
        elif name == "glEndList":
            if self._open:
                self._open.pop()
            self._open = None
            self.calls.append(call)
        elif name == "glCallList":
            call.listed = self.lists.get(int(args[0]), [])
        elif name == "glCallLists":
            call.listed = [c for each in args[2] for c in self.lists.get(int(each), [])]


_recorder: Recorder | None = None
current_pass = "setup"


@contextmanager
def recording(override: Override | None = None) -> Iterator[Recorder]:
    """Record every call made inside the block; ``override(name, args)`` may change arguments."""
    global _recorder, current_pass
    previous = _recorder
    _recorder = Recorder(override)
    gl.__dict__.clear()
    current_pass = "setup"
    try:
        yield _recorder
    finally:
        _recorder = previous
        gl.__dict__.clear()
        current_pass = "setup"


def begin_pass(name: str) -> None:
    """Tell the recorder which pass of the frame starts: reflection, main or overlay."""
    global current_pass
    current_pass = name


def _where(frame: FrameType | None) -> tuple[str, tuple[str, ...]]:
    """Return "file:line" of the caller outside the gl rooms, and the element(s) drawing.

    A module of ``elements`` names its element in ``ELEMENT``; one that draws several at once
    names them in the attribute ``elements`` of the object that draws.
    """
    source, elements = "", ("frame",)
    while frame is not None:
        path = Path(frame.f_code.co_filename)
        if path.is_relative_to(PACKAGE):
            parts = path.relative_to(PACKAGE).parts
            if not source or source.startswith("landscape/gl/"):
                source = f"landscape/{'/'.join(parts)}:{frame.f_lineno}"
            if parts[0] == "elements":
                owner = frame.f_locals.get("self")
                named = getattr(owner, "elements", None) or frame.f_globals.get("ELEMENT", "frame")
                elements = (named,) if isinstance(named, str) else tuple(named)
                break
        frame = frame.f_back
    return source, elements


MASKED = ("glClear", "glPushAttrib")
_BITS = (
    *("CURRENT", "POINT", "LINE", "POLYGON", "LIGHTING", "FOG", "DEPTH_BUFFER", "STENCIL_BUFFER"),
    *("VIEWPORT", "TRANSFORM", "ENABLE", "COLOR_BUFFER", "HINT", "LIST", "TEXTURE"),
)


def _mask(value: int) -> str:
    """Write an attribute or buffer mask as its bits' names."""
    import OpenGL.GL

    names = (f"GL_{bit}_BIT" for bit in _BITS)
    return " | ".join(name for name in names if value & getattr(OpenGL.GL, name))


def plain(value: Any) -> Any:
    """Turn an argument into JSON: enumerants by name, numbers as numbers, arrays described."""
    if isinstance(value, int) and hasattr(value, "name"):
        return value.name
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, (list, tuple, np.ndarray)):
        array = np.asarray(value)
        flat = array.ravel()[:64].tolist()
        return {"shape": list(array.shape), "dtype": str(array.dtype), "values": flat}
    if value is None or isinstance(value, (bool, int, float, str)):
        return value
    return getattr(value, "value", type(value).__name__)
