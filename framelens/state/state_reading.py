"""Reading the classic state: one plan of queries per kind of context, run again for each reading.

A query writes into a buffer that is allocated once, and goes to OpenGL past PyOpenGL: a thousand of
them take a millisecond, leave no trace in a recording and fetch no error.
"""

import ctypes
import functools
from collections.abc import Callable, Iterable, Mapping
from functools import partial
from typing import Any

from framelens.base.errors import InputError
from framelens.gl.named import gl_constant
from framelens.gl.raw import raw, raw_function
from framelens.gl.seam import gl
from framelens.state.state_tables import (
    BOOL,
    DOUBLE,
    EVERY,
    FLAG,
    FLOAT,
    LIST,
    MASK,
    MOST,
    POINTER,
    UNITS,
    Kind,
)
from framelens.state.state_variables import VARIABLES

State = dict[str, Any]
Values = Mapping[str, Any]  # the same, where it is only read


class StateError(InputError):
    """The state cannot be read or set now, or not in this context."""


INTS = (ctypes.c_int * 16)()
FLOATS = (ctypes.c_float * 16)()
DOUBLES = (ctypes.c_double * 16)()
ADDRESS = (ctypes.c_void_p * 1)()
PIXEL_MAPS = [name for name in VARIABLES if name.startswith("GL_PIXEL_MAP_")]
COEFFICIENTS = [each for each in VARIABLES.values() if each.query == "coefficients"]
STENCIL_MASKS = [n for n in VARIABLES if n.startswith("GL_STENCIL_") and n.endswith("MASK")]

Step = tuple[str, Callable[..., object], tuple[object, ...], Callable[[], object]]
"""The name of a variable, the query, its arguments, and what takes the value from a buffer."""


class Plan:
    """The queries that read a whole state, ``flags`` and ``steps`` by texture unit, None first."""

    def __init__(self, names: tuple[str, ...], units: int) -> None:
        self.names = names
        self.units = units
        self.flags: dict[int | None, list[tuple[str, int]]] = {}
        self.steps: dict[int | None, list[Step]] = {}
        for unit in (None, *range(units)):
            mine = [v for v in map(VARIABLES.__getitem__, names) if v.unit == unit]
            self.flags[unit] = [(v.name, enum(v.asked[0])) for v in mine if v.kind == FLAG]
            self.steps[unit] = [_step(v.name) for v in mine if v.kind not in (FLAG, LIST)]

    @functools.cached_property
    def single(self) -> dict[str, tuple[int | None, Callable[[], object]]]:
        """For each variable its texture unit and what reads it."""
        found: dict[str, tuple[int | None, Callable[[], object]]] = {}
        for unit in (None, *range(self.units)):
            for name, cap in self.flags[unit]:
                found[name] = unit, partial(lambda cap: raw.glIsEnabled(cap) != 0, cap)
            for name, query, args, take in self.steps[unit]:
                found[name] = unit, partial(_asked, query, args, take)
        return found


@functools.cache
def enum(name: str) -> int:
    """Return the value of an enumerant, also of one without a name, given as "0x....".

    OpenGL names clip planes up to 5, and counts on from there.
    """
    if name.startswith("GL_CLIP_PLANE"):
        return int(gl.GL_CLIP_PLANE0) + int(name.removeprefix("GL_CLIP_PLANE"))
    return int(name, 16) if name.startswith("0x") else int(gl_constant(name))


@functools.cache
def _names(family: tuple[str, ...]) -> dict[int, str]:
    return {enum(name): name for name in family}


def named(value: int, family: tuple[str, ...]) -> str:
    """Return an enumerant's name, or "0x...." for one that is not of the family."""
    return _names(family).get(value) or f"0x{value:04X}"


def whole(name: str) -> int:
    """Return the first integer of a glGet."""
    raw.glGetIntegerv(enum(name), INTS)
    return INTS[0]


def plan() -> Plan:
    """Return the plan for the current context; StateError where the state cannot be read now."""
    INTS[0] = -1
    raw.glGetIntegerv(enum("GL_LIST_INDEX"), INTS)
    if INTS[0] == -1:
        raise StateError("the state cannot be read between glBegin and glEnd, or with no context")
    if INTS[0]:
        raise StateError(
            "the state cannot be read while display list {ints} is compiled", ints=INTS[0]
        )
    text = ctypes.string_at(raw.glGetString(enum("GL_VERSION")))
    if text >= b"3.2" and whole("GL_CONTEXT_PROFILE_MASK") & 1:
        raise StateError("a core profile has no fixed function: only trace looks into it")
    limits = ("GL_MAX_TEXTURE_UNITS", "GL_MAX_LIGHTS", "GL_MAX_CLIP_PLANES")
    return _plan(text[:3].decode(), *(min(MOST, whole(name)) for name in limits))


@functools.cache
def _plan(version: str, units: int, lights: int, planes: int) -> Plan:
    beyond = {f"GL_LIGHT{k}" for k in range(lights, MOST)}
    beyond |= {f"GL_CLIP_PLANE{k}" for k in range(planes, MOST)}
    beyond |= {f"GL_TEXTURE{k}" for k in range(units, MOST)}
    names = (
        v.name
        for v in VARIABLES.values()
        if v.since <= version and v.name.split(".")[0] not in beyond
    )
    return Plan(tuple(names), units)


def prepare() -> None:
    """Look up all functions and enumerants, which takes longer than to read a state.

    That needs the platform, but no context.
    """
    Plan(tuple(VARIABLES), MOST)
    for variable in VARIABLES.values():
        if isinstance(variable.kind, tuple):
            _names(variable.kind)


def read_now() -> State:
    """Return the state of the current context, the attribute stacks by their depth only."""
    todo = plan()
    found: State = {}
    _run(todo, None, found)
    active, client = found["GL_ACTIVE_TEXTURE"], found["GL_CLIENT_ACTIVE_TEXTURE"]
    for unit in range(todo.units):
        raw.glActiveTexture(enum(UNITS[unit]))
        raw.glClientActiveTexture(enum(UNITS[unit]))
        _run(todo, unit, found)
        found[f"GL_TEXTURE{unit}.GL_TEXTURE_STACK"] = _below("GL_TEXTURE", found, unit)

    raw.glActiveTexture(enum(active))
    raw.glClientActiveTexture(enum(client))
    for name in ("GL_MODELVIEW", "GL_PROJECTION"):
        found[f"{name}_STACK"] = _below(name, found)
    raw.glMatrixMode(enum(found["GL_MATRIX_MODE"]))
    _read_images(found)
    _read_coefficients(found)
    _widen_masks(found)
    return {name: found[name] for name in todo.names}


def read_some(names: Iterable[str]) -> State:
    """Return those of the variables that are in this context, without the stacks and images."""
    todo, found = plan(), {}
    by_unit: dict[int, list[tuple[str, Callable[[], object]]]] = {}
    for name in names:
        if name not in todo.single:
            continue
        unit, query = todo.single[name]
        if unit is None:
            found[name] = query()
        else:
            by_unit.setdefault(unit, []).append((name, query))
    if not by_unit:
        return found

    active, client = whole("GL_ACTIVE_TEXTURE"), whole("GL_CLIENT_ACTIVE_TEXTURE")
    for unit, queries in by_unit.items():
        raw.glActiveTexture(enum(UNITS[unit]))
        raw.glClientActiveTexture(enum(UNITS[unit]))
        found.update((name, query()) for name, query in queries)
    raw.glActiveTexture(active)
    raw.glClientActiveTexture(client)
    return found


def _asked(
    query: Callable[..., object], args: tuple[object, ...], take: Callable[[], object]
) -> object:
    query(*args)
    return take()


def _run(todo: Plan, unit: int | None, found: State) -> None:
    is_enabled = raw.glIsEnabled
    for name, cap in todo.flags[unit]:
        found[name] = is_enabled(cap) != 0
    for name, query, args, take in todo.steps[unit]:
        query(*args)
        found[name] = take()


@functools.cache
def _step(name: str) -> Step:
    """Return the query of a variable that is a number, an enumerant, a vector or a pointer."""
    variable = VARIABLES[name]
    query, kind = variable.query, variable.kind
    buffer: Any = INTS
    if kind == POINTER:
        buffer = ADDRESS
    elif kind == DOUBLE:
        buffer = DOUBLES
        query += "Doublev" if query == "glGet" else ""
    elif kind == FLOAT:
        buffer = FLOATS
        query += "Floatv" if query == "glGet" else "fv"
    elif query != "glGetQueryiv":
        query += "Integerv" if query == "glGet" else "iv"
    args = (*map(enum, variable.asked), ctypes.addressof(buffer))
    count = len(variable.initial) if isinstance(variable.initial, tuple) else 0
    return variable.name, raw_function(query), args, _taking(buffer, kind, count)


def _taking(buffer: Any, kind: Kind, count: int) -> Callable[[], object]:
    """Return what takes a value from a buffer; a ``count`` of 0 means a single one."""
    if isinstance(kind, tuple):
        if count:
            return lambda: [named(value, kind) for value in buffer[:count]]
        return lambda: named(buffer[0], kind)
    if kind == BOOL:
        return (lambda: [v != 0 for v in buffer[:count]]) if count else (lambda: buffer[0] != 0)
    if kind == MASK:
        return lambda: buffer[0] & 0xFFFFFFFF
    if kind == POINTER:
        return lambda: buffer[0] or 0
    return partial(buffer.__getitem__, slice(count) if count else 0)


def _below(name: str, found: State, unit: int | None = None) -> list[list[float]]:
    """Return the matrices below the top of a stack, bottom first.

    They can only be read at the top: all are popped, and then pushed again.
    """
    of = "" if unit is None else f"GL_TEXTURE{unit}."
    depth = found[f"{of}{name}_STACK_DEPTH"]
    if depth == 1:
        return []
    raw.glMatrixMode(enum(name))
    matrices = [found[f"{of}{name}_MATRIX"]]
    for _ in range(depth - 1):
        raw.glPopMatrix()
        raw.glGetFloatv(enum(f"{name}_MATRIX"), FLOATS)
        matrices.append(FLOATS[:])
    for matrix in matrices[-2::-1]:
        raw.glPushMatrix()
        raw.glLoadMatrixf((ctypes.c_float * 16)(*matrix))
    return matrices[:0:-1]


# How OpenGL writes an image into memory without gaps, by the names of the pixel store.
TIGHT = {"SWAP_BYTES": 0, "LSB_FIRST": 0, "ROW_LENGTH": 0, "SKIP_ROWS": 0, "SKIP_PIXELS": 0}


def _read_images(found: State) -> None:
    """Read the polygon stipple and the pixel maps, which come through the pixel store."""
    stored = {f"GL_PACK_{name}": value for name, value in TIGHT.items()}
    stored["GL_PACK_ALIGNMENT"] = 1
    changed = {name: value for name, value in stored.items() if found[name] != value}
    for name, value in changed.items():
        raw.glPixelStorei(enum(name), value)
    bound = found.get("GL_PIXEL_PACK_BUFFER_BINDING", 0)
    if bound:
        raw.glBindBuffer(enum("GL_PIXEL_PACK_BUFFER"), 0)
    rows = (ctypes.c_ubyte * 128)()
    raw.glGetPolygonStipple(rows)
    found["GL_POLYGON_STIPPLE.pattern"] = [
        int.from_bytes(rows[at : at + 4], "big") for at in range(0, 128, 4)
    ]
    for name in PIXEL_MAPS:
        size = whole(f"{name}_SIZE")
        values = (ctypes.c_float * size)()
        raw.glGetPixelMapfv(enum(name), values)
        found[name] = values[:]

    if bound:
        raw.glBindBuffer(enum("GL_PIXEL_PACK_BUFFER"), bound)
    for name in changed:
        raw.glPixelStorei(enum(name), int(found[name]))


def _read_coefficients(found: State) -> None:
    """Read the control points of the evaluators, as many as their orders say."""
    for variable in COEFFICIENTS:
        target = variable.asked[0]
        order = found[f"{target}.GL_ORDER"]
        points = order[0] * order[1] if isinstance(order, list) else order
        values = (ctypes.c_float * (points * len(variable.initial)))()
        raw.glGetMapfv(enum(target), enum("GL_COEFF"), values)
        found[variable.name] = values[:]


def _widen_masks(found: State) -> None:
    """Write a stencil mask that has all bits of the buffer as one of 32 bits.

    OpenGL answers with the bits that the buffer has; the mask itself is as likely to have more.
    """
    every = (1 << whole("GL_STENCIL_BITS")) - 1
    for name in STENCIL_MASKS:
        if name in found and found[name] & every == every:
            found[name] = EVERY
