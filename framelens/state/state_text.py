"""A state as JSON, and as a listing in groups.

A matrix is listed in four rows, as one writes it: the translation is its last column.
"""

import re
from collections.abc import Iterator, Mapping, Sequence
from itertools import groupby
from typing import Any

import numpy as np

from framelens.spec.spec import written
from framelens.state.state import PUSH, changed
from framelens.state.state_tables import DOUBLE, FLAG, FLOAT, IDENTITY, LIST, MASK, POINTER
from framelens.state.state_variables import GROUPS, VARIABLES

MOST_NUMBERS = 8  # chosen: of a list, in a line


def as_json(values: Mapping[str, object]) -> dict[str, Any]:
    """Return a state, or a difference, with the fewest digits that give each number again."""
    return {name: _shortened(name, value) for name, value in values.items()}


def _shortened(name: str, value: object) -> object:
    if isinstance(value, float):
        variable = VARIABLES.get(name)
        double = variable is not None and variable.kind == DOUBLE
        return value if double else float(str(np.float32(value)))
    if isinstance(value, Mapping):  # a level of an attribute stack
        return {"mask": _mask(name, value), "saved": as_json(value["saved"])}
    if isinstance(value, (list, tuple)):
        return [_shortened(name, part) for part in value]
    return value


def as_text(state: Mapping[str, object]) -> Iterator[str]:
    """Yield the lines that list a state; ``*`` marks what differs from the initial value.

    Lights, texture units, evaluators and the like that are as they were initially share a line.
    """
    marked = changed(state)
    for group, names in _groups(state):
        yield group
        rows: list[tuple[str, str, list[str]]] = []
        for untouched, members in _runs(names, marked):
            if untouched:
                which = members[0] if len(members) == 1 else f"{members[0]} to {members[-1]}"
                rows.append((" ", which, ["initial values"]))
            else:
                marks = ["*" if name in marked else " " for name in members]
                shown = [_shown(name, state[name]) for name in members]
                rows += zip(marks, members, shown, strict=True)

        width = max(len(name) for _, name, _ in rows)
        for mark, name, lines in rows:
            yield from _lines(f"  {mark} {name:{width}}  ", lines)


def difference_as_text(difference: Mapping[str, Sequence[object]]) -> Iterator[str]:
    """Yield the lines that list a difference of two states: what was, and what is."""
    for group, names in _groups(difference):
        yield group
        width = max(map(len, names))
        for name in names:
            before, after = (_shown(name, value) for value in difference[name])
            yield from _lines(f"    {name:{width}}  ", _beside(before, after))


def _groups(names: Mapping[str, object]) -> Iterator[tuple[str, list[str]]]:
    """Yield the groups that have a name, each with its names in the order of the tables."""
    for group in GROUPS:
        mine = [name for name in VARIABLES if name in names and VARIABLES[name].group == group]
        if group == GROUPS[-1]:
            mine += [name for name in names if name not in VARIABLES]
        if mine:
            yield group, mine


# Objects that exist several times, each with several variables: one alternative for each kind.
_OWNER = re.compile(
    r"(GL_CLIP_PLANE\d)|(GL_LIGHT\d)|(GL_FRONT|GL_BACK)\.|(GL_TEXTURE\d)|(GL_PIXEL_MAP_\w+)"
    r"|(GL_MAP[12]_(?!GRID)\w+)"
    r"|(GL_(?:VERTEX|NORMAL|FOG_COORD|COLOR|SECONDARY_COLOR|INDEX|EDGE_FLAG)_ARRAY)(?!_BINDING)"
)


def _runs(names: Sequence[str], marked: Mapping[str, object]) -> Iterator[tuple[bool, list[str]]]:
    """Yield owners of one kind that are as initially (True), or names to list one by one."""

    def owner(name: str) -> tuple[int, str]:
        match = _OWNER.match(name)
        kind = match.lastindex if match else None
        return (kind, match[kind]) if match and kind else (0, name)

    found: list[tuple[int, list[str]]] = []  # kind, or 0, and owners or names
    for (kind, which), group in groupby(names, owner):
        members = list(group)
        if not kind or any(name in marked for name in members):
            found.append((0, members))
        elif found and found[-1][0] == kind:
            found[-1][1].append(which)
        else:
            found.append((kind, [which]))
    yield from ((kind > 0, members) for kind, members in found)


def _shown(name: str, value: Any) -> list[str]:
    """Return a value as lines."""
    variable = VARIABLES.get(name)
    kind = variable.kind if variable else ""
    if value is None:
        return ["-"]
    if kind == FLAG:
        return ["on" if value else "off"]
    if kind == FLOAT and isinstance(value, list) and len(value) == len(IDENTITY):
        return _rows(value)
    if name.endswith("_STACK"):
        return _stack(name, value)
    if name.endswith(".pattern"):
        rows = [f"{row:08x}" for row in value]
        return [" ".join(rows[at : at + 4]) for at in range(0, len(rows), 4)]
    if kind == POINTER:
        return [f"0x{value:x}"]
    if isinstance(value, (list, tuple)):
        more = f" ... ({len(value)})" if kind == LIST and len(value) > MOST_NUMBERS else ""
        return [" ".join(_number(v) for v in value[: MOST_NUMBERS if more else None]) + more]
    return [f"0x{value:x}" if kind == MASK else _number(value)]


def _stack(name: str, value: Sequence[Any]) -> list[str]:
    """Return the matrices, or pushed attributes, below the top of a stack."""
    lines: list[str] = []
    for k, level in enumerate(value):
        if isinstance(level, Mapping):
            lines.append(f"{k + 1}: {_mask(name, level)}")
            lines += [
                f"   {variable} {line}"
                for variable, saved in level["saved"].items()
                for line in _shown(variable, saved)
            ]
        else:
            rows = _rows(level)
            lines += [f"{f'{k + 1}: ' if not r else '   '}{row}" for r, row in enumerate(rows)]
    return lines or ["none below the top"]


def _mask(stack: str, level: Mapping[str, object]) -> str:
    """Return the mask of a pushed level by its bits' names."""
    mask = level["mask"]
    return mask if isinstance(mask, str) else written(PUSH[stack], 0, (mask,))


def _rows(matrix: Sequence[float]) -> list[str]:
    """Return a matrix, given column by column, as four rows of aligned columns."""
    columns = [[_number(v) for v in matrix[at : at + 4]] for at in range(0, 16, 4)]
    widths = [max(map(len, column)) for column in columns]
    return [
        "  ".join(column[row].rjust(width) for column, width in zip(columns, widths, strict=True))
        for row in range(4)
    ]


def _number(value: object) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def _beside(before: list[str], after: list[str]) -> list[str]:
    """Return two values side by side, an arrow between them."""
    height, width = max(len(before), len(after)), max(map(len, before))
    left, right = (lines + [""] * (height - len(lines)) for lines in (before, after))
    arrows = ["->" if row == 0 else "  " for row in range(height)]
    return [
        f"{a:{width}}  {arrow}  {b}".rstrip()
        for a, arrow, b in zip(left, arrows, right, strict=True)
    ]


def _lines(start: str, lines: Sequence[str]) -> Iterator[str]:
    for k, line in enumerate(lines):
        yield (start if k == 0 else " " * len(start)) + line
