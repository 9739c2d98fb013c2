"""The two errors that users see as one line, and how a line shows a value that was given."""

import reprlib
from typing import Any


class InputError(ValueError):
    """Bad input: one line that names the file or the key and what was expected (exit status 2)."""


class NoOpenGLError(RuntimeError):
    """No usable OpenGL: one line that names the package to install (exit status 3)."""


_REPR = reprlib.Repr()
_REPR.maxstring = _REPR.maxlong = _REPR.maxother = 60  # characters, chosen


def short(value: Any) -> str:
    """Return a value as Python writes it, on one line and truncated if it is long."""
    try:
        return " ".join(_REPR.repr(value).split())
    except ValueError:  # Python converts no integer of more than 4300 digits to text
        return "a number of thousands of digits"
