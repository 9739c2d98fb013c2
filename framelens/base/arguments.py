"""Checks of arguments, the same for the command line and for Python.

Each function takes a value of any type and returns it as the program uses it, or raises an
InputError that names the argument and says what was expected. Numbers may be numpy's; a bool is not
a number. ``given`` is how the error names the value: by default the argument's name and the value,
on the command line the text that was typed. The last two functions read numbers from such a text.
"""

import math
import operator
import os
from collections.abc import Iterable
from numbers import Real
from pathlib import Path
from typing import SupportsIndex, TypeGuard, TypeVar

from framelens.base.errors import InputError, short

BACKENDS = ("auto", "osmesa", "egl", "glfw", "cgl", "software")
SAMPLES = (0, 4)
MAX_SIDE = 16384  # the largest viewport side of llvmpipe; a context may allow less
MAX_PIXELS = 1 << 26  # chosen: they take 1.3 GB while a picture is drawn and written
FARTHEST = 1e9  # chosen: float32 has no fractions long before
Choice = TypeVar("Choice", str, int)


def plain(value: object) -> object:
    """Return numpy's numbers and arrays as Python's numbers and lists; anything else unchanged."""
    return value.tolist() if hasattr(value, "tolist") else value


def size(value: object, given: str = "") -> tuple[int, int]:
    """Return a width and a height in pixels, each from 1 to MAX_SIDE, MAX_PIXELS in all."""
    sides = plain(value)
    numbers = [_whole(side) for side in sides] if isinstance(sides, (list, tuple)) else []
    pixels = [number for number in numbers if number is not None]
    if len(numbers) != 2 or len(pixels) != 2:
        raise InputError(
            "size {value}: expected a width and a height in pixels", value=short(value)
        )

    width, height = pixels
    if not (0 < width <= MAX_SIDE and 0 < height <= MAX_SIDE):
        given = given or f"size {short(width)}x{short(height)}"
        raise InputError(
            "{value}: expected from 1x1 to {max_side}x{max_side}", value=given, max_side=MAX_SIDE
        )
    if width * height > MAX_PIXELS:
        given = given or f"size {width}x{height}"
        raise InputError(
            "{value}: expected at most {max_pixels:.0f} megapixels",
            value=given,
            max_pixels=MAX_PIXELS / 1000000.0,
        )
    return width, height


def whole(value: object, name: str, given: str = "") -> int:
    """Return a whole number from 0 to 10**18 - 1."""
    number = _whole(value)
    if number is None or not 0 <= number < 10**18:
        raise InputError(
            "{value}: expected a whole number from 0", value=given or f"{name} {short(value)}"
        )
    return number


def number(value: object, name: str, given: str = "") -> float:
    """Return a finite number below FARTHEST, positive or negative."""
    found = finite(value)
    if found is None:
        raise InputError("{value}: expected a number", value=given or f"{name} {short(value)}")
    return found


def choice(value: object, name: str, choices: tuple[Choice, ...], given: str = "") -> Choice:
    """Return the one of ``choices``, all strings or all whole numbers, that ``value`` equals."""
    wanted = value if isinstance(choices[0], str) else _whole(value)
    for each in choices:
        if isinstance(wanted, type(each)) and wanted == each:
            return each

    raise InputError(
        "{value}: expected one of {listed}",
        value=given or f"{name} {short(value)}",
        listed=", ".join(map(str, choices)),
    )


def flag(value: object, name: str) -> bool:
    """Return True or False, which must be given as such."""
    found = plain(value)
    if not isinstance(found, bool):
        raise InputError("{name} {value}: expected True or False", name=name, value=short(value))
    return found


def names(value: object, name: str) -> tuple[str, ...]:
    """Return names given as a text with commas, or as a collection of strings."""
    value = plain(value)
    if isinstance(value, str):
        return tuple(each.strip() for each in value.split(","))
    parts = tuple(value) if isinstance(value, Iterable) else (value,)
    texts = tuple(part for part in parts if isinstance(part, str))
    if len(texts) < len(parts):
        raise InputError(
            "{name} {value}: expected names, such as ground,water", name=name, value=short(value)
        )
    return texts


def folder(value: object, name: str) -> Path:
    """Return a path given as text or as a path; whether it is a folder is not checked."""
    text = os.fspath(value) if isinstance(value, (str, os.PathLike)) else None
    if not isinstance(text, str) or "\0" in text:  # no system has a file of such a name
        raise InputError("{name} {value}: expected a folder", name=name, value=short(value))
    return Path(text)


def _whole(value: object) -> int | None:
    """Return a whole number as an int; None for anything else."""
    value = plain(value)
    if isinstance(value, bool) or not isinstance(value, SupportsIndex):
        return None
    return operator.index(value)


def is_number(value: object) -> TypeGuard[int | float]:
    """Return whether a value of JSON or TOML is a number: true and false are none."""
    return isinstance(value, int | float) and not isinstance(value, bool)


def are_texts(value: object) -> TypeGuard[list[str]]:
    """Return whether a value of JSON or TOML is a list of texts."""
    return isinstance(value, list) and all(isinstance(each, str) for each in value)


def finite(value: object) -> float | None:
    """Return a finite number below FARTHEST as a float; None for anything else."""
    value = plain(value)
    if isinstance(value, bool) or not isinstance(value, Real):
        return None
    try:
        found = float(value)
    except (OverflowError, ValueError, TypeError):
        return None
    return found if math.isfinite(found) and abs(found) < FARTHEST else None


def digits(text: str) -> int | str:
    """Return a text of ASCII digits as a number; it stays a text if there is anything else."""
    # No number of 20 digits is allowed anywhere, and Python converts none of thousands.
    return int(text.lstrip("0")[:20] or 0) if text.isascii() and text.isdigit() else text


def real(text: str) -> float | str:
    """Return a text as a number; it stays a text if it is none."""
    try:
        return float(text)
    except ValueError:
        return text
