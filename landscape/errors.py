"""The errors that users see as one line, and how a line shows a value that was given."""

import reprlib
import sys
import traceback
from typing import Any


class InputError(ValueError):
    """Bad input: one line that names the file or the key and what was expected (exit status 2)."""


class NoOpenGLError(RuntimeError):
    """No usable OpenGL: one line that names the package to install (exit status 3)."""


class UnexpectedError(RuntimeError):
    """A defect of this program that another process met; ``details`` is the traceback there."""

    def __init__(self, reason: str, details: str = "") -> None:
        super().__init__(reason)
        self.details = details


UNEXPECTED = 70  # the exit status for a defect of this program: EX_SOFTWARE of sysexits.h


def say_unexpected(error: BaseException) -> int:
    """Print that this program has a defect: what and where, then the traceback; return UNEXPECTED.

    On standard error: what a command prints stays what it is documented to be.
    """
    if sys.stderr is not None:  # a program of Windows without a console has none
        what, details = located(error), "".join(traceback.format_exception(error))
        if isinstance(error, UnexpectedError):
            what, details = str(error), error.details or details
        print(f"landscape: a defect of this program: {what}", file=sys.stderr)
        print(details, end="", file=sys.stderr, flush=True)
    return UNEXPECTED


def located(error: BaseException) -> str:
    """Return on one line what an error is, and where it was raised."""
    reason = " ".join(str(error).split())
    what = f"{type(error).__name__}: {reason}" if reason else type(error).__name__
    frames = traceback.extract_tb(error.__traceback__)
    return f"{what}, in {frames[-1].filename}, line {frames[-1].lineno}" if frames else what


_REPR = reprlib.Repr()
_REPR.maxstring = _REPR.maxlong = _REPR.maxother = 60  # characters, chosen


def short(value: Any) -> str:
    """Return a value as Python writes it, on one line and truncated if it is long."""
    try:
        return " ".join(_REPR.repr(value).split())
    except ValueError:  # Python converts no integer of more than 4300 digits to text
        return "a number of thousands of digits"
