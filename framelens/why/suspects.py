"""Suspects: a suspected cause with the change that would mend it; and changes that rules share.

A rule is a function of a :class:`framelens.why.survey.Survey` that yields :class:`Suspect` objects.
It only suspects: diagnosis.py tries the change, and names no cause whose change is not seen.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import KW_ONLY, dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from framelens.gl.named import gl_constant
from framelens.gl.notes import plain
from framelens.gl.seam import Call, GluCall, gl
from framelens.why.survey import Drawn, Survey
from framelens.why.trial import Action, Around, Change

Rule = Callable[[Survey], Iterator["Suspect"]]
At = Call | GluCall | None


@dataclass
class Suspect:
    """A cause that may be: by its ID in findings.py, with the call or line that is to blame.

    ``change`` would mend it; None if the window is to blame, and ``pixels`` says how many it does
    not show. ``strength``, 0 to 100, is how likely a fault of this kind is one: the likelier of two
    proven causes comes first. ``state`` is the variable that has a wrong ``value``. ``values`` go
    into the texts.
    """

    cause: str
    _: KW_ONLY
    at: At
    change: Change | None
    strength: float
    state: str = ""
    value: object = None
    values: Mapping[str, object] = field(default_factory=dict)
    pixels: int = 0
    draws: Sequence[Drawn] = ()
    source: str = ""  # where the call cannot say it
    least: int = 0  # pixels that must differ, where that is more than usual
    reach: int = 1  # how far from the pixel asked about the picture may change; a place is guessed
    appear: bool = False  # whether ``draws`` must have fragments that pass, then


def places(draws: Iterable[Drawn]) -> frozenset[str]:
    """Return the places of draws."""
    return frozenset(draw.place for draw in draws)


def with_state(
    bits: Sequence[str], actions: Sequence[Action], draws: Iterable[Drawn] | None
) -> Change:
    """Return the change that surrounds draws, None for all, with other state of some groups."""
    mask = 0
    for bit in bits:
        mask |= int(gl_constant(f"GL_{bit}_BIT"))
    return Change(around=(Around(mask, actions, None if draws is None else places(draws)),))


def off(name: str, draws: Iterable[Drawn] | None) -> Change:
    """Return the change that switches something off for draws."""
    return with_state(["ENABLE"], [("glDisable", (gl_constant(name),))], draws)


def on(name: str, draws: Iterable[Drawn] | None) -> Change:
    """Return the change that switches something on for draws."""
    return with_state(["ENABLE"], [("glEnable", (gl_constant(name),))], draws)


def load(mode: str, matrix: ArrayLike) -> Callable[[], None]:
    """Return the action that sets a matrix, 16 numbers in OpenGL's order, of GL_MODELVIEW, ..."""
    array = np.array(matrix, np.float64).reshape(4, 4)

    def act() -> None:
        former = int(gl.glGetIntegerv(gl.GL_MATRIX_MODE))
        gl.glMatrixMode(gl_constant(mode))
        gl.glLoadMatrixd(array)
        gl.glMatrixMode(former)

    return act


def with_matrix(mode: str, new: Callable[[Drawn], ArrayLike], draws: Iterable[Drawn]) -> Change:
    """Return the change that gives draws another matrix; ``new`` makes it."""
    around = []
    for draw in draws:
        actions = [load(mode, new(draw))]
        undo = [load(mode, draw.state[f"{mode}_MATRIX"])]
        around.append(Around(0, actions, draw.places, undo))
    return Change(around=tuple(around))


def matrix_of(draw: Drawn, mode: str) -> np.ndarray:
    """Return a draw's matrix, float64 (4, 4): row vectors are multiplied from the left."""
    return np.array(draw.state[f"{mode}_MATRIX"], np.float64).reshape(4, 4)


def at_of(survey: Survey, call: Call | None) -> At:
    """Return the call of GLU that made a call, or the call itself."""
    if call is None:
        return None
    calls = survey.tape.calls
    if not (call.number < len(calls) and calls[call.number] is call):
        return call
    for note in survey.glu:
        if note.begin <= call.number < note.end:
            return note
    return call


def line_of(survey: Survey, draw: Drawn) -> str:
    """Return the line to blame for what a draw sends, as "file:line".

    Where a function draws several things, called with other values from other lines, it is the line
    that calls it for this one; else the draw's own, "".
    """
    own = draw.chain
    if len(own) < 2:
        return ""
    others = {d.chain[:-1] for d in survey.shapes if d.chain[-1:] == own[-1:]}
    lines = {chain[-1] for chain in others if chain}
    if len(lines) < 2:
        return ""
    return f"{draw.call.site.file}:{own[-2][1]}"


def in_frame(survey: Survey, call: At) -> bool:
    """Return whether a call is one of the frame that is looked at, not of the setup before it."""
    calls = survey.tape.calls
    return (
        isinstance(call, Call)
        and survey.tape.begin <= call.number < len(calls)
        and calls[call.number] is call
    )


def shows_elsewhere(survey: Survey, draws: Sequence[Drawn], name: str) -> bool:
    """Return whether a variable has its value, set in the same line, for draws that are seen."""
    setter, value = draws[0].setter(name), draws[0].state[name]
    return setter is not None and any(
        other is not None and other.source == setter.source
        for draw in survey.shapes
        if draw.state[name] == value and survey.seen(draw)
        for other in (draw.setter(name),)
    )


TEXTURES = tuple(
    f"GL_TEXTURE{unit}.GL_TEXTURE_{kind}"
    for unit, kind in ((0, "1D"), (0, "2D"), (0, "3D"), (0, "CUBE_MAP"), (1, "2D"))
)


def textured(draw: Drawn) -> bool:
    """Return whether textures of some kind are enabled for a draw."""
    return any(draw.state[name] for name in TEXTURES)


def closed(draw: Drawn) -> bool:
    """Return whether a draw is a closed shape: a solid of GLUT, or one whose edges all meet."""
    if draw.call.name.startswith("glutSolid"):
        return True
    found = draw.vertices
    if found is None or found.mode not in ("GL_QUADS", "GL_TRIANGLES") or len(found.faces) < 4:
        return False
    keys = [tuple(np.round(p, 4).tolist()) for p in found.positions[:20_000]]
    edges: dict[object, int] = {}
    for face in found.faces:
        if max(face) >= len(keys):
            return False
        for a, b in zip(face, face[1:] + face[:1], strict=True):
            if keys[a] != keys[b]:
                pair = frozenset((keys[a], keys[b]))
                edges[pair] = edges.get(pair, 0) + 1
    return bool(edges) and all(count == 2 for count in edges.values())


def surrounds(draws: Sequence[Drawn]) -> bool:
    """Return whether the eye is among a draw's vertices, on all sides of it."""
    points = [draw.placed.eye[:, :3] for draw in draws if draw.placed is not None]
    if not points:
        return False
    eye = np.concatenate(points)
    low, high = eye.min(axis=0), eye.max(axis=0)
    return bool(len(eye) > 7 and (low < 0).all() and (high > 0).all())


def written(at: At) -> str:
    """Return a call as one writes it."""
    if at is None:
        return ""
    values = [plain(value) for value in at.args]
    return f"{at.name}({', '.join(_short(value) for value in values)})"


def _short(value: object) -> str:
    if isinstance(value, dict) and "values" in value:
        numbers = value["values"]
        if len(numbers) <= 4 and all(isinstance(each, (int, float)) for each in numbers):
            return "(" + ", ".join(f"{each:g}" for each in numbers) + ")"
        return f"{value['dtype']}{value['shape']}"
    return f"{value:g}" if isinstance(value, float) else str(value)


def is_identity(matrix: ArrayLike) -> bool:
    """Return whether a matrix is the identity."""
    return bool(np.allclose(np.array(matrix, np.float64).reshape(4, 4), np.eye(4), atol=1e-6))


def perspective(matrix: ArrayLike) -> bool:
    """Return whether a projection is a perspective one."""
    flat = np.array(matrix, np.float64).reshape(16)
    return bool(abs(flat[11]) > 1e-6 and abs(flat[15]) < 1e-6)


def near_far(matrix: ArrayLike) -> tuple[float, float]:
    """Return the distances of the near and the far plane of a projection."""
    m = np.array(matrix, np.float64).reshape(4, 4)
    a, b = m[2, 2], m[3, 2]
    with np.errstate(all="ignore"):
        if perspective(matrix):
            return float(b / (a - 1.0)), float(b / (a + 1.0))
        return float((b + 1.0) / a), float((b - 1.0) / a)


def with_planes(
    matrix: ArrayLike, near: float | None = None, far: float | None = None
) -> np.ndarray:
    """Return a projection with another near or far plane, of the same angle of view."""
    m = np.array(matrix, np.float64).reshape(4, 4).copy()
    n, f = near_far(matrix)
    n = n if near is None else near
    f = f if far is None else far
    if perspective(matrix):
        m[2, 2] = -(f + n) / (f - n)
        m[3, 2] = -2.0 * f * n / (f - n)
    else:
        m[2, 2] = -2.0 / (f - n)
        m[3, 2] = -(f + n) / (f - n)
    return m


def ortho(left: float, right: float, bottom: float, top: float) -> np.ndarray:
    """Return the matrix of gluOrtho2D."""
    m = np.eye(4)
    m[0, 0], m[1, 1], m[2, 2] = 2.0 / (right - left), 2.0 / (top - bottom), -1.0
    m[3, 0] = -(right + left) / (right - left)
    m[3, 1] = -(top + bottom) / (top - bottom)
    return m


def lens(fovy: float, aspect: float, near: float, far: float) -> np.ndarray:
    """Return the matrix of gluPerspective; ``fovy`` in degrees."""
    f = 1.0 / np.tan(np.radians(fovy) / 2.0)
    m = np.zeros((4, 4))
    m[0, 0], m[1, 1] = f / aspect, f
    m[2, 2], m[2, 3] = -(far + near) / (far - near), -1.0
    m[3, 2] = -2.0 * far * near / (far - near)
    return m
