"""The calls of a program, as the tests of an exercise see them.

Most calls only give numbers: glVertex3f and its like. They are kept as :class:`Numbers`, in columns
for all of a program; among a frame's calls a range stands for those of them that follow each other.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache, cached_property
from typing import Any

import numpy as np

from framelens.spec import spec

State = Mapping[str, Any]
"""OpenGL's state, by the names of `landscape state`."""

NO_LINE = 0
KINDS = ("glVertex", "glNormal", "glColor", "glTexCoord")
WHOLE = {"b": 127, "ub": 255, "s": 32767, "us": 65535, "i": 2**31 - 1, "ui": 2**32 - 1}


@dataclass(eq=False, slots=True)  # thousands are made and looked for
class Call:
    """One call. ``line`` is that of the student's file; NO_LINE in a module that it imports.

    ``state`` is OpenGL's, by the names of `landscape state`, just before a call that draws; it is
    that of the glCallList for what a display list draws, and empty for other calls. ``way`` are the
    student's lines that lead to the call, from the outermost, each with the name of the function
    that it calls; it is not known of glVertex and its like, nor inside display lists.
    """

    name: str
    args: Sequence[Any]
    line: int
    function: str
    state: State = field(default_factory=dict, repr=False)
    arrays: Sequence[Any] = field(default=(), repr=False)
    inside: Sequence["Call | range"] = field(default=(), repr=False)
    way: Sequence[tuple[int, str]] = field(default=(), repr=False)

    @property
    def base(self) -> str:
        """The name without its suffix: glVertex for glVertex3f."""
        return base(self.name)

    def is_(self, name: str, *first: object) -> bool:
        """Return whether it calls a function, named with or without suffix, with these arguments.

        Only the first arguments need be given; None stands for any.
        """
        return (
            (name == self.name or name == self.base)
            and len(self.args) >= len(first)
            and all(a is None or a == b for a, b in zip(first, self.args, strict=False))
        )


Site = tuple[str, int, str, int]
"""What calls of one line have in common: name, line, function, and the count of arguments."""


@dataclass(eq=False)
class Numbers:
    """n calls that only give numbers, in their order.

    ``sites``: those that there are; ``of`` (n,): which one each call is of; ``values``: the
    arguments of all calls, one after the other.
    """

    sites: Sequence[Site]
    of: np.ndarray
    values: np.ndarray

    @cached_property
    def _first(self) -> np.ndarray:
        counts = np.array([count for *_, count in self.sites], int)[self.of]
        return np.concatenate([[0], np.cumsum(counts)])

    def check(self) -> None:
        """Raise an error of Python unless the columns go together."""
        if self.of.size and not 0 <= self.of.min() <= self.of.max() < len(self.sites):
            raise ValueError("a call of no site")
        if self._first[-1] != len(self.values) or min(self.kinds, default=0) < 0:
            raise ValueError(f"{len(self.values)} arguments of {len(self.of)} calls")

    def some(self, first: int, count: int) -> range:
        """Return ``count`` calls from ``first`` on; ValueError unless there are so many."""
        if not (0 <= first < first + count <= len(self.of)):
            raise ValueError(f"no {count} calls from {first} on")
        return range(first, first + count)

    def calls(self, some: range) -> list[Call]:
        """Return some of the calls; each time they are others."""
        first, of = (
            self._first[some.start : some.stop + 1].tolist(),
            self.of[some.start : some.stop].tolist(),
        )
        values = self.values[first[0] : first[-1]].tolist()
        found = []
        for site, begin, end in zip(of, first, first[1:], strict=False):
            name, line, function, _ = self.sites[site]
            found.append(Call(name, values[begin - first[0] : end - first[0]], line, function))
        return found

    def names(self, some: range) -> set[str]:
        """Return the names of some of the calls."""
        return {self.sites[site][0] for site in set(self.of[some.start : some.stop].tolist())}

    @cached_property
    def kinds(self) -> np.ndarray:
        """The kind of value that each call sets, (n,): an index of KINDS."""
        kinds = {name: kind for kind, name in enumerate(KINDS)}
        return np.array([kinds.get(base(name), -1) for name, *_ in self.sites], int)[self.of]

    @cached_property
    def vectors(self) -> np.ndarray:
        """The arguments of the calls, (n, 4), filled up with 0, 0, 0, 1 as OpenGL does."""
        found = np.tile([0.0, 0.0, 0.0, 1.0], (len(self.of), 1))
        for number, (name, _, _, count) in enumerate(self.sites):
            rows = np.flatnonzero(self.of == number)
            if len(rows):
                given = self.values[self._first[rows][:, None] + np.arange(min(count, 4))]
                found[rows, :count] = given / whole(name)
        return found

    @cached_property
    def latest(self) -> np.ndarray:
        """The last call of each kind but glVertex up to each call, (3, n); -1 without one."""
        places = np.arange(len(self.of))
        rows = [np.where(self.kinds == kind, places, -1) for kind in range(1, len(KINDS))]
        return np.maximum.accumulate(np.array(rows).reshape(len(rows), -1), axis=1)


NONE = Numbers((), np.zeros(0, int), np.zeros(0))
Item = Call | range
"""A call, or several that follow each other in :class:`Numbers`."""


def expanded(calls: Sequence[Item], numbers: Numbers | None) -> Iterator[Call]:
    """Yield calls and those of the display lists that they execute, in their order.

    Without ``numbers`` those that only give numbers are left out.
    """
    for call in calls:
        if isinstance(call, range):
            yield from numbers.calls(call) if numbers is not None else ()
        else:
            yield call
            yield from expanded(call.inside, numbers)


def names(calls: Sequence[Item], numbers: Numbers) -> set[str]:
    """Return the names of calls and of those of the display lists that they execute."""
    found: set[str] = set()
    for call in calls:
        if isinstance(call, range):
            found |= numbers.names(call)
        else:
            found.add(call.name)
            found |= names(call.inside, numbers)
    return found


@cache
def base(name: str) -> str:
    """Return the name of a function without its suffix: glVertex for glVertex3f."""
    known = spec.function(name)
    return known.base if known is not None else name


@cache
def whole(name: str) -> int:
    """Return by what a call divides its arguments: glColor3ub by 255."""
    known = spec.function(name)
    if known is None or known.base not in ("glColor", "glNormal"):
        return 1
    return WHOLE.get(name.removeprefix(known.base).strip("234").removesuffix("v"), 1)
