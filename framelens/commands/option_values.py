"""How the values of the command line's options are read.

Each function takes the text of an option and returns its value; argparse shows the message of the
ArgumentTypeError that it raises.
"""

import argparse
import os
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from framelens.base import arguments
from framelens.base.errors import InputError, Message
from framelens.base.texts import choose, said

MOST_JOBS = 256  # chosen


def refusal(template: str, /, **values: object) -> argparse.ArgumentTypeError:
    """Return the error that argparse shows: a Message in the user's language."""
    return argparse.ArgumentTypeError(said(Message(template, **values), choose(os.environ)))


T = TypeVar("T")


def checked(check: Callable[..., T], text: str, value: object, *more: object) -> T:
    """Check the value that a text stands for; argparse shows the text if it is wrong."""
    try:
        return check(value, *more, given=repr(text))
    except InputError as error:
        raise argparse.ArgumentTypeError(said(error, choose(os.environ))) from None


def size(text: str) -> object:
    sides = [arguments.digits(side) for side in text.lower().split("x")]
    if len(sides) != 2 or not all(isinstance(side, int) for side in sides):
        raise refusal("{text!r}: expected WxH such as 800x600", text=text)
    return checked(arguments.size, text, sides)


def count(text: str) -> object:
    return checked(arguments.whole, text, arguments.digits(text), "")


def jobs(text: str) -> object:
    """Return a number of processes."""
    try:
        found = arguments.whole(arguments.digits(text), "", repr(text))
    except InputError:
        found = 0
    if not 1 <= found <= MOST_JOBS:
        raise refusal(
            "{text!r}: expected a whole number from 1 to {most_jobs}",
            text=text,
            most_jobs=MOST_JOBS,
        )
    return found


def rate(text: str) -> object:
    rate = number(text)
    if rate != 0 and not 1 <= rate <= 1000:
        raise refusal("{text!r}: expected a number from 1 to 1000, or 0", text=text)
    return rate


def samples(text: str) -> object:
    return checked(arguments.choice, text, arguments.digits(text), "", arguments.SAMPLES)


def backend(text: str) -> object:
    return checked(arguments.choice, text, text, "", arguments.BACKENDS)


def number(text: str) -> float:
    return checked(arguments.number, text, arguments.real(text), "")


def seconds(text: str) -> float:
    found = number(text)
    if found <= 0:
        raise refusal("{text!r}: expected a number of seconds above 0", text=text)
    return found


def pathname(text: str) -> Path:
    """Return a path."""
    # An empty text is that of a shell's variable which is not set; pathlib takes it for `.`.
    if not text:
        raise refusal("{text!r}: expected the path of a file or folder", text=text)
    return Path(text)


def pair(text: str) -> tuple[str, str]:
    key, equals, value = text.partition("=")
    if not equals:
        raise refusal("{text!r}: expected KEY=VALUE such as fog.density=0.05", text=text)
    return key.strip(), value.strip()


def elements(text: str) -> tuple[str, ...]:
    return arguments.names(text, "only")
