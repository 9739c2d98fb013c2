"""An argument's kind and its legal values, given the call's other arguments."""

import ctypes
import functools
import math
import re
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from framelens.gl.named import gl_constant
from framelens.spec.spec_enumerants import BESIDE, BY_OTHER
from framelens.spec.spec_table import (
    Function,
    Parameter,
    by_pname,
    functions,
    group_of,
    names,
    scalar_pnames,
)

VENDORS = re.compile(r"(ARB|EXT)$")


@functools.cache
def function(name: str) -> Function | None:
    """Return a function of any suffix, or None where the table lacks it."""
    known = functions()
    return known.get(name) or known.get(VENDORS.sub("", name))


def parameter(name: str, index: int, args: Sequence[object]) -> Parameter | None:
    """Return what argument ``index`` of a call is, or None where the table lacks it."""
    known = function(name)
    if known is None:
        return None
    form = known.form(len(args))
    if not 0 <= index < len(form):
        return None
    found = form[index]
    if found.kind == "by":
        return _decided(known, found, form, args)
    if found.kind == "array" and index < len(args) and _is_offset(args[index]):
        return replace(found, kind="offset")
    return found


def deciding(found: Parameter, form: Sequence[Parameter], args: Sequence[object]) -> str:
    """Return the name of the pname that decides what an argument is, "" if the call has none."""
    place = next(k for k, other in enumerate(form) if other.name == "pname")
    return name_in(found.of, args[place]) if place < len(args) else ""


def _decided(
    known: Function, found: Parameter, form: Sequence[Parameter], args: Sequence[object]
) -> Parameter:
    """Return what an argument is whose pname decides."""
    decided = by_pname(found.of, deciding(found, form, args), known)
    if decided is not None:
        return decided
    return replace(found, kind="vector" if known.vector else "float", of="")


def _is_offset(value: object) -> bool:
    """Return whether a pointer argument is an offset into a buffer object."""
    return value is None or isinstance(value, (int, np.integer, ctypes.c_void_p))


def kind_of(name: str, index: int, args: Sequence[object]) -> str:
    """Return the kind of an argument (see spec_functions), or "" where the table lacks it."""
    found = parameter(name, index, args)
    return found.kind if found else ""


def limits(name: str, index: int, args: Sequence[object]) -> tuple[float, float] | None:
    """Return the least and the greatest legal value of an argument, or of each component.

    An end without a limit is infinite; None where there is none at all. Where OpenGL demands more
    than 0, the least value is a small positive number.
    """
    found = parameter(name, index, args)
    if found is None or (found.low is None and found.high is None):
        return None
    low = -math.inf if found.low is None else found.low
    return low, math.inf if found.high is None else found.high


def legal(name: str, index: int, args: Sequence[object]) -> tuple[str, ...]:
    """Return the names of an argument's legal enumerants, or of the bits of its mask.

    Where OpenGL accepts some numbers only, as for GL_RGB_SCALE, these as text. () for all others.
    """
    found = parameter(name, index, args)
    if found is None:
        return ()
    if found.kind == "boolean":
        return names("boolean")
    if found.kind not in ("enum", "mask"):
        return ()
    known = function(name)
    assert known is not None
    form = known.form(len(args))
    allowed = names(group_of(found, _other(found, form, args)))
    decided = next((other.of for other in form if other.kind == "by"), "")
    if decided and found.name == "pname" and known.type and not known.vector:
        scalars = scalar_pnames(decided)
        allowed = tuple(each for each in allowed if each in scalars)
    return allowed


def _other(found: Parameter, form: Sequence[Parameter], args: Sequence[object]) -> str:
    """Return the enumerant of the argument that decides the group of ``found``."""
    for place, other in enumerate(form):
        if other.name == found.other and place < len(args):
            return name_in(group_of(other, _other(other, form, args)), args[place])
    return ""


def value_of(name: str) -> Any:
    """Return the value of an enumerant, or of a number in the list of legal ones."""
    if name[0].isdigit():
        return float(name) if "." in name else int(name)
    return BESIDE[name] if name in BESIDE else gl_constant(name)


@functools.cache
def _values(group: str) -> dict[float, str]:
    """Return the names of a group by their values."""
    if group in BY_OTHER:
        choices = dict.fromkeys(BY_OTHER[group].values())
        found = [each for choice in choices for each in names(choice)]
    else:
        found = list(names(group))
    return {float(value_of(each)): each for each in reversed(found)}


def number(value: Any) -> float | None:
    """Return an argument as a number, the only one of an array also; None if it is none."""
    try:
        return float(value[0] if np.ndim(value) == 1 and len(value) == 1 else value)
    except (TypeError, ValueError):
        return None


def name_in(group: str, value: object) -> str:
    """Return the name that a value has in a group, "" where it has none."""
    found = number(value)
    return _values(group).get(found, "") if found is not None else ""


def enumerant(name: str, index: int, args: Sequence[object]) -> str:
    """Return the name of an argument's enumerant; where it is illegal, the value's own or ""."""
    found, known = parameter(name, index, args), function(name)
    if found is not None and known is not None and found.kind == "enum":
        other = _other(found, known.form(len(args)), args)
        groups = (group_of(found, other), found.of)
        text = next((text for group in groups if (text := name_in(group, args[index]))), "")
        if text:
            return text
    return str(getattr(args[index], "name", ""))
