"""Checking a student's program: it is run beside the solution, and graded."""

import ast
import os
import random
import secrets
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, TypedDict

import numpy as np

from framelens.base.errors import InputError
from framelens.base.texts import Translator
from landscape.course import solutions
from landscape.course.grader import recorded
from landscape.course.grader.budget import SECONDS
from landscape.course.grader.cause import told
from landscape.course.grader.confinement import AUTO
from landscape.course.grader.evidence import Evidence
from landscape.course.grader.evidence_file import TooLarge, load
from landscape.course.grader.grading import (
    Hint,
    Result,
    Test,
    Text,
    _,
    difference,
    equal_pictures,
    grade,
    hint,
    same_drawing,
    same_pictures,
)
from landscape.course.grader.grading_file import Grading, read_grading
from landscape.course.grader.sandbox import FULL, LATE, TOO_MUCH, Job, Outcome, Sandbox
from landscape.course.grader.trial import Trial, broken_off, elsewhere, trial
from landscape.course.grader.troubles import SENTENCES, known
from landscape.course.shelf import COURSE, HIDDEN, Exercise, Shelf
from landscape.course.solutions import solution as solution_of


@dataclass(frozen=True)
class Report:
    """The result of a check; without ``results`` if the program could not be graded.

    ``difference`` is the fraction of the pixels that differ, in the frame where most do. ``error``
    has a word of troubles.py and the values of its sentence. ``contained`` is what contained the
    program, "landlock" or "python" (confinement.py); "" if it was not run.
    """

    exercise: Exercise
    tests: Sequence[Test]
    results: Sequence[Result] = ()
    difference: float | None = None
    error: Mapping[str, Any] | None = None
    work: Evidence | None = None
    solution: Evidence | None = None
    contained: str = ""

    @property
    def passed(self) -> bool:
        """Whether every test has passed."""
        return bool(self.results) and all(result.passed for result in self.results)


class Verdict(TypedDict):
    """What is said of a test.

    "passed" is None if it was not made. "otherwise": it has passed because the picture is right,
    not by what it looks for. "hidden": students do not see it. "points": what it is worth.
    """

    name: str
    passed: bool | None
    rationale: str
    hint: str
    otherwise: bool
    hidden: bool
    points: float


def verdicts(report: Report, translate: Translator) -> list[Verdict]:
    """Return what is said of each test."""
    results = {result.test.key: result for result in report.results}
    tests: list[Verdict] = []
    for test in report.tests:
        result = results.get(test.key)
        hint = result.hint if result is not None else None
        tests.append(
            {
                "name": translate(test.name),
                "passed": result.passed if result is not None else None,
                "rationale": translate(test.rationale),
                "hint": hint.written(translate) if hint is not None else "",
                "otherwise": result is not None and result.otherwise,
                "hidden": test.hidden,
                "points": test.points,
            }
        )
    return tests


def gradings(found: Exercise) -> tuple[Grading, Grading | None]:
    """Return what an exercise looks at and tests, and the same of what students do not see."""
    hidden = found.folder / HIDDEN
    shown = read_grading(found.folder / "grading.py")
    if not hidden.is_file() or solution_of(found.folder) is None:
        return shown, None  # what is recorded of a solution has none of the hidden frames
    return shown, read_grading(hidden, hidden=True)


class Grader:
    """Checks programs, in a sandbox of its own; use it in a ``with``.

    ``seconds``: how long a program may take to its last frame. ``contain``: whether the system is
    to contain programs, "auto" where it can, "require" in any case, "none" (see sandbox.py).
    ``seed``: of the trials (trial.py), chosen by chance if it is left out, so that no program can
    know them. ``shelf``: where the exercises lie. ``private``: files and folders of which programs
    must read nothing, such as those of a class; the folder of each program is so in any case.
    """

    def __init__(
        self,
        seconds: float = SECONDS,
        contain: str = AUTO,
        seed: int | None = None,
        shelf: Shelf = COURSE,
        private: Sequence[str] = (),
    ) -> None:
        self._seconds = seconds
        self._others = private
        self._sandbox = Sandbox(contain)
        self._seed = secrets.randbits(64) if seed is None else seed
        self._shelf = shelf
        self._gradings: dict[Exercise, tuple[Grading, Grading | None]] = {}
        self._trials: dict[Exercise, tuple[Trial, int]] = {}
        # The evidence of the solutions by their names: as students know the tests, in trials, and
        # for the tests that students do not see.
        self._solutions: dict[str, Evidence] = {}
        self._elsewhere: dict[str, Evidence] = {}
        self._hidden: dict[str, Evidence] = {}

    def __enter__(self) -> "Grader":
        return self

    def __exit__(self, *_: object) -> None:
        self._sandbox.close()

    def check(self, path: Path) -> Report:
        """Run a student's program beside the solution, and grade it.

        Where its pictures are right, it is run once more, in a trial. InputError if the file cannot
        be read, is of no exercise, or cannot be contained though it must be; NoOpenGLError.
        """
        found = self._shelf.named_in(path)
        if found not in self._gradings:
            self._gradings[found] = gradings(found)
            self._trials[found] = self._trial(found)
        shown, hidden = self._gradings[found]
        drawn, take = self._trials[found]
        last = elsewhere(drawn, shown.elsewhere)
        tests = [*shown.tests, last, *(hidden.tests if hidden is not None else ())]
        path = self._runnable(path, found)
        error = _syntax(path)
        if error is not None:
            return Report(found, tests, error=error)

        work, trouble, solution = self._run(
            path, found, shown.frames, shown.events, self._solutions.get(found.name)
        )
        self._solutions[found.name] = solution
        if work is None:
            return Report(found, tests, error=trouble, contained=self._sandbox.contained)

        told, equal = None, False
        right = same_pictures(shown.tests, work, solution)
        if right:
            told, equal = self._tried(path, found, drawn, take, last)
        results = grade(shown.tests, work, solution, equal and equal_pictures(work, solution))
        results.append(_elsewhere(results, last, right, told))
        if hidden is not None:
            results += self._unseen(path, found, hidden, equal)

        most = max(difference(work.frame(n), solution.frame(n)) for n in solution.frames)
        contained = self._sandbox.contained
        return Report(found, tests, results, most, None, work, solution, contained)

    def _trial(self, found: Exercise) -> tuple[Trial, int]:
        """Return a trial by chance; one that was recorded, and its number, without a solution."""
        chance = random.Random(f"{self._seed} {found.name}")
        program = solution_of(found.folder)
        if program is not None:
            return trial(solutions.whole(program, found.folder), chance), 0
        takes = recorded.read(found.folder / recorded.FILE).takes
        number = chance.randrange(1, len(takes))
        return takes[number].trial, number

    def _tried(
        self, path: Path, found: Exercise, drawn: Trial, take: int, test: Test
    ) -> tuple[Hint | None, bool]:
        """Run a program in a trial; return what is wrong there, and whether nothing differs."""
        known = self._elsewhere.get(found.name)
        work, trouble, solution = self._run(
            path, found, drawn.frames, drawn.events, known, calls=False, take=take
        )
        self._elsewhere[found.name] = solution
        if work is None:
            return broken_off(trouble), False
        return test.check(work, solution), equal_pictures(work, solution)

    def _unseen(self, path: Path, found: Exercise, hidden: Grading, equal: bool) -> list[Result]:
        """Make the tests that students do not see, in a run of their own.

        ``equal``: in the trial nothing differed.
        """
        work, trouble, solution = self._run(
            path, found, hidden.frames, hidden.events, self._hidden.get(found.name)
        )
        self._hidden[found.name] = solution
        if work is not None:
            return grade(hidden.tests, work, solution, equal and equal_pictures(work, solution))
        reason = hint(Text(SENTENCES[str(trouble["word"])]), **trouble)
        stopped = hint(_("In the run of the hidden tests this happens: {reason}"), reason=reason)
        first, *others = hidden.tests
        return [Result(first, False, stopped), *(Result(test, None) for test in others)]

    def _run(
        self,
        path: Path,
        found: Exercise,
        frames: Sequence[int],
        events: Sequence[dict[str, object]],
        solution: Evidence | None,
        calls: bool = True,
        take: int = 0,
    ) -> tuple[Evidence | None, dict[str, Any], Evidence]:
        """Run a program, and the solution beside it if its evidence is not there yet.

        ``take`` is that of a recorded solution. Return the program's evidence, None if something
        went wrong, then what that is, and the solution's evidence.
        """
        program = solution_of(found.folder)
        model = None
        if solution is None and program is not None:
            model = self._runnable(program, found)
        private = self._private()  # the model's folder, too
        jobs = [Job(str(path), frames, events, calls, self._seconds, private=private, again=calls)]
        if solution is None:
            jobs.append(_of_solution(jobs[0], found, model, take))
        outcomes = self._sandbox.run(jobs)
        if solution is None:
            solution = _solution(found, program, model, outcomes[1], frames)

        work, trouble = _evidence(path, outcomes[0], frames)
        if work is None:
            limits = {"seconds": self._seconds, "megabytes": jobs[0].megabytes}
            return None, limits | trouble, solution
        if calls and (other := self._drawn_otherwise(work, frames, events)) is not None:
            return None, {"word": "forged", "frame": other}, solution
        return work, {}, solution

    def _drawn_otherwise(
        self, work: Evidence, frames: Sequence[int], events: Sequence[dict[str, object]]
    ) -> int | None:
        """Return the first frame that the program's calls draw otherwise than it says, if any does.

        They are made again by another process, which must get as far: the first frame if it does
        not. None, too, where there are calls that cannot be made again.
        """
        if work.made is None:
            return None
        made = recorded.parsed(work.made)
        if made is None or len(made.takes) != 1:
            return min(frames)
        with self._sandbox.file(work.made) as file:
            player = str(recorded.PLAYER)
            # Twice the time: what it takes must not depend on what else the machine does.
            job = Job(player, frames, events, seconds=2 * self._seconds, recorded=str(file))
            (outcome,) = self._sandbox.run([job])
        again, _trouble = _evidence(recorded.PLAYER, outcome, frames)
        if again is None:
            return min(frames)
        return next((n for n in frames if not same_drawing(work.frame(n), again.frame(n))), None)

    def _private(self) -> list[str]:
        """Return the files and folders of which a program must read nothing."""
        kept = self._sandbox.kept
        folders = [self._shelf.folder, *self._shelf.own.values(), solutions.folder(), kept]
        return [*(os.path.realpath(each) for each in folders if each is not None), *self._others]

    def _runnable(self, path: Path, found: Exercise) -> Path:
        """Return a file that can be run: the whole program, where a solution has only its parts."""
        if not solutions.is_in_parts(path, found.folder):
            return path
        data = solutions.whole(path, found.folder).encode()
        return self._sandbox.keep(f"{found.name}-{path.name}", data)

    def cause(self, path: Path, frame: int, language: str) -> dict[str, Any] | None:
        """Return why a frame of a program is as it is, as `landscape why --json`; None: not known.

        The program runs once more, in the sandbox.
        """
        private = self._private()
        job = Job(str(path), [frame], seconds=self._seconds, why=language, private=private)
        (outcome,) = self._sandbox.run([job])
        return told(outcome.answer[0].get("cause")) if outcome.answer is not None else None


def _elsewhere(results: Sequence[Result], last: Test, right: bool, told: Hint | None) -> Result:
    """Return the result of the test in a trial, in which ``told`` is wrong.

    Where a picture is not ``right``, or another test has failed, its hint says more of why.
    """
    if right and all(result.passed for result in results):
        return Result(last, told is None, told)
    return Result(last, None)


def _solution(
    found: Exercise,
    program: Path | None,
    model: Path | None,
    outcome: Outcome,
    frames: Sequence[int],
) -> Evidence:
    """Return the evidence of an exercise's solution, ``model`` as it was run; InputError if none.

    ``program`` is its file, None for a recorded one.
    """
    # A recorded one has no text: the tests compare with the text of the start.
    shown, trouble = _evidence(model or found.folder / "start.py", outcome, frames)
    if shown is None:
        raise InputError(
            "{model}: the solution cannot be run here ({solution})",
            model=program or found.folder,
            solution=trouble.get("reason", trouble["word"]),
        )
    return shown


def _syntax(path: Path) -> dict[str, object] | None:
    """Return why a file is not Python; None if it is."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of "\d" in a text, for instance
            ast.parse(path.read_bytes())
    except SyntaxError as error:
        return {"word": "syntax", "line": error.lineno or 1, "error": error.msg}
    except (ValueError, RecursionError, MemoryError):
        return {"word": "not_python"}
    return None


def _evidence(
    path: Path, outcome: Outcome, frames: Sequence[int]
) -> tuple[Evidence | None, dict[str, Any]]:
    """Return the evidence of a program that has run; None if something went wrong, then what."""
    if outcome.ended in (LATE, *TOO_MUCH):
        return None, {"word": outcome.ended}
    if outcome.crashed:
        if outcome.line:
            return None, {"word": "crashed_at", "signal": outcome.ended, "line": outcome.line}
        return None, {"word": "crashed", "signal": outcome.ended}

    died = {"word": "died", "signal": outcome.ended or "status 0"}
    if outcome.answer is None:
        return None, died
    try:
        answer = outcome.answer[0]
        if "error" in answer:
            return None, dict(answer["error"]) if known(answer["error"]) else died
        return _sound(load(path, outcome.answer, frames)), {}
    except TooLarge:
        return None, {"word": FULL}
    except (
        ArithmeticError,
        AttributeError,
        LookupError,
        RecursionError,
        TypeError,
        ValueError,
    ):
        return None, died  # the program itself wrote into the file


def _sound(found: Evidence) -> Evidence:
    """Return evidence from which it can be computed what is drawn; else errors of Python."""
    with np.errstate(all="ignore"):
        for frame in found.frames.values():
            len(frame.draws)
    return found


def _of_solution(job: Job, found: Exercise, model: Path | None, take: int) -> Job:
    """Return the job of the solution beside a program's: of its file, or of what was recorded."""
    job = replace(job, path=str(model or recorded.PLAYER), trusted=True, again=False)
    if model is None:
        job = replace(job, recorded=str(found.folder / recorded.FILE), take=take)
    return job
