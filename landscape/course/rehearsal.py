"""An exercise tried before students get it: its solutions, its start, its mistakes, its French.

Each solution passes; the start runs and does not pass; each mistake fails first in the test that it
names, with a hint that no other mistake gets.
"""

import tempfile
import traceback
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from framelens.base.errors import Message
from framelens.base.texts import Translator
from landscape.course.exercise import Grader, Report
from landscape.course.grader.grading import UNLIKE, Result
from landscape.course.grader.mutants import Mutant, mutants
from landscape.course.grader.troubles import sentence
from landscape.course.own_exercise import FRENCH, untranslated
from landscape.course.shelf import Exercise, start
from landscape.course.solutions import ways, whole

FEWEST = 4  # mistakes, chosen
GENERAL = "--heat-map"  # in the hints that say where the picture differs, but not why


@dataclass(frozen=True)
class Finding:
    """What was tried of an exercise, and what is ``wrong`` with it; None if nothing is."""

    tried: Message
    wrong: Message | None = None


def count(found: Exercise) -> int:
    """Return how many findings :meth:`Rehearsal.all` has, where solution.py passes."""
    french = (found.folder / FRENCH).is_file()
    return len(ways(found.folder)) + 2 + len(mutants(found)) + french


class Rehearsal:
    """Tries an exercise with a grader; texts of its own are in the language of ``translate``."""

    def __init__(self, found: Exercise, grader: Grader, translate: Translator) -> None:
        self._found = found
        self._grader = grader
        self._translate = translate
        self._told: dict[str, str] = {}  # who got a hint, as it is read and without its values

    def all(self) -> Iterator[Finding]:
        """Try everything; what is tried later is not, where solution.py itself does not pass."""
        for file in ways(self._found.folder):
            finding = self.solution(file)
            yield finding
            if finding.wrong is not None and file.name == "solution.py":
                return
        yield self.start()
        mistakes = mutants(self._found)
        yield self.count(mistakes)
        for name, mutant in mistakes.items():
            yield self.mistake(name, mutant)
        if (self._found.folder / FRENCH).is_file():
            yield self.french()

    def solution(self, file: Path) -> Finding:
        """Try a solution: it passes, the first one by what each test looks for."""
        tried = Message("{file} passes", file=file.name)
        report = self._grader.check(file)
        wrong = self._failed(report)
        otherwise = [result.test.key for result in report.results if result.otherwise]
        if wrong is None and otherwise and file.name == "solution.py":
            wrong = self._raised(report) or Message(
                "{test} does not find what it looks for: it passes as the picture is right",
                test=otherwise[0],
            )
        return Finding(tried, wrong)

    def start(self) -> Finding:
        """Try the start: it runs, and one test fails; its hint is no mistake's."""
        tried = Message("start.py runs and does not pass")
        report = self._grader.check(self._found.folder / "start.py")
        if report.error is not None:
            return Finding(tried, self._failed(report))
        if report.passed:
            return Finding(tried, Message("it passes as it is"))
        found = failures(report)
        for result in found:
            self._note("start.py", result)
        if len(found) > 1:
            return Finding(
                tried,
                Message(
                    "it fails in {tests}: expected one test, and `needs` for what builds on it",
                    tests=", ".join(result.test.key for result in found),
                ),
            )
        # What a test gives for nothing, a hidden one for instance, is not seen otherwise.
        given = sum(each.test.points for each in report.results if each.passed)
        return Finding(
            Message(
                "start.py runs and does not pass: it gets {given} of {all} points",
                given=f"{given:g}",
                all=f"{sum(test.points for test in report.tests):g}",
            )
        )

    def count(self, mistakes: Mapping[str, Mutant]) -> Finding:
        """Look how many mistakes there are."""
        tried = Message("mutants.py has at least {least} mistakes", least=FEWEST)
        few = Message("it has {count}", count=len(mistakes))
        return Finding(tried, few if len(mistakes) < FEWEST else None)

    def mistake(self, name: str, mutant: Mutant) -> Finding:
        """Try a mistake: the test fails that should, with a hint that no other gets."""
        tried = Message("the mistake {name} gets a hint of its own", name=name)
        try:
            code = mutant.of(whole(self._found.folder / "solution.py", self._found.folder))
        except ValueError as error:
            return Finding(tried, Message("{error}", error=error))
        with tempfile.TemporaryDirectory(prefix="landscape-test-") as folder:
            path = Path(folder) / "program.py"
            path.write_text(code, encoding="utf-8")
            report = self._grader.check(path)
        return Finding(tried, self._wrong(name, mutant, report))

    def _wrong(self, name: str, mutant: Mutant, report: Report) -> Message | None:
        if report.error is not None:
            return self._failed(report)
        found = failures(report)
        if [result.test.key for result in found] != [mutant.fails]:
            if not found:
                return Message("it passes, expected that {test} fails", test=mutant.fails)
            return Message(
                "it fails in {tests}, expected {test}",
                tests=", ".join(result.test.key for result in found),
                test=mutant.fails,
            )
        hint = found[0].hint
        assert hint is not None
        said = hint.written(self._translate)
        if hint.text == UNLIKE or GENERAL in hint.text:
            return Message("it gets only the general hint: {hint}", hint=said)
        return self._note(name, found[0])

    def _note(self, name: str, result: Result) -> Message | None:
        """Note that a mistake got a hint; return what is wrong where another has got it."""
        hint = result.hint
        assert hint is not None
        said = hint.written(self._translate)
        first = next((self._told[text] for text in (hint.text, said) if text in self._told), None)
        self._told |= {hint.text: name, said: name}
        if first is None:
            return None
        return Message("it gets the hint of {other}: {hint}", other=first, hint=said)

    def french(self) -> Finding:
        """Look whether all texts have a French one, and the program is one in French, too."""
        tried = Message("fr.po has all texts")
        missing = untranslated(self._found)
        if missing:
            return Finding(
                tried,
                Message("missing: {count}, the first: {text}", count=len(missing), text=missing[0]),
            )
        try:
            compile(start(self._found, "fr"), "start.py", "exec")
        except SyntaxError as error:
            return Finding(
                tried, Message("the program in French is not Python: {error}", error=error)
            )
        return Finding(tried)

    def _raised(self, report: Report) -> Message | None:
        """Return what a test raised, and on which line of its file; None if none has.

        Of a student's program that means that it draws something else; of one that draws the right
        picture, that the test itself is wrong.
        """
        work, solution = report.work, report.solution
        if work is None or solution is None:
            return None

        for test in (each.test for each in report.results if each.otherwise):
            if test.hidden:  # of another run
                continue
            try:
                with np.errstate(all="ignore"):
                    test.check(work, solution)
            except Exception as error:
                lines = traceback.extract_tb(error.__traceback__)
                own = [line for line in lines if Path(line.filename).parent == self._found.folder]
                where = (own or lines)[-1]
                return Message(
                    "{test} raised {kind}, {file}, line {line}: {error}",
                    test=test.key,
                    kind=type(error).__name__,
                    file=Path(where.filename).name,
                    line=where.lineno,
                    error=" ".join(str(error).split()),
                )
        return None

    def _failed(self, report: Report) -> Message | None:
        """Return why a program has not passed; None if it has."""
        if report.error is not None:
            return Message("{error}", error=sentence(report.error, self._translate))
        for result in report.results:
            if result.passed is False and result.hint is not None:
                hint = result.hint.written(self._translate)
                return Message("it fails in {test}: {hint}", test=result.test.key, hint=hint)
        return None


def failures(report: Report) -> Sequence[Result]:
    """Return the tests that failed, those that students do not see only where no other did."""
    found = [result for result in report.results if result.passed is False]
    return [result for result in found if not result.test.hidden] or found
