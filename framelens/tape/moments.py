"""The state at any call of a frame, found by drawing the frame again up to there.

Afterwards the whole frame is drawn once more, so that its context is as it was.
"""

import re

from framelens.base.errors import InputError, short
from framelens.gl.raw import end_primitive
from framelens.gl.seam import Call
from framelens.state.state import State, StateError, difference, read
from framelens.tape.steps import find, issue, steps
from framelens.tape.tape import Tape

OPEN = ("GL_ATTRIB_STACK", "GL_CLIENT_ATTRIB_STACK")
PUSHES = {"glPushAttrib": 0, "glPushClientAttrib": 1}
POPS = {"glPopAttrib": 0, "glPopClientAttrib": 1}
LAYOUT = re.compile(r"(.*_ARRAY)_(?:SIZE|TYPE|STRIDE|POINTER|BUFFER_BINDING)")


class Pushed:
    """The masks of the attribute pushes that are open, which OpenGL does not tell."""

    def __init__(self) -> None:
        self._masks: tuple[list[int], list[int]] = ([], [])

    def follow(self, call: Call) -> None:
        """Take note of a call that was made, with what a display list of it executes."""
        if call.skipped:
            return
        if call.name in PUSHES:
            self._masks[PUSHES[call.name]].append(int(call.args[0]))
        elif call.name in POPS and self._masks[POPS[call.name]]:
            self._masks[POPS[call.name]].pop()
        for inner in call.listed:
            self.follow(inner)

    def read(self) -> State:
        """Return the state, with what open pushes have saved where all their masks are known."""
        try:
            state = read()
        except StateError:  # between glBegin and glEnd: what the calls there set, they have set
            end_primitive()
            state = read()
        depths = [state[f"{stack}_DEPTH"] for stack in OPEN]
        if not any(depths) or depths != [len(masks) for masks in self._masks]:
            return state
        return read(*self._masks)


def state_at(tape: Tape, place: str = "") -> State:
    """Return the state in which a call of the frame is made; with no place, that at the end.

    A place is a call's number, with a point and a number for a call in a display list. Between
    glBegin and glEnd it is the state if glEnd came there. InputError where there is no such call.
    """
    state = _read_at(tape, place)
    tape.replay()
    return state


def _read_at(tape: Tape, place: str) -> State:
    """Draw the frame up to a call and read the state."""
    until = find(tape.calls, place).number if place else len(tape.calls)
    if until < tape.begin:
        raise InputError(
            "call {place}: it is made before the frame begins, whose calls are {begin} to {count}",
            place=short(place),
            begin=tape.begin,
            count=len(tape.calls) - 1,
        )

    tape.rewind()
    pushed = Pushed()
    for call in tape.calls[tape.begin : until]:
        issue(call)
        pushed.follow(call)
    if "." in place:
        for step in steps(tape.calls[until : until + 1]):
            if f"{step.place}.".startswith(f"{place}."):
                break
            issue(step.call)
            pushed.follow(step.call)

    return pushed.read()


def leaks(tape: Tape, element: str) -> dict[str, dict[str, list[object]]]:
    """Return for each pass of the frame what an element leaves changed: name to [before, after].

    That is the difference of the states before its first call and after its last one in the pass.
    Where a disabled array points does not count. Without calls of the element there is no pass.
    """
    numbers: dict[str, list[int]] = {}
    for call in tape.frame:
        if element in call.shared_by:
            numbers.setdefault(call.pass_, []).append(call.number)
    found = {
        pass_: _lasting(_read_at(tape, str(mine[0])), _read_at(tape, _after(tape, mine[-1])))
        for pass_, mine in numbers.items()
    }
    tape.replay()
    return found


def _after(tape: Tape, number: int) -> str:
    return str(number + 1) if number + 1 < len(tape.calls) else ""


def _lasting(before: State, after: State) -> dict[str, list[object]]:
    """Return the difference of two states without what has no effect in either."""
    found = difference(before, after)
    for name in list(found):
        match = LAYOUT.fullmatch(name)
        if match and not before.get(match[1]) and not after.get(match[1]):
            del found[name]
    return found
