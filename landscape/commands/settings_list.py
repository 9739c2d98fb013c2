"""The list of settings: all of them or some, as data and as text (`landscape settings`)."""

import textwrap
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from framelens.base.errors import InputError
from landscape.flyover import settings as flyover
from landscape.scene.scene import SCENES, Scene, check_options, scene
from landscape.settings import declare
from landscape.settings.declare import Kind
from landscape.settings.notices import (
    WALK,
    Slot,
    conditions,
    ignored,
    in_words,
    terms,
    unreplaced,
    value_text,
)

WIDTH = 80  # columns of the narrowest terminal
Row = dict[str, Any]


class Flyover:
    """The software fly-over: it has settings as a scene has, but there are no views of it."""

    name = "flyover"
    elements: tuple[str, ...] = ()
    slots: tuple[Slot, ...] = ()
    unread: tuple[str, ...] = ()
    settings, presets = flyover.Settings(), flyover.PRESETS

    def values(self, name: str | None, changes: Mapping[str, object] | None = None) -> Any:
        """Return the settings of a preset (None: the default) with changes."""
        chosen = declare.preset(self.settings, self.presets, name or flyover.BEST)
        return declare.with_settings(chosen, changes or {})

    def groups(self) -> tuple[str, ...]:
        """Return the names of the groups of its settings."""
        return tuple(
            dict.fromkeys(key.partition(".")[0] for key in declare.fields(flyover.Settings))
        )


FLYOVER = Flyover()


def rows(preset: str | None, changes: Mapping[str, object], word: str = "") -> list[Row]:
    """Return the settings of every scene; a change goes to the scenes that have its key.

    A key that means the same in several scenes is listed once, with the first; ``scenes`` are the
    values of the others. Where a scene means something else by it, it has a row of its own.
    ``word`` is a group, part of a key, or a word of what a setting does; "" means all. The groups
    of the software fly-over, which no view has, are listed when they are asked for by name. Raises
    InputError if it is none of these, and for a change that no scene accepts.
    """
    if word in FLYOVER.groups():
        FLYOVER.values(preset, changes)  # which raises for a key that it does not have
        return [row for row in _rows_of(FLYOVER, preset, changes) if _group(row) == word]
    check_options(preset, changes, None)
    found = _of_all_scenes(preset, changes)
    groups = list(dict.fromkeys(map(_group, found)))
    if word in groups:
        return [row for row in found if _group(row) == word]
    sought = word.lower()
    kept = [row for row in found if sought in row["key"] or sought in row["does"].lower()]
    if not kept:
        raise InputError(
            "settings {word!r}: expected part of a key, a word of a description, or a "
            "group: {names}",
            word=word,
            names=", ".join((*groups, *FLYOVER.groups())),
        )

    return kept


def _of_all_scenes(preset: str | None, changes: Mapping[str, object]) -> list[Row]:
    """Return the settings of all scenes, those that mean the same in several of them once."""
    listed: dict[tuple[str, str], Row] = {}
    for name in SCENES:
        for row in _rows_of(scene(name), preset, changes):
            first = listed.setdefault((row["key"], row["does"]), row)
            if first is not row:
                first["scenes"][name] = row["value"]
    return list(listed.values())


def _group(row: Row) -> str:
    return str(row["key"].partition(".")[0])


def _rows_of(
    kind: Scene | Flyover, preset: str | None, changes: Mapping[str, object]
) -> Iterator[Row]:
    current, _ = declare.current_names(kind.settings, changes)
    own = {key: v for key, v in current.items() if key in declare.fields(type(kind.settings))}
    values = kind.values(preset if preset in kind.presets else None, own)
    presets = {name: kind.values(name) for name in kind.presets}
    for key in declare.fields(type(values)):
        shown = (*kind.elements, WALK)
        why = ignored(values, key, shown, kind.elements, kind.slots, kind.unread)
        needs = [in_words(type(values), each) for each in conditions(type(values), key, kind.slots)]
        yield {
            **declare.row(values, key),
            "presets": {name: declare.get(each, key) for name, each in presets.items()},
            "needs": [words for words in needs if words],
            "ignored": str(why) if why else "",
            "scene": kind.name,
            "scenes": {},
        }


def _named(name: str) -> Scene | Flyover:
    return FLYOVER if name == FLYOVER.name else scene(name)


def as_text(found: Sequence[Row]) -> Iterator[str]:
    """Yield the lines that print these settings, group by group, at most WIDTH columns each."""
    group = ""
    scenes: dict[str, set[str]] = {}
    for row in found:
        scenes.setdefault(_group(row), set()).add(row["scene"])
    for row in found:
        kind = type(_named(row["scene"]).settings)
        name = _group(row)
        if f"{row['scene']}.{name}" != group:
            yield from ([""] if group else [])
            group = f"{row['scene']}.{name}"
            where = f" of {row['scene']}" if len(scenes[name]) > 1 else ""
            if row["key"] not in declare.words(kind):
                about = getattr(_named(row["scene"]).settings, name).__doc__ or ""
                yield from textwrap.wrap(f"{name}{where}: {about.splitlines()[0]}", WIDTH)
            elif where:
                yield f"{name}{where}:"
        yield from _lines(row, kind)


def _with_unit(row: Row, item: declare.Setting) -> str:
    """Return a value with its unit, if it is a number or several."""
    numbers = item.kind in (Kind.WHOLE, Kind.NUMBER, Kind.NUMBERS)
    return f"{value_text(row['value'])} {row['unit'] if numbers else ''}".rstrip()


def _values(row: Row) -> str:
    """Return the values in the presets, and those of other scenes that differ."""
    presets = ", ".join(f"{name}: {value_text(each)}" for name, each in row["presets"].items())
    elsewhere = {name: each for name, each in row["scenes"].items() if each != row["value"]}
    return presets + "".join(f"; {name}: {value_text(each)}" for name, each in elsewhere.items())


def _needs(row: Row, kind: type) -> list[str]:
    """Return in words the settings that a setting needs.

    What must be shown is plain from the group's name.
    """
    needs = declare.fields(kind)[row["key"]].needs
    needs += unreplaced(kind, row["key"], _named(row["scene"]).slots)
    told = [in_words(kind, each) for each in needs if any(t.is_setting for t in terms(each))]
    return [words for words in told if words]


def _lines(row: Row, kind: type) -> Iterator[str]:
    item = declare.fields(kind)[row["key"]]
    head, source = f"  {row['key']:28} {_with_unit(row, item)}", f"[{row['source']}]"
    room = WIDTH - len(head) - len(source)
    yield head + (" " * room + source if room > 0 else "")
    lines = [row["does"], f"{_accepted(row, item)}; {_values(row)}"]
    if needs := _needs(row, kind):
        lines.append("needs " + "; ".join(needs))
    if row["ignored"]:
        lines.append(f"now {row['ignored']}")
    if room <= 0:
        lines.append(source)
    for line in lines:
        yield from textwrap.wrap(line, WIDTH, initial_indent=" " * 6, subsequent_indent=" " * 8)


def _accepted(row: Row, item: declare.Setting) -> str:
    """Return what values a setting takes, in few words."""
    if item.kind == Kind.SWITCH:
        return "on or off"
    if item.kind in (Kind.CHOICE, Kind.FILE):
        return " | ".join(row["choices"]) or row["unit"]
    count = f"{item.count} numbers, " if item.kind == Kind.NUMBERS else ""
    return f"{count}{value_text(row['low'])} to {value_text(row['high'])}"
