"""Which cases of a sweep are run on a day: after n days each of them has been."""

from collections.abc import Sequence
from typing import Protocol, TypeVar

Item = TypeVar("Item")


class Todays(Protocol):
    """Chooses the cases of one test."""

    def __call__(self, cases: Sequence[Item], every: int, first: int = 0) -> list[Item]:
        """Return every nth case, at least one of them; on the next day those after them."""


def of_day(cases: Sequence[Item], day: int, every: int, first: int = 0) -> list[Item]:
    """Return every nth case, at least one of them; on the next day those after them."""
    every = min(every, len(cases))
    return list(cases[(first + day) % every :: every]) if cases else []
