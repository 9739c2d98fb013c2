"""A lecture on paper: for each step its texts, a picture, the code that matters, and the notes.

The pictures are drawn side by side. What HTML and PDF make of them is in page.py and pdf.py.
"""

import io
from collections.abc import Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from functools import partial
from operator import call

import numpy as np
from PIL import Image

from framelens.base.errors import InputError
from framelens.base.executor import ahead, in_order, lent_or_own
from framelens.base.progress import Progress
from landscape.course.ladder import lesson
from landscape.course.language import translated
from landscape.course.lecture import texts
from landscape.course.lecture.image import shown_rows
from landscape.course.lecture.plan import LESSON, TEXT, Lecture, Step, in_texts
from landscape.course.lecture.still import drawn

SIZE = (1024, 576)  # chosen: pixels of a view
LARGEST = 1280  # chosen: pixels of a picture's longer side; a larger one is made smaller
ROWS = 26  # chosen: lines of code on a slide
TAB = 4  # columns


@dataclass(frozen=True)
class Row:
    """A line of code; number 0 stands for lines that are left out."""

    number: int
    text: str
    marked: bool
    comment: bool


@dataclass(frozen=True)
class Slide:
    """A step. ``lines`` are its caption, or the lines of a step of text, where "- " is an item.

    ``picture`` is uint8 (h, w, 3), None for text, and ``alt`` says what it shows.
    """

    number: int
    name: str
    title: str
    lines: Sequence[str]
    picture: np.ndarray | None
    alt: str
    file: str
    code: Sequence[Row]
    notes: Sequence[str]

    def encoded(self, kind: str, quality: int) -> bytes:
        """Return the picture as "WEBP" or "JPEG"."""
        assert self.picture is not None
        buffer = io.BytesIO()
        Image.fromarray(self.picture).save(buffer, kind, quality=quality)
        return buffer.getvalue()


def slides(
    lecture: Lecture,
    language: str,
    jobs: int = 1,
    quiet: bool = True,
    executor: Executor | None = None,
) -> list[Slide]:
    """Return the slides of a lecture, in a language; InputError where a step cannot be drawn."""
    steps = lecture.steps
    work = [partial(_drawn, step, language) for step in steps]
    made = []
    with lent_or_own(executor, jobs) as workers, Progress(len(steps), quiet) as progress:
        pictures = in_order(workers, call, work, ahead(jobs))
        for number, (step, picture) in enumerate(zip(steps, pictures, strict=True), 1):
            made.append(_slide(step, number, picture))
            progress.step(step.name)
    return made


def _drawn(step: Step, language: str) -> np.ndarray | None:
    """Return a step's picture, not too large."""
    try:
        pixels = drawn(step, SIZE, language)
    except InputError as error:
        raise InputError(
            "line {line} of the lecture: {error}", line=step.line, error=error
        ) from None
    if pixels is None or max(pixels.shape[:2]) <= LARGEST:
        return pixels
    image = Image.fromarray(pixels)
    image.thumbnail((LARGEST, LARGEST))
    return np.asarray(image)


def _slide(step: Step, number: int, picture: np.ndarray | None) -> Slide:
    title, caption = texts.title(step), texts.caption(step)
    lines = texts.paragraphs(step) if step.kind == TEXT else [caption] if caption else []
    notes = list(texts.notes(step))
    if step.kind == LESSON:
        notes.append(translated(lesson(step.name).about[-1]))
    if step.keys:
        notes.append(texts.word("pressed", keys=" ".join(step.keys)))
    return Slide(
        number,
        step.name,
        title,
        lines,
        picture,
        " ".join(part if part[-1:] in ".?!" else f"{part}." for part in (title, caption) if part),
        step.called,
        _code(step) if step.code is not None else (),
        notes,
    )


def _code(step: Step) -> list[Row]:
    """Return the lines that matter, and those around them."""
    lines, marked = texts.program(step)
    source = [line.expandtabs(TAB) for line in lines]
    quoted = in_texts(source)
    return [
        Row(number, source[number - 1] if number else "", number in marked, number in quoted)
        for number in shown_rows(len(source), marked, ROWS, None)
    ]
