"""Where the solutions of the exercises are: with teachers, not in what students install.

A checkout has them beside the exercises. The wheel has the calls of each instead, recorded in some
trials (grader/recorded.py): they can be drawn, and not read as a program. Where LANDSCAPE_SOLUTIONS
names a folder like landscape/course/exercises of a checkout, its solutions are used.
"""

import os
from pathlib import Path

from framelens.base.errors import InputError

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
