"""The programs of the exercises' solutions, as they are run."""

from functools import cache

from landscape.course.shelf import exercise
from landscape.course.solutions import whole


@cache
def solved(name: str, file: str = "solution.py") -> str:
    """Return the whole program that solves an exercise of the course."""
    folder = exercise(name).folder
    return whole(folder / file, folder)
