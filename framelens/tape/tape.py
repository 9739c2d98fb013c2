"""A frame as it was drawn: all calls with their arguments, and the state in which it began.

It can be drawn again in its context, whole or in part, and in a new one from the tape alone.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from framelens.gl.seam import Call
from framelens.state.state import restore
from framelens.state.state_reading import Values
from framelens.tape.buffers import Buffers
from framelens.tape.steps import Step, bind_again, issue, steps

if TYPE_CHECKING:
    from framelens.program.past import Past


@dataclass
class Tape:
    """The calls up to the end of a frame; the frame itself begins with ``calls[begin]``.

    ``start`` is the state in which it began (framelens/state/state.py), ``size`` the picture's in
    pixels. ``notices`` are lines for the user; ``before`` is what the framebuffer held, where that
    may matter; ``past`` says what came before, where somebody has asked for it.
    """

    calls: Sequence[Call]
    begin: int
    start: Values
    size: tuple[int, int]
    notices: list[str] = field(default_factory=list)
    before: Buffers | None = None
    past: "Past | None" = None

    @property
    def frame(self) -> Sequence[Call]:
        """The calls of the frame, without those of the setup."""
        return self.calls[self.begin :]

    def steps(self) -> Iterator[Step]:
        """Return the frame's calls one by one, with what display lists execute."""
        return steps(self.frame)

    def rewind(self) -> None:
        """Set the state in which the frame began, and what the framebuffer held."""
        restore(self.start)
        bind_again(self.frame, self.start.get("GL_CURRENT_PROGRAM", 0))
        if self.before is not None:
            self.before.write()

    def replay(self, before: Callable[[Call], object] | None = None) -> None:
        """Draw the frame again, in its own context; ``before`` is told of each call in advance."""
        self.rewind()
        for call in self.frame:
            if before is not None:
                before(call)
            issue(call)

    def play(self) -> None:
        """Make all calls, those of the setup too: in a new context, with a target of its own."""
        for call in self.calls:
            issue(call)
