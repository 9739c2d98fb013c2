"""How the values of the command line's options are read.

Each function takes the text of an option and returns its value; argparse shows the message of the
ArgumentTypeError that it raises.
"""

import argparse
from collections.abc import Callable
from typing import Any

from framelens.base import arguments
from framelens.base.errors import InputError

MOST_JOBS = 256  # chosen


def checked(check: Callable[..., Any], text: str, value: Any, *more: Any) -> Any:
    """Check the value that a text stands for; argparse shows the text if it is wrong."""
    try:
        return check(value, *more, given=repr(text))
    except InputError as error:
        raise argparse.ArgumentTypeError(str(error)) from None


def size(text: str) -> Any:
    sides = [arguments.digits(side) for side in text.lower().split("x")]
    if len(sides) != 2 or not all(isinstance(side, int) for side in sides):
        raise argparse.ArgumentTypeError(f"{text!r}: expected WxH such as 800x600")
    return checked(arguments.size, text, sides)


def count(text: str) -> Any:
    return checked(arguments.whole, text, arguments.digits(text), "")


def jobs(text: str) -> Any:
    """Return a number of processes."""
    try:
        found = arguments.whole(arguments.digits(text), "", repr(text))
    except InputError:
        found = 0
    if not 1 <= found <= MOST_JOBS:
        raise argparse.ArgumentTypeError(f"{text!r}: expected a whole number from 1 to {MOST_JOBS}")
    return found


def rate(text: str) -> Any:
    rate = number(text)
    if rate != 0 and not 1 <= rate <= 1000:
        raise argparse.ArgumentTypeError(f"{text!r}: expected a number from 1 to 1000, or 0")
    return rate


def samples(text: str) -> Any:
    return checked(arguments.choice, text, arguments.digits(text), "", arguments.SAMPLES)


def backend(text: str) -> Any:
    return checked(arguments.choice, text, text, "", arguments.BACKENDS)


def number(text: str) -> Any:
    return checked(arguments.number, text, arguments.real(text), "")


def seconds(text: str) -> float:
    found: float = number(text)
    if found <= 0:
        raise argparse.ArgumentTypeError(f"{text!r}: expected a number of seconds above 0")
    return found


def pair(text: str) -> tuple[str, str]:
    key, equals, value = text.partition("=")
    if not equals:
        raise argparse.ArgumentTypeError(f"{text!r}: expected KEY=VALUE such as fog.density=0.05")
    return key.strip(), value.strip()


def elements(text: str) -> tuple[str, ...]:
    return arguments.names(text, "only")
