"""A frame to look into from Python, as notebooks show it: its picture, strip, pixels, calls, why.

The frame is drawn in a process of its own, once for each question: a program that crashes ends that
process, and neither the user's own nor the OpenGL that is used in it.
"""

import io
import logging
import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, TypeVar

import numpy as np
from PIL import Image

from framelens.base import arguments
from framelens.base.errors import InputError
from framelens.base.isolated import Ended, isolated
from framelens.base.packages import speaker
from framelens.base.texts import choose
from framelens.program.program_events import presses, read_events
from framelens.program.program_frame import ProgramFrame
from framelens.report import in_cells, strip, trace_text, why_report
from framelens.tape.buffers import Buffers
from framelens.tape.pixel import history
from framelens.tape.strip import BUFFERS, GROUPINGS
from framelens.tape.tape import Tape
from framelens.tape.target import Target

T = TypeVar("T")
SECONDS = 120.0  # chosen: after which a frame is given up


@dataclass(frozen=True)
class Html:
    """A result that a notebook shows as HTML."""

    html: str

    def _repr_html_(self) -> str:
        return self.html


@dataclass(frozen=True)
class PixelHistory(Html):
    """A pixel's history; ``rows`` are those of `framelens pixel --json`."""

    rows: Sequence[dict[str, object]]


@dataclass(frozen=True)
class CallList(Html):
    """The calls of a frame; ``calls`` are as of `framelens trace --json`."""

    calls: Sequence[dict[str, object]]


@dataclass(frozen=True)
class Reason(Html):
    """Why a picture is black, or wrong at a pixel; ``found`` is as of `framelens why --json`."""

    found: dict[str, object]


class Look:
    """A frame of ``target``, and its ``picture``, a PIL image, which a notebook shows.

    Each method draws the frame again. Their texts are in the user's language. InputError for a
    program that cannot be run to its frame, NoOpenGLError where no backend works.
    """

    def __init__(self, target: Target) -> None:
        self.target = target
        self.picture = Image.fromarray(self._picture())

    def _picture(self) -> np.ndarray:
        """Return the picture, uint8 (h, w, 3), the top row first."""
        return self._asked(_color)

    def _repr_png_(self) -> bytes:
        buffer = io.BytesIO()
        self.picture.save(buffer, "PNG", optimize=True)
        return buffer.getvalue()

    def __repr__(self) -> str:
        return f"<{self.target.name}, {self.picture.width}x{self.picture.height}>"

    def strip(self, by: str = "element", buffers: Sequence[str] = BUFFERS[:1]) -> Html:
        """Return how the frame grows: ``by`` pass, element or draw, with these buffers."""
        arguments.choice(by, "by", GROUPINGS)
        for name in buffers:
            arguments.choice(name, "buffers", BUFFERS)
        return Html(self._asked(_strip, strip.Request(by, tuple(buffers), _language())))

    def pixel(self, x: int, y: int) -> PixelHistory:
        """Return every draw that covered a pixel; ``x``, ``y`` from the picture's top left."""
        return PixelHistory(*self._asked(_pixel, _place(x, y), _language()))

    def calls(self, element: str | None = None) -> CallList:
        """Return the calls up to the end of the frame; of one ``element`` if it is named."""
        return CallList(*self._asked(_calls, element, _language()))

    def why(self, x: int | None = None, y: int | None = None) -> Reason:
        """Return why the picture is black, or wrong at a pixel, and what would mend it."""
        place = None if x is None or y is None else _place(x, y)
        return Reason(*self._asked(_why, place, _language()))

    def _asked(self, question: Callable[..., tuple[T, list[str]]], *values: object) -> T:
        """Return what a function below answers of the target; log what it has to tell."""
        answer, told = answered(self.target.name, question, self.target, *values)
        for line in told:
            logging.getLogger(speaker()).warning(line)
        return answer


def look(
    path: str | os.PathLike[str],
    frame: int = 0,
    keys: str = "",
    events: Sequence[Mapping[str, object]] = (),
    backend: str = "auto",
) -> Look:
    """Return a frame of a PyOpenGL program, by its path, as a :class:`Look`.

    ``frame`` counts from 0. ``keys``, by GLFW's names as in "SPACE LEFT LEFT", are pressed and
    released after frame 0, so that frame 1 is the first to show them. ``events`` are as in a file
    of events (docs/frame.md). InputError for a program that cannot be run to that frame, and
    NoOpenGLError.
    """
    path = os.fspath(path)
    frame = arguments.whole(frame, "frame")
    pressed = presses(keys.split())
    coming = [*pressed, *events]
    read_events(coming)  # what is wrong with them is said before anything is run
    return Look(ProgramFrame(path, backend, frame=max(frame, int(bool(pressed))), events=coming))


def answered(name: str, work: Callable[..., T], *values: object) -> T:
    """Return ``work(*values)``, done in a process of its own; InputError if that was ended.

    ``name`` is what is drawn there.
    """
    try:
        return isolated(work, *values, seconds=SECONDS)
    except Ended as ended:
        if ended.status is None:
            raise InputError(
                "{name}: was not drawn within {seconds:g} s", name=name, seconds=SECONDS
            ) from None
        raise InputError(
            "{name}: its process ended with status {status}: {message}",
            name=name,
            status=ended.status,
            message=ended.message,
        ) from None


def _language() -> str:
    return choose(os.environ)


def _place(x: int, y: int) -> tuple[int, int]:
    return arguments.whole(x, "x"), arguments.whole(y, "y")


# The functions below run in the other process. Each answer comes with lines for the user.


def _looked(target: Any, use: Callable[[Tape], T]) -> tuple[T, list[str]]:
    told: list[str] = []
    return replace(target, tell=told.extend).look(use), told


def _color(target: Target) -> tuple[np.ndarray, list[str]]:
    def read(tape: Tape) -> np.ndarray:
        return np.ascontiguousarray(Buffers.read(tape.size).color[::-1, :, :3])

    return _looked(target, read)


def _strip(target: Target, request: strip.Request) -> tuple[str, list[str]]:
    return _looked(target, lambda tape: strip.fragment(tape, target.name, request))


def _pixel(
    target: Target, place: tuple[int, int], language: str
) -> tuple[tuple[str, list[dict[str, object]]], list[str]]:
    def read(tape: Tape) -> tuple[str, list[dict[str, object]]]:
        rows = history(tape, *place)
        html = in_cells.pixel(language, target.name, place, rows)
        return html, [row.as_json() for row in rows]

    return _looked(target, read)


def _calls(
    target: Target, element: str | None, language: str
) -> tuple[tuple[str, list[dict[str, object]]], list[str]]:
    if element is not None:
        target.check_element(element)

    def read(tape: Tape) -> tuple[str, list[dict[str, object]]]:
        chosen = trace_text.chosen(tape.calls, element, None)
        return in_cells.calls(language, chosen), [call.as_json() for call in chosen]

    return _looked(target, read)


def _why(
    target: Target, place: tuple[int, int] | None, language: str
) -> tuple[tuple[str, dict[str, Any]], list[str]]:
    told: list[str] = []
    listening: Any = replace(target, tell=told.extend)  # type: ignore[type-var]
    found = why_report.find(listening, place, language=language)
    lines = why_report.as_text(found, language)
    return (in_cells.paragraphs(lines), found.as_json(language)), told
