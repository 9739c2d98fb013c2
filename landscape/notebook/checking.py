"""An exercise checked from a notebook: each test, its hint, and where the picture differs."""

import base64
import os
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from PIL import Image

from framelens.base.errors import InputError
from framelens.base.output import png
from framelens.base.texts import Translator, choose
from framelens.report.in_cells import fragment
from framelens.report.look import answered
from landscape.commands.exercise_check import as_text, title_of
from landscape.commands.shelves import shelf
from landscape.course.exercise import Grader, Report, Verdict, verdicts
from landscape.course.grader.grading import _
from landscape.course.grader.heat_map import heat_map
from landscape.course.grader.troubles import sentence

PICTURES = _("Your picture, where it differs, and the solution's")
WIDTH = 960  # chosen: pixels of the three pictures in a row
CELL = "cell.py"  # what a program of a cell is called
MARKS = {True: "✓", False: "✗", None: "–"}
COLORS = {True: "#1a7f37", False: "#c0392b", None: "inherit"}


@dataclass(frozen=True)
class Check:
    """A check's result, as of `landscape exercise check --json`, and its form in a notebook.

    ``error`` says why a program could not be graded, "" if it was. ``png`` has three pictures: the
    program's, where it differs, and the solution's.
    """

    exercise: str
    title: str
    passed: bool
    tests: Sequence[Verdict]
    difference: float | None
    error: str
    text: str
    png: bytes | None
    pictures: str  # what the PNG shows, in words

    def __repr__(self) -> str:
        return self.error or self.text

    def _repr_png_(self) -> bytes | None:
        return self.png

    def _repr_html_(self) -> str:
        lines = [f"<h4>{escape(self.title)}</h4>"]
        if self.error:
            lines.append(f"<p>{escape(self.error)}</p>")
        for test in self.tests if not self.error else ():
            mark = f'<b style="color:{COLORS[test["passed"]]}">{MARKS[test["passed"]]}</b>'
            hint = f"<br>{escape(test['hint'])}" if test["hint"] else ""
            lines.append(f"<p>{mark} {escape(test['name'])}{hint}</p>")
        if self.png is not None:
            source = base64.b64encode(self.png).decode()
            alt = escape(self.pictures)
            lines.append(f'<img alt="{alt}" src="data:image/png;base64,{source}">')
            lines.append(f'<p class="quiet">{alt}</p>')
        return fragment(lines)


def check(
    program: str | os.PathLike[str], exercises: str | os.PathLike[str] | None = None
) -> Check:
    """Grade a program for an exercise: its path, or its text, which has more than one line.

    The line ``# exercise: NAME`` in it says of which exercise it is: one of the course, or of the
    folder ``exercises``. InputError if it is of none,
    or cannot be read; NoOpenGLError.
    """
    text = os.fspath(program)
    language = choose(os.environ)
    folder = None if exercises is None else Path(exercises)
    if "\n" not in text:
        return answered(text, _checked, Path(text), folder, language)
    with TemporaryDirectory(prefix="landscape-") as place:
        path = Path(place, CELL)
        path.write_text(text, encoding="utf-8")
        try:
            return answered(CELL, _checked, path, folder, language)
        except InputError as error:
            error.values["path"] = CELL  # not that of the folder, which goes
            raise


def _checked(path: Path, exercises: Path | None, language: str) -> Check:
    """Grade a program, in this process."""
    with Grader(shelf=shelf(exercises)) as grader:
        report = grader.check(path)
    return _told(report, report.exercise.translate.to(language))


def _told(report: Report, _: Translator) -> Check:
    """Return what a notebook shows of a report."""
    picture = None
    if report.work is not None and report.solution is not None:
        row = Image.fromarray(heat_map(report.work, report.solution))
        small = row.resize((WIDTH, round(row.height * WIDTH / row.width)))
        picture = png(np.asarray(small), small=True)
    return Check(
        exercise=report.exercise.name,
        title=title_of(report.exercise, _),
        passed=report.passed,
        tests=verdicts(report, _),
        difference=report.difference,
        error=sentence(report.error, _) if report.error is not None else "",
        text="\n".join(as_text(report, _)),
        png=picture,
        pictures=_(PICTURES),
    )
