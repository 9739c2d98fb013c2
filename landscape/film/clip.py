"""A clip: a part of a film that is drawn from its time alone.

That is what lets several processes share a film: whichever draws a frame, and whatever it has drawn
before, the picture is the same. A new kind of film is a class with these three
members.
"""

from collections.abc import Callable
from typing import Protocol

import numpy as np

from landscape.film.stage import Stage

Pictures = Callable[[float], np.ndarray]
"""From seconds since a clip's start to its picture, uint8 (h, w, 3), top row first."""


class Clip(Protocol):
    """A part of a film; a plain value, which is sent to the processes that draw."""

    @property
    def seconds(self) -> float:
        """How long it is."""

    @property
    def needs_opengl(self) -> bool:
        """Whether OpenGL draws it."""

    def open(self, stage: Stage) -> Pictures:
        """Return the function that draws it on a stage; it may open scenes there when called."""
