"""Rules about matrices that are wrong as such, by the calls that made them.

An aspect of 0, a frustum of nearly 180 degrees, rows for columns, degrees for radians, a camera or
a projection on the wrong stack, a stack that is not balanced.
"""

import math
from collections.abc import Iterable, Iterator, Sequence
from typing import Any

import numpy as np

from framelens.gl.named import gl_function
from framelens.gl.seam import Call, GluCall, gl
from framelens.program.past import MATRIX
from framelens.program.program_run import Chain
from framelens.spec import spec
from framelens.why.mends import (
    always,
    end_of,
    glu_function,
    instead_of_glu,
    mode_at,
    mode_named,
    undone,
)
from framelens.why.survey import Drawn, Survey
from framelens.why.suspects import Suspect, at_of, lens, matrix_of, textured, with_matrix, written
from framelens.why.trial import NOTHING, Action, Change


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
    yield from _camera_wiped(survey)
    yield from _picking(survey)
    yield from _singular(survey)
    yield from _wrong_stack(survey)
    yield from _scaled_again(survey)
    yield from unbalanced(survey)


def _without_effect(
    survey: Survey, note: GluCall, aspect: float, projection: np.ndarray
) -> Suspect:
    """Return that a gluPerspective made no call of OpenGL; ``projection`` is one that would."""
    state = mode_at(survey, note)
    return Suspect(
        "aspect-zero" if aspect == 0.0 else "no-effect",
        at=note,
        change=_with_projection(survey, projection, state),
        strength=96,
        state=f"{state}_MATRIX",
        value=aspect,
        values={"call": written(note)},
    )


def _of_glu(survey: Survey, note: GluCall) -> Iterator[Suspect]:
    args = [float(a) for a in np.ravel(np.array(note.args, dtype=object)) if _number(a)]
    width, height = survey.tape.size
    if note.name == "gluPerspective" and len(args) == 4:
        fovy, aspect, near, far = args
        good = (
            fovy if 5 < fovy < 175 else 45.0,
            aspect if aspect > 0 else width / height,
            *_planes(near, far),
        )
        if note.end == note.begin:
            yield _without_effect(survey, note, aspect, lens(*good))
        elif 0 < fovy < 3.5:
            yield Suspect(
                "fovy-radians",
                at=note,
                change=_with_projection(
                    survey, lens(math.degrees(fovy), *good[1:]), mode_at(survey, note)
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
                change=_with_projection(survey, lens(*good), mode_at(survey, note)),
                strength=90,
                state="GL_PROJECTION_MATRIX",
                value=args,
                values={"call": written(note)},
            )

    if note.name == "gluLookAt" and len(args) == 9:
        yield from _look_at(survey, note, args)


def _planes(near: float, far: float) -> tuple[float, float]:
    """Return two planes of a perspective that are right: the given ones, or better ones."""
    if 0 < far < near:
        return far, near
    near = near if near > 0 else 0.1
    return near, far if far > near else near * 1000.0


def _number(value: object) -> bool:
    return isinstance(value, (int, float, np.generic)) and not isinstance(value, str)


def _with_projection(survey: Survey, matrix: np.ndarray, mode: str = "GL_PROJECTION") -> Change:
    if mode != "GL_PROJECTION":
        return with_matrix(
            "GL_MODELVIEW", lambda d: matrix_of(d, "GL_MODELVIEW") @ matrix, survey.shapes
        )
    return with_matrix("GL_PROJECTION", lambda d: matrix, survey.shapes)


def _across(forward: np.ndarray) -> np.ndarray:
    """Return an axis that can be up for who looks ``forward``, (3,)."""
    if np.abs(forward[2]) < np.abs(forward[1]):
        return np.array([0.0, 0.0, -1.0])
    axis = np.zeros(3)
    axis[int(np.argmin(np.abs(forward)))] = 1.0
    return axis


def _look_at(survey: Survey, note: GluCall, args: list[float]) -> Iterator[Suspect]:
    eye, center, up = np.array(args).reshape(3, 3)
    forward = center - eye
    length = np.linalg.norm(forward) * np.linalg.norm(up)
    parallel = length > 0 and np.linalg.norm(np.cross(forward, up)) < 1e-4 * length
    if not (parallel or length == 0):
        return
    if length > 0:
        axis = _across(forward)
    else:
        axis = up if np.linalg.norm(up) else np.array([0.0, 1.0, 0.0])
        center = eye + np.array([0.0, 0.0, -1.0]) if not np.linalg.norm(forward) else center

    better = (*eye.tolist(), *center.tolist(), *axis.tolist())
    yield Suspect(
        "look-at-up" if parallel else "look-at-nowhere",
        at=note,
        change=instead_of_glu(survey, note, better),
        strength=95,
        state="GL_MODELVIEW_MATRIX",
        value=args[6:],
        values={"call": written(note)},
    )


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


def _wiping(calls: Iterable[Call], mode: str) -> Call | None:
    """Return the glLoadIdentity that wipes what a mode's matrix had before; None if none does."""
    current = mode
    pushed = 0
    for call in calls:
        if call.name == "glMatrixMode":
            current = mode_named(call)
            if current == mode:
                return None  # chosen again: what follows is meant
        elif call.name == "glBegin" or call.name.startswith(("glDraw", "glRect", "glut")):
            return None
        elif current == mode and call.name == "glPushMatrix":
            pushed += 1
        elif current == mode and call.name == "glPopMatrix":
            pushed -= 1
        elif current == mode and call.name == "glLoadIdentity" and pushed == 0:
            return call
    return None


def _modelview_after(survey: Survey) -> Change:
    """Return the change that gives what was multiplied to a projection to the modelview matrix."""
    return with_matrix(
        "GL_MODELVIEW",
        lambda d: matrix_of(d, "GL_MODELVIEW") @ matrix_of(d, "GL_PROJECTION"),
        survey.shapes,
    )


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
        call = _wiping(calls[begin + 1 :], mode)
        if call is not None and not _again_after(survey, call):
            wiped.append((note, mode, call))

    for note, mode, call in wiped:
        matrix = _matrix_by(survey, note)
        if matrix is None:
            continue
        change = with_matrix("GL_PROJECTION", always(matrix), survey.shapes)
        if mode == "GL_PROJECTION":
            change |= _modelview_after(survey)
        yield Suspect(
            "projection-wiped" if mode == "GL_PROJECTION" else "projection-on-modelview",
            at=note,
            change=change,
            strength=92,
            state="GL_MATRIX_MODE",
            value=mode,
            values={"call": written(note), "wiped": call.site.line},
        )


def _camera_wiped(survey: Survey) -> Iterator[Suspect]:
    """Yield that a glLoadIdentity wipes the camera of a gluLookAt before anything is drawn."""
    calls = survey.tape.calls
    for note in survey.glu:
        if note.name not in CAMERA_CALLS or note.begin < survey.tape.begin or note.pass_ == "setup":
            continue
        mode = mode_at(survey, note)
        for call in calls[note.end :]:
            if spec.draws(call.name) or call.name in ("glMatrixMode", "glPushMatrix"):
                break
            if call.name == "glLoadIdentity":
                yield from _without_camera(survey, note, mode, call)
                break


def _without_camera(survey: Survey, note: GluCall, mode: str, wiped: Call) -> Iterator[Suspect]:
    mine = [draw for draw in survey.shapes if draw.number > wiped.number]
    camera = _matrix_by(survey, note)
    if mode != "GL_MODELVIEW" or not mine or camera is None:
        return
    if np.abs(matrix_of(mine[0], mode)[3, :3]).max() > 1e-6:
        return  # what is drawn is moved away from the eye in another way
    yield Suspect(
        "camera-wiped",
        at=wiped,
        change=with_matrix(mode, lambda d: matrix_of(d, mode) @ camera, mine),
        strength=92,
        state="GL_MODELVIEW_MATRIX",
        values={"call": written(note), "line": note.site.line},
        draws=mine,
    )


def _picking(survey: Survey) -> Iterator[Suspect]:
    """Yield that the small region of gluPickMatrix is still in force where a picture is drawn."""
    for draw in survey.shapes:
        if draw.state.get("GL_RENDER_MODE") not in (None, "GL_RENDER"):
            continue
        chain = draw.setters.chained.get("GL_PROJECTION_MATRIX", [])
        notes = [at for call in chain if isinstance(at := at_of(survey, call), GluCall)]
        note = next((each for each in notes if each.name == "gluPickMatrix"), None)
        region = _matrix_by(survey, note) if note is not None else None
        if note is None or region is None or abs(np.linalg.det(region)) < 1e-12:
            continue

        mine = [
            each
            for each in survey.shapes
            if each.setters.chained.get("GL_PROJECTION_MATRIX", [])[: len(chain)] == chain
        ]
        yield Suspect(
            "pick-matrix-left",
            at=note,
            change=_times("GL_PROJECTION", np.linalg.inv(region), mine),
            strength=93,
            state="GL_PROJECTION_MATRIX",
            values={"call": written(note), "line": mine[0].call.site.line},
            draws=mine,
        )
        return


def _times(mode: str, matrix: np.ndarray, draws: Sequence[Drawn]) -> Change:
    """Return the change that multiplies a matrix of draws, after all that it does already."""
    return with_matrix(mode, lambda d: matrix_of(d, mode) @ matrix, draws)


def _singular(survey: Survey) -> Iterator[Suspect]:
    """Yield that a matrix handed over maps everything to a plane, a line or a point."""
    for mode in ("GL_MODELVIEW", "GL_PROJECTION"):
        mine = [draw for draw in survey.shapes if not draw.covered and _flattens(draw, mode)]
        setter = mine[0].setter(f"{mode}_MATRIX") if mine else None
        if setter is None or not setter.name.startswith(("glLoadMatrix", "glMultMatrix")):
            continue
        if isinstance(at_of(survey, setter), GluCall):
            continue
        yield Suspect(
            "matrix-zero",
            at=setter,
            change=_made_regular(mode, mine),
            strength=90,
            state=f"{mode}_MATRIX",
            value=[float(v) for v in mine[0].state[f"{mode}_MATRIX"]],
            values={"call": setter.name, "matrix": f"{mode}_MATRIX"},
            draws=mine,
        )


def _made_regular(mode: str, draws: Sequence[Drawn]) -> Change:
    return with_matrix(mode, lambda d: _regular(matrix_of(d, mode)), draws)


def _flattens(draw: Drawn, mode: str) -> bool:
    """Return whether a draw's matrix has no inverse."""
    matrix = matrix_of(draw, mode)
    return bool(np.isfinite(matrix).all()) and abs(float(np.linalg.det(matrix))) < 1e-12


def _regular(matrix: np.ndarray) -> np.ndarray:
    """Return a matrix with ones on its diagonal where it had zeros."""
    better = matrix.copy()
    for k in range(4):
        if better[k, k] == 0.0:
            better[k, k] = 1.0
    return better


def _again_after(survey: Survey, call: Call) -> bool:
    """Return whether a projection is set again after a call, before anything is drawn."""
    notes = {n: note for note in survey.glu for n in range(note.begin, note.end)}
    for later in survey.tape.calls[call.number + 1 :]:
        note = notes.get(later.number)
        if (note or later).name in PROJECTING:
            return True
        if note is None and later.name.startswith(("glLoadMatrix", "glMultMatrix")):
            return True
        if spec.draws(later.name):
            return False
    return False


def _mode_of(survey: Survey, number: int) -> str:
    mode = "GL_MODELVIEW"
    for call in survey.tape.calls[:number]:
        if call.name == "glMatrixMode":
            mode = mode_named(call)
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
            gl_function(at.name)(*at.args)
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
        if note.name in CAMERA_CALLS and mode_at(survey, note) == "GL_PROJECTION":
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


def _may_be_meant(survey: Survey, call: Call, mode: str) -> bool:
    """Return whether a transformation may be meant for a matrix other than the modelview."""
    after = next((d for d in survey.shapes if d.number > call.number), None)
    if mode == "GL_TEXTURE":
        return after is None or textured(after)
    # If it shows something.
    return mode == "GL_PROJECTION" and after is not None and survey.seen(after)


def _left_mode(survey: Survey) -> Iterator[Suspect]:
    """Transformations of objects made while the mode is GL_TEXTURE or GL_PROJECTION."""
    mode_call: Call | None = None
    mode = "GL_MODELVIEW"
    known = survey.past.setters.last.get("GL_MATRIX_MODE") if survey.past else None
    if survey.tape.begin and known is not None:
        mode_call, mode = known, mode_named(known)

    for call in survey.calls:
        if call.name == "glMatrixMode":
            mode_call, mode = call, mode_named(call)
        elif mode == "GL_MODELVIEW" or mode_call is None:
            continue
        elif call.name.startswith(("glTranslate", "glRotate", "glScale")):
            if _set_back(survey, call) or isinstance(at_of(survey, call), GluCall):
                continue
            if _may_be_meant(survey, call, mode):
                continue
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
        lines: dict[object, list[Call]] = {}
        for call in chain:
            if call.name.startswith("glScale") and call.number >= survey.tape.begin:
                lines.setdefault((call.site.path, call.site.line), []).append(call)
        repeated = [calls for calls in lines.values() if len(calls) > 1]
        repeated = [calls for calls in repeated if _meant_alone(calls)]
        if not repeated:
            continue
        calls = repeated[0]
        change = undone(survey, calls[0].site.function)
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

    if pushes:
        yield from _never_popped(survey, pushes)


def _never_popped(survey: Survey, pushes: list[Call]) -> Iterator[Suspect]:
    """Yield where the glPopMatrix of ``pushes`` may be missing."""
    change = _popped(survey)
    if change is not None:
        yield _without_pop(pushes, change, 84)
    if survey.past is not None and survey.past.frame:
        # Matrices that earlier frames left on the stack may have filled it.
        yield _without_pop(pushes, Change(start=[_emptied]) | (change or NOTHING), 82)

    # Else nobody can tell where it was forgotten: after a draw that follows, or at the end.
    after = [draw for draw in survey.shapes if draw.number > pushes[-1].number]
    ends = [end_of(survey, draw.call) for draw in after if "." not in draw.place][:TRIED]
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
    before: dict[str, list[Action]] = {}
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


RULES = (matrices,)
