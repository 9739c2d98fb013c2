"""Which calls may be changed or left out, so that a program runs on with an edit.

OpenGL answers a wrong value with an error, but it reads the program's memory as far as it is told.
So whatever says how much is read, and from where, stays as it is; and so does what the program
needs to go on, the names of new objects for instance.
"""

from collections.abc import Sequence
from typing import Any

from framelens.spec import spec

# Groups of calls that say where in memory something lies, or that only answer.
FIXED_GROUPS = ("array", "buffer", "framebuffer", "get", "query")
FIXED = ("glPixelStore", "glNewList", "glEndList", "glListBase", "glRenderMode", "glMap")
PAIRED = ("glBegin", "glEnd")  # without one of them OpenGL takes nothing but errors
CHANGEABLE = ("enum", "mask", "boolean", "int", "float", "clampf", "angle", "bits")
VECTORS = ("vector", "matrix")
OBJECTS = ("texture", "list")  # a name that means nothing is harmless


def _fixed(name: str) -> bool:
    known = spec.function(name)
    return (
        known is None
        or known.group in FIXED_GROUPS
        or known.base in FIXED
        or spec.is_query(name)
        or spec.creates(name)
        or spec.deletes(name)
    )


def may_be_left_out(name: str) -> bool:
    """Whether the program runs on without calls of this name."""
    return not _fixed(name) and name not in PAIRED


def may_be_changed(name: str, index: int, args: Sequence[object]) -> bool:
    """Whether argument ``index`` of a call may have another value."""
    found = spec.parameter(name, index, args)
    if found is None or _fixed(name):
        return False
    kinds = [spec.kind_of(name, each, args) for each in range(len(args))]
    if "array" in kinds or "offset" in kinds:
        # The other arguments say how much of the array is read.
        return found.of == "primitive" or (found.kind == "count" and spec.draws(name))
    if name.startswith("glDrawArrays"):
        return found.name != "first"
    if found.kind == "object":
        return found.of in OBJECTS
    return found.kind in (*CHANGEABLE, *VECTORS, "count")


def most(name: str, index: int, args: Sequence[Any]) -> float | None:
    """Return the greatest value that reads no more memory than the program's own; None if any."""
    drawn = name.startswith(("glDrawArrays", "glDrawElements", "glDrawRangeElements"))
    counted = spec.kind_of(name, index, args) == "count"
    return float(args[index]) if drawn and counted else None
