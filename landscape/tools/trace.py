"""A frame as the list of OpenGL calls that draw it."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from landscape.capture.edits import as_code
from landscape.gl.calls import Call, recording
from landscape.render import Offscreen

SIZE = (320, 240)  # chosen: which calls are made does not depend on it


def trace_view(
    view: str,
    preset: str | None = None,
    settings: Mapping[str, Any] | None = None,
    wireframe: bool = False,
    **options: Any,
) -> list[Call]:
    """Draw one frame of a view and return its calls in order, those of the setup first.

    Reading the picture back is not part of a frame and is left out.
    """
    with Offscreen(SIZE, preset, settings, **options) as offscreen, recording() as recorder:
        offscreen.look(view, wireframe=wireframe)
        offscreen.submit()
        return list(recorder.calls)


def as_text(calls: Sequence[Call], indent: str = "") -> Iterator[str]:
    """Yield a line per call: pass, element, source, and the call as code."""
    for call in calls:
        where = f"{call.pass_:10} {call.element:10} {call.source:44}"
        yield f"{where} {indent}{as_code(call)}"
        yield from as_text(call.listed, indent + "  ")
