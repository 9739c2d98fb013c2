"""The draws of a frame with their vertices, as the tests of an exercise see them."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from framelens.spec import spec
from landscape.course.grader.calls import NONE, Call, Item, Numbers, State, whole


@dataclass(frozen=True, eq=False)
class Draw:
    """The n vertices of one glBegin, glDrawArrays or glDrawElements (also glDrawElementsui).

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
    def state(self) -> State:
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


def rotation(angle: float, axis: np.ndarray) -> np.ndarray:
    """Return the matrix (3, 3) that turns by an angle in radians about an axis (3,), any length."""
    x, y, z = axis / (np.linalg.norm(axis) or 1.0)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    outer = np.outer((x, y, z), (x, y, z))
    return np.asarray(outer + math.cos(angle) * (np.eye(3) - outer) + math.sin(angle) * cross)


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
        found[:3, :3] = rotation(math.radians(args[0]), np.array(args[1:], float))
    elif base in ("glMultMatrix", "glLoadMatrix"):
        found = np.array(args[0], float).reshape(4, 4).T
    elif base in ("glMultTransposeMatrix", "glLoadTransposeMatrix"):
        found = np.array(args[0], float).reshape(4, 4)
    elif base != "glLoadIdentity":
        return None

    return found


def state_matrix(state: State, name: str) -> np.ndarray:
    """Return a matrix of a state, such as GL_MODELVIEW_MATRIX, as (4, 4)."""
    return np.array(state[name], float).reshape(4, 4).T


FROM_ARRAYS = (
    *("glDrawArrays", "glDrawElements", "glDrawRangeElements"),
    *("glDrawElementsub", "glDrawElementsus", "glDrawElementsui"),  # PyOpenGL's
)
CURRENT = {
    "normal": "GL_CURRENT_NORMAL",
    "color": "GL_CURRENT_COLOR",
    "texture": "GL_TEXTURE0.GL_CURRENT_TEXTURE_COORDS",
}
SIZES = (3, 4, 4)  # of their values


class _Current:
    """The current values while calls are followed."""

    def __init__(self) -> None:
        self.modelview = np.eye(4)
        self.stack: list[np.ndarray] = []
        self.state: State = {}
        self.normal = [0.0, 0.0, 1.0]
        self.color = [1.0, 1.0, 1.0, 1.0]
        self.texture = [0.0, 0.0, 0.0, 1.0]
        self.taken: dict[str, object] = {}

    def take(self, state: State) -> None:
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

    def values(self) -> Sequence[list[float]]:
        """Return the current normal, colour and texture coordinates."""
        return self.normal, self.color, self.texture

    def give(self, run: range, numbers: Numbers) -> None:
        """Take what calls give that only give numbers."""
        for (attribute, size), latest in zip(
            zip(CURRENT, SIZES, strict=True), numbers.latest[:, run.stop - 1].tolist(), strict=True
        ):
            if latest >= run.start:
                setattr(self, attribute, numbers.vectors[latest, :size].tolist())

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


def drawn(calls: Sequence[Item], numbers: Numbers = NONE) -> Iterator[Draw]:
    """Yield what a frame's calls draw, in order; each is computed when it is asked for."""
    yield from _drawn(calls, numbers, _Current(), listed=False)


def _drawn(calls: Sequence[Item], numbers: Numbers, now: _Current, listed: bool) -> Iterator[Draw]:
    begun: Call | None = None
    # Of the block of glBegin: a vertex, or several as (range, current values).
    rows: list[Any] = []
    for call in calls:
        if isinstance(call, range):
            rows.append((call, now.values()))
            now.give(call, numbers)
            continue

        base = call.base
        if call.state:
            now.take(call.state)
        elif listed:
            now.follow(call)
            if spec.draws(call.name) or call.inside:
                call = Call(
                    call.name,
                    call.args,
                    call.line,
                    call.function,
                    now.state,
                    call.arrays,
                    call.inside,
                    call.way,
                )

        if call.name == "glBegin":
            begun, rows = call, []
        elif call.name == "glEnd" and begun is not None:
            yield _draw(begun, str(begun.args[0]), _columns(rows, numbers), now)
            begun, rows = None, []
        elif call.name == "glPopAttrib":
            now.taken.clear()
        elif base == "glVertex":
            rows.append([_vector(call, 4), *now.values()])
        elif base == "glNormal":
            now.normal = _vector(call, 3)
        elif base == "glColor":
            now.color = _vector(call, 4)
        elif base == "glTexCoord":
            now.texture = _vector(call, 4)
        elif call.name in FROM_ARRAYS:
            yield _draw(call, str(call.args[0]), _stacked(_from_arrays(call, now)), now)
        elif call.inside:
            yield from _drawn(call.inside, numbers, now, listed=True)


Columns = tuple[np.ndarray, ...]
"""The vertices (n, 4), their normals (n, 3), colours (n, 4) and texture coordinates (n, 4)."""


def _columns(rows: Sequence[Any], numbers: Numbers) -> Columns:
    """Return the columns of what stands between glBegin and glEnd, one row for each vertex."""
    if not rows:
        return _stacked(())
    if all(isinstance(row, tuple) for row in rows):
        return _together(rows, numbers)
    parts = [
        _together([row], numbers) if isinstance(row, tuple) else _stacked([row]) for row in rows
    ]
    return tuple(np.concatenate(column) for column in zip(*parts, strict=True))


def _stacked(rows: Sequence[Sequence[object]]) -> Columns:
    columns = list(zip(*rows, strict=True)) if rows else [()] * 4
    return tuple(
        np.array(column, float).reshape(len(rows), width)
        for column, width in zip(columns, (4, *SIZES), strict=True)
    )


def _together(runs: Sequence[tuple[range, Sequence[object]]], numbers: Numbers) -> Columns:
    """Return the columns of calls that only give numbers, from runs that adjoin in the columns."""
    first, counts = runs[0][0].start, [len(run) for run, _ in runs]
    inside = np.flatnonzero(numbers.kinds[first : runs[-1][0].stop] == 0)
    places, of = inside + first, np.repeat(np.arange(len(runs)), counts)[inside]
    begins = np.array([run.start for run, _ in runs])[of]
    columns = [numbers.vectors[places]]
    for attribute, size in enumerate(SIZES):
        latest = numbers.latest[attribute][places]
        column = numbers.vectors[latest, :size]
        before = np.flatnonzero(latest < begins)  # given before the run
        current = np.array([values[attribute] for _, values in runs], float)
        column[before] = current[of[before]]
        columns.append(column)
    return tuple(columns)


def _vector(call: Call, size: int) -> list[float]:
    """Return the arguments of glVertex and its like, filled up to ``size`` numbers."""
    values = call.args[0] if call.args and isinstance(call.args[0], list) else call.args
    given = [float(value) for value in values]
    if (most := whole(call.name)) != 1:
        given = [value / most for value in given]
    return (given + [0.0, 0.0, 0.0, 1.0][len(given) :])[:size]


def _draw(call: Call, mode: str, columns: Columns, now: _Current) -> Draw:
    projection = state_matrix(now.state, "GL_PROJECTION_MATRIX")
    vertices, normals, colors, texture = columns
    return Draw(call, mode, vertices, normals, colors, texture, now.modelview, projection)


def _from_arrays(call: Call, now: _Current) -> list[list[list[float]]]:
    """Return the rows of a draw call that reads vertex arrays; none where they are not known."""
    arrays: dict[str, list[list[float]]] = {}
    for name, args in call.arrays:
        kind, pointer, suffix = name.partition("Pointer")
        if not pointer or not isinstance(args[-1], list):
            continue
        values = np.array(args[-1], float)
        if suffix:  # glVertexPointerf and its like, PyOpenGL's: the size is that of the array
            if values.ndim < 2:
                return []
            size = values.shape[-1]
        else:
            size = 3 if name == "glNormalPointer" else int(args[0])
            if args[-2] not in (0, None):
                return []
        flat = values.ravel()
        rows = flat[: len(flat) // size * size].reshape(-1, size).tolist()
        if kind == "glColor" and (suffix == "ub" or args[1:2] == ["GL_UNSIGNED_BYTE"]):
            rows = [[value / 255 for value in row] for row in rows]
        arrays[kind] = [(row + [0.0, 0.0, 0.0, 1.0][len(row) :]) for row in rows]

    points = arrays.get("glVertex", [])
    if call.name == "glDrawArrays":
        indices = list(range(int(call.args[1]), int(call.args[1]) + int(call.args[2])))
    elif isinstance(call.args[-1], list):
        indices = np.array(call.args[-1]).ravel().tolist()
        if not call.name.startswith("glDrawElementsu"):
            indices = indices[: int(call.args[-3])]
    else:
        return []

    others = (
        [row[:3] for row in arrays.get("glNormal", [])],
        arrays.get("glColor", []),
        arrays.get("glTexCoord", []),
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
