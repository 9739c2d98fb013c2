"""Where the solutions of the exercises are: with teachers, not in what students install.

A checkout has them beside the exercises. The wheel has the calls of each instead, recorded in some
trials (grader/recorded.py): they can be drawn, and not read as a program. Where LANDSCAPE_SOLUTIONS
names a folder like landscape/course/exercises of a checkout, its solutions are used.

A solution is a whole program, or only the parts in which it differs from start.py (parts.py).
"""

import contextlib
import os
import tempfile
from collections.abc import Iterator
from pathlib import Path

from framelens.base.errors import InputError
from landscape.course import parts
from landscape.course.shelf import source

FOLDER = "LANDSCAPE_SOLUTIONS"
PROGRAM = "solution.py"


def folder() -> Path | None:
    """Return the folder that the environment names, if it names one."""
    named = os.environ.get(FOLDER)
    return Path(named) if named else None


def solution(exercise: Path) -> Path | None:
    """Return the program that solves the exercise of a folder; None where it is not installed."""
    named = folder()
    places = [exercise, *([named / exercise.name] if named is not None else [])]
    return next((each / PROGRAM for each in places if (each / PROGRAM).is_file()), None)


def found(exercise: Path) -> Path:
    """Return the program that solves the exercise; InputError says where teachers get it."""
    program = solution(exercise)
    if program is None:
        raise InputError(
            "{name}: the solutions are not installed with the program; teachers have them in a "
            "checkout, in landscape/course/exercises, or name a copy of that folder by {variable}",
            name=exercise.name,
            variable=FOLDER,
        )
    return program


def ways(exercise: Path) -> list[Path]:
    """Return the files of an exercise's solutions, solution.py first, even if it is not there."""
    first = solution(exercise) or exercise / PROGRAM
    return [first, *sorted(set(first.parent.glob("solution*.py")) - {first})]


def whole(file: Path, exercise: Path) -> str:
    """Return the program of a file of solutions, with what it leaves to the start."""
    code = source(file)
    if not parts.is_parts(code):
        return code
    return parts.assembled(code, source(exercise / "start.py"), file)


def is_in_parts(file: Path, exercise: Path) -> bool:
    """Return whether a program is one of an exercise's solutions, and not whole."""
    named = folder()
    places = [exercise, *([named / exercise.name] if named is not None else [])]
    beside = file.resolve().parent in [each.resolve() for each in places]
    return beside and file.suffix == ".py" and parts.is_parts(source(file))


@contextlib.contextmanager
def runnable(file: Path, exercise: Path) -> Iterator[Path]:
    """Have a file that Python can run for the block: this one, or a copy of the whole program."""
    if not is_in_parts(file, exercise):
        yield file
        return
    with tempfile.TemporaryDirectory(prefix="landscape-solution-") as place:
        path = Path(place) / file.name
        path.write_text(whole(file, exercise), encoding="utf-8")
        yield path
