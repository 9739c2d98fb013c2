"""Which cases of a sweep are run on a day, and in which order files are given to workers."""

from collections.abc import Sequence
from typing import Protocol, TypeVar

Item = TypeVar("Item")


class Todays(Protocol):
    """Chooses the cases of one test."""

    def __call__(self, cases: Sequence[Item], every: int, turns: int = 1) -> list[Item]:
        """Return every nth case, at least one of them; in the next turn those after them.

        A test that itself runs on one day in ``turns`` says so: else it would take the same cases
        whenever it runs, if the two numbers have a factor in common.
        """


def of_day(
    cases: Sequence[Item], day: int, every: int, first: int = 0, neighbours: bool = False
) -> list[Item]:
    """Return every nth case; on the next day those after them.

    With ``neighbours``, an nth of them that stand side by side, as they share a preparation. If
    there are fewer than n, there is none on some days.
    """
    turn = (first + day) % every
    if neighbours:
        return list(cases[turn * len(cases) // every : (turn + 1) * len(cases) // every])
    return list(cases[turn::every])


# Files that take a worker longest, the longest first: begun last, one would go on alone at the end.
LONG = (
    *("attacks", "exercises", "cluster", "drivers", "no_shaders_called", "window", "why", "cli"),
    *("documents", "voxel_visibility", "lessons", "catalogues", "every_setting_of_the_hall_shows"),
    *("every_setting_of_the_voxels_shows", "contract", "solutions", "why_students", "site", "film"),
    *("title", "strip", "contexts", "hall_shadow", "notebooks", "grader", "trials", "program_glfw"),
    *("time", "every_setting_shows", "weathered_castle", "voxel_play", "guard", "parts", "bench"),
    *("scene", "sandbox", "face", "lecture", "lesson_programs", "goldens", "own_exercises"),
)


def longest_first(path: str) -> int:
    """Return the place of a file of tests among those of a run; most have the last one."""
    name = path.rpartition("/")[2].removeprefix("test_").removesuffix(".py")
    return LONG.index(name) if name in LONG else len(LONG)
