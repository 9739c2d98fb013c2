"""A frame as the list of OpenGL calls that draw it, as text."""

from collections.abc import Container, Iterator, Sequence

from framelens.gl.seam import Call
from framelens.tape.edits import as_code


def chosen(calls: Sequence[Call], element: str | None, pass_: str | None) -> list[Call]:
    """Return the calls of an element and of a pass; None means all."""
    return [
        call
        for call in calls
        if (element is None or element in call.shared_by) and pass_ in (None, call.pass_)
    ]


def as_text(
    calls: Sequence[Call],
    inside: str = "",
    indent: str = "",
    pass_: str = "",
    idle: Container[str] = (),
) -> Iterator[str]:
    """Yield a line per call: its number, pass, element, source, and the call as code.

    ``pass_`` is the one in which a display list is called; it may have been compiled in another.
    ``idle`` has the places of draws that change no pixel.
    """
    for index, call in enumerate(calls):
        place = f"{inside}.{index}" if inside else str(call.number)
        where = f"{place:>9} {pass_ or call.pass_:10} {call.element:10} {call.source:44}"
        left_out = "  (left out)" if call.skipped else ""
        nothing = "  (changes no pixel)" if place in idle else ""
        yield f"{where} {indent}{as_code(call)}{left_out}{nothing}"
        yield from as_text(call.listed, place, indent + "  ", pass_ or call.pass_, idle)
