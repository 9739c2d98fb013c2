"""The mistakes by which an exercise is tried, in its mutants.py."""

from collections.abc import Sequence
from dataclasses import dataclass

from framelens.base.errors import InputError
from landscape.course.grader.grading_file import names_of
from landscape.course.shelf import Exercise


@dataclass(frozen=True)
class Mutant:
    """A mistake: what it is, the first test that fails, and how solution.py is changed.

    Each change is (old, new); old stands in the solution exactly once.
    """

    mistake: str
    fails: str
    changes: Sequence[tuple[str, str]]

    def of(self, code: str) -> str:
        """Return the solution with the mistake; ValueError where the old text is not there once."""
        for old, new in self.changes:
            if code.count(old) != 1:
                raise ValueError(f"{self.mistake}: {code.count(old)} times in the solution: {old}")
            code = code.replace(old, new)
        return code


def mutants(exercise: Exercise) -> dict[str, Mutant]:
    """Return the mistakes of an exercise by their names; InputError if its mutants.py has none."""
    path = exercise.folder / "mutants.py"
    found = names_of(path).get("MUTANTS")
    if not isinstance(found, dict) or not all(isinstance(each, Mutant) for each in found.values()):
        raise InputError(
            '{path}: MUTANTS: expected mistakes by their names, {{"NAME": Mutant(...), ...}}',
            path=path,
        )
    return found
