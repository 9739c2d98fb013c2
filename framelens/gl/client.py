"""Client arrays in a complete recording: what a draw call would read, copied when it is made.

glVertexPointer and its relatives only say where an array lies; OpenGL reads it at each draw call,
and the program may change it in between. So a recording that is to be replayed keeps the pointer
calls of the arrays, and a copy of their contents with each draw call.
"""

import ctypes
import sys
from collections.abc import Sequence
from typing import Any

import numpy as np

from framelens.gl.notes import Call
from framelens.gl.raw import raw

POINTERS = {
    "glVertexPointer": "GL_VERTEX_ARRAY",
    "glNormalPointer": "GL_NORMAL_ARRAY",
    "glColorPointer": "GL_COLOR_ARRAY",
    "glSecondaryColorPointer": "GL_SECONDARY_COLOR_ARRAY",
    "glTexCoordPointer": "GL_TEXTURE_COORD_ARRAY",
    "glFogCoordPointer": "GL_FOG_COORD_ARRAY",
    "glIndexPointer": "GL_INDEX_ARRAY",
    "glEdgeFlagPointer": "GL_EDGE_FLAG_ARRAY",
    "glInterleavedArrays": "",  # several at once
}
# By the numbers of GL_VERTEX_ARRAY and so on, as a program may give them.
KINDS = {
    0x8074: "GL_VERTEX_ARRAY",
    0x8075: "GL_NORMAL_ARRAY",
    0x8076: "GL_COLOR_ARRAY",
    0x8077: "GL_INDEX_ARRAY",
    0x8078: "GL_TEXTURE_COORD_ARRAY",
    0x8079: "GL_EDGE_FLAG_ARRAY",
    0x8457: "GL_FOG_COORD_ARRAY",
    0x845E: "GL_SECONDARY_COLOR_ARRAY",
}
# PyOpenGL's shorter names, as in glVertexPointerf(array).
SHORT = ("glVertexPointer", "glNormalPointer", "glColorPointer", "glTexCoordPointer")
READS_ARRAYS = frozenset(
    {
        *("glDrawArrays", "glDrawElements", "glDrawRangeElements", "glArrayElement"),
        *("glMultiDrawArrays", "glMultiDrawElements"),
        *("glDrawElementsub", "glDrawElementsus", "glDrawElementsui"),
    }
)

LIST_BASE = 0x0B32  # GL_LIST_BASE
TEXTURE0 = 0x84C0  # GL_TEXTURE0: the client's active texture unit at first

Arguments = tuple[Any, ...]


def list_base(name: str, calls: Sequence[Call]) -> int:
    """Return what OpenGL adds to the names of a glCallLists that is made after ``calls``.

    0 for a glCallList, and between glBegin and glEnd, where nothing can be asked.
    """
    block = next((c.name for c in reversed(calls) if c.name in ("glBegin", "glEnd")), "")
    if name != "glCallLists" or block == "glBegin":
        return 0
    base = (ctypes.c_int * 1)()
    raw.glGetIntegerv(LIST_BASE, base)
    return int(base[0])


SEEN = READS_ARRAYS | {
    *("glEnableClientState", "glDisableClientState", "glClientActiveTexture"),
    *("glPushClientAttrib", "glPopClientAttrib"),
}
FIXED = {int, float, bool, str, bytes, type(None)}  # most arguments


def concerns_arrays(name: str) -> bool:
    """Return whether :class:`ClientArrays` must see the calls of a function."""
    return name in SEEN or pointer_kind(name) is not None


def frozen(args: Arguments) -> Arguments:
    """Return arguments with a copy of each array that the program could change later.

    Of a pointer call that is the array itself: what matters is what it holds at a draw call.
    """
    return tuple([each if type(each) in FIXED else _frozen(each) for each in args])


def _frozen(value: Any) -> Any:
    if isinstance(value, int):  # an enumerant
        return value
    if isinstance(value, np.ndarray):
        return value.copy()
    if isinstance(value, bytearray):
        return bytes(value)
    if isinstance(value, list):
        return [_frozen(each) for each in value]
    if hasattr(value, "_length_") and hasattr(value, "_type_"):  # a ctypes array
        return type(value).from_buffer_copy(value)
    return value


def pointer_kind(name: str) -> str | None:
    """Return which array a call points to, "" for several, None for another call."""
    if name in POINTERS:
        return POINTERS[name]
    full = next((each for each in SHORT if name.startswith(each)), None)
    return POINTERS[full] if full else None


def buffer_offset(value: object) -> int | None:
    """Return where in the bound buffer a pointer argument leads; None for another argument.

    PyOpenGL's VBO is read from its beginning. A ctypes.c_void_p may also be an address.
    """
    if isinstance(value, ctypes.c_void_p):
        return value.value or 0
    vbo = sys.modules.get("OpenGL.arrays.vbo")  # whoever has such an object has imported it
    if vbo is not None and isinstance(value, vbo.VBO):
        return 0
    if vbo is not None and isinstance(value, vbo.VBOOffset):
        return int(value.offset)
    return None


class ClientArrays:
    """Where the client arrays lie, by the calls that said so."""

    def __init__(self) -> None:
        self._unit = TEXTURE0
        self._pointers: dict[tuple[str, int], tuple[str, Arguments]] = {}
        self._enabled: dict[tuple[str, int], object] = {}  # with the argument that names it
        self._stack: list[tuple[Any, ...]] = []

    def see(self, name: str, args: Arguments) -> Sequence[tuple[str, Arguments]]:
        """Take note of a call; return the calls that give it its arrays, if it reads any."""
        if name in READS_ARRAYS:
            return self._read()
        self._follow(name, args)
        return ()

    def _follow(self, name: str, args: Arguments) -> None:
        kind = pointer_kind(name)
        if kind is not None:
            self._point(kind, name, args)
        elif name in ("glEnableClientState", "glDisableClientState"):
            key = self._key(KINDS.get(args[0], str(args[0])))
            self._enabled.pop(key, None)
            if name == "glEnableClientState":
                self._enabled[key] = args[0]
        elif name == "glClientActiveTexture":
            self._unit = int(args[0])
        elif name == "glPushClientAttrib":
            self._stack.append((self._unit, dict(self._pointers), dict(self._enabled)))
        elif name == "glPopClientAttrib" and self._stack:
            self._unit, self._pointers, self._enabled = self._stack.pop()

    def _key(self, kind: str) -> tuple[str, int]:
        return kind, self._unit if kind == "GL_TEXTURE_COORD_ARRAY" else 0

    def _point(self, kind: str, name: str, args: Arguments) -> None:
        if not kind:
            # glInterleavedArrays enables what its format holds and disables the rest.
            self._pointers.clear()
            self._enabled = {("", 0): None}
        self._pointers[self._key(kind)] = name, args

    def _read(self) -> Sequence[tuple[str, Arguments]]:
        """Return the calls that enable the arrays in use and point to copies of them.

        Arrays in buffer objects are not among them: a recording has the buffers' own calls.
        """
        found: list[tuple[str, Arguments]] = []
        for (kind, unit), (name, args) in self._pointers.items():
            if (kind, unit) not in self._enabled or not _in_memory(args[-1]):
                continue
            other = kind == "GL_TEXTURE_COORD_ARRAY" and unit != self._unit
            if other:
                found.append(("glClientActiveTexture", (unit,)))
            found.append((name, frozen(args)))
            if kind:
                found.append(("glEnableClientState", (self._enabled[kind, unit],)))
            if other:
                found.append(("glClientActiveTexture", (self._unit,)))
        return found


def _in_memory(pointer: object) -> bool:
    """Whether a pointer argument is an array of the program's, not an offset into a buffer."""
    return isinstance(pointer, (np.ndarray, list, tuple, bytes, bytearray)) or hasattr(
        pointer, "_length_"
    )
