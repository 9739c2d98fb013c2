"""Changes that several rules try, of matrices: other arguments for GLU, a function undone.

Suspects hand them over; see suspects.py for the plain ones.
"""

from collections.abc import Callable, Sequence

import numpy as np

from framelens.gl.seam import Call, GluCall, gl
from framelens.program.program_run import Chain
from framelens.why.survey import Drawn, Survey
from framelens.why.suspects import load, matrix_of, with_matrix
from framelens.why.trial import Action, Change


def glu_function(name: str) -> Callable[..., object]:
    """Return a function of GLU; PyOpenGL must be bound to a platform before it is imported."""
    from framelens.gl.glu import FUNCTIONS

    return FUNCTIONS[name]


def mode_at(survey: Survey, note: GluCall) -> str:
    """Return which matrix a call of GLU multiplies, as far as the tape tells."""
    mode = "GL_MODELVIEW"
    if survey.past is not None and note.pass_ != "setup":
        known = survey.past.setters.last.get("GL_MATRIX_MODE")
        mode = mode_named(known) if known else mode
    for call in survey.tape.calls[: note.begin]:
        if call.name == "glMatrixMode":
            mode = mode_named(call)
    return mode


def mode_named(call: Call) -> str:
    """Return the mode that a glMatrixMode chooses."""
    return {0x1700: "GL_MODELVIEW", 0x1701: "GL_PROJECTION"}.get(int(call.args[0]), "GL_TEXTURE")


def instead_of_glu(survey: Survey, note: GluCall, args: Sequence[float]) -> Change:
    """Return the change that calls GLU with other arguments."""
    frame = survey.tape.begin
    if note.begin < frame:
        return _instead_of_earlier(survey, note, args)
    function = glu_function(note.name)
    numbers = range(note.begin, note.end)
    instead: dict[str, Sequence[Action]] = {str(number): () for number in numbers}
    if not instead:
        if note.begin > frame:
            return Change(after={str(note.begin - 1): [lambda: function(*args)]})
        return Change(before={str(note.begin): [lambda: function(*args)]})
    instead[str(note.begin)] = [lambda: function(*args)]
    return Change(instead=instead)


def _instead_of_earlier(survey: Survey, note: GluCall, args: Sequence[float]) -> Change:
    """Return the change that gives the frame the matrix of a call of GLU before it."""
    old, new = _glu_matrix(note.name, note.args), _glu_matrix(note.name, args)
    mode = mode_at(survey, note)
    if old is None or new is None or abs(np.linalg.det(old)) < 1e-12:
        return Change(start=[load(mode, new)] if new is not None else ())
    fixed = np.linalg.inv(old) @ new
    return with_matrix(mode, lambda d: matrix_of(d, mode) @ fixed, survey.shapes)


def _glu_matrix(name: str, args: Sequence[object]) -> np.ndarray | None:
    """Return the matrix that a call of GLU multiplies by, found by making it."""
    gl.glPushMatrix()
    gl.glLoadIdentity()
    mode = int(gl.glGetIntegerv(gl.GL_MATRIX_MODE))
    glu_function(name)(*args)
    which = {0x1700: gl.GL_MODELVIEW_MATRIX, 0x1701: gl.GL_PROJECTION_MATRIX}
    found = np.array(gl.glGetDoublev(which.get(mode, gl.GL_MODELVIEW_MATRIX)))
    gl.glPopMatrix()
    return found.reshape(4, 4)


def always(matrix: np.ndarray) -> Callable[[Drawn], np.ndarray]:
    """Return what gives every draw the same matrix."""
    return lambda draw: matrix


def _called_from(chain: Chain, function: str) -> tuple[Chain | None, int]:
    """Return from where a function was called in a chain of calls, and its line; None if not."""
    depth = next((k for k, (name, _) in enumerate(chain) if name == function), None)
    return (None, 0) if depth is None else (chain[:depth], chain[depth][1])


def undone(survey: Survey, function: str) -> Change | None:
    """Return the change that undoes, after each run of a function, what it did to the matrix."""
    before: dict[str, list[Action]] = {}
    after: dict[str, list[Action]] = {}
    chains = survey.past.chains if survey.past else {}
    run: tuple[Chain, int] | None = None
    last = ""
    for call in survey.calls:
        chain = chains.get(call.number)
        if chain is None:
            continue
        outer, line = _called_from(chain, function)
        if run is not None and (outer != run[0] or line < run[1]):
            after.setdefault(last, []).append(("glPopMatrix", ()))
            run = None
        if outer is not None:
            if run is None:
                before.setdefault(str(call.number), []).append(("glPushMatrix", ()))
            run, last = (outer, line), end_of(survey, call)

    if run is not None:
        after.setdefault(last, []).append(("glPopMatrix", ()))
    return Change(before=before, after=after) if before else None


def end_of(survey: Survey, call: Call) -> str:
    """Return the place of a call, or of the glEnd that belongs to a glBegin."""
    if call.name != "glBegin":
        return str(call.number)
    for later in survey.tape.calls[call.number :]:
        if later.name == "glEnd":
            return str(later.number)
    return str(call.number)
