"""What a program has drawn, as the tests of an exercise see it: pictures, calls, draws.

    frame = work.frame(0)
    frame.picture                      uint8 (h, w, 3), top row first
    frame.calls                        the frame's calls in order, those of display lists among them
    frame.find("glRotate")             those of one function, whatever its suffix: glRotatef, ...d
    work.find("glEnable", "GL_FOG")    those of the setup and of all frames, by first arguments, too
    frame.draws                        what each glBegin, glDrawArrays and glDrawElements draws

A :class:`Draw` has its vertices, in object, eye and window coordinates, their normals, colours and
texture coordinates, and OpenGL's state. Matrices are as one writes them, (4, 4), for column
vectors: the translation is the last column. Arrays in buffer objects and interleaved arrays are not
followed: such a draw has no vertices.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache, cached_property
from pathlib import Path
from typing import Any

import numpy as np

from landscape.capture import spec

NO_LINE = 0


@dataclass(eq=False, slots=True)  # thousands are made and looked for
class Call:
    """One call. ``line`` is that of the student's file; NO_LINE in a module that it imports.

    ``state`` is OpenGL's, by the names of `landscape state`, just before a call that draws; it is
    that of the glCallList for what a display list draws, and empty for other calls. ``way`` are the
    student's lines that lead to the call, from the outermost, each with the name of the function
    that it calls; it is not known of glVertex and its like, nor inside display lists.
    """

    name: str
    args: Sequence[Any]
    line: int
    function: str
    state: Mapping[str, Any] = field(default_factory=dict, repr=False)
    arrays: Sequence[Any] = field(default=(), repr=False)
    inside: Sequence["Call"] = field(default=(), repr=False)
    way: Sequence[tuple[int, str]] = field(default=(), repr=False)

    @property
    def base(self) -> str:
        """The name without its suffix: glVertex for glVertex3f."""
        known = spec.function(self.name)
        return known.base if known is not None else self.name

    def is_(self, name: str, *first: Any) -> bool:
        """Return whether it calls a function, named with or without suffix, with these arguments.

        Only the first arguments need be given; None stands for any.
        """
        return (
            (name == self.name or name == self.base)
            and len(self.args) >= len(first)
            and all(a is None or a == b for a, b in zip(first, self.args, strict=False))
        )


@dataclass(frozen=True, eq=False)
class Draw:
    """What one glBegin, glDrawArrays or glDrawElements draws, n vertices.

    ``vertices``: object coordinates (n, 4); ``normals`` (n, 3), ``colors`` (n, 4) and ``texture``
    coordinates (n, 4) of each vertex. ``modelview`` and ``projection`` are (4, 4).
    """

    call: Call
    mode: str
    vertices: np.ndarray
    normals: np.ndarray
    colors: np.ndarray
    texture: np.ndarray
    modelview: np.ndarray
    projection: np.ndarray

    @property
    def line(self) -> int:
        """The line of the call."""
        return self.call.line

    @property
    def state(self) -> Mapping[str, Any]:
        """OpenGL's state before the call."""
        return self.call.state

    @cached_property
    def eye(self) -> np.ndarray:
        """The vertices in eye coordinates, (n, 3)."""
        found = self.vertices @ self.modelview.T
        return np.asarray(found[:, :3] / found[:, 3:])

    @cached_property
    def window(self) -> np.ndarray:
        """The vertices in window coordinates, (n, 2), in pixels from the lower left."""
        clip = self.vertices @ (self.projection @ self.modelview).T
        x, y, width, height = self.state["GL_VIEWPORT"]
        with np.errstate(divide="ignore", invalid="ignore"):
            device = clip[:, :2] / clip[:, 3:]
        return np.asarray((device + 1) / 2 * [width, height] + [x, y])

    @property
    def center(self) -> np.ndarray:
        """The mean of the vertices in eye coordinates, (3,)."""
        return np.asarray(self.eye.mean(axis=0))


@dataclass(frozen=True, eq=False)
class Frame:
    """A frame of a program; ``setup`` are the calls before the first that draws."""

    number: int
    picture: np.ndarray
    setup: Sequence[Call]
    top: Sequence[Call]

    @cached_property
    def calls(self) -> list[Call]:
        """The frame's calls in the order in which they take effect, without those of the setup."""
        return list(_expanded(self.top))

    @cached_property
    def draws(self) -> list[Draw]:
        """What is drawn, in order."""
        return list(drawn(self.top))

    def find(self, name: str, *first: Any) -> list[Call]:
        """Return the frame's calls of a function (see :meth:`Call.is_`), in order."""
        return [call for call in self.calls if call.is_(name, *first)]


@dataclass(frozen=True, eq=False)
class Evidence:
    """What was noted of a program, by the frames that were looked at.

    ``early``: the first function that was called without a context, in vain, and the line.
    """

    path: Path
    source: Sequence[str]
    frames: Mapping[int, Frame]
    early: tuple[str, int] | None = None

    def frame(self, number: int) -> Frame:
        """Return a frame that the exercise looks at."""
        return self.frames[number]

    @property
    def last(self) -> Frame:
        """The last frame that is looked at."""
        return self.frames[max(self.frames)]

    def find(self, name: str, *first: Any) -> list[Call]:
        """Return calls of a function, of the setup and of all frames that are looked at."""
        setup = [call for call in _expanded(self.last.setup) if call.is_(name, *first)]
        return setup + [c for frame in self.frames.values() for c in frame.find(name, *first)]

    def text(self, line: int) -> str:
        """Return a line of the program without the space around it."""
        return self.source[line - 1].strip() if 0 < line <= len(self.source) else ""


def load(path: Path, answer: Mapping[str, Any], folder: Path, wanted: Sequence[int]) -> Evidence:
    """Return the evidence of a program from what witness.py wrote into a folder.

    If it is not in that form, or a wanted frame is not there, an error of Python is raised.
    """
    states: list[Mapping[str, Any]] = []
    for each in answer["states"]:
        states.append({**states[0], **each} if states else each)
    frames = {}
    for number in wanted:
        found = answer["frames"][str(number)]
        width, height = found["size"]
        if min(width, height) < 1:
            raise ValueError(f"a picture of {width} x {height} pixels")
        pixels = np.fromfile(folder / Path(found["pixels"]).name, np.uint8)
        frames[number] = Frame(
            number,
            pixels.reshape(height, width, 3),
            [_call(each, states) for each in found["setup"]],
            [_call(each, states) for each in found["calls"]],
        )
    source = path.read_text(encoding="utf-8", errors="replace").splitlines()
    early = answer.get("early")
    return Evidence(path, source, frames, (str(early[0]), int(early[1])) if early else None)


def _call(found: Mapping[str, Any], states: Sequence[Mapping[str, Any]]) -> Call:
    line = int(found["line"]) if found["own"] else NO_LINE
    basic = str(found["name"]), list(found["args"]), line, str(found["function"])
    if len(found) == 5:  # as most: what every call has, and no more
        return Call(*basic)
    index = found.get("state")
    return Call(
        *basic,
        states[index] if index is not None else {},
        found.get("arrays", ()),
        [_call(each, states) for each in found["inside"]] if "inside" in found else (),
        [(int(line), str(name)) for line, name in found["way"]] if "way" in found else (),
    )


def _expanded(calls: Sequence[Call]) -> Iterator[Call]:
    for call in calls:
        yield call
        yield from _expanded(call.inside)


def matrix(name: str, args: Sequence[Any]) -> np.ndarray | None:
    """Return the matrix (4, 4) that a call multiplies with or loads; None for other calls."""
    known = spec.function(name)
    if known is None or known.group != "matrix":
        return None
    base, found = known.base, np.eye(4)
    if base == "glTranslate":
        found[:3, 3] = args
    elif base == "glScale":
        found[range(3), range(3)] = args
    elif base == "glRotate":
        angle, axis = math.radians(args[0]), np.array(args[1:], float)
        x, y, z = axis / (np.linalg.norm(axis) or 1.0)
        cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
        outer = np.outer((x, y, z), (x, y, z))
        found[:3, :3] = outer + math.cos(angle) * (np.eye(3) - outer) + math.sin(angle) * cross
    elif base in ("glMultMatrix", "glLoadMatrix"):
        found = np.array(args[0], float).reshape(4, 4).T
    elif base in ("glMultTransposeMatrix", "glLoadTransposeMatrix"):
        found = np.array(args[0], float).reshape(4, 4)
    elif base != "glLoadIdentity":
        return None
    return found


def state_matrix(state: Mapping[str, Any], name: str) -> np.ndarray:
    """Return a matrix of a state, such as GL_MODELVIEW_MATRIX, as (4, 4)."""
    return np.array(state[name], float).reshape(4, 4).T


CURRENT = {
    "normal": "GL_CURRENT_NORMAL",
    "color": "GL_CURRENT_COLOR",
    "texture": "GL_TEXTURE0.GL_CURRENT_TEXTURE_COORDS",
}


class _Current:
    """The current values while calls are followed."""

    def __init__(self) -> None:
        self.modelview = np.eye(4)
        self.stack: list[np.ndarray] = []
        self.state: Mapping[str, Any] = {}
        self.normal = [0.0, 0.0, 1.0]
        self.color = [1.0, 1.0, 1.0, 1.0]
        self.texture = [0.0, 0.0, 0.0, 1.0]
        self.taken: dict[str, Any] = {}

    def take(self, state: Mapping[str, Any]) -> None:
        """Take the values from a state that was read.

        The state is not read again after glColor and the like. So what it says of the current
        colour, normal and texture coordinate counts only where it differs from the time before.
        """
        self.state = state
        self.modelview = state_matrix(state, "GL_MODELVIEW_MATRIX")
        for attribute, name in CURRENT.items():
            if self.taken.get(name) != state[name]:
                setattr(self, attribute, list(state[name]))
            self.taken[name] = state[name]

    def follow(self, call: Call) -> None:
        """Follow a call of a display list that changes the modelview matrix."""
        if self.state.get("GL_MATRIX_MODE") != "GL_MODELVIEW":
            return
        if call.name == "glPushMatrix":
            self.stack.append(self.modelview)
        elif call.name == "glPopMatrix" and self.stack:
            self.modelview = self.stack.pop()
        else:
            found = matrix(call.name, call.args)
            if found is not None:
                loads = call.base.startswith("glLoad")
                self.modelview = found if loads else self.modelview @ found


def drawn(calls: Sequence[Call]) -> Iterator[Draw]:
    """Yield what a frame's calls draw, in order; each is computed when it is asked for."""
    now = _Current()
    yield from _drawn(calls, now, listed=False)


def _drawn(calls: Sequence[Call], now: _Current, listed: bool) -> Iterator[Draw]:
    begun: Call | None = None
    rows: list[list[list[float]]] = []
    for call in calls:
        base = call.base
        if call.state:
            now.take(call.state)
        elif listed:
            now.follow(call)
            if spec.draws(call.name) or call.inside:
                call = Call(call.name, call.args, call.line, call.function, now.state,
                            call.arrays, call.inside, call.way)  # fmt: skip
        if call.name == "glBegin":
            begun, rows = call, []
        elif call.name == "glEnd" and begun is not None:
            yield _draw(begun, str(begun.args[0]), rows, now)
            begun = None
        elif call.name == "glPopAttrib":
            now.taken.clear()
        elif base == "glVertex":
            rows.append([_vector(call, 4), now.normal, now.color, now.texture])
        elif base == "glNormal":
            now.normal = _vector(call, 3)
        elif base == "glColor":
            now.color = _vector(call, 4)
        elif base == "glTexCoord":
            now.texture = _vector(call, 4)
        elif call.name in ("glDrawArrays", "glDrawElements"):
            yield _draw(call, str(call.args[0]), _from_arrays(call, now), now)
        elif call.inside:
            yield from _drawn(call.inside, now, listed=True)


WHOLE = {"b": 127, "ub": 255, "s": 32767, "us": 65535, "i": 2**31 - 1, "ui": 2**32 - 1}


def _vector(call: Call, size: int) -> list[float]:
    """Return the arguments of glVertex and its like, filled up to ``size`` numbers."""
    values = call.args[0] if call.args and isinstance(call.args[0], list) else call.args
    given = [float(value) for value in values]
    if (whole := _whole(call.name)) != 1:
        given = [value / whole for value in given]
    return (given + [0.0, 0.0, 0.0, 1.0][len(given) :])[:size]


@cache
def _whole(name: str) -> int:
    """Return by what a call divides its arguments: glColor3ub by 255."""
    known = spec.function(name)
    if known is None or known.base not in ("glColor", "glNormal"):
        return 1
    return WHOLE.get(name.removeprefix(known.base).strip("234").removesuffix("v"), 1)


def _draw(call: Call, mode: str, rows: Sequence[Sequence[Any]], now: _Current) -> Draw:
    columns = list(zip(*rows, strict=True)) if rows else [()] * 4
    vertices, normals, colors, texture = (
        np.array(column, float).reshape(len(rows), width)
        for column, width in zip(columns, (4, 3, 4, 4), strict=True)
    )
    projection = state_matrix(now.state, "GL_PROJECTION_MATRIX")
    return Draw(call, mode, vertices, normals, colors, texture, now.modelview, projection)


def _from_arrays(call: Call, now: _Current) -> list[list[list[float]]]:
    """Return the rows of a draw call that reads vertex arrays; none where they are not known."""
    arrays: dict[str, list[list[float]]] = {}
    for name, args in call.arrays:
        if not name.endswith("Pointer") or not isinstance(args[-1], list):
            continue
        size = 3 if name == "glNormalPointer" else int(args[0])
        if args[-2] not in (0, None):
            return []
        flat = np.array(args[-1], float).ravel()
        rows = flat[: len(flat) // size * size].reshape(-1, size).tolist()
        if name == "glColorPointer" and args[1] == "GL_UNSIGNED_BYTE":
            rows = [[value / 255 for value in row] for row in rows]
        arrays[name] = [(row + [0.0, 0.0, 0.0, 1.0][len(row) :]) for row in rows]
    points = arrays.get("glVertexPointer", [])
    if call.name == "glDrawArrays":
        indices = list(range(int(call.args[1]), int(call.args[1]) + int(call.args[2])))
    elif isinstance(call.args[-1], list):
        indices = np.array(call.args[-1]).ravel()[: int(call.args[1])].tolist()
    else:
        return []
    others = (
        [row[:3] for row in arrays.get("glNormalPointer", [])],
        arrays.get("glColorPointer", []),
        arrays.get("glTexCoordPointer", []),
    )
    current = (now.normal, now.color, now.texture)
    found = []
    for index in indices:
        if index >= len(points):
            return []
        more = [
            array[index] if index < len(array) else value
            for array, value in zip(others, current, strict=True)
        ]
        found.append([points[index], *more])
    return found
