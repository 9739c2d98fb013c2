"""Draw calls taken apart into their primitives, so that each can be drawn by itself.

A primitive drawn alone gives the fragments that it gives within its draw call: a pixel that a
meadow of triangles covers many times can be followed triangle by triangle.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from framelens.gl.named import gl_constant, gl_function
from framelens.gl.seam import Call, gl
from framelens.spec import spec
from framelens.tape.steps import Step, issue

# Vertices of a primitive, and how many vertices on the next one begins, by the mode of glBegin.
INDEPENDENT = {"GL_POINTS": 1, "GL_LINES": 2, "GL_TRIANGLES": 3, "GL_QUADS": 4}
ELEMENTS = ("glDrawElements", "glDrawRangeElements")


@dataclass(frozen=True, slots=True)
class Draw:
    """A draw: one step, or those from a glBegin to its glEnd."""

    steps: Sequence[Step]

    @property
    def first(self) -> Step:
        """The step that names it."""
        return self.steps[0]

    def issue(self) -> None:
        """Draw it, all of it."""
        for step in self.steps:
            issue(step.call)


def grouped(steps: Iterator[Step]) -> Iterator[Step | Draw]:
    """Yield the steps with those that draw as a Draw each."""
    for step in steps:
        if not spec.draws(step.call.name) or step.call.skipped:
            yield step
        elif step.call.name == "glBegin":
            inside = [step]
            for step in steps:
                inside.append(step)
                if step.call.name == "glEnd":
                    break
            yield Draw(inside)
        else:
            yield Draw([step])


@dataclass(frozen=True, slots=True)
class Primitives:
    """The primitives of a draw: how many, and how to draw some of them."""

    count: int
    draw: Callable[[int, int], None]
    """``draw(first, last)`` draws those from ``first`` up to, not including, ``last``."""


def primitives(draw: Draw) -> Primitives:
    """Take a draw apart; one that cannot be is its own single primitive."""
    call = draw.first.call
    try:
        if call.name == "glBegin":
            return _of_begin(draw)
        if call.name in ELEMENTS:
            return _of_elements(call)
        if call.name == "glDrawArrays":
            return _of_arrays(call)
    except _Whole:
        pass
    return Primitives(1, lambda first, last: draw.issue())


class _Whole(Exception):
    """This draw cannot be taken apart."""


def _mode(value: Any) -> str:
    """Return the name of a glBegin's mode."""
    names = (
        *("GL_POINTS", "GL_LINES", "GL_LINE_LOOP", "GL_LINE_STRIP", "GL_TRIANGLES"),
        *("GL_TRIANGLE_STRIP", "GL_TRIANGLE_FAN", "GL_QUADS", "GL_QUAD_STRIP", "GL_POLYGON"),
    )
    if not 0 <= int(value) < len(names):
        raise _Whole
    return names[int(value)]


def _counted(mode: str, vertices: int) -> int:
    """Return how many primitives so many vertices make."""
    if mode in INDEPENDENT:
        return vertices // INDEPENDENT[mode]
    if mode == "GL_LINE_STRIP":
        return max(vertices - 1, 0)
    if mode == "GL_LINE_LOOP":
        return vertices if vertices > 1 else 0
    if mode in ("GL_TRIANGLE_STRIP", "GL_TRIANGLE_FAN"):
        return max(vertices - 2, 0)
    if mode == "GL_QUAD_STRIP":
        return max(vertices // 2 - 1, 0)
    return 1 if vertices > 2 else 0


def _pieces(mode: str, vertices: int, first: int, last: int) -> list[tuple[str, list[int]]]:
    """Return modes and vertices that draw the primitives from ``first`` up to ``last``."""
    if mode in INDEPENDENT:
        size = INDEPENDENT[mode]
        return [(mode, list(range(first * size, last * size)))]
    some = range(first, last)
    if mode in ("GL_LINE_STRIP", "GL_LINE_LOOP"):
        return [("GL_LINES", [v for k in some for v in (k, (k + 1) % vertices)])]
    if mode == "GL_TRIANGLE_FAN":
        return [("GL_TRIANGLES", [v for k in some for v in (0, k + 1, k + 2)])]
    if mode == "GL_TRIANGLE_STRIP":
        # Every second triangle of a strip has its first two vertices swapped, to face the same way.
        turned = [(k + 1, k, k + 2) if k % 2 else (k, k + 1, k + 2) for k in some]
        return [("GL_TRIANGLES", [v for each in turned for v in each])]
    if mode == "GL_QUAD_STRIP":
        return [("GL_QUAD_STRIP", [2 * k, 2 * k + 1, 2 * k + 2, 2 * k + 3]) for k in some]
    return [(mode, list(range(vertices)))]


def _point(arrays: Sequence[tuple[str, tuple[object, ...]]]) -> None:
    for name, args in arrays:
        gl_function(name)(*args)


def _of_elements(call: Call) -> Primitives:
    mode = call.args[0]
    count, kind, indices = call.args[-3:]
    types = {
        int(gl.GL_UNSIGNED_BYTE): np.uint8,
        int(gl.GL_UNSIGNED_SHORT): np.uint16,
        int(gl.GL_UNSIGNED_INT): np.uint32,
    }
    if not isinstance(indices, np.ndarray) or int(kind) not in types:
        raise _Whole
    flat = np.ascontiguousarray(indices).reshape(-1).view(types[int(kind)])[: int(count)]
    named = _mode(mode)

    def draw(first: int, last: int) -> None:
        _point(call.arrays)
        if named in INDEPENDENT:
            size = INDEPENDENT[named]
            part = flat[first * size : last * size]
            gl.glDrawElements(mode, len(part), kind, part)
            return
        for piece, vertices in _pieces(named, len(flat), first, last):
            part = flat[vertices]
            gl.glDrawElements(gl_constant(piece), len(part), kind, part)

    return Primitives(_counted(named, len(flat)), draw)


def _of_arrays(call: Call) -> Primitives:
    mode = call.args[0]
    begin = int(call.args[1])
    count = int(call.args[2])
    named = _mode(mode)

    def draw(first: int, last: int) -> None:
        _point(call.arrays)
        if named in INDEPENDENT:
            size = INDEPENDENT[named]
            gl.glDrawArrays(mode, begin + first * size, (last - first) * size)
            return
        for piece, vertices in _pieces(named, count, first, last):
            part = np.array(vertices, np.uint32) + begin
            gl.glDrawElements(gl_constant(piece), len(part), gl.GL_UNSIGNED_INT, part)

    return Primitives(_counted(named, count), draw)


def _of_begin(draw: Draw) -> Primitives:
    """Take a glBegin apart: a vertex keeps the colour, the normal, ... that it was sent with."""
    named = _mode(draw.first.call.args[0])
    vertices: list[tuple[dict[object, Call], Call]] = []
    current: dict[object, Call] = {}
    for step in draw.steps[1:-1]:
        call = step.call
        if call.skipped:
            continue
        if call.name.startswith("glVertex"):
            vertices.append((dict(current), call))
        elif call.name.startswith(("glArrayElement", "glEval", "glCall")):
            raise _Whole
        else:
            current[_attribute(call)] = call

    def draw_some(first: int, last: int) -> None:
        for piece, some in _pieces(named, len(vertices), first, last):
            gl.glBegin(gl_constant(piece))
            for index in some:
                attributes, vertex = vertices[index]
                for call in attributes.values():
                    issue(call)
                issue(vertex)
            gl.glEnd()

    return Primitives(_counted(named, len(vertices)), draw_some)


def _attribute(call: Call) -> object:
    """Return what a call between glBegin and glEnd sets: a later one of the same replaces it."""
    name = call.name
    if name.startswith("glMultiTexCoord"):
        return "glMultiTexCoord", int(call.args[0])
    if name.startswith("glMaterial"):
        return "glMaterial", int(call.args[0]), int(call.args[1])
    return name.rstrip("234bsifduv")
