"""Pixel history as text: a paragraph for each fragment that reached the pixel."""

import textwrap
from collections.abc import Iterator, Sequence

from framelens.tape.edits import as_code
from framelens.tape.pixel import Row

WIDTH = 100  # chosen


def _lines(row: Row) -> Iterator[str]:
    """Yield what is said of a call that reached the pixel."""
    call = row.call
    which = "" if row.primitive is None else f", primitive {row.primitive}"
    yield f"{row.step.place:>9}  {row.outcome:8} {row.step.elements[0]}: {as_code(call)}{which}"
    yield f"{'':21}{row.step.top.pass_} pass, {call.source}  {call.site.text}".rstrip()
    for part in row.arithmetic.split("; "):
        yield from textwrap.wrap(part, WIDTH, initial_indent=" " * 21, subsequent_indent=" " * 25)
    pixel = row.pixel
    depth = "" if pixel.depth is None else f", depth {pixel.depth:.6f}"
    stencil = "" if pixel.stencil is None else f", stencil {pixel.stencil}"
    yield f"{'':21}then RGBA {' '.join(map(str, pixel.color))}{depth}{stencil}"


def as_text(
    rows: Sequence[Row], before: Sequence[int] | None = None, unseen: Sequence[str] = ()
) -> Iterator[str]:
    """Yield the lines of a report: what drew, from where, what came of it, and the arithmetic.

    ``before``: the colour that earlier frames have left there, if they have; ``unseen``: lines
    about draws that leave no trace in the picture.
    """
    for row in rows:
        yield from _lines(row)
    if not rows and before is not None:
        yield f"nothing was drawn there in this frame; earlier ones left RGB {_numbers(before)}"
    elif not rows:
        yield "nothing was drawn there"

    if unseen:
        yield ""
        yield "draws that leave no trace in the picture:"
        yield from (f"  {line}" for line in unseen)


def _numbers(values: Sequence[int]) -> str:
    return " ".join(str(int(value)) for value in values)
