"""The effect of each call of a frame on the state: the variables it sets, before and after it.

A call that sets what is set already is redundant. The frame is made once more, call by call, and
only the variables that a call sets are read, so that a frame of two thousand calls takes a fraction
of a second.
"""

from collections.abc import Container, Mapping
from dataclasses import dataclass

from framelens.gl.seam import Call, Recorder
from framelens.spec import spec
from framelens.state.state_reading import Values, read_some
from framelens.tape.steps import CLIENT, issue
from framelens.tape.tape import Tape

# They decide which variables a call sets.
SELECTING = (
    *("GL_MATRIX_MODE", "GL_ACTIVE_TEXTURE", "GL_CLIENT_ACTIVE_TEXTURE"),
    *("GL_COLOR_MATERIAL", "GL_COLOR_MATERIAL_FACE", "GL_COLOR_MATERIAL_PARAMETER"),
)


@dataclass(frozen=True, slots=True)
class Effect:
    """The variables that a call sets, by name, before and after it."""

    before: Values
    after: Values

    @property
    def redundant(self) -> bool:
        """Whether all of them had their values already."""
        return bool(self.after) and self.before == self.after


def effects(tape: Tape) -> dict[str, Effect]:
    """Make a tape's frame again; return the effect of each call that sets state, by its place.

    Not of those between glBegin and glEnd, where OpenGL answers no question. The tape's context
    must be current; the frame is in its framebuffer afterwards.
    """
    found: dict[str, Effect] = {}
    inside = False
    tape.rewind()
    for step in tape.steps():
        call = step.call
        # In a display list these have been executed when it was compiled.
        listed = "." in step.place and call.name in CLIENT
        inside = inside or call.name == "glBegin"
        if not step.place or inside or listed or call.skipped:
            issue(call)
        else:
            names = _set_by(call)
            before = read_some(names) if names else {}
            issue(call)
            if before:
                found[step.place] = Effect(before, read_some(names))
        inside = inside and call.name != "glEnd"

    return found


def watch(recorder: Recorder, numbers: Container[int]) -> dict[str, Effect]:
    """Return a dictionary that gets the effects of these calls while the recording makes them.

    Nothing is made again, so this is cheap enough for a frame that is on its way to the screen;
    but calls inside display lists are not among them.
    """
    found: dict[str, Effect] = {}
    former: dict[int, Mapping[str, object]] = {}
    inside = False

    def before(call: Call) -> None:
        nonlocal inside
        inside = (inside or call.name == "glBegin") and not call.skipped
        if call.number in numbers and not inside and not call.skipped:
            former[call.number] = read_some(_set_by(call))

    def after(call: Call) -> None:
        nonlocal inside
        inside = inside and call.name != "glEnd"
        if variables := former.get(call.number):
            found[str(call.number)] = Effect(variables, read_some(variables))

    recorder.before, recorder.after = before, after
    return found


def _set_by(call: Call) -> tuple[str, ...]:
    """Return the names of the variables that a call sets in the state in which it is made."""
    if not spec.sets(call.name, call.args):
        return ()
    return tuple(spec.sets(call.name, call.args, read_some(SELECTING)))
