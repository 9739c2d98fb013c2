"""The state of OpenGL in a frame: at a call, between two, and what an element leaves changed."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from framelens.state.state import changed, difference
from framelens.state.state_reading import Values
from framelens.state.state_text import as_json, as_text, difference_as_text
from framelens.tape.edits import as_code
from framelens.tape.moments import leaks, state_at
from framelens.tape.steps import find
from framelens.tape.tape import Tape
from framelens.tape.target import place_of

INITIAL = "initial"
NUMBERED = (*"+0123456789",)  # how a call's number begins
NOTHING = "nothing differs"


@dataclass(frozen=True)
class Report:
    """A state, or differences of states, each under a line that says what it is."""

    parts: Mapping[str, Values]
    compared: bool

    def as_json(self) -> dict[str, object]:
        """Return the state, or name to [before, after]; of several passes the first and last."""
        found: dict[str, Any] = {}
        for part in self.parts.values():
            for name, value in as_json(part).items():
                found[name] = [found[name][0], value[1]] if name in found else value
        return found

    def as_text(self) -> Iterator[str]:
        """Yield the lines of the report."""
        for title, part in self.parts.items():
            yield title
            if self.compared:
                yield from difference_as_text(part) if part else [f"    {NOTHING}"]
            else:
                yield from as_text(part)


def report(tape: Tape, at: str = "", diff: str = "") -> Report:
    """Return what `landscape state --at AT --diff DIFF` prints; "" where one is not given.

    InputError for a call or an element that the frame does not have.
    """
    if diff and diff != INITIAL and not at and diff[:1] not in NUMBERED:
        place_of(tape, diff)
        return Report(
            {f"{diff} leaves, {pass_} pass": part for pass_, part in leaks(tape, diff).items()},
            True,
        )

    first = place_of(tape, at) if at else ""
    if diff == INITIAL:
        title = f"a new context -> {_where(tape, first)}"
        return Report({title: changed(state_at(tape, first))}, True)
    if not diff:
        return Report({f"state {_where(tape, first)}": state_at(tape, first)}, False)
    last = place_of(tape, diff)
    before = state_at(tape, first) if first else tape.start
    start = _where(tape, first) if first else "the frame's beginning"
    after = state_at(tape, last)
    return Report({f"{start} -> {_where(tape, last)}": difference(before, after)}, True)


def _where(tape: Tape, place: str) -> str:
    """Return in words which moment a place means."""
    if not place:
        return "after the frame"
    step = find(tape.calls, place)
    call, top = step.call, step.top
    return f"before call {place}: {as_code(call)}, {call.element}, {top.pass_} pass, {call.source}"
