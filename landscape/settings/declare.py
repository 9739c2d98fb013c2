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
from numbers import Real
from pathlib import Path
from typing import Any, TypeVar

from framelens.base.arguments import plain
from framelens.base.errors import InputError, Message, short
from framelens.base.input import read_bounded

MOST_TOML = 128 << 10  # bytes, chosen: all settings with a long comment each take a third of it
LONGEST_LINE = 1000  # characters, chosen
Value = bool | int | float | str | tuple[float, ...]
Settings = TypeVar("Settings")
Field = dataclasses.Field[Any]


@dataclasses.dataclass(frozen=True)
class Renamed:
    """What became of a key that files may still have: its new name, or "" if it is gone.

    With ``negated`` the sign of the value changed too.
    """

    key: str = ""
    negated: bool = False


def setting(
    default: Any,
    source: str,
    does: str,
    low: float | None = None,
    high: float | None = None,
    choices: tuple[str, ...] = (),
    unit: str = "",
    needs: tuple[str, ...] = (),
) -> Any:
    """Declare one setting: its default, the source of the default, what it does, and its limits.

    ``unit`` may be left out where the values have none. ``needs`` are the conditions under which
    the setting has an effect, see :mod:`landscape.settings.notices`.
    """
    meta = {"source": source, "does": does, "low": low, "high": high, "choices": choices}
    return field(default=default, metadata={**meta, "unit": unit, "needs": needs})


def word(default: str, tables: Mapping[str, Mapping[str, Value]], source: str, does: str) -> Any:
    """Declare a word, whose key has no dot: each of its values stands for a table of settings."""
    made = setting(default, source, does, choices=tuple(tables))
    return field(default=default, metadata={**made.metadata, "tables": tables})


_FIELDS: dict[type, dict[str, Field]] = {}


def fields(kind: type) -> dict[str, Field]:
    """Return the words of a settings class by key, and then its fields by dotted key, in order."""
    if kind not in _FIELDS:
        top = dataclasses.fields(kind)
        words = {item.name: item for item in top if "tables" in item.metadata}
        _FIELDS[kind] = words | {
            f"{group.name}.{item.name}": item
            for group in top
            if group.name not in words
            for item in dataclasses.fields(group.default)  # type: ignore[arg-type]
        }
    return _FIELDS[kind]


def words(kind: type) -> dict[str, Mapping[str, Mapping[str, Value]]]:
    """Return the tables of a settings class's words, by the word's key and by its value."""
    known = fields(kind).items()
    return {key: item.metadata["tables"] for key, item in known if "tables" in item.metadata}


def get(settings: Any, key: str) -> Value:
    """Return the value of a key."""
    value: Any = settings
    for name in key.split("."):
        value = getattr(value, name)
    found: Value = value
    return found


def differs(settings: Any, key: str) -> bool:
    """Return whether a key has another value than its default."""
    return get(settings, key) != fields(type(settings))[key].default


def next_value(settings: Any, key: str) -> Value:
    """Return the other value of a bool, or the next of a key's choices, all round."""
    value, choices = get(settings, key), fields(type(settings))[key].metadata["choices"]
    if isinstance(value, bool):
        return not value
    following: Value = choices[(choices.index(value) + 1) % len(choices)]
    return following


@dataclasses.dataclass(frozen=True)
class Toggle:
    """What a digit or letter changes in a walk, and its name.

    That is a bool, a setting with choices, or another; for that ``values`` are those that it takes
    in turn.
    """

    setting: str
    name: str
    values: tuple[Value, ...] = ()

    def next(self, settings: Any) -> Value:
        """Return the setting's next value."""
        if not self.values:
            return next_value(settings, self.setting)
        now = get(settings, self.setting)
        place = self.values.index(now) + 1 if now in self.values else 0
        return self.values[place % len(self.values)]


def with_settings(settings: Settings, changes: Mapping[str, Any]) -> Settings:
    """Return settings with some keys changed.

    Values may be strings, as on the command line, or numpy's numbers and arrays; a file's name may
    be a path. Old names of renamed keys are accepted as well. The table of a word is laid over the
    settings first, wherever the word is among the changes: all others override it. Raises
    InputError that names the key and what was expected.
    """
    known = fields(type(settings))
    wanted = current_names(settings, changes)[0]
    laid: dict[str, Any] = {}
    for key in wanted.keys() & words(type(settings)).keys():
        laid |= known[key].metadata["tables"][_checked(key, known[key], wanted[key])]
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


def passing(settings: Settings, defaults: Settings, changes: Mapping[str, Any]) -> Settings:
    """Return settings with changes; a word among them takes back the table of the former one.

    ``defaults`` are the settings of the preset. What has the value that the former word gives it
    there gets the value of the new word; the user's values stay.
    """
    given: dict[str, Any] = {}
    for key in changes.keys() & words(type(settings)).keys():
        tables = words(type(settings))[key].values()
        then, now = (
            with_settings(defaults, {key: value}) for value in (get(settings, key), changes[key])
        )
        for name in {name for table in tables for name in table}:
            own = get(settings, name)
            given[name] = get(now, name) if own == get(then, name) else own
    return with_settings(settings, given | dict(changes))


def preset(defaults: Settings, presets: Mapping[str, Mapping[str, Value]], name: str) -> Settings:
    """Return settings with a preset's differences; InputError if there is none of that name."""
    if not isinstance(name, str) or name not in presets:
        raise InputError(
            "preset {name}: expected one of {names}", name=short(name), names=", ".join(presets)
        )
    return with_settings(defaults, presets[name])


def flattened(changes: Any) -> dict[str, Any]:
    """Return changes by dotted keys: ``{"fog": {"density": 1}}`` as ``{"fog.density": 1}``.

    InputError if they are no mapping, or a key is no string.
    """
    if not isinstance(changes, Mapping):
        raise InputError(
            'settings {changes}: expected a mapping such as {{"fog.density": 0.05}}',
            changes=short(changes),
        )

    flat: dict[str, Any] = {}
    for key, value in changes.items():
        group = value if isinstance(value, Mapping) else {}
        for each in (key, *group):
            if not isinstance(each, str):
                raise InputError(
                    "settings: key {name}: expected a string such as fog.density", name=short(each)
                )
        inner = {f"{key}.{name}": each for name, each in group.items()}
        flat |= inner if isinstance(value, Mapping) else {key: value}

    return flat


def current_names(settings: Any, changes: Mapping[str, Any]) -> tuple[dict[str, Any], list[str]]:
    """Return changes under current names, and a one-line notice for each key under an old name.

    The class attribute ``RENAMED`` of a settings class, if it has one, maps old keys to
    :class:`Renamed`.
    """
    renamed: Mapping[str, Renamed] = getattr(settings, "RENAMED", {})
    current: dict[str, Any] = {}
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


def _negated(value: Any) -> Any:
    """Return a number, or a string of one, with its sign changed; anything else unchanged."""
    number = plain(value)
    if isinstance(number, bool):
        return value
    try:
        return -float(number)
    except (TypeError, ValueError, OverflowError):
        return value


def read_toml(path: Path) -> dict[str, Any]:
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

    flat: dict[str, Any] = {}
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


def _checked(key: str, item: Field, given: Any) -> Value:
    """Convert a value that was given to the type of the key's default, and check its limits."""
    meta, default = item.metadata, item.default
    wrong = InputError(
        "setting {key}: expected {expected}, not {value}",
        key=key,
        expected=expected(item),
        value=short(given),
    )
    value = plain(given)
    if isinstance(default, bool):
        if isinstance(value, str):
            words = {"true": True, "on": True, "1": True, "yes": True}
            words |= {"false": False, "off": False, "0": False, "no": False}
            value = words.get(value.lower())
        if not isinstance(value, bool):
            raise wrong
        return value

    if isinstance(default, str):
        text = os.fspath(value) if isinstance(value, os.PathLike) else value
        if not isinstance(text, str) or (meta["choices"] and text not in meta["choices"]):
            raise wrong
        if not meta["choices"] and not _names_a_file(text):
            raise wrong
        return text

    if isinstance(default, tuple):
        parts = value.split(",") if isinstance(value, str) else value
        if not isinstance(parts, (list, tuple)) or len(parts) != len(default):
            raise wrong
        return tuple(_number(part, meta, wrong, float) for part in parts)

    return _number(value, meta, wrong, type(default))


def _names_a_file(text: str) -> bool:
    """Return whether a text may be a file's name: not empty, and the system can encode it."""
    try:
        return b"\0" not in (os.fsencode(text) or b"\0")
    except UnicodeEncodeError:
        return False


def _number(value: Any, meta: Mapping[str, Any], wrong: InputError, kind: type) -> Any:
    value = plain(value)
    if isinstance(value, bool) or not isinstance(value, (str, Real)):
        raise wrong
    try:
        number = kind(value.replace("_", "") if isinstance(value, str) else value)
    except (TypeError, ValueError, OverflowError):
        raise wrong from None
    if kind is int and not isinstance(value, str) and number != value:
        raise wrong
    # Comparing is safe where converting is not: an int may be larger than any float.
    if not meta["low"] <= number <= meta["high"]:
        raise wrong
    return number


def expected(item: Field) -> Message:
    """Say in words what values a setting takes."""
    meta, default = item.metadata, item.default
    if isinstance(default, bool):
        return Message("true or false")
    if meta["choices"]:
        return Message("one of {choices}", choices=", ".join(meta["choices"]))
    if isinstance(default, str):
        return Message("a file name")
    limits = {"low": meta["low"], "high": meta["high"]}
    if isinstance(default, tuple):
        return Message(
            "{count} numbers from {low} to {high}, separated by commas",
            count=len(default),
            **limits,
        )
    if isinstance(default, int):
        return Message("a whole number from {low} to {high}", **limits)
    return Message("a number from {low} to {high}", **limits)


def unit(item: Field) -> str:
    """Return the unit of a setting's values, or what kind of value it takes."""
    default = item.default
    if item.metadata["unit"]:
        return str(item.metadata["unit"])
    if isinstance(default, bool):
        return "on or off"
    return ("name" if item.metadata["choices"] else "file") if isinstance(default, str) else ""


def table(settings: Any) -> list[dict[str, Any]]:
    """Return every key with its value, default, unit, source, what it does and what it accepts."""
    return [
        {
            "key": key,
            "value": get(settings, key),
            "default": item.default,
            "unit": unit(item),
            "source": item.metadata["source"],
            "does": item.metadata["does"],
            "expected": str(expected(item)),
            **{name: item.metadata[name] for name in ("low", "high", "choices")},
        }
        for key, item in fields(type(settings)).items()
    ]
