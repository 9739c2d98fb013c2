"""The list of settings in the walk: what it shows, and how its keys change a value. No OpenGL.

A row is a value that can be stepped: a bool, a choice, a number, or one component of a tuple. The
names of files are left out. What a key does becomes a changed setting before a frame is recorded,
so a replay does not depend on how large a step is.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from framelens.base.texts import said, translator
from framelens.inspector.inspector_values import step_of
from landscape.settings import declare
from landscape.settings.declare import Kind, Setting, Value
from landscape.settings.notices import WALK, Slot, ignored
from landscape.walk import words

DIGITS = 6  # significant digits shown


@dataclass(frozen=True)
class Row:
    """A value of the list: a setting, or component ``part`` of one that is a tuple."""

    key: str
    item: Setting
    part: int = -1

    @property
    def name(self) -> str:
        """The row's name in recordings: ``fog.density``, or ``fog.color.0``."""
        return self.key if self.part < 0 else f"{self.key}.{self.part}"

    @property
    def group(self) -> str:
        """The group's name."""
        return self.key.split(".")[0]

    @property
    def label(self) -> str:
        """The name within the group, as ``color R``."""
        label = self.key.split(".")[-1]
        if self.part < 0:
            return label
        colour = self.item.unit.startswith("RGB")
        return f"{label} {'RGBA'[self.part] if colour else self.part + 1}"

    def value(self, settings: object) -> Value:
        """Return the row's value in settings."""
        value = declare.get(settings, self.key)
        return value[self.part] if isinstance(value, tuple) else value

    def changed(self, settings: object, value: Value) -> Value:
        """Return the value of the whole setting with the row's value replaced."""
        whole = declare.get(settings, self.key)
        if not isinstance(whole, tuple):
            return value
        assert isinstance(value, int | float)
        return *whole[: self.part], value, *whole[self.part + 1 :]


def rows(kind: type) -> tuple[Row, ...]:
    """Return the rows of a settings class, in the order of its declaration."""
    found = []
    for key, item in declare.fields(kind).items():
        if item.kind == Kind.NUMBERS:
            found += [Row(key, item, part) for part in range(item.count)]
        elif item.kind != Kind.FILE:
            found.append(Row(key, item))
    return tuple(found)


def stepped(row: Row, value: Value, way: int, usual: float) -> Value:
    """Return the value one step up (``way`` 1) or down (-1), within the setting's limits.

    Bools change over, choices go round, and numbers go to the next multiple of a step that is a
    fraction of the number, or of ``usual`` where that is larger: zero can be reached and left.
    """
    if isinstance(value, bool):
        return not value
    choices = row.item.choices
    if choices:
        return choices[(choices.index(value) + way) % len(choices)]

    assert isinstance(value, int | float)
    low, high = row.item.limits
    step = step_of(max(abs(value), abs(usual)) or min(1.0, high))
    if isinstance(value, int):
        step = max(1, round(step))
    at = value / step
    at = math.floor(at + 1e-6) + 1 if way > 0 else math.ceil(at - 1e-6) - 1

    # Ten digits hide the error of multiplying by a step such as 0.002.
    number = float(f"{at * step:.10g}")
    return type(value)(min(max(number, low), high))


def written(value: Value, language: str) -> str:
    """Return a value as the list shows it."""
    if isinstance(value, bool):
        return words.text(language, "list.on" if value else "list.off")
    if isinstance(value, int):
        return f"{value:,}".replace(",", "\u00a0")
    return f"{value:.{DIGITS}g}" if isinstance(value, float) else str(value)


class Chooser:
    """Which row is chosen, and whether the list is open; follows the keys that were pressed."""

    def __init__(self, defaults: object) -> None:
        """``defaults`` are the settings of the preset."""
        self.defaults = defaults
        self.rows = rows(type(defaults))
        self.index = 0
        self.open = False

    @property
    def row(self) -> str:
        """The name of the row chosen, "" while the list is closed."""
        return self.rows[self.index].name if self.open else ""

    def follow(self, picks: Sequence[str], settings: object) -> dict[str, Value]:
        """Carry out what keys asked for; return the settings to change, by dotted key."""
        changes: dict[str, Value] = {}
        for pick in picks:
            if pick == "list":
                self.open = not self.open
            elif self.open:
                self._pick(pick, settings, changes)
        return {key: value for key, value in changes.items() if value != declare.get(settings, key)}

    def _pick(self, pick: str, settings: object, changes: dict[str, Value]) -> None:
        if pick in ("up", "down"):
            self.index = (self.index + (1 if pick == "down" else -1)) % len(self.rows)
        elif pick in ("first", "last"):
            self.index = 0 if pick == "first" else len(self.rows) - 1
        elif pick in ("previous_group", "next_group"):
            self._to_group(1 if pick == "next_group" else -1)
        else:
            row = self.rows[self.index]
            current = declare.with_settings(settings, changes)
            value, usual = row.value(current), row.value(self.defaults)
            if pick == "default":
                value = usual
            elif pick in ("more", "less"):
                number = 0.0 if isinstance(usual, bool | str | tuple) else usual
                value = stepped(row, value, 1 if pick == "more" else -1, number)
            elif isinstance(value, bool):
                value = not value
            changes[row.key] = row.changed(current, value)

    def _to_group(self, way: int) -> None:
        """Choose the first row of the next or the previous group."""
        starts = [k for k, row in enumerate(self.rows) if k == 0 or row.group != self._before(k)]
        here = max(k for k, start in enumerate(starts) if start <= self.index)
        self.index = starts[(here + way) % len(starts)]

    def _before(self, index: int) -> str:
        return self.rows[index - 1].group


@dataclass(frozen=True)
class Line:
    """One line of the list: a group's heading, or a row; an ``idle`` one has no effect."""

    name: str
    value: str = ""
    default: str = ""
    chosen: bool = False
    idle: bool = False


@dataclass(frozen=True)
class Page:
    """All that the list shows: a title, lines, and texts below them, each wrapped to its width."""

    title: str
    lines: tuple[Line, ...]
    below: tuple[str, ...]


def _about(row: Row, usual: str, language: str) -> str:
    """Return three lines about the chosen row: its key, what it does, and its limits."""
    limits = words.text(language, "list.range", range=_limits(row, language), default=usual)
    return f"{row.key}\n{described(row, language)}\n{limits}"


def _line(
    row: Row, settings: object, defaults: object, chosen: bool, idle: bool, language: str
) -> Line:
    """Return a row as it is shown; ``idle`` if it has no effect now."""
    value, default = row.value(settings), row.value(defaults)
    differs = written(default, language) if value != default else ""
    return Line(row.label, written(value, language), differs, chosen, idle)


def page(
    settings: object,
    defaults: object,
    chosen: str,
    note: str,
    language: str,
    shown: frozenset[str],
    elements: tuple[str, ...],
    slots: tuple[Slot, ...] = (),
    unread: tuple[str, ...] = (),
) -> Page:
    """Return the list with the row ``chosen``; ``note`` says what the last change did.

    ``shown`` are the names, of the scene's ``elements``, that are drawn: a row is marked where it
    has no effect now.
    """
    lines: list[Line] = []
    below = ""
    group = ""
    for row in rows(type(settings)):
        if row.group != group:
            group = row.group
            lines.append(Line(heading(group, language)))
        idle = ignored(settings, row.key, {*shown, WALK}, elements, slots, unread)
        lines.append(_line(row, settings, defaults, row.name == chosen, bool(idle), language))
        if row.name == chosen:
            below = _about(row, written(row.value(defaults), language), language)
            note = note or (said(idle, language) if idle else "")

    text = words.text
    texts = (*below.split("\n"), note, text(language, "list.choose"), text(language, "list.change"))
    return Page(text(language, "list.title"), tuple(lines), texts)


def heading(group: str, language: str) -> str:
    """Return a group's heading: its name, after a word for it in another language."""
    word = translator(language, "settings")(group)
    return group if word == group else f"{word} ({group})"


def described(row: Row, language: str) -> str:
    """Return what a setting is, in its language where a text is known, else in English."""
    return translator(language, "settings")(row.item.does, row.key)


def _limits(row: Row, language: str) -> str:
    """Return what values a row takes, in few words."""
    item = row.item
    if item.kind == Kind.SWITCH:
        return f"{written(True, language)}, {written(False, language)}"
    if item.choices:
        return ", ".join(item.choices)
    kind = int if item.kind == Kind.WHOLE else float
    low, high = (written(kind(limit), language) for limit in item.limits)
    unit = translator(language, "settings")(item.unit)
    return words.text(language, "list.from_to", low=low, high=high, unit=unit).strip()
