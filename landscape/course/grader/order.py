"""An order: a job, with the places where its program runs, as a process is given it in JSON."""

from collections.abc import Sequence
from typing import TypedDict


class Order(TypedDict):
    """The fields of a :class:`~landscape.course.grader.sandbox.Job`, then those of its place.

    ``folder`` is what the program may write into, ``cwd`` the folder that it begins in, and
    ``hidden`` are files and folders that it must not read.
    """

    path: str
    frames: Sequence[int]
    events: Sequence[dict[str, object]]
    calls: bool
    seconds: float
    megabytes: int
    trusted: bool
    why: str
    private: Sequence[str]
    again: bool
    recorded: str
    take: int

    folder: str
    cwd: str
    hidden: Sequence[str]
