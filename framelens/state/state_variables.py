"""The variables of classic OpenGL's state, made of their tables, and how each is read.

:data:`VARIABLES` has every one by its name, :data:`DEFAULTS` the initial values.
"""

import struct
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

from framelens.state.state_tables import (
    ARRAYS,
    BINDINGS,
    BOOL,
    COLOURING,
    CURRENT,
    DOUBLE,
    ENVIRONMENT,
    EVALUATED,
    EVALUATORS,
    EVERY,
    FLAG,
    FLOAT,
    FRAMEBUFFER,
    GENERATION,
    HINT,
    IDENTITY,
    INT,
    LIGHT,
    LIST,
    MATERIAL,
    MOST,
    PIXEL_MAPS,
    PIXEL_OPERATIONS,
    PIXEL_STORE,
    PIXELS,
    PLANES,
    POINTER,
    RASTERIZATION,
    STACKS,
    TEXTURE_TARGETS,
    TRANSFORM,
    TYPES,
    UNITS,
    Kind,
    Row,
)


@dataclass(frozen=True, slots=True)
class Variable:
    """One variable: ``query`` is the function that reads it and ``asked`` its enumerants.

    ``unit`` is the texture unit that it belongs to, or None; ``how`` the call that sets it, or ""
    where several variables are restored together; ``since`` the version that introduced it.
    """

    name: str
    group: str
    kind: Kind
    initial: Any
    query: str
    asked: tuple[str, ...]
    unit: int | None = None
    how: str = ""
    since: str = ""


def variables() -> Iterator[Variable]:
    """Yield every variable, in the order in which they are listed."""
    yield from _of_transform()
    yield from _of_current_values()
    yield from _of_lighting()
    yield from _of_pictures()
    yield from _of_evaluators()
    yield from _plain("hints", HINT)
    yield from _of_client()
    yield from _of_stacks()


def _of_transform() -> Iterator[Variable]:
    yield from _plain("transform", TRANSFORM[:3])
    yield _stack("GL_MODELVIEW_STACK")
    yield from _plain("transform", TRANSFORM[3:5])
    yield _stack("GL_PROJECTION_STACK")
    yield from _plain("transform", TRANSFORM[5:])
    for k in range(MOST):
        name = f"GL_CLIP_PLANE{k}"
        yield Variable(name, "transform", FLAG, False, "glIsEnabled", (name,))
        how = f"glClipPlane {name} &"
        nothing = (0.0, 0.0, 0.0, 0.0)
        yield Variable(
            f"{name}.equation", "transform", DOUBLE, nothing, "glGetClipPlane", (name,), None, how
        )


def _of_current_values() -> Iterator[Variable]:
    yield from _plain("current values", CURRENT)
    for k in range(MOST):
        for name in ("GL_CURRENT_TEXTURE_COORDS", "GL_CURRENT_RASTER_TEXTURE_COORDS"):
            how = f"glMultiTexCoord4f GL_TEXTURE{k} $" if "RASTER" not in name else ""
            row = (name, FLOAT, (0.0, 0.0, 0.0, 1.0), how)
            yield from _plain("current values", [row], k)


def _of_lighting() -> Iterator[Variable]:
    yield from _plain("colouring and lighting", COLOURING)
    for face in ("GL_FRONT", "GL_BACK"):
        yield from _asked("colouring and lighting", "glGetMaterial", face, MATERIAL)
    for k in range(MOST):
        name = f"GL_LIGHT{k}"
        yield Variable(name, "colouring and lighting", FLAG, False, "glIsEnabled", (name,))
        white = {"GL_DIFFUSE": (1.0,) * 4, "GL_SPECULAR": (1.0,) * 4} if k == 0 else {}
        rows = [(row[0], row[1], white.get(row[0], row[2])) for row in LIGHT]
        yield from _asked("colouring and lighting", "glGetLight", name, rows)


def _of_pictures() -> Iterator[Variable]:
    """Yield what rasterization, textures and pixels depend on."""
    yield from _plain("rasterization", RASTERIZATION)
    yield Variable(
        *("GL_POLYGON_STIPPLE.pattern", "rasterization", LIST, (EVERY,) * 32),
        *("glGetPolygonStipple", ()),
    )
    yield from _plain("texturing", [("GL_ACTIVE_TEXTURE", UNITS, "GL_TEXTURE0", "")])
    for k in range(MOST):
        yield from _unit(k)
    yield from _plain("pixel operations", PIXEL_OPERATIONS)
    yield from _plain("framebuffer", FRAMEBUFFER)
    yield from _plain("pixel transfer", PIXEL_STORE + PIXELS)
    for name in PIXEL_MAPS:
        yield Variable(name, "pixel transfer", LIST, (0.0,), "glGetPixelMapfv", (name,))


def _of_evaluators() -> Iterator[Variable]:
    yield from _plain("evaluators", EVALUATORS)
    for dimensions in (1, 2):
        for name, point in EVALUATED.items():
            yield from _map(dimensions, f"GL_MAP{dimensions}_{name}", point)


def _of_client() -> Iterator[Variable]:
    yield from _plain("client", BINDINGS)
    for name in ARRAYS:
        for unit in range(MOST) if name == "GL_TEXTURE_COORD_ARRAY" else (None,):
            yield from _array(name, unit)


def _of_stacks() -> Iterator[Variable]:
    yield from _plain("stacks, lists and modes", STACKS)
    for name in ("GL_SELECTION_BUFFER_POINTER", "GL_FEEDBACK_BUFFER_POINTER"):
        yield Variable(name, "stacks, lists and modes", POINTER, 0, "glGetPointerv", (name,))
    yield Variable(
        *("GL_SAMPLES_PASSED.GL_CURRENT_QUERY", "stacks, lists and modes", INT, 0),
        *("glGetQueryiv", ("GL_SAMPLES_PASSED", "GL_CURRENT_QUERY")),
    )


def _plain(group: str, rows: Iterable[Row], unit: int | None = None) -> Iterator[Variable]:
    """Yield what glGet or glIsEnabled read."""
    for name, kind, initial, how, since in ((*row, "", "")[:5] for row in rows):
        query = "glIsEnabled" if kind == FLAG else "glGet"
        full = name if unit is None else f"GL_TEXTURE{unit}.{name}"
        yield Variable(full, group, kind, initial, query, (name,), unit, how, since)


def _asked(
    group: str, query: str, of: str, rows: Iterable[Row], unit: int | None = None
) -> Iterator[Variable]:
    """Yield what a query with an object and a parameter reads: a light, a texture environment."""
    for name, kind, initial in rows:
        setter = query.replace("Get", "")
        number = "i" if isinstance(kind, tuple) or kind == BOOL else "f"
        vector = ("v", "&") if isinstance(initial, tuple) else ("", "$")
        how = f"{setter}{number}{vector[0]} {of} {name} {vector[1]}"
        full = f"{of}.{name}" if unit is None else f"GL_TEXTURE{unit}.{of}.{name}"
        yield Variable(full, group, kind, initial, query, (of, name), unit, how)


def _stack(name: str, unit: int | None = None) -> Variable:
    """Return the matrices below the top of a stack, bottom first."""
    full = name if unit is None else f"GL_TEXTURE{unit}.{name}"
    group = "transform" if unit is None else "texturing"
    return Variable(full, group, LIST, (), "stack", (name,), unit)


def _unit(k: int) -> Iterator[Variable]:
    """Yield the variables of a texture unit."""
    for name in TEXTURE_TARGETS:
        since = "3.1" if name == "RECTANGLE" else ""
        binding, target = f"GL_TEXTURE_BINDING_{name}", f"GL_TEXTURE_{name}"
        rows: list[Row] = [
            (target, FLAG, False, "", since),
            (binding, INT, 0, f"glBindTexture {target} $", since),
        ]
        yield from _plain("texturing", rows, k)

    yield from _asked("texturing", "glGetTexEnv", "GL_TEXTURE_ENV", ENVIRONMENT, k)
    bias = [("GL_TEXTURE_LOD_BIAS", FLOAT, 0.0)]
    yield from _asked("texturing", "glGetTexEnv", "GL_TEXTURE_FILTER_CONTROL", bias, k)
    replaced = [("GL_COORD_REPLACE", BOOL, False)]
    yield from _asked("texturing", "glGetTexEnv", "GL_POINT_SPRITE", replaced, k)
    for axis in "STRQ":
        yield from _plain("texturing", [(f"GL_TEXTURE_GEN_{axis}", FLAG, False)], k)
        plane = PLANES.get(axis, (0.0, 0.0, 0.0, 0.0))
        rows = [
            ("GL_TEXTURE_GEN_MODE", GENERATION, "GL_EYE_LINEAR"),
            ("GL_OBJECT_PLANE", FLOAT, plane),
            ("GL_EYE_PLANE", FLOAT, plane),
        ]
        yield from _asked("texturing", "glGetTexGen", f"GL_{axis}", rows, k)

    rows = [
        ("GL_TEXTURE_STACK_DEPTH", INT, 1),
        ("GL_TEXTURE_MATRIX", FLOAT, IDENTITY),
    ]
    yield from _plain("texturing", rows, k)
    yield _stack("GL_TEXTURE_STACK", k)


def _map(dimensions: int, name: str, point: tuple[float, ...]) -> Iterator[Variable]:
    """Yield the variables of one evaluator."""
    yield Variable(name, "evaluators", FLAG, False, "glIsEnabled", (name,))
    order: object = 1 if dimensions == 1 else (1, 1)
    for part, kind, initial in (("ORDER", INT, order), ("DOMAIN", FLOAT, (0.0, 1.0) * dimensions)):
        asked = (name, f"GL_{part}")
        yield Variable(f"{name}.GL_{part}", "evaluators", kind, initial, "glGetMap", asked)
    yield Variable(f"{name}.GL_COEFF", "evaluators", LIST, point, "coefficients", (name,))


def _array(name: str, unit: int | None) -> Iterator[Variable]:
    """Yield the variables of one client array."""
    yield from _plain("client", [(name, FLAG, False)], unit)
    rows: list[Row] = []
    if size := ARRAYS[name][1]:
        rows.append((f"{name}_SIZE", INT, size))
    if name != "GL_EDGE_FLAG_ARRAY":
        rows.append((f"{name}_TYPE", TYPES, "GL_FLOAT"))
    rows.append((f"{name}_STRIDE", INT, 0))
    rows.append((f"{name}_BUFFER_BINDING", INT, 0))
    yield from _plain("client", rows, unit)
    full = f"{name}_POINTER" if unit is None else f"GL_TEXTURE{unit}.{name}_POINTER"
    yield Variable(full, "client", POINTER, 0, "glGetPointerv", (f"{name}_POINTER",), unit)


VARIABLES: dict[str, Variable] = {variable.name: variable for variable in variables()}
"""Every variable by its name, in the order of the groups."""

GROUPS = tuple(dict.fromkeys(variable.group for variable in VARIABLES.values()))


def _as_read(variable: Variable) -> object:
    """Return an initial value as it is read: floats rounded to single precision, vectors lists."""
    value = variable.initial
    if variable.kind in (FLOAT, LIST):
        many = value if isinstance(value, tuple) else (value,)
        rounded = [
            struct.unpack("f", struct.pack("f", v))[0] if isinstance(v, float) else v for v in many
        ]
        return rounded if isinstance(value, tuple) else rounded[0]
    return list(value) if isinstance(value, tuple) else value


DEFAULTS: dict[str, object] = {name: _as_read(variable) for name, variable in VARIABLES.items()}
"""The initial state, by the specification.

Five of its values depend on the window and the OpenGL, and the ones here stand in for them:
GL_VIEWPORT and GL_SCISSOR_BOX are as large as the window, GL_DRAW_BUFFER and GL_READ_BUFFER are
GL_FRONT where it has a single buffer, and GL_POINT_SIZE_MAX is the largest size that it can draw.
"""
