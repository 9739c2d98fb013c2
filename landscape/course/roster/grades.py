"""Grading the submissions of a class, side by side: a row each, never a stop."""

import atexit
import json
import math
import pickle
import re
from collections.abc import Callable, Generator, Iterable, Mapping, Sequence
from concurrent.futures import Executor
from contextlib import closing
from dataclasses import dataclass, replace
from datetime import datetime
from functools import partial
from pathlib import Path
from time import monotonic
from typing import Any

import numpy as np
from PIL import Image

from framelens.base.errors import InputError, NoOpenGLError, UnexpectedError
from framelens.base.executor import Kept, ahead, in_order, lent_or_own
from framelens.base.output import png
from framelens.base.texts import said, translator
from framelens.system.processes import cores
from landscape.course.exercise import Grader, Report, Verdict, verdicts
from landscape.course.grader.budget import SECONDS
from landscape.course.grader.confinement import AUTO
from landscape.course.grader.grading import Hint, _
from landscape.course.grader.heat_map import heat_map
from landscape.course.grader.troubles import LONGEST, sentence
from landscape.course.grader.workplace import Workplace
from landscape.course.roster.submissions import Submission, late
from landscape.course.shelf import MARKER, Shelf
from landscape.files.cache import code_below, content, recall, recalled

Outcome = tuple[dict[str, Any], bytes]  # the values of a program's row, and its picture
UNSEEN = _("The tests that you see pass, but not all of those that you do not see.")
TOGETHER = 8  # chosen: programs of one exercise that a worker grades one after the other
SHARES = 2  # chosen: such groups for each worker, where all programs are of one exercise
WIDEST = 960  # chosen: pixels of the picture of a page, of three side by side


@dataclass(frozen=True)
class Row:
    """What a submission is given; the fields are those of the tables.

    ``tests``: {"name", "passed", "hint", "points", "hidden"} of each; "points" is what it is worth,
    and students do not see what is "hidden". ``hint`` comes from the first test that failed which
    they see, ``line`` the line of the program that it names, or 0. ``error`` says why it was not
    graded; ``of`` is 0 where nobody can say what it would be worth.
    """

    student: str
    id: str
    file: str
    exercise: str = ""
    passed: bool = False
    points: float = 0.0
    of: float = 0.0
    tests: Sequence[Mapping[str, Any]] = ()
    hint: str = ""
    line: int = 0
    late: bool = False
    seconds: float = 0.0
    contained: str = ""
    version: str = ""
    error: str = ""


@dataclass(frozen=True)
class Graded:
    """A row, its submission, and its picture: the student's, the difference, the solution's."""

    row: Row
    submission: Submission
    picture: bytes = b""


@dataclass(frozen=True)
class Rules:
    """How a class is graded; ``points`` is what a program gets that passes all tests.

    Where it is None, each test is worth its own points, one by default. ``version`` is told in each
    row. ``again``: files that have not changed are run, too. ``contain``: as of a Grader.
    ``exercises``: the folder of a lecturer's own exercises, which every worker reads. ``private``:
    files and folders of which programs must read nothing, those of the class.
    """

    language: str = "en"
    seconds: float = SECONDS
    points: float | None = None
    version: str = ""
    again: bool = False
    contain: str = AUTO
    exercises: Path | None = None
    private: Sequence[str] = ()


def grade_class(
    found: Sequence[Submission],
    rules: Rules,
    due: datetime | None = None,
    done: Callable[[str], None] = lambda student: None,
    executor: Executor | None = None,
    jobs: int = 0,
) -> list[Graded]:
    """Grade submissions, and call ``done`` with the student of each; in their order.

    The workers are ``jobs`` processes of this machine, as many as it has cores by default, or those
    of an ``executor``, which are as many. A file that was graded before, by the same tests, is not
    run again. NoOpenGLError without a usable OpenGL.
    """
    texts = list(dict.fromkeys(each.data for each in found if each.data is not None))
    count = jobs or min(cores(), max(len(texts), 1))
    known = {} if rules.again else _graded_before(rules, texts)
    graded: list[Graded] = []
    try:
        unknown = [text for text in texts if text not in known]
        with closing(_by_workers(rules, unknown, count, executor)) as results:
            for each in found:
                while each.data is not None and each.data not in known:
                    known.update([next(results)])
                graded.append(_given(each, rules, due, known))
                done(each.student)
    finally:
        _open.close()  # where the executor is one in this process
    return graded


def _graded_before(rules: Rules, texts: Iterable[bytes]) -> dict[bytes, Outcome]:
    """Return what is known of programs from an earlier run."""
    shelf = Shelf(rules.exercises)
    found = ((text, recalled([_key(rules, shelf), text])) for text in texts)
    return {text: _read(*arrays) for text, arrays in found if arrays is not None}


def _by_workers(
    rules: Rules, texts: Sequence[bytes], count: int, executor: Executor | None
) -> Generator[tuple[bytes, Outcome], None, None]:
    """Grade programs, each told with what it was given; without any, no worker is started."""
    if not texts:
        return
    tasks = _by_exercise(texts, math.ceil(len(texts) / (SHARES * count)))
    with (
        lent_or_own(executor, count) as workers,
        closing(in_order(workers, partial(grade, rules), tasks, ahead(count))) as results,
    ):
        for task, outcomes in zip(tasks, results, strict=True):
            yield from zip(task, outcomes, strict=True)


def _by_exercise(texts: Iterable[bytes], most: int) -> list[list[bytes]]:
    """Return programs in groups of one exercise each, in the order of the first of each group.

    Whoever grades a group runs the solution once. A group has at most TOGETHER programs, and at
    most so many that each worker gets some.
    """
    tasks: list[list[bytes]] = []
    open_ones: dict[frozenset[str], list[bytes]] = {}
    for text in texts:
        names = frozenset(MARKER.findall(text.decode(errors="replace")))
        task = open_ones.get(names)
        if task is None or len(task) >= min(most, TOGETHER):
            task = open_ones[names] = []
            tasks.append(task)
        task.append(text)
    return tasks


def _given(
    each: Submission,
    rules: Rules,
    due: datetime | None,
    known: Mapping[bytes, Outcome],
) -> Graded:
    """Return what a submission is given; ``known`` has what each program is."""
    row = Row(
        each.student,
        each.id,
        each.file,
        of=rules.points or 0.0,
        late=late(each, due),
        version=rules.version,
    )
    if each.data is None:
        assert each.error is not None
        return Graded(replace(row, error=said(each.error, rules.language)), each)
    values, picture = known[each.data]
    return Graded(replace(row, **values), each, picture)


def grade(rules: Rules, texts: Sequence[bytes]) -> list[Outcome]:
    """Return the values of each program's row, and its picture: a task for any executor."""
    return [_graded(rules, each) for each in texts]


def _key(rules: Rules, shelf: Shelf) -> bytes:
    """Return what a program's grade depends on besides the program.

    It is given the same wherever the class lies.
    """
    return pickle.dumps((replace(rules, again=False, private=()), _code(shelf, rules.language)))


def _graded(rules: Rules, data: bytes) -> Outcome:
    shelf = Shelf(rules.exercises)
    key = _key(rules, shelf)

    def make() -> tuple[np.ndarray, ...]:
        with _open.opened(
            key + pickle.dumps(rules.private), lambda: _Opened(rules, shelf)
        ) as opened:
            values, picture = opened.graded(data)
        text = json.dumps(values).encode()
        return np.frombuffer(text, np.uint8), np.frombuffer(picture, np.uint8)

    try:
        text, picture = recall([key, data], make, fresh=rules.again)
    except NoOpenGLError:
        raise
    # As a program can provoke: the others are graded all the same.
    except Exception as error:
        return {"error": _defect(error)}, b""
    return _read(text, picture)


def _read(text: np.ndarray, picture: np.ndarray) -> Outcome:
    """Return an outcome as it was put into the cache."""
    return dict(json.loads(text.tobytes())), picture.tobytes()


def _defect(error: Exception) -> str:
    """Return a defect of the grader in one line."""
    text = str(error) if isinstance(error, UnexpectedError) else f"{type(error).__name__}: {error}"
    return " ".join(text.split())[:LONGEST]


def _code(shelf: Shelf, language: str) -> bytes:
    """Return what a lecturer's own exercises are made of: nothing for those of the course."""
    parts = [
        code_below(folder) + content(folder / f"{language}.po") for folder in shelf.own.values()
    ]
    return b"".join(parts)


class _Opened:
    """A grader, and the folder in which programs stand while they are checked."""

    def __init__(self, rules: Rules, shelf: Shelf) -> None:
        self._rules = rules
        self._grader = Grader(rules.seconds, rules.contain, shelf=shelf, private=rules.private)
        # Where what a killed worker leaves is deleted by the next.
        self._place = Workplace()
        atexit.register(self.close)  # a worker keeps it until it ends

    def graded(self, data: bytes) -> tuple[dict[str, object], bytes]:
        """Return the values of a program's row, and its picture as a PNG."""
        path = self._place.folder / "program.py"
        path.write_bytes(data)
        began = monotonic()
        try:
            report = self._grader.check(path)
        except InputError as error:
            text = said(error, self._rules.language)
            return {"error": re.sub(rf"{re.escape(str(path))}\s*: ", "", text)}, b""

        values = _values(report, self._rules)
        values["seconds"] = round(monotonic() - began, 2)
        return values, _picture(report)

    def close(self) -> None:
        """End the grader's processes and delete its files; may be called twice."""
        atexit.unregister(self.close)
        self._grader.__exit__()
        self._place.close()


_open: Kept[_Opened] = Kept()


def _shared_out(tests: list[Verdict], whole: float | None) -> tuple[float, float]:
    """Share points out among tests, by the points they have; None keeps these.

    Return the points for those passed, and all points.
    """
    right = sum(test["points"] for test in tests if test["passed"] is True)
    all_points = sum(test["points"] for test in tests)
    whole = all_points if whole is None else whole
    for test in tests:
        test["points"] = round(whole * test["points"] / all_points, 4)
    return round(whole * right / all_points, 2), whole


def _values(report: Report, rules: Rules) -> dict[str, Any]:
    translate = report.exercise.translate.to(rules.language)
    tests = verdicts(report, translate)

    told = (each for each in report.results if each.hint is not None and not each.test.hidden)
    first = next((each.hint for each in told), None)
    right, whole = _shared_out(tests, rules.points)

    values: dict[str, Any] = {
        "exercise": report.exercise.name,
        "contained": report.contained,
        "passed": report.passed,
        "points": right,
        "of": whole,
        "tests": [
            {
                "name": test["name"],
                "passed": test["passed"],
                "hint": test["hint"],
                "points": test["points"],
                "hidden": test["hidden"],
            }
            for test in tests
        ],
        "hint": first.written(translate) if first is not None else "",
        "line": _line(first),
    }

    if first is None and not report.passed and report.error is None:
        values["hint"] = translate(UNSEEN)
    if report.error is not None:
        values["error"] = sentence(report.error, translator(rules.language, "course"))
        values["line"] = int(report.error.get("line", 0))
    return values


def _line(hint: Hint | None) -> int:
    line = hint.values.get("line", 0) if hint is not None else 0
    return line if isinstance(line, int) else 0


def _picture(report: Report) -> bytes:
    """Return a PNG of the student's picture, the difference and the solution's side by side."""
    if report.work is None or report.solution is None:
        return b""
    pixels = heat_map(report.work, report.solution)
    if pixels.shape[1] > WIDEST:
        image = Image.fromarray(pixels)
        image.thumbnail((WIDEST, WIDEST))
        pixels = np.asarray(image)
    return png(pixels)
