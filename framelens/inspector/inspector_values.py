"""The values of a call: what can be changed in it, in steps and by dragging. No OpenGL drawing.

A cell is one number, one enumerant, one bit of a mask or one truth value. A vector or a matrix has
a cell for each component.
"""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from framelens.gl.seam import Call
from framelens.spec import spec
from framelens.tape.edits import Edit, Located, edited_value
from framelens.tape.safe import may_be_changed, most

NUMBERS = ("int", "float", "clampf", "angle", "count", "bits", "object")
COMPONENTS = {
    "color": ("red", "green", "blue", "alpha"),
    "position": ("x", "y", "z", "w"),
    "direction": ("x", "y", "z"),
    "coordinates": ("s", "t", "r", "q"),
    "plane": ("a", "b", "c", "d"),
}
DIGITS = 4  # chosen: significant digits of a dragged number
PIXELS = 200.0  # chosen: a drag of so many pixels doubles a number, or brings it down to 0
FINE = 10.0  # chosen: how much finer steps and drags are with Shift
NOTCH = 8.0  # chosen: pixels of a drag to the next enumerant or small whole number
SMALL = 10  # chosen: a whole number up to this one goes by notches
FRACTION = 1 / 20  # chosen: a step, in relation to the number it changes


@dataclass(frozen=True)
class Cell:
    """Something that can be changed in a call, or, if ``kind`` is "fixed", only be looked at.

    ``kind`` is number, enum, bit, boolean or fixed; ``text`` the value as code, ``value`` what an
    edit would have. ``bit`` is a mask's bit, and ``low`` and ``high`` are limits.
    """

    argument: int
    name: str
    kind: str
    text: str
    value: Any
    component: int | None = None
    bit: str = ""
    low: float = -math.inf
    high: float = math.inf
    whole: bool = False
    choices: tuple[str, ...] = ()

    @property
    def place(self) -> tuple[int, int | None, str]:
        """Which cell of its call it is."""
        return self.argument, self.component, self.bit


def step_of(size: float) -> float:
    """Return FRACTION of ``size`` > 0, rounded down to 1, 2 or 5 times a power of ten."""
    target = size * FRACTION
    power = 10.0 ** math.floor(math.log10(target) + 1e-9)
    return float(max(m * power for m in (1, 2, 5) if m * power <= target * (1 + 1e-9)))


def own(call: Call) -> tuple[object, ...]:
    """Return the arguments as the program gave them."""
    return call.args if call.given is None else call.given


def current(call: Call, edits: Iterable[Edit]) -> tuple[object, ...]:
    """Return the arguments with edits of this call."""
    args = list(own(call))
    for edit in edits:
        if not edit.skip and edit.argument < len(args):
            args[edit.argument] = edited_value(args[edit.argument], edit.value, edit.component)
    return tuple(args)


def cells(call: Call, edits: Sequence[Edit] = ()) -> list[Cell]:
    """Return what a call has, its arguments in order."""
    args = current(call, edits)
    return [cell for index in range(len(args)) for cell in _of(call.name, index, args, own(call))]


def _of(name: str, index: int, args: Sequence[Any], given: Sequence[object]) -> list[Cell]:
    found = spec.parameter(name, index, args)
    value = args[index]
    text = spec.written(name, index, args)
    label = found.name if found else f"{index + 1}"
    whole = Cell(index, label, "fixed", text, value)
    if found is None or not may_be_changed(name, index, given):
        return [whole]
    low, high = spec.limits(name, index, args) or (-math.inf, math.inf)
    limit = most(name, index, given)
    high = high if limit is None else min(high, limit)
    kind, flat = found.kind, np.ravel(np.asarray(value)) if np.ndim(value) else None
    if kind in ("vector", "matrix") and flat is not None:
        numbers = flat.dtype.kind in "iu"
        names = component_names(kind, found.of, len(flat))
        return [
            replace(
                whole,
                name=f"{label}.{names[k]}",
                kind="number",
                text=_shown(flat[k]),
                value=flat[k].item(),
                component=k,
                low=low,
                high=high,
                whole=numbers,
            )
            for k in range(len(flat))
        ]

    if flat is not None:
        if kind in NUMBERS and len(flat) == 1:
            number = flat[0].item()
            return [replace(whole, kind="number", value=number, component=0, low=low, high=high)]
        return [whole]

    if kind == "mask":
        return [
            replace(whole, name=bit, kind="bit", bit=bit, text=_mark(value, bit), value=int(value))
            for bit in spec.legal(name, index, args)
        ]

    if kind == "boolean":
        return [replace(whole, kind="boolean", value=bool(value))]
    if kind == "enum":
        choices = _choices(name, index, args)
        if len(choices) < 2:
            return [whole]
        return [replace(whole, kind="enum", value=text, choices=choices)]

    counted = kind in ("int", "count", "bits", "object")
    return [replace(whole, kind="number", value=value, low=low, high=high, whole=counted)]


def component_names(kind: str, of: str, count: int) -> tuple[str, ...]:
    """Return the names of a vector's components, or of a matrix's: its rows and columns from 0."""
    if kind == "matrix" and count == 16:
        return tuple(f"{k % 4}{k // 4}" for k in range(16))
    known = COMPONENTS.get(of, ())
    return known if len(known) >= count else tuple(str(k) for k in range(count))


def _shown(value: object) -> str:
    return f"{value.item():.7g}" if isinstance(value, np.generic) else str(value)


def _mark(mask: Any, bit: str) -> str:
    return "1" if int(mask) & int(spec.value_of(bit)) else "0"


def _choices(name: str, index: int, args: Sequence[object]) -> tuple[str, ...]:
    """Return the legal enumerants that an edit can have here.

    Where another one would need an array of another length, it is not among them.
    """
    legal = spec.legal(name, index, args)
    known = spec.function(name)
    if known is not None and known.vector:
        last = len(args) - 1
        wanted = spec.parameter(name, last, args)
        count = wanted.count if wanted else None
        legal = tuple(each for each in legal if _count(name, index, args, each, last) == count)
    return tuple(each for each in legal if each.startswith("GL_") or each[0].isdigit())


def _count(name: str, index: int, args: Sequence[object], choice: str, last: int) -> int | None:
    """Return how many numbers the last argument has with another enumerant."""
    if index == last:
        return None if (found := spec.parameter(name, last, args)) is None else found.count
    other = spec.parameter(name, last, [*args[:index], spec.value_of(choice), *args[index + 1 :]])
    return other.count if other else None


def stepped(cell: Cell, way: int, fine: bool, usual: object = None) -> object:
    """Return the value of an edit one step up (``way`` 1) or down (-1); Shift makes it ``fine``.

    A number goes to the next multiple of a step that suits it and ``usual``, the program's own.
    """
    if cell.kind == "enum":
        at = cell.choices.index(cell.value) if cell.value in cell.choices else -1
        return _enumerant(cell.choices[(at + way) % len(cell.choices)])
    if cell.kind == "boolean":
        return not cell.value
    if cell.kind == "bit":
        return cell.value ^ int(spec.value_of(cell.bit))
    own_size = abs(usual) if isinstance(usual, (int, float)) else abs(cell.value)
    size = max(abs(cell.value), own_size or min(1.0, cell.high))
    step = step_of(size) / (FINE if fine else 1.0)
    if cell.whole:
        step = max(1, round(step))
    at = cell.value / step
    to = math.floor(at + 1e-6) + 1 if way > 0 else math.ceil(at - 1e-6) - 1
    return within(cell, float(f"{to * step:.10g}"))


def dragged(cell: Cell, pixels: float, fine: bool = False) -> object:
    """Return the value after the mouse has moved so far to the right, from the value of ``cell``.

    A number grows by a factor and shrinks in even steps, through zero and beyond.
    """
    if cell.kind in ("enum", "boolean", "bit"):
        return None
    way = pixels / (FINE if fine else 1.0)
    if cell.whole and abs(cell.value) <= SMALL:
        return within(cell, cell.value + int(way / NOTCH))
    size = abs(cell.value) or min(1.0, cell.high) / 2
    part = way / PIXELS * (1 if cell.value >= 0 else -1)
    grown = math.expm1(min(part, 60.0)) if part > 0 else part
    value = cell.value + size * grown * (1 if cell.value >= 0 else -1)
    return within(cell, float(f"{value:.{DIGITS}g}"))


def within(cell: Cell, value: float) -> object:
    """Return a number within the limits of a cell, whole if it must be."""
    value = min(max(value, cell.low), cell.high)
    return int(round(value)) if cell.whole else float(value)


def chosen(cell: Cell, name: str) -> object:
    """Return the value of an edit that chooses an enumerant by name."""
    return _enumerant(name)


def _enumerant(name: str) -> object:
    """Return an enumerant as an edit has it: by name, or a number where OpenGL wants one."""
    return spec.value_of(name) if name[0].isdigit() else name


def edit_of(found: Located, cell: Cell, value: object) -> Edit:
    """Return the edit that gives a cell a value."""
    if cell.kind == "bit":
        args = list(own(found.call))
        args[cell.argument] = value
        names = spec.written(found.call.name, cell.argument, args)
        value = names if names.startswith("GL_") and "0x" not in names else value
    return found.edit(cell.argument, value, cell.component)
