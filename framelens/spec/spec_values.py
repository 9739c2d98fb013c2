"""An argument's value as text, as one writes it in code, and the value that a text means."""

import ast
import ctypes
import math
import re
from collections.abc import Iterable, Sequence
from typing import Any, NoReturn, SupportsFloat, SupportsInt

import numpy as np
from numpy.typing import DTypeLike

from framelens.base.errors import InputError, short
from framelens.spec.spec_arguments import enumerant, function, legal, number, parameter, value_of
from framelens.spec.spec_table import SMALLEST, TYPES, Parameter

ALL_BITS = {"attrib": "GL_ALL_ATTRIB_BITS", "client_attrib": "GL_CLIENT_ALL_ATTRIB_BITS"}
OLD_BITS = 0xFFFFF  # GL_ALL_ATTRIB_BITS of OpenGL 1.0, which many programs still write
NAMES_SHOWN = 16  # chosen: enumerants that a message lists
INTEGERS = ("int", "count", "object", "bits")
NUMBERS = (*INTEGERS, "float", "clampf", "angle")


def written(name: str, index: int, args: Sequence[Any]) -> str:
    """Return an argument as code: "GL_SRC_ALPHA", "0.3", "(0.0, 1.0, 0.0)".

    A plain number becomes the name that it has in this place: 1 is GL_LINES in glBegin, and GL_ONE
    in glBlendFunc. Of an array only the type and the shape are written: "float32[441, 2]".
    """
    value, found = args[index], parameter(name, index, args)
    kind = found.kind if found else ""
    if found and kind == "mask" and number(value) is not None:
        return _mask(found, legal(name, index, args), value)
    if kind == "boolean" and number(value) is not None:
        text = "GL_TRUE" if number(value) else "GL_FALSE"
        return text if np.ndim(value) == 0 else f"({text},)"
    if kind in ("enum", ""):
        text = enumerant(name, index, args)
        if text:
            return text if np.ndim(value) == 0 else f"({text},)"

    if kind == "bits" and number(value) is not None:
        return f"0x{int(value) & 0xFFFFFFFF:X}"
    known = function(name)
    return _plain(value, kind, known.type if known else "")


def _mask(found: Parameter, bits: Sequence[str], value: SupportsInt) -> str:
    """Write a mask as its bits' names; bits without a name in hexadecimal."""
    rest = int(value) & 0xFFFFFFFF
    values = {bit: int(value_of(bit)) for bit in bits}
    if found.of in ALL_BITS and all(rest & each for each in values.values() if each < OLD_BITS):
        return ALL_BITS[found.of]
    parts = [bit for bit, each in values.items() if rest & each]
    for bit in parts:
        rest &= ~values[bit]
    return " | ".join(parts + [f"0x{rest:X}"] * (rest > 0)) or "0"


def _plain(value: object, kind: str, type_: str) -> str:
    """Write a value that has no name."""
    if isinstance(value, ctypes.c_void_p):
        return f"ctypes.c_void_p({value.value or 0})"
    if isinstance(value, (list, tuple, np.ndarray)):
        if kind not in ("vector", "matrix") and np.size(value) > 16:
            array = np.asarray(value)
            return f"{array.dtype}{list(array.shape)}"
        parts = [_number(part, type_) for part in np.asarray(value).ravel()]
        return f"({', '.join(parts)}{',' if len(parts) == 1 else ''})"
    if isinstance(value, (bytes, str)):
        return short(value)
    if isinstance(value, (bool, int, float, np.generic)):
        return _number(value, type_)
    return "None" if value is None else type(value).__name__


def _number(value: Any, type_: str) -> str:
    """Write a number with as many digits as its type can tell apart."""
    if isinstance(value, (float, np.floating)):
        single = type_ == "f" or isinstance(value, np.float32)
        return str(np.float32(value)) if single else repr(float(value))
    return repr(value.item() if isinstance(value, np.generic) else int(value))


def parsed(name: str, index: int, args: Sequence[Any], text: str) -> object:
    """Return the value that a text means as an argument: the reverse of :func:`written`.

    A vector becomes an array of the function's type and of the given argument's shape. InputError
    names what is expected where the text is not legal.
    """
    found = parameter(name, index, args)
    if found is None:
        raise InputError(
            "{name}: argument {index} is not in the table of OpenGL 1.5", name=name, index=index
        )
    text = text.strip()
    if found.kind in ("enum", "boolean"):
        value = _chosen(name, found, legal(name, index, args), text)
        return np.array([value]) if index < len(args) and np.ndim(args[index]) == 1 else value
    if found.kind == "mask":
        return _bits(name, found, legal(name, index, args), text)
    if found.kind in ("vector", "matrix"):
        return _vector(name, found, args[index] if index < len(args) else None, text)
    if found.kind in NUMBERS:
        value = _checked(name, found, text)
        return np.array([value], _dtype(name, None)) if found.count == 1 else value
    if found.kind == "offset":
        return _offset(name, found, text)
    raise InputError(
        "{call} {name}: an argument of this kind cannot be changed", call=name, name=found.name
    )


def _offset(name: str, found: Parameter, text: str) -> object:
    """Return a place in a buffer as ctypes has it, or None."""
    match = re.fullmatch(r"(?:ctypes\.c_void_p\()?(\d+)\)?", text)
    if match:
        return ctypes.c_void_p(int(match[1]))
    return None if text == "None" else _refuse(name, found, text, "a number of bytes")


def _chosen(name: str, found: Parameter, allowed: Sequence[str], text: str) -> object:
    """Return the value of one of the legal enumerants, given by its name or its number."""
    alias = {"True": "GL_TRUE", "False": "GL_FALSE"}.get(text, text)
    plain = re.sub(r"^(GL_)?(?=[A-Z])", "GL_", alias) if not alias.startswith("GLU_") else alias
    for each in allowed:
        value = value_of(each)
        if plain == each or text == each or _same_number(text, value):
            return int(value) if isinstance(value, float) and _whole(name) else value
    shown = ", ".join(allowed[:NAMES_SHOWN]) + (", ..." if len(allowed) > NAMES_SHOWN else "")
    return _refuse(name, found, text, shown)


def _whole(name: str) -> bool:
    """Return whether a function takes whole numbers only: glTexEnvi, glLighti."""
    known = function(name)
    return known is not None and "int" in TYPES.get(known.type, ("",))[0]


def _same_number(text: str, value: SupportsFloat) -> bool:
    try:
        return float(text) == float(value)
    except ValueError:
        return False


def _bits(name: str, found: Parameter, allowed: Sequence[str], text: str) -> int:
    """Return the mask of "GL_A | GL_B", of a number, or of the name for all bits."""
    values = {bit: int(value_of(bit)) for bit in allowed}
    if found.of in ALL_BITS:
        values[ALL_BITS[found.of]] = int(value_of(ALL_BITS[found.of]))
    mask = 0
    for part in text.split("|"):
        word = part.strip()
        if word in values:
            mask |= values[word]
        elif re.fullmatch(r"0x[0-9a-fA-F]+|\d+", word):
            mask |= int(word, 0)
        else:
            _refuse(name, found, text, " | ".join(allowed))
    if mask & ~_union(values.values()):
        _refuse(name, found, text, " | ".join(allowed))
    return mask


def _union(masks: Iterable[int]) -> int:
    found = 0
    for mask in masks:
        found |= mask
    return found


def _checked(name: str, found: Parameter, text: str) -> int | float:
    """Return a number that is within the parameter's limits."""
    whole = found.kind in INTEGERS or _whole(name)
    try:
        value = int(text, 0) if whole else float(text)
    except ValueError:
        _refuse(name, found, text, expected(found, whole))
    if whole and not -(2**31) <= value < 2**32:
        _refuse(name, found, text, "a number of 32 bits")
    low = -math.inf if found.low is None else found.low
    high = math.inf if found.high is None else found.high
    if not math.isfinite(value) or not (low <= value <= high or value in found.also):
        _refuse(name, found, text, expected(found, whole))
    return value


def expected(found: Parameter, whole: bool) -> str:
    """Return in words which numbers are legal."""
    what = "a whole number" if whole else "a number"
    low, high = found.low, found.high
    if low is not None and high is not None:
        also = "".join(f" or {value:g}" for value in found.also)
        return f"{what} from {low:.10g} to {high:.10g}{also}"
    if low == SMALLEST:
        return f"{what} greater than 0"
    if low is not None:
        return f"{what} of at least {low:g}"
    return what


def _vector(name: str, found: Parameter, given: Any, text: str) -> np.ndarray:
    """Return the components as an array of the shape of the given argument."""
    count = found.count if found.count is not None else int(np.size(given))
    try:
        read = ast.literal_eval(text if text[:1] in "([" else f"({text},)")
        parts = [str(part) for part in np.asarray(read).ravel().tolist()]
    except (ValueError, SyntaxError, TypeError, MemoryError, RecursionError):
        parts = []
    if len(parts) != count:
        _refuse(name, found, text, f"{count} numbers")
    values = [_checked(name, found, part) for part in parts]
    array = np.array(values, _dtype(name, given, found.of))
    return array.reshape(np.shape(given)) if np.size(given) == count else array


def _dtype(name: str, given: object, of: str = "") -> DTypeLike:
    """Return the type of numbers that a function reads from an array."""
    if isinstance(given, np.ndarray):
        return given.dtype
    known = function(name)
    if known is not None and known.type:
        return TYPES[known.type][0]
    if of == "viewport":
        return "int32"
    return "float32" if name in ("glLight", "glMaterial", "glTexParameter") else "float64"


def _refuse(name: str, found: Parameter, text: str, wanted: str) -> NoReturn:
    raise InputError(
        "{call} {argument} {text}: expected {wanted}",
        call=name,
        argument=found.name,
        text=short(text)[1:-1],
        wanted=wanted,
    )
