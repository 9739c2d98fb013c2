"""The exercises: which there are, what each asks, and checking a student's program.

An exercise is a folder landscape/course/exercises/NAME; docs/exercises.md says what is in it.
"""

import ast
import io
import random
import re
import secrets
import textwrap
import tokenize
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from runpy import run_path
from typing import Any

from framelens.base.errors import InputError, short
from framelens.base.input import read_bounded
from framelens.base.texts import Translator, translator
from landscape.course import program_texts
from landscape.course.grader.budget import SECONDS
from landscape.course.grader.cause import told
from landscape.course.grader.confinement import AUTO
from landscape.course.grader.evidence import Evidence
from landscape.course.grader.evidence_file import load
from landscape.course.grader.grading import (
    Hint,
    Result,
    Test,
    _,
    difference,
    equal_pictures,
    grade,
    same_pictures,
    tests_of,
)
from landscape.course.grader.sandbox import FULL, LATE, Job, Outcome, Sandbox
from landscape.course.grader.trial import Trial, broken_off, elsewhere, trial
from landscape.course.grader.troubles import known

FOLDER = Path(__file__).resolve().parent / "exercises"
# From one line to a page.
NAMES: tuple[str, ...] = (
    "missing_enable",
    "window",
    "first_drawing",
    "primitives",
    "winding",
    "mesh_tables",
    "homogeneous",
    "perspective",
    "look_at",
    "transform_order",
    "frames",
    "matrix_stack",
    "normals",
    "light_position",
    "materials",
    "texture_coordinates",
    "texture_filters",
    "textured_sphere",
    "fog",
    "blending_order",
    "clip_plane",
    "vertex_arrays",
    "billboard",
    "second_viewport",
    "mirror",
    "planar_shadow",
    "stencil_mirror",
    "hidden_faces",
    "shadow_map",
    "projection",
    "bresenham",
    "line_clipping",
    "back_faces",
    "bezier_path",
    "quad_tree",
    "level_of_detail",
    "floating_horizon",
)
HOLE = _("# Your code goes here.")
LEAD = _("Lessons to read first: {lessons}.")
MARKER = re.compile(r"^#\s*exercise:\s*(\S+)\s*$", re.MULTILINE)
LESSONS = re.compile(r"^# lessons: (.+)$", re.MULTILINE)
MOST_BYTES = 1 << 20  # chosen: of a program
COLUMNS = 92  # chosen: of the task in a program


@dataclass(frozen=True)
class Exercise:
    """One exercise; ``title`` and ``task`` (its paragraphs) are in English.

    ``lessons``: the names of those that it builds on.
    """

    name: str
    title: str
    task: Sequence[str]
    lessons: Sequence[str] = ()

    @property
    def folder(self) -> Path:
        """The folder of its files."""
        return FOLDER / self.name

    @property
    def translate(self) -> "Translate":
        """What translates its texts."""
        return Translate(self.name)


@dataclass(frozen=True)
class Translate:
    """The translators of an exercise's texts, and of the grader's own."""

    name: str

    def to(self, language: str) -> Translator:
        """Return the translator to a language."""
        return translator(language, f"exercises/{self.name}", "course")


@dataclass(frozen=True)
class Report:
    """What a check has found; without ``results`` if the program could not be graded.

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


def verdicts(report: Report, translate: Translator) -> list[dict[str, Any]]:
    """Return what is said of each test: name, passed, rationale, hint and otherwise.

    "passed" is None if it was not made. "otherwise": it has passed because the picture is right,
    not by what it looks for.
    """
    results = {result.test.key: result for result in report.results}
    tests = []
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
            }
        )
    return tests


def paragraphs(docstring: str) -> list[str]:
    """Return the paragraphs of a docstring, each on one line."""
    return [" ".join(part.split()) for part in re.split(r"\n\s*\n", docstring.strip())]


@cache
def exercise(name: str) -> Exercise:
    """Return the exercise of a name; InputError lists the names."""
    if name not in NAMES:
        raise InputError(
            "{name}: expected an exercise, one of {names}", name=short(name), names=", ".join(NAMES)
        )
    code = (FOLDER / name / "start.py").read_text(encoding="utf-8")
    title, *task = paragraphs(ast.get_docstring(ast.parse(code)) or "")
    named = LESSONS.search(code)
    return Exercise(name, title, task, named[1].split(", ") if named else ())


def start(found: Exercise, language: str) -> str:
    """Return the program that a student starts from, with its task in a language."""
    code = (found.folder / "start.py").read_text(encoding="utf-8")
    translated = found.translate.to(language)
    texts = [translated(text) for text in (found.title, *found.task)]
    texts.append(translated(LEAD).format(lessons=", ".join(found.lessons)))
    parts = [textwrap.fill(text, COLUMNS) for text in texts]
    # The names stay as they are: the language of OpenGL's is English.
    program = program_texts.translated(code[code.index('"""', 3) + 3 :], translated)
    return '"""' + "\n\n".join(parts) + '\n"""' + program.replace(HOLE, translated(HOLE))


def named_in(path: Path) -> Exercise:
    """Return the exercise that a student's file is of, by its line `# exercise: NAME`."""
    if path.is_dir():
        raise InputError(
            "{path}: is a folder, expected a program written for an exercise", path=path
        )
    data = read_bounded(path, MOST_BYTES)
    try:
        encoding, _lines = tokenize.detect_encoding(io.BytesIO(data).readline)
        text = data.decode(encoding)
    except (SyntaxError, UnicodeDecodeError):
        raise InputError("{path}: is not text, expected a Python program", path=path) from None

    names = MARKER.findall(text)
    if not names:
        raise InputError(
            "{path}: expected a line such as `# exercise: {names}`, which says of which "
            "exercise it is; `landscape exercise start` writes it",
            path=path,
            names=NAMES[0],
        )

    if len(set(names)) > 1:
        raise InputError(
            "{path}: names two exercises, {first} and {second}; expected one",
            path=path,
            first=names[0],
            second=names[1],
        )
    if names[0] not in NAMES:
        raise InputError(
            "{path}: {name}: expected an exercise, one of {names}",
            path=path,
            name=short(names[0]),
            names=", ".join(NAMES),
        )

    return exercise(names[0])


@cache
def grading(name: str) -> dict[str, Any]:
    """Return the names of an exercise's grading.py."""
    return run_path(str(FOLDER / name / "grading.py"))


class Grader:
    """Checks programs, in a sandbox of its own; use it in a ``with``.

    ``seconds``: how long a program may take to its last frame. ``contain``: whether the system is
    to contain programs, "auto" where it can, "require" in any case, "none" (see sandbox.py).
    ``seed``: of the trials (trial.py), chosen by chance if it is left out, so that no program can
    know them.
    """

    def __init__(
        self, seconds: float = SECONDS, contain: str = AUTO, seed: int | None = None
    ) -> None:
        self._seconds = seconds
        self._sandbox = Sandbox(contain)
        self._seed = secrets.randbits(64) if seed is None else seed
        self._solutions: dict[str, Evidence] = {}
        self._elsewhere: dict[str, Evidence] = {}  # of the solutions, in trials

    def __enter__(self) -> "Grader":
        return self

    def __exit__(self, *_: object) -> None:
        self._sandbox.close()

    def check(self, path: Path) -> Report:
        """Run a student's program beside the solution, and grade it.

        Where its pictures are right, it is run once more, in a trial. InputError if the file cannot
        be read, is of no exercise, or cannot be contained though it must be; NoOpenGLError.
        """
        found = named_in(path)
        names = grading(found.name)
        tests = tests_of(names)
        error = _syntax(path)
        if error is not None:
            return Report(found, tests, error=error)

        work, solution = self._run(
            path, found, names["FRAMES"], names.get("EVENTS", ()), self._solutions.get(found.name)
        )
        self._solutions[found.name] = solution
        if not isinstance(work, Evidence):
            return Report(found, tests, error=work, contained=self._sandbox.contained)

        code = (found.folder / "solution.py").read_text(encoding="utf-8")
        drawn = trial(code, random.Random(f"{self._seed} {found.name}"))
        last = elsewhere(drawn)
        told, equal = None, False
        right = same_pictures(tests, work, solution)
        if right:
            told, equal = self._tried(path, found, drawn, last)
        results = grade(tests, work, solution, equal and equal_pictures(work, solution))
        # The hint of another test that has failed says more of why the picture is wrong elsewhere.
        if right and all(result.passed for result in results):
            results.append(Result(last, told is None, told))
        else:
            results.append(Result(last, None))

        most = max(difference(work.frame(n), solution.frame(n)) for n in solution.frames)
        contained = self._sandbox.contained
        return Report(found, [*tests, last], results, most, None, work, solution, contained)

    def _tried(
        self, path: Path, found: Exercise, drawn: Trial, test: Test
    ) -> tuple[Hint | None, bool]:
        """Run a program in a trial; return what is wrong there, and whether nothing differs."""
        work, solution = self._run(
            path, found, drawn.frames, drawn.events, self._elsewhere.get(found.name), calls=False
        )
        self._elsewhere[found.name] = solution
        if not isinstance(work, Evidence):
            return broken_off(work), False
        return test.check(work, solution), equal_pictures(work, solution)

    def _run(
        self,
        path: Path,
        found: Exercise,
        frames: Sequence[int],
        events: Sequence[dict[str, Any]],
        solution: Evidence | None,
        calls: bool = True,
    ) -> tuple[Evidence | dict[str, Any], Evidence]:
        """Run a program, and the solution beside it if its evidence is not there yet.

        Return the evidence of both; of the program what went wrong, if anything did.
        """
        model = found.folder / "solution.py"
        paths = [path] if solution is not None else [path, model]
        jobs = [
            Job(str(each), frames, events, calls, self._seconds, trusted=each == model)
            for each in paths
        ]
        outcomes = self._sandbox.run(jobs)
        if solution is None:
            shown = _evidence(model, outcomes[1], frames)
            if not isinstance(shown, Evidence):
                raise InputError(
                    "{model}: the solution cannot be run here ({solution})",
                    model=model,
                    solution=shown["word"],
                )
            solution = shown

        work = _evidence(path, outcomes[0], frames)
        if not isinstance(work, Evidence):
            work = {"seconds": self._seconds, "megabytes": jobs[0].megabytes, **work}
        return work, solution

    def cause(self, path: Path, frame: int, language: str) -> dict[str, Any] | None:
        """Return why a frame of a program is as it is, as `landscape why --json`; None: not known.

        The program runs once more, in the sandbox.
        """
        job = Job(str(path), [frame], seconds=self._seconds, why=language)
        (outcome,) = self._sandbox.run([job])
        return told(outcome.answer[0].get("cause")) if outcome.answer is not None else None


def _syntax(path: Path) -> dict[str, Any] | None:
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


def _evidence(path: Path, outcome: Outcome, frames: Sequence[int]) -> Evidence | dict[str, Any]:
    """Return the evidence of a program that has run, or what went wrong."""
    if outcome.ended in (LATE, FULL):
        return {"word": outcome.ended}
    if outcome.crashed:
        if outcome.line:
            return {"word": "crashed_at", "signal": outcome.ended, "line": outcome.line}
        return {"word": "crashed", "signal": outcome.ended}

    died = {"word": "died", "signal": outcome.ended or "status 0"}
    if outcome.answer is None:
        return died
    try:
        answer = outcome.answer[0]
        if "error" in answer:
            return dict(answer["error"]) if known(answer["error"]) else died
        return load(path, outcome.answer, frames)
    except (
        ArithmeticError,
        AttributeError,
        LookupError,
        RecursionError,
        TypeError,
        ValueError,
    ):
        return died  # the program itself wrote into the file
