"""Rules about vertices and matrices: where are they, and why not in the picture?

First shapes that are wrong wherever they stand: not a number, no area, crossed, concave. Then what
is wrong with matrices as such: a frustum of nearly 180 degrees, an aspect of 0, rows for columns, a
camera on the wrong stack. At last the draws that lie outside the view volume, with the planes that
they lie beyond, and the call that put them there.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from typing import Any

import numpy as np

from framelens.gl.seam import Call, GluCall, gl
from framelens.program.past import MATRIX
from framelens.program.program_run import Chain
from framelens.spec import spec
from framelens.why.geometry import LEAST, Vertices, concave, crossed_faces
from framelens.why.survey import Drawn, Survey
from framelens.why.suspects import (
    Suspect,
    at_of,
    cap,
    is_identity,
    lens,
    line_of,
    load,
    matrix_of,
    near_far,
    ortho,
    perspective,
    with_matrix,
    with_planes,
    with_state,
    written,
)
from framelens.why.trial import NOTHING, Change


def glu_function(name: str) -> Any:
    """Return a function of GLU; PyOpenGL must be bound to a platform before it is imported."""
    from framelens.gl.glu import FUNCTIONS

    return FUNCTIONS[name]


def shapes(survey: Survey) -> Iterator[Suspect]:
    """Shapes that are wrong by themselves."""
    yield from _of_nothing(survey)
    yield from _too_few(survey)
    for draw in survey.shapes:
        found = draw.vertices
        if found is None:
            continue
        count = len(found.positions)
        if not np.isfinite(found.positions).all():
            yield from _not_numbers(draw, found)
        elif not draw.covered and count and not _lacking(draw):
            yield from _flat(draw, found)

        if bad := crossed_faces(found):
            yield _crossed(survey, draw, found, bad)
        elif bad := concave(found):
            yield _concave(survey, draw, found, bad)


QUADRICS = {"gluSphere": 1, "gluCylinder": 3, "gluDisk": 2, "gluPartialDisk": 2}
"""GLU's shapes, and how many lengths stand between the quadric and the number of slices."""


def _of_nothing(survey: Survey) -> Iterator[Suspect]:
    """Yield that a shape of GLU has too few slices or a length that is none, and draws nothing."""
    for note in survey.glu:
        lengths = QUADRICS.get(note.name)
        if lengths is None or note.end != note.begin or note.pass_ == "setup":
            continue
        quadric, *numbers = note.args
        sizes = [abs(float(size)) for size in numbers[:lengths]]
        slices, stacks = (max(int(number), 8) for number in numbers[lengths : lengths + 2])
        if note.name in ("gluDisk", "gluPartialDisk"):
            sizes.sort()
        if not any(sizes):
            sizes = [1.0] * lengths
        better = (quadric, *sizes, slices, stacks, *numbers[lengths + 2 :])
        yield Suspect(
            "glu-nothing",
            at=note,
            change=_instead_of_glu(survey, note, better),
            strength=88,
            value=numbers,
            values={"call": f"{note.name}(..., {', '.join(f'{n:g}' for n in numbers)})"},
        )


def _lacking(draw: Drawn) -> bool:
    """Return whether a glBegin gets vertices, and too few for a primitive."""
    found = draw.vertices
    if found is None or draw.call.name != "glBegin":
        return False
    return 0 < len(found.positions) < LEAST[found.mode]


def _too_few(survey: Survey) -> Iterator[Suspect]:
    """Yield that a mode wants more vertices than there are, for all draws of a line together."""
    lines: dict[str, list[Drawn]] = {}
    for draw in survey.shapes:
        if _lacking(draw):
            lines.setdefault(draw.call.source, []).append(draw)

    for draws in lines.values():
        found = draws[0].vertices
        assert found is not None
        count = len(found.positions)
        mode = ALONE.get(count, "GL_POLYGON")
        yield Suspect(
            "too-few-vertices",
            at=draws[0].call,
            change=Change(instead={draw.place: [("glBegin", (cap(mode),))] for draw in draws}),
            strength=85,
            values={"mode": found.mode, "n": count, "needed": LEAST[found.mode]},
            draws=draws,
        )


ALONE = {1: "GL_POINTS", 2: "GL_LINES"}  # what so few vertices can be drawn as


def _not_numbers(draw: Drawn, found: Vertices) -> Iterator[Suspect]:
    bad = np.flatnonzero(~np.isfinite(found.positions).all(axis=1))
    if not found.places:
        yield Suspect(
            "nan",
            at=draw.call,
            change=Change(around=()),
            strength=50,
            values={"n": len(bad)},
            draws=[draw],
        )
        return
    place = found.places[int(bad[0])]
    call = next(step.call for step in draw.steps if step.place == place)
    fixed = {
        found.places[int(k)]: [
            ("glVertex4f", tuple(np.nan_to_num(found.positions[k], posinf=0, neginf=0)))
        ]
        for k in bad
    }
    yield Suspect(
        "nan",
        at=call,
        change=Change(instead=fixed),
        strength=95,
        values={"n": len(bad)},
        draws=[draw],
    )


def _flat(draw: Drawn, found: Vertices) -> Iterator[Suspect]:
    """Yield why a draw has no area: a scale by 0, or all vertices in one point or line."""
    chain = draw.setters.chained.get("GL_MODELVIEW_MATRIX", [])
    zero = [c for c in chain if c.name.startswith("glScale") and 0.0 in [float(a) for a in c.args]]
    if zero:
        call = zero[-1]
        args = tuple(float(a) or 1.0 for a in call.args)
        yield Suspect(
            "zero-scale",
            at=call,
            change=Change(instead={str(call.number): [(call.name, args)]}),
            strength=94,
            state="GL_MODELVIEW_MATRIX",
            value=[float(a) for a in call.args],
            values={"call": written(call)},
            draws=[draw],
        )
        return

    points = found.positions[:, :3]
    if found.mode == "GL_POINTS" or not np.isfinite(points).all():
        return
    spread = np.linalg.svd(points - points.mean(axis=0), compute_uv=False)
    least = 2 if found.mode not in ("GL_LINES", "GL_LINE_STRIP", "GL_LINE_LOOP") else 1
    if len(spread) >= least and spread[least - 1] > 1e-6 * max(float(np.abs(points).max()), 1e-9):
        return
    yield Suspect(
        "no-area",
        at=draw.call,
        change=with_state(
            ["POLYGON", "POINT"],
            [("glPolygonMode", (gl.GL_FRONT_AND_BACK, gl.GL_POINT)), ("glPointSize", (9.0,))],
            [draw],
        ),
        strength=70,
        values={"n": len(points)},
        draws=[draw],
    )


def _vertex_call(draw: Drawn, found: Vertices, index: int) -> Call:
    place = found.places[index] if found.places else draw.place
    return next(step.call for step in draw.steps if step.place == place)


def _crossed(survey: Survey, draw: Drawn, found: Vertices, bad: Sequence[int]) -> Suspect:
    instead: dict[str, Any] = {}
    for index in bad:
        face = found.faces[index]
        a, b, c, d = (found.positions[k] for k in face)
        order = [a, b, d, c] if _area(a, b, d, c) >= _area(a, c, b, d) else [a, c, b, d]
        for k, point in zip(face, order, strict=True):
            if found.places:
                instead[found.places[k]] = [("glVertex4d", tuple(point.tolist()))]
    return Suspect(
        "crossed-quad",
        at=_vertex_call(draw, found, found.faces[bad[0]][2]),
        change=Change(instead=instead),
        strength=90,
        values={"n": len(bad)},
        draws=[draw],
        source=line_of(survey, draw),
    )


def _area(*corners: np.ndarray) -> float:
    points = np.array(corners)[:, :3]
    total = sum(np.cross(points[k], points[(k + 1) % 4]) for k in range(4))
    return float(np.linalg.norm(total))


def _concave(survey: Survey, draw: Drawn, found: Vertices, bad: Sequence[int]) -> Suspect:
    """Suspect polygons that are not convex; the change draws them as triangles that are."""
    triangles = [
        tuple(found.positions[k].tolist())
        for index in bad
        for triangle in ears(found.positions[found.faces[index]][:, :3])
        for k in (found.faces[index][j] for j in triangle)
    ]
    good = [k for k in range(len(found.faces)) if k not in set(bad)]

    def act() -> None:
        if found.mode == "GL_QUADS" and good:
            gl.glBegin(gl.GL_QUADS)
            for index in good:
                for k in found.faces[index]:
                    gl.glVertex4d(*found.positions[k])
            gl.glEnd()
        gl.glBegin(gl.GL_TRIANGLES)
        for point in triangles:
            gl.glVertex4d(*point)
        gl.glEnd()

    steps = draw.steps
    instead: dict[str, Any] = {step.place: () for step in steps if step.place}
    instead[steps[-1].place] = [act]
    return Suspect(
        "concave",
        at=draw.call,
        change=Change(instead=instead),
        strength=90 if not found.colors else 60,
        values={"n": len(bad), "mode": found.mode},
        draws=[draw],
        source=line_of(survey, draw),
    )


def ears(points: np.ndarray) -> list[tuple[int, int, int]]:
    """Cut a flat polygon, (n, 3), into triangles of its corners, ear by ear."""
    normal = sum(np.cross(points[k], points[(k + 1) % len(points)]) for k in range(len(points)))
    axis = int(np.argmax(np.abs(normal)))
    flat = np.delete(points, axis, axis=1)
    left = list(range(len(flat)))
    area = sum(flat[k - 1][0] * flat[k][1] - flat[k][0] * flat[k - 1][1] for k in range(len(flat)))
    if area < 0:
        left.reverse()
    found = []
    while len(left) > 3:
        for at in range(len(left)):
            a = left[at - 1]
            b = left[at]
            c = left[(at + 1) % len(left)]
            if _turn(flat[a], flat[b], flat[c]) <= 0:
                continue
            others = (k for k in left if k not in (a, b, c))
            if not any(_within(flat[k], flat[a], flat[b], flat[c]) for k in others):
                found.append((a, b, c))
                del left[at]
                break
        else:
            break

    return [*found, (left[0], left[1], left[2])]


def _turn(a: Any, b: Any, c: Any) -> float:
    return float((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))


def _within(p: Any, a: Any, b: Any, c: Any) -> bool:
    return _turn(a, b, p) >= 0 and _turn(b, c, p) >= 0 and _turn(c, a, p) >= 0


def matrices(survey: Survey) -> Iterator[Suspect]:
    """Matrices that are wrong by themselves, by the calls that made them."""
    shapes_ = survey.shapes
    if not shapes_:
        return
    for note in survey.glu:
        yield from _of_glu(survey, note)
    yield from _wide(survey)
    yield from _transposed(survey)
    yield from _radians(survey)
    yield from _wiped(survey)
    yield from _wrong_stack(survey)
    yield from _scaled_again(survey)
    yield from unbalanced(survey)


def _of_glu(survey: Survey, note: GluCall) -> Iterator[Suspect]:
    args = [float(a) for a in np.ravel(np.array(note.args, dtype=object)) if _number(a)]
    width, height = survey.tape.size
    if note.name == "gluPerspective" and len(args) == 4:
        fovy, aspect, near, far = args
        good = (
            fovy if 5 < fovy < 175 else 45.0,
            aspect if aspect > 0 else width / height,
            near if near > 0 else 0.1,
            far if far > near else 100.0,
        )
        if note.end == note.begin:
            state = _mode_at(survey, note)
            if aspect == 0.0:
                cause, values = "aspect-zero", {"call": written(note)}
            else:
                cause, values = "no-effect", {"call": written(note)}
            yield Suspect(
                cause,
                at=note,
                change=_with_projection(survey, lens(*good), state),
                strength=96,
                state=f"{state}_MATRIX",
                value=aspect,
                values=values,
            )
        elif 0 < fovy < 3.5:
            yield Suspect(
                "fovy-radians",
                at=note,
                change=_with_projection(
                    survey, lens(math.degrees(fovy), *good[1:]), _mode_at(survey, note)
                ),
                strength=93,
                state="GL_PROJECTION_MATRIX",
                value=fovy,
                values={"fovy": fovy, "degrees": round(math.degrees(fovy), 1)},
            )
        elif fovy >= 170 or aspect < 0 or near < 0 or far < near:
            yield Suspect(
                "perspective",
                at=note,
                change=_with_projection(survey, lens(*good), _mode_at(survey, note)),
                strength=90,
                state="GL_PROJECTION_MATRIX",
                value=args,
                values={"call": written(note)},
            )

    if note.name == "gluLookAt" and len(args) == 9:
        yield from _look_at(survey, note, args)


def _number(value: Any) -> bool:
    return isinstance(value, (int, float, np.generic)) and not isinstance(value, str)


def _mode_at(survey: Survey, note: GluCall) -> str:
    """Return which matrix a call of GLU multiplies, as far as the tape tells."""
    mode = "GL_MODELVIEW"
    if survey.past is not None and note.pass_ != "setup":
        known = survey.past.setters.last.get("GL_MATRIX_MODE")
        mode = _named(known) if known else mode
    for call in survey.tape.calls[: note.begin]:
        if call.name == "glMatrixMode":
            mode = _named(call)
    return mode


def _named(call: Call) -> str:
    return {0x1700: "GL_MODELVIEW", 0x1701: "GL_PROJECTION"}.get(int(call.args[0]), "GL_TEXTURE")


def _with_projection(survey: Survey, matrix: Any, mode: str = "GL_PROJECTION") -> Change:
    if mode != "GL_PROJECTION":
        return with_matrix(
            "GL_MODELVIEW", lambda d: matrix_of(d, "GL_MODELVIEW") @ matrix, survey.shapes
        )
    return with_matrix("GL_PROJECTION", lambda d: matrix, survey.shapes)


def _look_at(survey: Survey, note: GluCall, args: list[float]) -> Iterator[Suspect]:
    eye, center, up = np.array(args).reshape(3, 3)
    forward = center - eye
    length = np.linalg.norm(forward) * np.linalg.norm(up)
    parallel = length > 0 and np.linalg.norm(np.cross(forward, up)) < 1e-4 * length
    if not (parallel or length == 0):
        return
    axis = np.zeros(3)
    if length > 0:
        axis[int(np.argmin(np.abs(forward)))] = 1.0
        if np.abs(forward[2]) < np.abs(forward[1]):
            axis = np.array([0.0, 0.0, -1.0])
    else:
        axis = up if np.linalg.norm(up) else np.array([0.0, 1.0, 0.0])
        center = eye + np.array([0.0, 0.0, -1.0]) if not np.linalg.norm(forward) else center

    better = (*eye.tolist(), *center.tolist(), *axis.tolist())
    yield Suspect(
        "look-at-up" if parallel else "look-at-nowhere",
        at=note,
        change=_instead_of_glu(survey, note, better),
        strength=95,
        state="GL_MODELVIEW_MATRIX",
        value=args[6:],
        values={"call": written(note)},
    )


def _instead_of_glu(survey: Survey, note: GluCall, args: Sequence[float]) -> Change:
    """Return the change that calls GLU with other arguments."""
    function = glu_function(note.name)
    numbers = range(note.begin, note.end)
    frame = survey.tape.begin
    if note.begin < frame:
        old, new = _glu_matrix(note.name, note.args), _glu_matrix(note.name, args)
        mode = _mode_at(survey, note)
        if old is None or new is None or abs(np.linalg.det(old)) < 1e-12:
            return Change(start=[load(mode, new)] if new is not None else ())
        fixed = np.linalg.inv(old) @ new
        return with_matrix(mode, lambda d: matrix_of(d, mode) @ fixed, survey.shapes)
    instead: dict[str, Any] = {str(number): () for number in numbers}
    if not instead:
        return Change(before={str(note.begin): [lambda: function(*args)]})
    instead[str(note.begin)] = [lambda: function(*args)]
    return Change(instead=instead)


def _glu_matrix(name: str, args: Sequence[Any]) -> np.ndarray | None:
    """Return the matrix that a call of GLU multiplies by, found by making it."""
    gl.glPushMatrix()
    gl.glLoadIdentity()
    mode = int(gl.glGetIntegerv(gl.GL_MATRIX_MODE))
    glu_function(name)(*args)
    which = {0x1700: gl.GL_MODELVIEW_MATRIX, 0x1701: gl.GL_PROJECTION_MATRIX}
    found = np.array(gl.glGetDoublev(which.get(mode, gl.GL_MODELVIEW_MATRIX)))
    gl.glPopMatrix()
    return found.reshape(4, 4)


def _wide(survey: Survey) -> Iterator[Suspect]:
    """A frustum whose sides are given in degrees: the view is nearly 180 degrees wide."""
    groups: dict[int, list[Drawn]] = {}
    calls: dict[int, Call] = {}
    for draw in survey.shapes:
        call = draw.setter("GL_PROJECTION_MATRIX")
        if call is not None and call.name == "glFrustum":
            groups.setdefault(id(call), []).append(draw)
            calls[id(call)] = call

    for key, draws in groups.items():
        call = calls[key]
        left, right, bottom, top, near, _ = (float(a) for a in call.args)
        half = max(abs(left), abs(right), abs(bottom), abs(top))
        if near <= 0 or half / near < 8:
            continue
        yield Suspect(
            "frustum-wide",
            at=at_of(survey, call),
            change=narrowed(draws, half / near),
            strength=90,
            state="GL_PROJECTION_MATRIX",
            value=[float(a) for a in call.args],
            values={
                "angle": round(2 * math.degrees(math.atan(half / near))),
                "half": half,
                "near": near,
            },
            draws=draws,
        )


def _transposed(survey: Survey) -> Iterator[Suspect]:
    """A matrix given row by row, where OpenGL expects columns."""
    for call in survey.calls:
        if not call.name.startswith(("glLoadMatrix", "glMultMatrix")):
            continue
        if at_of(survey, call) is not call:
            continue
        flat = np.ravel(np.asarray(call.args[0], np.float64))
        if flat.size != 16 or not np.isfinite(flat).all():
            continue
        rows = np.abs(flat[[3, 7, 11]]).max()
        if rows > 1e-6 and np.abs(flat[12:15]).max() < 1e-9 and abs(flat[15] - 1) < 1e-6:
            other = flat.reshape(4, 4).T.copy()
            yield Suspect(
                "transposed",
                at=call,
                change=Change(instead={str(call.number): [(call.name[:-1] + "d", (other,))]}),
                strength=95,
                state="GL_MODELVIEW_MATRIX",
                value=flat.tolist(),
                values={"call": call.name},
            )


STEP = math.pi / 12


def _radians(survey: Survey) -> Iterator[Suspect]:
    """Angles of glRotate in radians: multiples of pi / 12, and no whole numbers."""
    found = []
    for call in survey.calls:
        if call.name.startswith("glRotate"):
            angle = float(call.args[0])
            steps = angle / STEP
            whole = abs(steps - round(steps)) < 1e-5 and round(steps) != 0
            if whole and abs(angle) < 6.3 and abs(angle - round(angle)) > 1e-4:
                found.append(call)

    if found:
        yield Suspect(
            "rotate-radians",
            at=found[0],
            change=Change(
                instead={
                    str(c.number): [(c.name, (math.degrees(float(c.args[0])), *c.args[1:]))]
                    for c in found
                }
            ),
            strength=75,
            state="GL_MODELVIEW_MATRIX",
            value=float(found[0].args[0]),
            values={
                "angle": round(float(found[0].args[0]), 4),
                "degrees": round(math.degrees(float(found[0].args[0])), 1),
            },
        )


PROJECTING = ("gluPerspective", "gluOrtho2D", "glOrtho", "glFrustum")


def _wiped(survey: Survey) -> Iterator[Suspect]:
    """A projection that a glLoadIdentity wipes: the matrix mode was not set back, or never set."""
    projected = [note for note in survey.glu if note.name in PROJECTING and note.end > note.begin]
    wiped: list[tuple[Any, str, Call]] = []
    calls = list(survey.tape.calls)
    notes: list[Any] = list(projected)
    inside = {n for note in projected for n in range(note.begin, note.end)}
    notes += [c for c in calls if c.name in PROJECTING and c.number not in inside]
    for note in notes:
        begin = note.begin if isinstance(note, GluCall) else note.number
        mode = _mode_of(survey, begin)
        current = mode
        pushed = 0
        for call in calls[begin + 1 :]:
            if call.name == "glMatrixMode":
                current = _named(call)
                if current == mode:
                    break  # chosen again: what follows is meant
            elif call.name == "glBegin" or call.name.startswith(("glDraw", "glRect", "glut")):
                break
            elif current == mode and call.name == "glPushMatrix":
                pushed += 1
            elif current == mode and call.name == "glPopMatrix":
                pushed -= 1
            elif current == mode and call.name == "glLoadIdentity" and pushed == 0:
                if not _again_after(survey, call):
                    wiped.append((note, mode, call))
                break

    for note, mode, call in wiped:
        matrix = _matrix_by(survey, note)
        if matrix is None:
            continue
        if mode == "GL_PROJECTION":
            # What came after the projection belongs to the modelview matrix.
            change = with_matrix("GL_PROJECTION", always(matrix), survey.shapes) | (
                with_matrix(
                    "GL_MODELVIEW",
                    lambda d: matrix_of(d, "GL_MODELVIEW") @ matrix_of(d, "GL_PROJECTION"),
                    survey.shapes,
                )
            )
        else:
            change = with_matrix("GL_PROJECTION", always(matrix), survey.shapes)
        yield Suspect(
            "projection-wiped" if mode == "GL_PROJECTION" else "projection-on-modelview",
            at=note,
            change=change,
            strength=92,
            state="GL_MATRIX_MODE",
            value=mode,
            values={"call": written(note), "wiped": call.site.line},
        )


def _again_after(survey: Survey, call: Call) -> bool:
    """Return whether a projection is set again after a call, before anything is drawn."""
    notes = {n: note for note in survey.glu for n in range(note.begin, note.end)}
    for later in survey.tape.calls[call.number + 1 :]:
        note = notes.get(later.number)
        if (note or later).name in PROJECTING:
            return True
        if note is None and later.name.startswith(("glLoadMatrix", "glMultMatrix")):
            return True
        if later.name == "glBegin" or later.name.startswith("glDraw"):
            return False
    return False


def _mode_of(survey: Survey, number: int) -> str:
    mode = "GL_MODELVIEW"
    for call in survey.tape.calls[:number]:
        if call.name == "glMatrixMode":
            mode = _named(call)
    return mode


def _matrix_by(survey: Survey, at: Any) -> np.ndarray | None:
    """Return the projection that a call makes."""
    former = int(gl.glGetIntegerv(gl.GL_MATRIX_MODE))
    gl.glMatrixMode(gl.GL_PROJECTION)
    gl.glPushMatrix()
    gl.glLoadIdentity()
    try:
        if isinstance(at, GluCall):
            glu_function(at.name)(*at.args)
        else:
            getattr(gl, at.name)(*at.args)
        return np.array(gl.glGetDoublev(gl.GL_PROJECTION_MATRIX)).reshape(4, 4)
    except Exception:
        return None
    finally:
        gl.glPopMatrix()
        gl.glMatrixMode(former)


CAMERA_CALLS = ("gluLookAt",)


def _wrong_stack(survey: Survey) -> Iterator[Suspect]:
    """A camera on the projection stack, or calls for an object on a stack that is none."""
    draws = survey.shapes
    for note in survey.glu:
        if note.name in CAMERA_CALLS and _mode_at(survey, note) == "GL_PROJECTION":
            matrix = _matrix_by(survey, note)
            if matrix is None or abs(np.linalg.det(matrix)) < 1e-12:
                continue
            change = moved_camera(draws, matrix)
            yield Suspect(
                "camera-in-projection",
                at=note,
                change=change,
                strength=88,
                state="GL_PROJECTION_MATRIX",
                values={"call": written(note)},
            )
            break

    yield from _left_mode(survey)


def moved_camera(draws: Sequence[Drawn], camera: np.ndarray) -> Change:
    """Return the change that takes a camera from the projection matrix into the modelview one."""
    inverse = np.linalg.inv(camera)
    return with_matrix(
        "GL_PROJECTION", lambda d: inverse @ matrix_of(d, "GL_PROJECTION"), draws
    ) | with_matrix("GL_MODELVIEW", lambda d: matrix_of(d, "GL_MODELVIEW") @ camera, draws)


def narrowed(draws: Sequence[Drawn], factor: float) -> Change:
    """Return the change that makes the angle of view smaller: the tangent of its half, so often."""
    fixed = np.diag((factor, factor, 1.0, 1.0))
    return with_matrix("GL_PROJECTION", lambda d: matrix_of(d, "GL_PROJECTION") @ fixed, draws)


def always(matrix: np.ndarray) -> Callable[[Drawn], np.ndarray]:
    """Return what gives every draw the same matrix."""
    return lambda draw: matrix


def _left_mode(survey: Survey) -> Iterator[Suspect]:
    """Transformations of objects made while the mode is GL_TEXTURE or GL_PROJECTION."""
    mode_call: Call | None = None
    mode = "GL_MODELVIEW"
    known = survey.past.setters.last.get("GL_MATRIX_MODE") if survey.past else None
    if survey.tape.begin and known is not None:
        mode_call, mode = known, _named(known)

    for call in survey.calls:
        if call.name == "glMatrixMode":
            mode_call, mode = call, _named(call)
        elif mode == "GL_MODELVIEW" or mode_call is None:
            continue
        elif call.name.startswith(("glTranslate", "glRotate", "glScale")):
            if _set_back(survey, call) or isinstance(at_of(survey, call), GluCall):
                continue
            after = next((d for d in survey.shapes if d.number > call.number), None)
            if mode == "GL_TEXTURE" and (after is None or any(after.state[n] for n in TEXTURES)):
                continue
            if mode == "GL_PROJECTION" and after is not None and survey.seen(after):
                continue  # it shows something, so it may be meant
            place = str(_first_of_object(survey, call).number)
            yield Suspect(
                "matrix-mode",
                at=mode_call,
                change=Change(before={place: [("glMatrixMode", (gl.GL_MODELVIEW,))]}),
                strength=82 if mode == "GL_TEXTURE" else 76,
                state="GL_MATRIX_MODE",
                value=mode,
                values={"call": written(call), "line": call.site.line, "mode": mode},
            )
            return


def _first_of_object(survey: Survey, call: Call) -> Call:
    """Return the first of the calls for matrices before a call, after the last draw."""
    first = call
    for earlier in reversed(survey.tape.calls[survey.tape.begin : call.number]):
        if earlier.name in ("glEnd", "glMatrixMode") or spec.draws(earlier.name):
            break
        if earlier.name.startswith(MATRIX):
            first = earlier
    return first


TEXTURES = tuple(
    f"GL_TEXTURE{unit}.GL_TEXTURE_{kind}"
    for unit, kind in ((0, "1D"), (0, "2D"), (0, "3D"), (0, "CUBE_MAP"), (1, "2D"))
)


def _set_back(survey: Survey, call: Call) -> bool:
    """Return whether the mode is set back before the next draw."""
    for later in survey.tape.calls[call.number + 1 :]:
        if later.name == "glMatrixMode":
            return True
        if later.name == "glBegin" or later.name.startswith(("glDraw", "glut", "glRect")):
            return False
    return False


def _scaled_again(survey: Survey) -> Iterator[Suspect]:
    """A scale that piles up from object to object: nothing undoes it in between."""
    for draw in reversed(survey.shapes):
        chain = draw.setters.chained.get("GL_MODELVIEW_MATRIX", [])
        lines: dict[Any, list[Call]] = {}
        for call in chain:
            if call.name.startswith("glScale") and call.number >= survey.tape.begin:
                lines.setdefault((call.site.path, call.site.line), []).append(call)
        repeated = [calls for calls in lines.values() if len(calls) > 1]
        repeated = [calls for calls in repeated if _meant_alone(calls)]
        if not repeated:
            continue
        calls = repeated[0]
        change = _undone(survey, calls[0].site.function)
        if change is not None:
            yield Suspect(
                "piled-up",
                at=calls[0],
                change=change,
                strength=89,
                state="GL_MODELVIEW_MATRIX",
                values={"function": calls[0].site.function, "times": len(calls)},
            )

        return


def _meant_alone(calls: Sequence[Call]) -> bool:
    """Return whether scales are each meant for one object: uneven ones, or of several sizes.

    One that is the same in each direction and each time may well pile up, as in a spiral.
    """
    sizes = [tuple(abs(float(a)) for a in call.args) for call in calls]
    uneven = any(max(size) - min(size) > 1e-6 for size in sizes)
    return uneven or len(set(sizes)) > 1


def _undone(survey: Survey, function: str) -> Change | None:
    """Return the change that undoes, after each run of a function, what it did to the matrix."""
    before: dict[str, Any] = {}
    after: dict[str, Any] = {}
    chains = survey.past.chains if survey.past else {}
    run: Any = None
    last = ""
    for call in survey.calls:
        chain = chains.get(call.number)
        if chain is None:
            continue
        depth = next((k for k, (name, _) in enumerate(chain) if name == function), None)
        outer = chain[:depth] if depth is not None else None
        line = chain[depth][1] if depth is not None else 0
        if run is not None and (outer != run[0] or line < run[1]):
            after.setdefault(last, []).append(("glPopMatrix", ()))
            run = None
        if outer is not None:
            if run is None:
                before.setdefault(str(call.number), []).append(("glPushMatrix", ()))
            run, last = (outer, line), _end_of(survey, call)

    if run is not None:
        after.setdefault(last, []).append(("glPopMatrix", ()))
    return Change(before=before, after=after) if before else None


def _end_of(survey: Survey, call: Call) -> str:
    """Return the place of a call, or of the glEnd that belongs to a glBegin."""
    if call.name != "glBegin":
        return str(call.number)
    for later in survey.tape.calls[call.number :]:
        if later.name == "glEnd":
            return str(later.number)
    return str(call.number)


def unbalanced(survey: Survey) -> Iterator[Suspect]:
    """A glPushMatrix without its glPopMatrix, or one glPopMatrix too many."""
    depth = 0
    pushes: list[Call] = []
    for call in survey.calls:
        if call.name == "glPushMatrix":
            pushes.append(call)
            depth += 1
        elif call.name == "glPopMatrix":
            depth -= 1
            if pushes:
                pushes.pop()
            elif any("underflow" in said for _, _, said in survey.errors):
                yield Suspect(
                    "pop-too-many",
                    at=call,
                    change=Change(instead={str(call.number): ()}),
                    strength=80,
                    state="GL_MODELVIEW_STACK_DEPTH",
                )

    if not pushes:
        return
    change = _popped(survey)
    if change is not None:
        yield _without_pop(pushes, change, 84)
    if survey.past is not None and survey.past.frame:
        # What the frames before have left on the stack may have filled it.
        yield _without_pop(pushes, Change(start=[_emptied]) | (change or NOTHING), 82)

    # Else nobody can tell where it was forgotten: after a draw that follows, or at the end.
    after = [draw for draw in survey.shapes if draw.number > pushes[-1].number]
    ends = [_end_of(survey, draw.call) for draw in after if "." not in draw.place][:TRIED]
    for index, end in enumerate(dict.fromkeys([*ends, str(survey.calls[-1].number)])):
        change = Change(after={end: [("glPopMatrix", ())]})
        yield _without_pop(pushes, change, 83 - index / 10)


def _emptied() -> None:
    """Take all matrices from the modelview stack."""
    mode = int(gl.glGetIntegerv(gl.GL_MATRIX_MODE))
    gl.glMatrixMode(gl.GL_MODELVIEW)
    while int(gl.glGetIntegerv(gl.GL_MODELVIEW_STACK_DEPTH)) > 1:
        gl.glPopMatrix()
    gl.glMatrixMode(mode)


def _without_pop(pushes: Sequence[Call], change: Change, strength: float) -> Suspect:
    return Suspect(
        "push-without-pop",
        at=pushes[-1],
        change=change,
        strength=strength,
        state="GL_MODELVIEW_STACK_DEPTH",
        value=len(pushes),
        values={"n": len(pushes)},
    )


def _popped(survey: Survey) -> Change | None:
    """Return the change that pops what a function has pushed when it ends, or goes on to the next.

    None where the calls do not tell when that is.
    """
    chains = survey.past.chains if survey.past else {}
    open_: list[Chain] = []  # of each glPushMatrix that waits for its glPopMatrix
    before: dict[str, Any] = {}
    for call in survey.calls:
        chain = chains.get(call.number)
        if chain is None:
            continue
        missing = 0
        while open_ and call.name != "glPopMatrix" and _left(open_[-1], chain):
            open_.pop()
            missing += 1
        if missing:
            before[str(call.number)] = [("glPopMatrix", ())] * missing
        if call.name == "glPushMatrix":
            open_.append(chain)
        elif call.name == "glPopMatrix" and open_:
            open_.pop()
    return Change(before=before) if before else None


def _left(pushed: Chain, now: Chain) -> bool:
    """Return whether a function that has pushed a matrix has ended, or begins its loop again."""
    depth = len(pushed) - 1
    if now[:depth] != pushed[:depth] or len(now) <= depth or now[depth][0] != pushed[depth][0]:
        return True
    return now[depth][1] <= pushed[depth][1]


TRIED = 6  # draws after which a missing glPopMatrix is tried; chosen


def outside(survey: Survey) -> Iterator[Suspect]:
    """Draws that lie outside the view volume: behind the eye, too near, too far, beside."""
    for group in survey.hidden():
        mine = [d for d in group if not d.covered and d.placed is not None and d.placed.faces]
        if not mine:
            continue
        finite = [d for d in mine if d.placed is not None and d.placed.finite]
        if not finite:
            yield from _infinite(survey, mine)
            continue
        yield from _placed(survey, finite)


def _infinite(survey: Survey, mine: list[Drawn]) -> Iterator[Suspect]:
    for mode in ("GL_MODELVIEW", "GL_PROJECTION"):
        if not np.isfinite(matrix_of(mine[0], mode)).all():
            call = mine[0].setter(f"{mode}_MATRIX")
            yield Suspect(
                "nan-matrix",
                at=at_of(survey, call),
                change=with_matrix(mode, lambda d: np.eye(4), mine),
                strength=90,
                state=f"{mode}_MATRIX",
                values={"matrix": f"{mode}_MATRIX"},
                draws=mine,
            )


def _placed(survey: Survey, mine: list[Drawn]) -> Iterator[Suspect]:
    placed = [d.placed for d in mine if d.placed is not None]
    count = sum(p.count for p in placed)
    behind = sum(p.behind for p in placed)
    nearest = min(p.distances[0] for p in placed)
    farthest = max(p.distances[1] for p in placed)
    near, far = near_far(mine[0].state["GL_PROJECTION_MATRIX"])
    values = {"n": count, "behind": behind, "nearest": nearest, "farthest": farthest}
    values |= {"near": near, "far": far}
    if is_identity(mine[0].state["GL_PROJECTION_MATRIX"]):
        if abs(mine[0].state["GL_MODELVIEW_MATRIX"][11]) > 1e-6:
            # The projection stands in the modelview matrix, as in many short programs: w tells.
            w = np.concatenate([p.clip[:, 3] for p in placed])
            values |= {"behind": int((w < 0).sum()), "nearest": w.min(), "farthest": w.max()}
            if (w < 0).all():
                yield from _turned_round(survey, mine, values)
            return
        yield from _units(survey, mine, values)
        return

    lensed = perspective(mine[0].state["GL_PROJECTION_MATRIX"])
    if lensed and behind == count:
        yield from _behind(survey, mine, values, farthest - nearest)
    between = sum(int(((p.eye[:, 2] < 0) & (-p.eye[:, 2] < near)).sum()) for p in placed)
    if lensed and between * 3 >= count and all("near" in p.outside for p in placed):
        yield _other_plane(survey, mine, "near", max(nearest, farthest / 50, 1e-4) / 4, values)
    if all("far" in p.outside for p in placed):
        yield _other_plane(survey, mine, "far", farthest * 2 + 1, values)
    if not lensed and all("near" in p.outside for p in placed):
        yield _other_plane(survey, mine, "near", nearest - abs(nearest) - 1, values)
    yield from _beside(survey, mine, values)


def _behind(
    survey: Survey, mine: list[Drawn], values: dict[str, Any], size: float
) -> Iterator[Suspect]:
    tried = False
    for suspect in _turned_round(survey, mine, values):
        tried = True
        yield suspect
    if tried:
        return

    chain = mine[0].setters.chained.get("GL_MODELVIEW_MATRIX", [])
    away = values["nearest"] - 1.5 * max(size, 1.0) - values["near"]
    moved = np.eye(4)
    moved[3, 2] = away
    camera = at_of(survey, chain[-1]) if chain else None
    yield Suspect(
        "behind",
        at=camera or mine[0].call,
        change=with_matrix("GL_MODELVIEW", lambda d: matrix_of(d, "GL_MODELVIEW") @ moved, mine),
        strength=80,
        state="GL_MODELVIEW_MATRIX",
        value=values["farthest"],
        values=values | {"call": written(camera or mine[0].call)},
        draws=mine,
    )


def _turned_round(survey: Survey, mine: list[Drawn], values: dict[str, Any]) -> Iterator[Suspect]:
    """Yield the translations towards the eye that would be right with the other sign."""
    chain = mine[0].setters.chained.get("GL_MODELVIEW_MATRIX", [])
    for call in reversed(chain):
        if not call.name.startswith("glTranslate") or float(call.args[2]) <= 0:
            continue
        x, y, z = (float(a) for a in call.args)
        if call.number < survey.tape.begin or survey.tape.calls[call.number] is not call:
            continue
        if isinstance(at_of(survey, call), GluCall):
            continue
        yield Suspect(
            "behind",
            at=call,
            change=Change(instead={str(call.number): [(call.name, (x, y, -z))]}),
            strength=86,
            state="GL_MODELVIEW_MATRIX",
            value=z,
            values=values | {"call": written(call)},
            draws=mine,
            appear=True,
        )


def _other_plane(
    survey: Survey, mine: list[Drawn], plane: str, new: float, values: dict[str, Any]
) -> Suspect:
    call = mine[0].setter("GL_PROJECTION_MATRIX")
    at = at_of(survey, call)
    projection = list(mine[0].state["GL_PROJECTION_MATRIX"])
    alike = [d for d in survey.shapes if list(d.state["GL_PROJECTION_MATRIX"]) == projection]

    return Suspect(
        f"beyond-{plane}",
        at=at or mine[0].call,
        change=with_matrix(
            "GL_PROJECTION",
            lambda d: with_planes(
                d.state["GL_PROJECTION_MATRIX"],
                new if plane == "near" else None,
                new if plane == "far" else None,
            ),
            alike,
        ),
        strength=84,
        state="GL_PROJECTION_MATRIX",
        value=values[plane],
        values=values | {"call": written(at) if at else ""},
        draws=mine,
        appear=True,
    )


def _units(survey: Survey, mine: list[Drawn], values: dict[str, Any]) -> Iterator[Suspect]:
    """Yield that pixels are given where OpenGL, without a projection, has -1 to 1."""
    width, height = survey.tape.size
    points = np.concatenate([d.placed.eye for d in mine if d.placed is not None])[:, :3]
    if np.abs(points).max() <= 1.0:
        return
    projections = [ortho(0, width, 0, height), ortho(0, width, height, 0)]
    if points[:, 2].max() < 0 and np.abs(points[:, :2]).max() < 100:
        projections = [lens(45.0, width / height, 0.1, 1000.0)]
    for projection in projections:
        yield Suspect(
            "no-projection",
            at=mine[0].call,
            change=with_matrix("GL_PROJECTION", always(projection), mine),
            strength=83,
            state="GL_PROJECTION_MATRIX",
            value="identity",
            values=values,
            draws=mine,
        )


def _beside(survey: Survey, mine: list[Drawn], values: dict[str, Any]) -> Iterator[Suspect]:
    """Yield that a function's transformations are not undone, and push others out of the view."""
    chain = mine[0].setters.chained.get("GL_MODELVIEW_MATRIX", [])
    loading = {call.site.function for call in chain if call.name.startswith("glLoad")}
    names = {
        call.site.function
        for call in chain
        if call.number >= survey.tape.begin and isinstance(at_of(survey, call), Call)
    }
    for name in sorted(names - loading):
        change = _undone(survey, name)
        if change is not None:
            chain = mine[0].setters.chained["GL_MODELVIEW_MATRIX"]
            call = next(c for c in chain if c.site.function == name)
            yield Suspect(
                "not-undone",
                at=call,
                change=change,
                strength=72,
                state="GL_MODELVIEW_MATRIX",
                values=values | {"function": name},
                draws=mine,
                appear=True,
            )

    if survey.empty:
        moved = np.eye(4)
        points = np.concatenate([d.placed.eye[:, :3] for d in mine if d.placed is not None])
        middle = (points.min(axis=0) + points.max(axis=0)) / 2
        size = float(np.ptp(points, axis=0).max())
        moved[3, :3] = [-middle[0], -middle[1], -middle[2] - max(size, 1.0) * 2.0]
        chain = mine[0].setters.chained.get("GL_MODELVIEW_MATRIX", [])
        at = at_of(survey, chain[-1]) if chain else mine[0].call
        yield Suspect(
            "beside",
            at=at,
            change=with_matrix(
                "GL_MODELVIEW", lambda d: matrix_of(d, "GL_MODELVIEW") @ moved, mine
            ),
            strength=55,
            state="GL_MODELVIEW_MATRIX",
            values=values | {"sides": ", ".join(_sides(mine))},
            draws=mine,
        )


def _sides(mine: list[Drawn]) -> list[str]:
    names: list[str] = []
    for draw in mine:
        if draw.placed is not None:
            names += [name for name in draw.placed.outside if name not in names]
    return names or ["outside"]


def left_behind(survey: Survey) -> Iterator[Suspect]:
    """A function, called several times, that moves what it draws and does not move back.

    Only where a pixel is asked about: a chain of links is drawn in this way, too.
    """
    if survey.pixel is None or survey.past is None:
        return
    for function in sorted(_movers(survey)):
        change = _undone(survey, function)
        chains = survey.past.chains
        call = next(c for c in survey.calls if c.site.function == function and c.number in chains)
        if change is not None:
            yield Suspect(
                "not-undone",
                at=call,
                change=change,
                strength=66,
                state="GL_MODELVIEW_MATRIX",
                values={"function": function},
            )


def _movers(survey: Survey) -> set[str]:
    """Return the functions that end with a draw, and multiply the matrix before it each time.

    Who moves on after the draw means it so: the next link begins where this one ends.
    """
    chains = survey.past.chains if survey.past else {}
    turns: dict[str, list[str]] = {}
    for call in survey.calls:
        if call.number in chains and not isinstance(at_of(survey, call), GluCall):
            turns.setdefault(call.site.function, []).append(_kind(call))
    return {
        function
        for function, kinds in turns.items()
        if not {"stack", "load"} & set(kinds)
        and "".join(kinds).count("movedraw") > 1
        and kinds[0] == "move"
        and kinds[-1] == "draw"
    }


def _kind(call: Call) -> str:
    if call.name in ("glPushMatrix", "glPopMatrix"):
        return "stack"
    if call.name.startswith("glLoad"):
        return "load"
    return "move" if call.name.startswith(MATRIX) else "draw"


def near_cuts(survey: Survey) -> Iterator[Suspect]:
    """A near plane that cuts off a part of what the pixel asked about should show."""
    if survey.pixel is None:
        return
    mine = []
    for draw in survey.shapes:
        placed = draw.placed
        if placed is None or not perspective(draw.state["GL_PROJECTION_MATRIX"]):
            continue
        near, _ = near_far(draw.state["GL_PROJECTION_MATRIX"])
        front = (placed.eye[:, 2] < 0) & (-placed.eye[:, 2] < near)
        if front.any() and near >= 0.5:
            mine.append(draw)

    if mine:
        values: dict[str, Any] = {"near": near_far(mine[0].state["GL_PROJECTION_MATRIX"])[0]}
        placed = mine[0].placed
        assert placed is not None
        nearest, farthest = placed.distances
        values |= {"nearest": nearest, "farthest": farthest, "n": placed.count, "far": 0.0}
        yield _other_plane(survey, mine, "near", max(nearest, values["near"] / 50) / 4, values)


__all__ = ["RULES", "cap"]
RULES = (shapes, matrices, outside, left_behind, near_cuts)
