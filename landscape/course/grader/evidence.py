"""The evidence of a run, as the tests of an exercise see it: pictures, calls, draws.

    frame = work.frame(0)
    frame.picture                      uint8 (h, w, 3), top row first
    frame.calls                        the frame's calls in order, those of display lists among them
    frame.find("glRotate")             those of one function, whatever its suffix: glRotatef, ...d
    work.find("glEnable", "GL_FOG")    those of the setup and of all frames, by first arguments, too
    frame.draws                        what each glBegin, glDrawArrays and glDrawElements draws

A :class:`Draw` has its vertices, in object, eye and window coordinates, their normals, colours and
texture coordinates, and OpenGL's state. Matrices are as one writes them, (4, 4), for column
vectors: the translation is the last column. Arrays in buffer objects and interleaved arrays are not
followed: such a draw has no vertices.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from landscape.course.grader.calls import (
    KINDS,
    NO_LINE,
    NONE,
    Call,
    Item,
    Numbers,
    base,
    expanded,
    names,
)
from landscape.course.grader.draws import Draw, drawn, state_matrix

__all__ = ["NO_LINE", "Call", "Draw", "Evidence", "Frame", "drawn", "state_matrix"]


@dataclass(frozen=True, eq=False)
class Frame:
    """A frame of a program; ``setup`` are the calls before the first that draws."""

    number: int
    picture: np.ndarray
    setup: Sequence[Item]
    top: Sequence[Item]
    numbers: Numbers = NONE

    @cached_property
    def calls(self) -> list[Call]:
        """The frame's calls in the order in which they take effect, without those of the setup."""
        return list(expanded(self.top, self.numbers))

    @cached_property
    def names(self) -> set[str]:
        """The names of the functions that the frame calls."""
        return names(self.top, self.numbers)

    @cached_property
    def draws(self) -> list[Draw]:
        """What is drawn, in order."""
        return list(drawn(self.top, self.numbers))

    @cached_property
    def _others(self) -> list[Call]:
        """The calls that do more than give numbers: far fewer."""
        return list(expanded(self.top, None))

    def find(self, name: str, *first: object) -> list[Call]:
        """Return the frame's calls of a function (see :meth:`Call.is_`), in order."""
        calls = self.calls if base(name) in KINDS else self._others
        return [call for call in calls if call.is_(name, *first)]


@dataclass(frozen=True, eq=False)
class Evidence:
    """What was noted of a program, by the frames that were looked at.

    ``early``: the first function that was called without a context, in vain, and the line.
    ``made``: all its calls, to draw the frames again (recorded.py); None if they cannot be.
    """

    path: Path
    source: Sequence[str]
    frames: Mapping[int, Frame]
    early: tuple[str, int] | None = None
    made: bytes | None = None

    def frame(self, number: int) -> Frame:
        """Return a frame that the exercise looks at."""
        return self.frames[number]

    @property
    def last(self) -> Frame:
        """The last frame that is looked at."""
        return self.frames[max(self.frames)]

    def find(self, name: str, *first: object) -> list[Call]:
        """Return calls of a function, of the setup and of all frames that are looked at."""
        setup = expanded(self.last.setup, self.last.numbers)
        found = [call for call in setup if call.is_(name, *first)]
        return found + [c for frame in self.frames.values() for c in frame.find(name, *first)]

    def text(self, line: int) -> str:
        """Return a line of the program without the space around it."""
        return self.source[line - 1].strip() if 0 < line <= len(self.source) else ""
