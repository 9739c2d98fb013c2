"""Setting the classic state: from the state that is to another one, by the calls that differ."""

import ctypes
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import takewhile
from typing import Any

from framelens.gl.raw import raw, raw_function
from framelens.state.state_reading import TIGHT, State, StateError, Values, enum, read_now
from framelens.state.state_tables import ARRAYS, DOUBLE, FLAG, FLOAT, IDENTITY, UNITS
from framelens.state.state_variables import VARIABLES, Variable

FRAMEBUFFERS = {
    "GL_DRAW_FRAMEBUFFER_BINDING": "GL_DRAW_FRAMEBUFFER",
    "GL_READ_FRAMEBUFFER_BINDING": "GL_READ_FRAMEBUFFER",
}
STENCIL = {
    "glStencilFunc": "FUNC REF VALUE_MASK",
    "glStencilOp": "FAIL PASS_DEPTH_FAIL PASS_DEPTH_PASS",
    "glStencilMask": "WRITEMASK",
}
RASTER = "GL_CURRENT_RASTER_"

# Memory that OpenGL writes hits and feedback to: it must live as long as the context may use it.
_memory: dict[tuple[str, int], object] = {}


def apply(now: State, target: Mapping[str, object]) -> None:
    """Set what differs; both states are whole, and ``now`` is the current one.

    Afterwards ``now`` equals ``target``, but for the depths of the attribute stacks.
    """
    _bind_containers(now, target)
    if now["GL_COLOR_MATERIAL"]:  # else each colour would change materials as well
        raw.glDisable(enum("GL_COLOR_MATERIAL"))
    _set_images(now, target)
    _set_raster(now, target)
    _set_stacks(now, target)
    _set_rest(now, target)
    _set_arrays(now, target)
    _set_modes(now, target)
    if target["GL_COLOR_MATERIAL"]:
        raw.glEnable(enum("GL_COLOR_MATERIAL"))
    raw.glMatrixMode(enum(target["GL_MATRIX_MODE"]))
    raw.glActiveTexture(enum(target["GL_ACTIVE_TEXTURE"]))
    raw.glClientActiveTexture(enum(target["GL_CLIENT_ACTIVE_TEXTURE"]))
    now.update(target)


def _bind_containers(now: State, target: Mapping[str, object]) -> None:
    """Bind framebuffers and the array of arrays, which bring state of their own with them."""
    for name, place in FRAMEBUFFERS.items():
        if now.get(name) != target.get(name):
            if target[name] and not raw.glIsFramebuffer(target[name]):
                raise StateError(
                    "{name} is {target}: no such framebuffer here", name=name, target=target[name]
                )
            raw.glBindFramebuffer(enum(place), target[name])
    name = "GL_VERTEX_ARRAY_BINDING"
    if now.get(name) != target.get(name):
        raw.glBindVertexArray(target[name])
    elif all(now.get(name) == target.get(name) for name in FRAMEBUFFERS):
        return
    now.update({name: value for name, value in read_now().items() if name in now})


Number = type[ctypes.c_float] | type[ctypes.c_double] | type[ctypes.c_int] | type[ctypes.c_uint]


def _set_images(now: State, target: Values) -> None:
    """Set the polygon stipple and the pixel maps, which OpenGL reads through the pixel store."""
    names = [name for name in VARIABLES if name.startswith("GL_PIXEL_MAP_")]
    names = [name for name in names if now[name] != target[name]]
    pattern = target["GL_POLYGON_STIPPLE.pattern"]
    stippled = now["GL_POLYGON_STIPPLE.pattern"] != pattern
    if not names and not stippled:
        return
    for name, value in (*TIGHT.items(), ("ALIGNMENT", 1)):
        raw.glPixelStorei(enum(f"GL_UNPACK_{name}"), value)
        now[f"GL_UNPACK_{name}"] = value
    if now.get("GL_PIXEL_UNPACK_BUFFER_BINDING"):
        raw.glBindBuffer(enum("GL_PIXEL_UNPACK_BUFFER"), 0)
        now["GL_PIXEL_UNPACK_BUFFER_BINDING"] = 0
    if stippled:
        rows = b"".join(row.to_bytes(4, "big") for row in pattern)
        raw.glPolygonStipple((ctypes.c_ubyte * 128)(*rows))
    for name in names:
        values = target[name]
        raw.glPixelMapfv(enum(name), len(values), _array(values))


def _set_raster(now: State, target: Values) -> None:
    """Set the raster position with what belongs to it; its fourth component becomes 1."""
    mine = [name for name in now if RASTER in name]
    if all(now[name] == target[name] for name in mine):
        return

    raw.glDepthRange(0.0, 1.0)
    raw.glFogi(enum("GL_FOG_COORD_SRC"), enum("GL_FOG_COORD"))
    now |= {"GL_DEPTH_RANGE": [0.0, 1.0], "GL_FOG_COORD_SRC": "GL_FOG_COORD"}

    taken = {
        "GL_CURRENT_FOG_COORD": f"{RASTER}DISTANCE",
        "GL_CURRENT_COLOR": f"{RASTER}COLOR",
    }
    taken |= {name.replace("RASTER_", ""): name for name in mine if name.endswith("TEXTURE_COORDS")}
    for current, name in taken.items():
        now[current] = target[name]
        _call(VARIABLES[current], {**target, current: target[name]})

    raw.glWindowPos3f(*target[f"{RASTER}POSITION"][:3])
    if not target[f"{RASTER}POSITION_VALID"]:
        for name in ("GL_PROJECTION", "GL_MODELVIEW"):
            raw.glMatrixMode(enum(name))
            raw.glLoadIdentity()
            now[f"{name}_MATRIX"] = list(IDENTITY)
        raw.glRasterPos4f(2.0, 0.0, 0.0, 1.0)


def _in_eye_space(name: str) -> bool:
    """Return whether a value is multiplied by the modelview matrix when it is set."""
    return name.endswith((".equation", ".GL_POSITION", ".GL_SPOT_DIRECTION", ".GL_EYE_PLANE"))


def _set_in_eye_space(now: State, target: Values) -> None:
    """Set places of lights, planes and the like, which the matrix changes, under the identity."""
    placed = [name for name in now if _in_eye_space(name) and now[name] != target[name]]
    if not placed:
        return
    raw.glMatrixMode(enum("GL_MODELVIEW"))
    raw.glLoadIdentity()
    now["GL_MODELVIEW_MATRIX"] = list(IDENTITY)
    for name in placed:
        variable = VARIABLES[name]
        if variable.unit is not None:
            raw.glActiveTexture(enum(UNITS[variable.unit]))
        _call(variable, target)


def _set_stacks(now: State, target: Values) -> None:
    """Set what is in eye space, under the identity, and then the matrix stacks."""
    _set_in_eye_space(now, target)
    stacks = [name for name in now if name.endswith("_STACK") and "ATTRIB" not in name]
    for name in stacks:
        variable, top = VARIABLES[name], name.replace("_STACK", "_MATRIX")
        before, after = [*now[name], now[top]], [*target[name], target[top]]
        if before == after:
            continue
        if variable.unit is not None:
            raw.glActiveTexture(enum(UNITS[variable.unit]))
        raw.glMatrixMode(enum(variable.asked[0].replace("_STACK", "")))
        pairs = zip(before, after, strict=False)
        common = len(list(takewhile(lambda pair: pair[0] == pair[1], pairs)))
        for _ in range(len(before) - max(common, 1)):
            raw.glPopMatrix()
        if not common:
            raw.glLoadMatrixf(_array(after[0]))
        for matrix in after[max(common, 1) :]:
            raw.glPushMatrix()
            raw.glLoadMatrixf(_array(matrix))


def _set_rest(now: State, target: Mapping[str, object]) -> None:
    """Set, unit by unit, what one call sets with no regard to anything else."""
    done: set[str] = set()
    active = client = ""
    for name, value in now.items():
        if value == target[name] or name == "GL_COLOR_MATERIAL" or _in_eye_space(name):
            continue
        variable = VARIABLES[name]
        if variable.unit is not None:
            unit = UNITS[variable.unit]
            if name.endswith("_ARRAY"):
                if client != unit:
                    raw.glClientActiveTexture(enum(unit))
                    client = unit
            elif active != unit:
                raw.glActiveTexture(enum(unit))
                active = unit
        if variable.kind == FLAG:
            of_client = variable.asked[0] in ARRAYS
            switch = ("glEnable" if target[name] else "glDisable") + (
                "ClientState" if of_client else ""
            )
            raw_function(switch)(enum(variable.asked[0]))
        elif variable.how:
            own = " ".join(f"${name}" if word in "$&" else word for word in variable.how.split())
            if own not in done:
                done.add(own)
                _call(variable, target)

    _set_together(now, target)


@dataclass(frozen=True)
class _Difference:
    """Two states: the one that OpenGL has, and the one that it is to have."""

    now: State
    target: Values

    def of(self, *names: str) -> bool:
        """Return whether they differ in one of these variables."""
        return any(self.now.get(name) != self.target.get(name) for name in names)

    def values(self, *names: str) -> list[Any]:
        """Return the numbers that these variables are to have, one after the other."""
        return [value for name in names for value in _numbers(VARIABLES[name], self.target[name])]


def _set_together(now: State, target: Values) -> None:
    """Set the variables that share a call with others, in ways the table does not describe."""
    states = _Difference(now, target)
    if states.of("GL_CURRENT_SECONDARY_COLOR"):
        raw.glSecondaryColor3f(*target["GL_CURRENT_SECONDARY_COLOR"][:3])
    if states.of("GL_POLYGON_MODE"):
        for face, mode in zip(("GL_FRONT", "GL_BACK"), target["GL_POLYGON_MODE"], strict=True):
            raw.glPolygonMode(enum(face), enum(mode))

    separate = "GL_BLEND_EQUATION_ALPHA" in now
    _set_blending(states, separate)
    _set_stencil(states, separate)
    _set_evaluators(states)


def _set_blending(states: _Difference, separate: bool) -> None:
    """Set how colours are blended; ``separate`` if alpha may have an equation of its own."""
    factors = [f"GL_BLEND_{way}_{part}" for part in ("RGB", "ALPHA") for way in ("SRC", "DST")]
    if states.of(*factors):
        raw.glBlendFuncSeparate(*states.values(*factors))
    if states.of("GL_BLEND_EQUATION_RGB", "GL_BLEND_EQUATION_ALPHA"):
        if separate:
            equations = states.values("GL_BLEND_EQUATION_RGB", "GL_BLEND_EQUATION_ALPHA")
            raw.glBlendEquationSeparate(*equations)
        else:
            raw.glBlendEquation(*states.values("GL_BLEND_EQUATION_RGB"))


def _set_stencil(states: _Difference, separate: bool) -> None:
    """Set the stencil test; ``separate`` if the back of faces may have one of its own."""
    for face, prefix in (("GL_FRONT", "GL_STENCIL"), ("GL_BACK", "GL_STENCIL_BACK")):
        if f"{prefix}_FUNC" not in states.now:
            continue
        for function, parts in STENCIL.items():
            names = [f"{prefix}_{part}" for part in parts.split()]
            if not states.of(*names):
                continue
            if separate:
                raw_function(f"{function}Separate")(enum(face), *states.values(*names))
            else:
                raw_function(function)(*states.values(*names))


def _set_evaluators(states: _Difference) -> None:
    """Set the evaluators' grids and control points."""
    for k in (1, 2):
        grid = f"GL_MAP{k}_GRID_SEGMENTS", f"GL_MAP{k}_GRID_DOMAIN"
        if states.of(*grid):
            segments, domain = map(states.values, grid)
            args = [v for j in range(k) for v in (segments[j], *domain[2 * j : 2 * j + 2])]
            raw_function(f"glMapGrid{k}f")(*args)

    raw.glActiveTexture(enum("GL_TEXTURE0"))  # with another one OpenGL refuses evaluators
    for variable in VARIABLES.values():
        if variable.query == "coefficients":
            shape = [f"{variable.asked[0]}.GL_{part}" for part in ("ORDER", "DOMAIN")]
            if states.of(variable.name, *shape):
                order, domain = map(states.values, shape)
                _set_evaluator(variable, order, domain, states.target[variable.name])


def _set_evaluator(
    variable: Variable, order: list[int], domain: list[float], points: list[float]
) -> None:
    width = len(variable.initial)
    args: list[object] = []
    for k, count in enumerate(order):
        stride = width if k == len(order) - 1 else width * order[-1]
        args += [*domain[2 * k : 2 * k + 2], stride, count]
    function = raw_function(f"glMap{len(order)}f")
    function(enum(variable.asked[0]), *args, _array(points))


def _set_arrays(now: State, target: Mapping[str, object]) -> None:
    """Point the client arrays at the addresses, or offsets in buffers, that they had."""
    name = "GL_ARRAY_BUFFER_BINDING"
    bound = now[name]
    for array, (function, _) in ARRAYS.items():
        units = range(len(UNITS)) if array == "GL_TEXTURE_COORD_ARRAY" else (None,)
        for unit in units:
            of = array if unit is None else f"GL_TEXTURE{unit}.{array}"
            parts = [f"{of}_{p}" for p in ("SIZE", "TYPE", "STRIDE", "POINTER", "BUFFER_BINDING")]
            parts = [part for part in parts if part in now]
            if all(now[part] == target[part] for part in parts):
                continue
            if unit is not None:
                raw.glClientActiveTexture(enum(UNITS[unit]))
            bound = target[parts[-1]]
            raw.glBindBuffer(enum("GL_ARRAY_BUFFER"), bound)
            args = [v for part in parts[:-1] for v in _numbers(VARIABLES[part], target[part])]
            raw_function(function)(*args)

    if bound != target[name]:
        raw.glBindBuffer(enum("GL_ARRAY_BUFFER"), target[name])


def _set_modes(now: State, target: Values) -> None:
    """Begin or end selection, feedback and an occlusion query."""
    query = "GL_SAMPLES_PASSED.GL_CURRENT_QUERY"
    if now[query] != target[query]:
        if now[query]:
            raw.glEndQuery(enum("GL_SAMPLES_PASSED"))
        if target[query]:
            raw.glBeginQuery(enum("GL_SAMPLES_PASSED"), target[query])

    names = [name for name in now if name.startswith(("GL_SELECTION_", "GL_FEEDBACK_"))]
    names += ["GL_RENDER_MODE", "GL_NAME_STACK_DEPTH"]
    if all(now[name] == target[name] for name in names):
        return
    raw.glRenderMode(enum("GL_RENDER"))
    size = target["GL_SELECTION_BUFFER_SIZE"]
    if now["GL_SELECTION_BUFFER_SIZE"] != size:
        raw.glSelectBuffer(size, _kept("select", ctypes.c_uint, size))
    size = target["GL_FEEDBACK_BUFFER_SIZE"]
    kind = target["GL_FEEDBACK_BUFFER_TYPE"]
    if now["GL_FEEDBACK_BUFFER_SIZE"] != size or now["GL_FEEDBACK_BUFFER_TYPE"] != kind:
        raw.glFeedbackBuffer(size, enum(kind), _kept("feedback", ctypes.c_float, size))
    raw.glRenderMode(enum(target["GL_RENDER_MODE"]))
    for _ in range(target["GL_NAME_STACK_DEPTH"]):
        raw.glPushName(0)


def _kept(purpose: str, kind: Number, size: int) -> object:
    key = (purpose, size)
    if key not in _memory:
        _memory[key] = (kind * max(1, size))()
    return _memory[key]


def _numbers(variable: Variable, value: object) -> list[object]:
    """Return a value as numbers that a call takes."""
    many = value if isinstance(value, (list, tuple)) else [value]
    if isinstance(variable.kind, tuple):
        return [enum(name) for name in many]
    return [int(v) if isinstance(v, bool) else v for v in many]


def _array(values: Sequence[Any], kind: Number = ctypes.c_float) -> object:
    return (kind * len(values))(*values)


def _call(variable: Variable, target: Mapping[str, object]) -> None:
    """Make the call that sets a variable, as its table row describes it."""
    function, *words = variable.how.split()
    args: list[object] = []
    for word in words:
        if word == "$":
            args += _numbers(variable, target[variable.name])
        elif word == "&":
            numbers = _numbers(variable, target[variable.name])
            kinds: dict[str, Number] = {FLOAT: ctypes.c_float, DOUBLE: ctypes.c_double}
            args.append(_array(numbers, kinds.get(str(variable.kind), ctypes.c_int)))
        elif word.startswith("$"):
            args += _numbers(VARIABLES[word[1:]], target[word[1:]])
        else:
            args.append(enum(word))
    raw_function(function)(*args)
