"""What can be looked into: a frame that draws itself onto a tape."""

from collections.abc import Callable, Sequence
from typing import Protocol, TypeVar

from framelens.base.errors import InputError, short
from framelens.tape.tape import Tape

T = TypeVar("T")


def untold(lines: Sequence[str]) -> None:
    """Drop lines for the user; a function of a module, so that a frame with it can be pickled."""


class Target(Protocol):
    """A frame that can be looked into."""

    @property
    def name(self) -> str:
        """The name by which the user asked for it."""

    @property
    def is_program(self) -> bool:
        """Whether it is a frame of a program."""

    def look(self, use: Callable[[Tape], T], past: bool = False) -> T:
        """Draw the frame and return what ``use`` makes of its tape, in its context.

        ``past``: the tape says what came before the frame, too, and the frame may be one in which
        the program raises an error.
        """

    def following(self) -> "Target | None":
        """Return the next frame of a program, without lines for the user; None for a view."""

    def check_element(self, name: str) -> None:
        """Raise InputError if no call of the frame can belong to an element of this name."""


def place_of(tape: Tape, text: str) -> str:
    """Return the place of a call that a user gave by its number, or by an element's name.

    "+12" counts from the frame's beginning, as the inspector of the walk does. An element means
    the first of its calls in the frame. InputError if there is none.
    """
    if text[:1].isdigit():
        return text
    first, point, rest = text[1:].partition(".")
    if text[:1] == "+" and first.isascii() and first.isdigit():
        return f"{tape.begin + int(first[:20])}{point}{rest}"
    named = [call for call in tape.frame if text in call.shared_by]
    if not named:
        elements = dict.fromkeys(name for call in tape.frame for name in call.shared_by)
        raise InputError(
            "{text}: expected a call's number or an element of the frame: {names}",
            text=short(text),
            names=", ".join(elements),
        )
    return str(named[0].number)
