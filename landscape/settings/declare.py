"""Dotted settings: how they are declared, checked, changed, read from TOML, and listed.

A scene's settings are a frozen dataclass of groups, each a frozen dataclass of values declared by
:func:`setting`. The key of a value is ``group.name``. A value is a bool, an int, a float, a string
or a tuple of floats. Beside the groups there may be words, declared by :func:`word`: one stands for
a table of values. No setting is named here: each scene brings its own.
"""

import dataclasses
import os
import tomllib
from collections.abc import Mapping
from dataclasses import field
from enum import Enum, auto
from numbers import Real
from pathlib import Path
from typing import TypeVar

from framelens.base.arguments import plain
from framelens.base.errors import InputError, Message, short
from framelens.base.input import read_bounded

MOST_TOML = 128 << 10  # bytes, chosen: all settings with a long comment each take a third of it
LONGEST_LINE = 1000  # characters, chosen
SWITCHES = {"true": True, "on": True, "1": True, "yes": True} | {
    "false": False,
    "off": False,
    "0": False,
    "no": False,
}
"""What users may write for a bool."""
Value = bool | int | float | str | tuple[float, ...]


class Kind(Enum):
    """What values a setting takes."""

    SWITCH = auto()
    CHOICE = auto()
    FILE = auto()
    WHOLE = auto()
    NUMBER = auto()
    NUMBERS = auto()


KINDS = {
    bool: Kind.SWITCH,
    int: Kind.WHOLE,
    float: Kind.NUMBER,
    str: Kind.FILE,
    tuple: Kind.NUMBERS,
}
"""By the type of a setting's default, unless it has choices."""
Settings = TypeVar("Settings")
Default = TypeVar("Default", bound=Value)
Tables = Mapping[str, Mapping[str, Value]]


@dataclasses.dataclass(frozen=True)
class Setting:
    """How a setting is declared: see :func:`setting`, and for ``tables`` :func:`word`."""

    default: Value
    source: str
    does: str
    low: float | None = None
    high: float | None = None
    choices: tuple[str, ...] = ()
    unit: str = ""
    needs: tuple[str, ...] = ()
    tables: Tables | None = None

    @property
    def kind(self) -> Kind:
        """What values it takes."""
        return Kind.CHOICE if self.choices else KINDS[type(self.default)]

    @property
    def count(self) -> int:
        """How many numbers its value is."""
        return len(self.default) if isinstance(self.default, tuple) else 1

    @property
    def limits(self) -> tuple[float, float]:
        """The least and the greatest value of a number, or of each number of a tuple."""
        assert self.low is not None and self.high is not None
        return self.low, self.high


@dataclasses.dataclass(frozen=True)
class Renamed:
    """The fate of an old key that files may still have: its new name, or "" if it is gone.

    With ``negated`` the sign of the value changed too.
    """

    key: str = ""
    negated: bool = False


def setting(
    default: Default,
    source: str,
    does: str,
    low: float | None = None,
    high: float | None = None,
    choices: tuple[str, ...] = (),
    unit: str = "",
    needs: tuple[str, ...] = (),
) -> Default:
    """Declare one setting: its default, the source of the default, what it does, and its limits.

    ``unit`` may be left out where the values have none. ``needs`` are the conditions under which
    the setting has an effect, see :mod:`landscape.settings.notices`.
    """
    declared = Setting(default, source, does, low, high, choices, unit, needs)
    return field(default=default, metadata={DECLARED: declared})


def word(default: str, tables: Tables, source: str, does: str) -> str:
    """Declare a word, whose key has no dot: each of its values stands for a table of settings."""
    declared = Setting(default, source, does, choices=tuple(tables), tables=tables)
    return field(default=default, metadata={DECLARED: declared})


DECLARED = "setting"  # the key of a field's metadata
_FIELDS: dict[type, dict[str, Setting]] = {}


def fields(kind: type) -> dict[str, Setting]:
    """Return the settings of a class in order: its words by key, then the others by dotted key."""
    if kind not in _FIELDS:
        top = dataclasses.fields(kind)
        words = {item.name: item.metadata[DECLARED] for item in top if DECLARED in item.metadata}
        _FIELDS[kind] = words | {
            f"{group.name}.{item.name}": item.metadata[DECLARED]
            for group in top
            if group.name not in words
            for item in dataclasses.fields(group.default)  # type: ignore[arg-type]
        }
    return _FIELDS[kind]


def words(kind: type) -> dict[str, Tables]:
    """Return the tables of a settings class's words, by the word's key and by its value."""
    return {key: item.tables for key, item in fields(kind).items() if item.tables is not None}


def get(settings: object, key: str) -> Value:
    """Return the value of a key."""
    group, _, name = key.rpartition(".")
    value: Value = getattr(getattr(settings, group) if group else settings, name)
    return value


def differs(settings: object, key: str) -> bool:
    """Return whether a key has another value than its default."""
    return get(settings, key) != fields(type(settings))[key].default


def next_value(settings: object, key: str) -> Value:
    """Return the other value of a bool, or the next of a key's choices, all round."""
    value, choices = get(settings, key), fields(type(settings))[key].choices
    if isinstance(value, bool):
        return not value
    return choices[(choices.index(value) + 1) % len(choices)]


@dataclasses.dataclass(frozen=True)
class Toggle:
    """The setting that a digit or letter changes in a walk, and its name.

    That is a bool, a setting with choices, or another; for that ``values`` are those that it takes
    in turn.
    """

    setting: str
    name: str
    values: tuple[Value, ...] = ()

    def next(self, settings: object) -> Value:
        """Return the setting's next value."""
        if not self.values:
            return next_value(settings, self.setting)
        now = get(settings, self.setting)
        place = self.values.index(now) + 1 if now in self.values else 0
        return self.values[place % len(self.values)]


def with_settings(settings: Settings, changes: Mapping[str, object]) -> Settings:
    """Return settings with some keys changed.

    Values may be strings, as on the command line, or numpy's numbers and arrays; a file's name may
    be a path. Old names of renamed keys are accepted as well. The table of a word is laid over the
    settings first, wherever the word is among the changes: all others override it. Raises
    InputError that names the key and what was expected.
    """
    known = fields(type(settings))
    wanted = current_names(settings, changes)[0]
    laid: dict[str, object] = {}
    for key, tables in words(type(settings)).items():
        if key in wanted:
            laid |= tables[str(_checked(key, known[key], wanted[key]))]
    for key, value in (laid | wanted).items():
        if key not in known:
            raise InputError(
                "setting {key!r}: no such key; `landscape settings` lists them all", key=key
            )
        checked = _checked(key, known[key], value)
        group, _, name = key.partition(".")
        if name:
            checked = dataclasses.replace(getattr(settings, group), **{name: checked})
        settings = dataclasses.replace(settings, **{group: checked})  # type: ignore[type-var]

    return settings


def passing(settings: Settings, defaults: Settings, changes: Mapping[str, object]) -> Settings:
    """Return settings with changes; a word among them takes back the table of the former one.

    ``defaults`` are the settings of the preset. What has the value that the former word gives it
    there gets the value of the new word; the user's values stay.
    """
    passed: dict[str, object] = {}
    for key in changes.keys() & words(type(settings)).keys():
        tables = words(type(settings))[key].values()
        then, now = (
            with_settings(defaults, {key: value}) for value in (get(settings, key), changes[key])
        )
        for name in {name for table in tables for name in table}:
            own = get(settings, name)
            passed[name] = get(now, name) if own == get(then, name) else own
    return with_settings(settings, passed | dict(changes))


def preset(defaults: Settings, presets: Mapping[str, Mapping[str, Value]], name: str) -> Settings:
    """Return settings with a preset's differences; InputError if there is none of that name."""
    if not isinstance(name, str) or name not in presets:
        raise InputError(
            "preset {name}: expected one of {names}", name=short(name), names=", ".join(presets)
        )
    return with_settings(defaults, presets[name])


def flattened(changes: object) -> dict[str, object]:
    """Return changes by dotted keys: ``{"fog": {"density": 1}}`` as ``{"fog.density": 1}``.

    InputError if they are no mapping, or a key is no string.
    """
    if not isinstance(changes, Mapping):
        raise InputError(
            'settings {changes}: expected a mapping such as {{"fog.density": 0.05}}',
            changes=short(changes),
        )

    flat: dict[str, object] = {}
    for key, value in changes.items():
        _check_names(key, *(value if isinstance(value, Mapping) else ()))
        if isinstance(value, Mapping):
            flat |= {f"{key}.{name}": inner for name, inner in value.items()}
        else:
            flat[key] = value

    return flat


def _check_names(*names: object) -> None:
    """Raise InputError if a name of a group or a key is no string."""
    for name in names:
        if not isinstance(name, str):
            raise InputError(
                "settings: key {name}: expected a string such as fog.density", name=short(name)
            )


def current_names(
    settings: object, changes: Mapping[str, object]
) -> tuple[dict[str, object], list[str]]:
    """Return changes under current names, and a one-line notice for each key under an old name.

    The class attribute ``RENAMED`` of a settings class, if it has one, maps old keys to
    :class:`Renamed`.
    """
    renamed: Mapping[str, Renamed] = getattr(settings, "RENAMED", {})
    current: dict[str, object] = {}
    notices = []
    for key, value in changes.items():
        new = renamed.get(key)
        if new is None:
            current[key] = value
        elif not new.key:
            notices.append(f"setting {key}: no longer used, ignored")
        else:
            current[new.key] = _negated(value) if new.negated else value
            notices.append(f"setting {key}: now called {new.key}")
    return current, notices


def _negated(value: object) -> object:
    """Return a number, or a string of one, with its sign changed; anything else unchanged."""
    number = plain(value)
    if isinstance(number, bool) or not isinstance(number, str | Real):
        return value
    try:
        return -float(number)
    except (TypeError, ValueError, OverflowError):
        return value


def read_toml(path: Path) -> dict[str, object]:
    """Read a TOML file of settings into a flat table of dotted keys."""
    data = read_bounded(path, MOST_TOML)
    try:
        # "utf-8-sig": some Windows editors begin a file with a byte order mark.
        text = data.decode("utf-8-sig").replace("\r\n", "\n")
        # The parser's memory grows with the square of the number of dots in a key.
        if max(map(len, text.split("\n"))) > LONGEST_LINE:
            raise ValueError(f"a line of more than {LONGEST_LINE} characters")
        tables = tomllib.loads(text)
    except (ValueError, RecursionError) as error:  # TOMLDecodeError and UnicodeDecodeError as well
        raise InputError(
            "{path}: expected a TOML file of settings ({error})", path=path, error=error
        ) from error

    flat: dict[str, object] = {}
    for group, table in tables.items():
        if isinstance(table, str):
            flat[group] = table
        elif isinstance(table, dict):
            flat |= {f"{group}.{name}": value for name, value in table.items()}
        else:
            raise InputError(
                "{path}: {group}: expected a table such as [fog] or [grass]", path=path, group=group
            )

    return flat


def _checked(key: str, item: Setting, given: object) -> Value:
    """Convert a user's value to the type of the key's default, and check its limits."""
    wrong = InputError(
        "setting {key}: expected {expected}, not {value}",
        key=key,
        expected=expected(item),
        value=short(given),
    )
    value = plain(given)
    if item.kind == Kind.SWITCH:
        switch = SWITCHES.get(value.lower()) if isinstance(value, str) else value
        if not isinstance(switch, bool):
            raise wrong
        return switch

    if item.kind in (Kind.CHOICE, Kind.FILE):
        text = os.fspath(value) if isinstance(value, os.PathLike) else value
        if not isinstance(text, str) or not _accepts(item, text):
            raise wrong
        return text

    if item.kind == Kind.NUMBERS:
        parts = value.split(",") if isinstance(value, str) else value
        if not isinstance(parts, (list, tuple)) or len(parts) != item.count:
            raise wrong
        return tuple(_number(part, item, wrong, float) for part in parts)

    return _number(value, item, wrong, int if item.kind == Kind.WHOLE else float)


def _accepts(item: Setting, text: str) -> bool:
    """Return whether a text is one of a setting's choices, or else may name its file."""
    return text in item.choices if item.choices else _names_a_file(text)


def _names_a_file(text: str) -> bool:
    """Return whether a text may be a file's name: not empty, and the system can encode it."""
    try:
        return b"\0" not in (os.fsencode(text) or b"\0")
    except UnicodeEncodeError:
        return False


def _number(
    value: object, item: Setting, wrong: InputError, kind: type[int] | type[float]
) -> int | float:
    """Return a user's value as a number of a kind; raise ``wrong`` if it is none, or too large."""
    value = plain(value)
    if isinstance(value, bool) or not isinstance(value, (str, Real)):
        raise wrong
    try:
        if isinstance(value, str):
            number = kind(value.replace("_", ""))
        else:
            number = kind(value if isinstance(value, int) else float(value))
    except (TypeError, ValueError, OverflowError):
        raise wrong from None
    if kind is int and not isinstance(value, str) and number != value:
        raise wrong
    # Comparing is safe where converting is not: an int may be larger than any float.
    low, high = item.limits
    if not low <= number <= high:
        raise wrong
    return number


def expected(item: Setting) -> Message:
    """Say in words what values a setting takes."""
    limits = {"low": item.low, "high": item.high}
    match item.kind:
        case Kind.SWITCH:
            return Message("true or false")
        case Kind.CHOICE:
            return Message("one of {choices}", choices=", ".join(item.choices))
        case Kind.FILE:
            return Message("a file name")
        case Kind.NUMBERS:
            return Message(
                "{count} numbers from {low} to {high}, separated by commas",
                count=item.count,
                **limits,
            )
        case Kind.WHOLE:
            return Message("a whole number from {low} to {high}", **limits)
        case Kind.NUMBER:
            return Message("a number from {low} to {high}", **limits)


UNITS = {Kind.SWITCH: "on or off", Kind.CHOICE: "name", Kind.FILE: "file"}
"""What kind of value a setting takes, where it has no unit."""


def unit(item: Setting) -> str:
    """Return the unit of a setting's values, or what kind of value it takes."""
    return item.unit or UNITS.get(item.kind, "")


def row(settings: object, key: str) -> dict[str, object]:
    """Return a key with its value and how it is declared, for JSON."""
    item = fields(type(settings))[key]
    return {
        "key": key,
        "value": get(settings, key),
        "default": item.default,
        "unit": unit(item),
        "source": item.source,
        "does": item.does,
        "expected": str(expected(item)),
        "low": item.low,
        "high": item.high,
        "choices": item.choices,
    }
