"""Rules about vertex arrays and buffers: does OpenGL read what the program has put there?

For each array of a draw: is it enabled, do type and dtype agree, is the offset an address, does the
stride fit a row of the data? Then the indices, and what a display list holds.
"""

import ast
import ctypes
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np

from framelens.gl.named import gl_constant, gl_function
from framelens.gl.seam import Call, gl
from framelens.spec.spec import draws
from framelens.why.geometry import LEAST, MODES
from framelens.why.survey import Drawn, Survey
from framelens.why.suspects import Suspect, written
from framelens.why.trial import Action, Change

FLOAT = 0x1406  # GL_FLOAT
POINTERS = {
    "glVertexPointer": "GL_VERTEX_ARRAY",
    "glNormalPointer": "GL_NORMAL_ARRAY",
    "glColorPointer": "GL_COLOR_ARRAY",
    "glTexCoordPointer": "GL_TEXTURE_COORD_ARRAY",
}
TYPES = {
    0x1400: "int8",
    0x1401: "uint8",
    0x1402: "int16",
    0x1403: "uint16",
    0x1404: "int32",
    0x1405: "uint32",
    0x1406: "float32",
    0x140A: "float64",
}
DRAWS = ("glDrawArrays", "glDrawElements", "glDrawRangeElements")
ARRAY_BUFFER, ELEMENTS = 0x8892, 0x8893


class UploadedArrays:
    """The contents of the program's buffer objects, and where its pointers point.

    Follows all calls that the tape has; pointers set frames ago come from the last setters.
    """

    def __init__(self, survey: Survey) -> None:
        self.data: dict[int, tuple[Call, np.ndarray]] = {}
        self.bound = {ARRAY_BUFFER: 0, ELEMENTS: 0}
        self.pointers: dict[str, tuple[Call, int]] = {}  # with the buffer bound then
        self.enabled: set[str] = set()  # arrays that the program enables at some time
        self.at: dict[int, tuple[dict[str, tuple[Call, int]], dict[int, int]]] = {}
        for step in survey.tape.steps() if not survey.tape.begin else ():
            self._follow(step.call)
        if survey.tape.begin:
            for call in survey.tape.calls:
                self._follow(call)

    def _follow(self, call: Call) -> None:
        if call.name == "glBindBuffer":
            self.bound[int(call.args[0])] = int(call.args[1])
        elif call.name == "glBufferData":
            array = next((a for a in call.args if isinstance(a, np.ndarray)), None)
            if array is not None:
                self.data[self.bound.get(int(call.args[0]), 0)] = (call, array)
        elif call.name in POINTERS:
            self.pointers[POINTERS[call.name]] = (call, self.bound[ARRAY_BUFFER])
        elif call.name == "glEnableClientState":
            self.enabled.add(getattr(call.args[0], "name", ""))
        elif call.name in DRAWS:
            self.at[call.number] = dict(self.pointers), dict(self.bound)


def arrays(survey: Survey) -> Iterator[Suspect]:
    """The arrays of each draw, against what lies in their buffers."""
    if not any(draw.call.name in DRAWS for draw in survey.shapes):
        return
    buffers = UploadedArrays(survey)
    done: set[tuple[str, int]] = set()
    for draw in survey.shapes:
        if draw.call.name not in DRAWS:
            continue
        yield from _not_enabled(draw, buffers)
        pointers, bound = buffers.at.get(draw.number, ({}, {}))
        for kind, (call, buffer) in pointers.items():
            if (kind, id(call)) in done or not _enabled(draw, kind):
                continue
            done.add((kind, id(call)))
            yield from _pointer(survey, draw, kind, call, buffer, buffers)
        if draw.call.name != "glDrawArrays":
            yield from _indices(survey, draw, bound, buffers)
        yield from _count(draw, pointers, buffers)


def _enabled(draw: Drawn, kind: str) -> bool:
    name = f"GL_TEXTURE0.{kind}" if "TEXTURE" in kind else kind
    return bool(draw.state.get(name))


def _not_enabled(draw: Drawn, buffers: UploadedArrays) -> Iterator[Suspect]:
    pointers, _ = buffers.at.get(draw.number, ({}, {}))
    for kind, (call, buffer) in pointers.items():
        if _enabled(draw, kind) or kind in buffers.enabled:
            continue
        if kind != "GL_VERTEX_ARRAY" and not draw.state["GL_VERTEX_ARRAY"]:
            continue

        def start(c: Call = call, k: str = kind, b: int = buffer) -> None:
            _point(c, b)
            gl.glEnableClientState(gl_constant(k))

        def stop(k: str = kind) -> None:
            gl.glDisableClientState(gl_constant(k))

        yield Suspect(
            "array-not-enabled",
            at=call,
            change=Change(before={draw.place: [start]}, after={draw.place: [stop]}),
            strength=92 if kind == "GL_VERTEX_ARRAY" else 83,
            state=kind,
            value=False,
            values={"array": kind, "call": written(call)},
            draws=[draw],
        )


def _point(call: Call, buffer: int, args: Any = None) -> None:
    former = int(gl.glGetIntegerv(gl.GL_ARRAY_BUFFER_BINDING))
    gl.glBindBuffer(gl.GL_ARRAY_BUFFER, buffer)
    gl_function(call.name)(*(call.args if args is None else args))
    gl.glBindBuffer(gl.GL_ARRAY_BUFFER, former)


def _pointer(
    survey: Survey, draw: Drawn, kind: str, call: Call, buffer: int, buffers: UploadedArrays
) -> Iterator[Suspect]:
    """Yield what is wrong with an array, the likeliest mistake alone."""
    type_, stride = int(call.args[-3]), int(call.args[-2])
    pointer = call.args[-1]
    if type_ not in TYPES:
        return
    if buffer and isinstance(pointer, (int, np.integer)) and not isinstance(pointer, bool):
        yield _int_offset(draw, kind, call, buffer)
        return

    stored = buffers.data.get(buffer) if buffer else None
    if stored is not None and _other_numbers(stored[1], type_):
        yield _other_dtype(survey, draw, kind, type_, buffer, stored)
        return

    size = 3 if call.name == "glNormalPointer" else int(call.args[0])
    data = _rows(draw, buffer, buffers, pointer)
    wrong = _other_size(draw, kind, call, data, size) if stride == 0 else None
    if wrong is not None:
        yield wrong
        return
    wanted = np.dtype(TYPES[type_])
    if kind == "GL_COLOR_ARRAY":
        yield from _color_range(draw, call, data, wanted)
    if stored is not None:
        row = _row_bytes(stored[1])
        yield from _stride(draw, kind, call, buffer, stride, row, wanted.itemsize * size)


def _row_bytes(array: np.ndarray) -> int:
    """Return the bytes of a row of an array; 0 if it has a single one."""
    return array.dtype.itemsize * array.shape[-1] if array.ndim > 1 else 0


def _rows(draw: Drawn, buffer: int, buffers: UploadedArrays, pointer: object) -> np.ndarray | None:
    """Return the array that a pointer alone reads; None for one of several in a buffer."""
    if isinstance(pointer, np.ndarray):
        return pointer
    sharing = [at for _, at in buffers.at[draw.number][0].values() if at == buffer]
    stored = buffers.data.get(buffer) if buffer else None
    return stored[1] if stored is not None and len(sharing) == 1 else None


def _int_offset(draw: Drawn, kind: str, call: Call, buffer: int) -> Suspect:
    offset = int(call.args[-1])
    return _changed(
        "offset-int",
        draw,
        kind,
        call,
        buffer,
        (*call.args[:-1], ctypes.c_void_p(offset)),
        94,
        f"{kind}_POINTER",
        offset,
        {"offset": offset, "call": written(call)},
    )


def _other_numbers(array: np.ndarray, type_: int) -> bool:
    """Return whether an array holds numbers of another type than OpenGL is told; bytes do not."""
    return array.dtype != TYPES[type_] and array.dtype.fields is None and array.dtype != np.uint8


def _other_dtype(
    survey: Survey, draw: Drawn, kind: str, type_: int, buffer: int, stored: tuple[Call, np.ndarray]
) -> Suspect:
    upload, array = stored
    converted = np.ascontiguousarray(array.astype(TYPES[type_]))
    return Suspect(
        "dtype",
        at=upload,
        change=Change(
            first=[_refill(buffer, converted)], after=_after_upload(upload, buffer, converted)
        ),
        strength=95,
        state=f"{kind}_TYPE",
        value=str(array.dtype),
        values={"dtype": str(array.dtype), "wanted": TYPES[type_], "type": TYPE_NAMES[type_]},
        draws=[draw],
        source=assigned(survey, upload),
    )


def _other_size(
    draw: Drawn, kind: str, call: Call, data: np.ndarray | None, size: int
) -> Suspect | None:
    """Suspect that a pointer takes more or fewer numbers than a row of its array has."""
    columns = data.shape[-1] if data is not None and data.ndim == 2 else size
    if call.name == "glNormalPointer" or columns == size or not 2 <= columns <= 4:
        return None
    if columns == 4 and size == 3:
        return None  # the fourth may be left out on purpose
    args = (columns, *call.args[1:])
    return Suspect(
        "pointer-size",
        at=call,
        change=_pointed(draw, call, args),
        strength=91,
        state=f"{kind}_SIZE",
        value=size,
        values={"size": size, "columns": columns, "call": written(call)},
        draws=[draw],
    )


def _pointed(draw: Drawn, call: Call, args: tuple[object, ...]) -> Change:
    """Return the change that makes a draw with another pointer in the place of one."""

    def act() -> None:
        for name, given in draw.call.arrays:
            gl_function(name)(*(args if name == call.name else given))
        if not any(name == call.name for name, _ in draw.call.arrays):
            gl_function(call.name)(*args)
        gl_function(draw.call.name)(*draw.call.args)

    return Change(instead={draw.place: [act]})


def _color_range(
    draw: Drawn, call: Call, data: np.ndarray | None, wanted: np.dtype
) -> Iterator[Suspect]:
    """Suspect an array of colours from 0 to 255 as floats, or from 0 to 1 as bytes."""
    if data is None or data.ndim != 2 or not data.size or data.shape[1] not in (3, 4):
        return

    most = float(data[:, :3].max())
    if data.dtype == np.uint8 and wanted == np.uint8 and 0 < most <= 1:
        cause, better = "color-range-bytes", data.astype(np.float32)
    elif data.dtype.kind == "f" and most >= 16 and np.array_equal(data, np.rint(data)):
        cause, better = "color-range", (data / 255.0).astype(np.float32)
    else:
        return
    if int(draw.state.get("GL_ARRAY_BUFFER_BINDING") or 0):
        return

    yield Suspect(
        cause,
        at=call,
        change=_pointed(draw, call, (data.shape[1], FLOAT, 0, better)),
        strength=88,
        state="GL_COLOR_ARRAY_TYPE",
        value=most,
        values={"call": written(call)},
        draws=[draw],
    )


TYPE_NAMES = {
    0x1400: "GL_BYTE",
    0x1401: "GL_UNSIGNED_BYTE",
    0x1402: "GL_SHORT",
    0x1403: "GL_UNSIGNED_SHORT",
    0x1404: "GL_INT",
    0x1405: "GL_UNSIGNED_INT",
    0x1406: "GL_FLOAT",
    0x140A: "GL_DOUBLE",
}


def assigned(survey: Survey, call: Call) -> str:
    """Return the line that makes the array handed to a call, as "file:line"; "" if none is found.

    It is looked for in the program's text: the variable among the call's arguments, and the last
    assignment to it before the call.
    """
    if survey.past is None or call.site.path != survey.past.source:
        return ""
    with suppress(OSError, SyntaxError, ValueError):
        nodes = list(ast.walk(ast.parse(Path(call.site.path).read_bytes())))
        names = {name for node in nodes for name in _handed(node, call)}
        lines = [
            node.lineno
            for node in nodes
            if isinstance(node, ast.Assign)
            and any(ast.unparse(target) in names for target in node.targets)
        ]
        if lines:
            line = max((n for n in lines if n < call.site.line), default=lines[0])
            return f"{call.site.file}:{line}"
    return ""


def _handed(node: ast.AST, call: Call) -> list[str]:
    """Return the variables that a call in the program's text hands over, but for enumerants."""
    if not isinstance(node, ast.Call) or not ast.unparse(node.func).endswith(call.name):
        return []
    if not node.lineno <= call.site.line <= (node.end_lineno or 0):
        return []
    names = [ast.unparse(arg) for arg in node.args if isinstance(arg, (ast.Name, ast.Attribute))]
    return [name for name in names if not name.split(".")[-1].startswith("GL_")]


def _after_upload(upload: Call, buffer: int, array: np.ndarray) -> dict[str, Sequence[Action]]:
    return {str(upload.number): [_refill(buffer, array)]}


def _refill(buffer: int, array: np.ndarray, target: int = ARRAY_BUFFER) -> Callable[[], None]:
    def act() -> None:
        name = gl.GL_ARRAY_BUFFER_BINDING
        if target == ELEMENTS:
            name = gl.GL_ELEMENT_ARRAY_BUFFER_BINDING
        former = int(gl.glGetIntegerv(name))
        gl.glBindBuffer(target, buffer)
        gl.glBufferData(target, array.nbytes, array, gl.GL_STATIC_DRAW)
        gl.glBindBuffer(target, former)

    return act


def _changed(
    cause: str,
    draw: Drawn,
    kind: str,
    call: Call,
    buffer: int,
    args: object,
    strength: float,
    state: str,
    value: object,
    values: dict[str, object],
) -> Suspect:
    return Suspect(
        cause,
        at=call,
        change=Change(before={draw.place: [lambda: _point(call, buffer, args)]}),
        strength=strength,
        state=state,
        value=value,
        values=values,
        draws=[draw],
    )


def _stride(
    draw: Drawn, kind: str, call: Call, buffer: int, stride: int, row: int, element: int
) -> Iterator[Suspect]:
    """Suspect a stride that is neither 0 nor that of a row of the data."""
    values = {"stride": stride, "row": row, "element": element, "call": written(call)}
    if row and (stride or element) != row and row >= element:
        right = row
    elif 0 < stride < element:
        right = 0
    else:
        return

    if not buffer:
        return
    args = (*call.args[:-2], right, call.args[-1])
    yield _changed(
        "stride",
        draw,
        kind,
        call,
        buffer,
        args,
        88 if stride or row else 70,
        f"{kind}_STRIDE",
        stride,
        values | {"right": right},
    )


def _indices(
    survey: Survey, draw: Drawn, bound: dict[int, int], buffers: UploadedArrays
) -> Iterator[Suspect]:
    call = draw.call
    kind, indices = int(call.args[-2]), call.args[-1]
    if kind not in TYPES:
        yield _unknown_type(call, kind)
        return

    wanted = np.dtype(TYPES[kind])
    stored = buffers.data.get(bound.get(ELEMENTS, 0))
    if stored is not None and not isinstance(indices, np.ndarray):
        yield from _indices_in_buffer(survey, draw, bound[ELEMENTS], stored, kind)
    elif isinstance(indices, np.ndarray) and indices.dtype.itemsize != wanted.itemsize:
        converted = np.ascontiguousarray(indices.astype(wanted))
        change = Change(instead={draw.place: [(call.name, (*call.args[:-1], converted))]})
        yield _index_type(survey, draw, call, indices, kind, change, 90)


def _indices_in_buffer(
    survey: Survey, draw: Drawn, buffer: int, stored: tuple[Call, np.ndarray], kind: int
) -> Iterator[Suspect]:
    """Yield that a buffer's indices are of another type than the draw says."""
    upload, array = stored
    wanted = np.dtype(TYPES[kind])
    if array.dtype.itemsize != wanted.itemsize:
        converted = np.ascontiguousarray(array.astype(wanted))
        change = Change(before={draw.place: [_refill(buffer, converted, ELEMENTS)]})
        yield _index_type(survey, draw, upload, array, kind, change, 95)


def _unknown_type(call: Call, kind: int) -> Suspect:
    """Suspect that a draw says a type of indices that there is not."""
    return Suspect(
        "index-type",
        at=call,
        change=None,
        strength=40,
        value=kind,
        values={"call": written(call)},
        pixels=1,
    )


def _index_type(
    survey: Survey,
    draw: Drawn,
    at: Call,
    array: np.ndarray,
    kind: int,
    change: Change,
    strength: int,
) -> Suspect:
    """Suspect that indices have another type than a draw says, ``kind``."""
    return Suspect(
        "index-type",
        at=at,
        change=change,
        strength=strength,
        state="GL_ELEMENT_ARRAY_BUFFER",
        value=str(array.dtype),
        values={"dtype": str(array.dtype), "wanted": TYPES[kind], "type": TYPE_NAMES[kind]},
        draws=[draw],
        source=assigned(survey, at),
    )


def _count(draw: Drawn, pointers: Any, buffers: UploadedArrays) -> Iterator[Suspect]:
    """Suspect a count of vertices below those that there are."""
    call = draw.call
    if call.name == "glDrawElements":
        yield from _count_of_faces(draw)
    if call.name != "glDrawArrays" or "GL_VERTEX_ARRAY" not in pointers:
        return
    pointer, buffer = pointers["GL_VERTEX_ARRAY"]
    array = buffers.data[buffer][1] if buffer in buffers.data else pointer.args[-1]
    if not isinstance(array, np.ndarray) or array.ndim < 2:
        return
    first, count = int(call.args[1]), int(call.args[2])

    # A third: who counts triangles instead of vertices.
    third = len(array) - 3 <= count * 3 and count <= len(array) // 2
    if first or not (count == 0 or third):
        return
    yield Suspect(
        "count",
        at=call,
        change=Change(instead={draw.place: [(call.name, (call.args[0], 0, len(array)))]}),
        strength=68,
        value=count,
        values={"n": count, "all": len(array), "call": written(call)},
        draws=[draw],
    )


def _count_of_faces(draw: Drawn) -> Iterator[Suspect]:
    """Suspect a glDrawElements that is given the number of faces, and wants that of indices."""
    call = draw.call
    indices, count = call.args[-1], int(call.args[1])
    size = LEAST.get(MODES[int(call.args[0])], 0)
    if not isinstance(indices, np.ndarray) or size < 2 or int(call.args[-2]) not in TYPES:
        return
    all_ = indices.nbytes // np.dtype(TYPES[int(call.args[-2])]).itemsize
    if count and count * size != all_:
        return
    yield Suspect(
        "count",
        at=call,
        change=Change(instead={draw.place: [_pointed_all(draw, all_)]}),
        strength=88,
        value=count,
        values={"n": count, "all": all_, "call": written(call)},
        draws=[draw],
    )


def _pointed_all(draw: Drawn, count: int) -> Callable[[], None]:
    def act() -> None:
        for name, given in draw.call.arrays:
            gl_function(name)(*given)
        mode, _, *others = draw.call.args
        gl.glDrawElements(mode, count, *others)

    return act


def array_left(survey: Survey) -> Iterator[Suspect]:
    """An array of colours that another draw has set, and that is still enabled for this one."""
    pointed: dict[str, Call] = {}
    drawn: dict[int, Drawn] = {draw.number: draw for draw in survey.shapes}
    users: dict[int, list[Drawn]] = {}  # of each glColorPointer
    for call in survey.calls:
        if call.name in POINTERS:
            pointed[call.name] = call
        draw = drawn.get(call.number)
        if draw is None or call.name not in DRAWS or not draw.state["GL_COLOR_ARRAY"]:
            continue

        color, vertex = pointed.get("glColorPointer"), pointed.get("glVertexPointer")
        if color is None or vertex is None:
            continue
        mine = users.setdefault(color.number, [])
        setter = draw.setter("GL_CURRENT_COLOR")
        if mine and vertex.number > color.number and setter and setter.number > mine[-1].number:
            yield Suspect(
                "array-left",
                at=color,
                change=_colored_by(draw, setter),
                strength=87,
                state="GL_COLOR_ARRAY",
                value=True,
                values={"line": call.site.line},
                draws=[draw],
            )

        mine.append(draw)


def lists(survey: Survey) -> Iterator[Suspect]:
    """A glCallList of a list that is empty or does not exist, or a list that nothing calls."""
    yield from _not_called(survey)
    for call in _unknown(survey):
        if call.name == "glCallLists":
            yield from _from_base(survey, call)
            return
        full = [n for n, listing in survey_lists(survey).items() if listing]
        for number in full[:3]:
            yield Suspect(
                "list-unknown",
                at=call,
                change=Change(instead={str(call.number): [("glCallList", (number,))]}),
                strength=66,
                state="GL_LIST_BASE",
                value=int(call.args[0]),
                values={"list": int(call.args[0]), "other": number},
            )
        return


def _colored_by(draw: Drawn, color: Call) -> Change:
    """Return the change that makes a draw in the colour of a call, without its array of colours."""

    def act() -> None:
        for name, given in draw.call.arrays:
            gl_function(name)(*given)
        gl.glDisableClientState(gl.GL_COLOR_ARRAY)
        gl_function(color.name)(*color.args)
        gl_function(draw.call.name)(*draw.call.args)

    return Change(instead={draw.place: [act]})


def _unknown(survey: Survey) -> list[Call]:
    """Return the calls that execute a display list of which nothing is known, or an empty one."""
    return [c for c in survey.calls if c.name in ("glCallList", "glCallLists") and not c.listed]


def _from_base(survey: Survey, call: Call) -> Iterator[Suspect]:
    """Yield that a glCallLists counts from a base at which there are no lists."""
    known = sorted(survey_lists(survey))
    based = [c for c in survey.tape.calls[: call.number] if c.name == "glListBase"]
    base = int(based[-1].args[0]) if based else 0
    if not known or base == known[0]:
        return

    def counted_from_first() -> None:
        gl.glListBase(known[0])
        gl.glCallLists(*call.args)

    yield Suspect(
        "list-base",
        at=based[-1] if based else call,
        change=Change(instead={str(call.number): [counted_from_first]}),
        strength=80,
        state="GL_LIST_BASE",
        value=base,
        values={"base": base, "first": known[0]},
    )


def _not_called(survey: Survey) -> Iterator[Suspect]:
    """Yield that a frame draws nothing, and calls none of the lists that were compiled."""
    if survey.shapes or not survey.calls or _unknown(survey):
        return
    compiled = {int(c.args[0]): c for c in survey.tape.calls if c.name == "glNewList"}
    last = survey.calls[-1]
    waiting = [n for n, calls in survey_lists(survey).items() if any(draws(c.name) for c in calls)]
    for number in waiting[:3]:
        yield Suspect(
            "list-not-called",
            at=compiled[number],
            change=Change(after={str(last.number): [("glCallList", (number,))]}),
            strength=75,
            state="GL_LIST_BASE",
            value=number,
            values={"list": number},
        )


def survey_lists(survey: Survey) -> dict[int, Any]:
    """Return the display lists that the tape compiles and never calls, with their calls."""
    found = {}
    for call in survey.tape.calls:
        if call.name == "glNewList" and call.compiled is not None:
            number = int(call.args[0])
            if number not in survey.called:
                found[number] = call.compiled.calls()
    return found


RULES = (arrays, array_left, lists)
