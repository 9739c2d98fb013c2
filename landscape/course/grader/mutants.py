"""The mistakes that an exercise ships, in landscape/course/exercises/NAME/mutants.py."""

from collections.abc import Sequence
from dataclasses import dataclass
from runpy import run_path

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
    """Return the mistakes of an exercise by their names."""
    found: dict[str, Mutant] = run_path(str(exercise.folder / "mutants.py"))["MUTANTS"]
    return found
