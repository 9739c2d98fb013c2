"""A user's preferences for every walk: keys, mouse, comfort, language; in one commented TOML file.

The file is ``preferences.toml`` in the system's folder for settings, or in the folder that the
environment variable LANDSCAPE_CONFIG names; if it is empty, nothing is kept. A replay takes its
keys from here and nothing else: a recorded walk looks as it did. A file that cannot be read is kept
aside under another name, and a value that is wrong is left out; both are said in a line.
"""

import json
import os
import textwrap
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from pathlib import Path

from framelens.base.arguments import is_number
from framelens.base.errors import InputError, Message, short
from framelens.base.input import read_bounded
from framelens.base.output import write_whole
from framelens.base.texts import choose, said
from landscape.settings import declare
from landscape.walk import words
from landscape.walk.keymap import ACTIONS, KEY_NAMES, Keymap, key_named

FILE = "preferences.toml"
MOST_BYTES = 64 << 10  # chosen: many times what all of them take
LANGUAGES = ("", "en", "fr")
Said = Message | InputError  # what is to be said about a file
STILL: Mapping[str, declare.Value] = {"walk.bob": 0.0, "plants.sway": 0.0}
"""Settings of a walk with less motion: no bob at each step, no plants that sway before the eye."""


@dataclass(frozen=True)
class Preferences:
    """The file's contents; each value's default is the program's behaviour without a file."""

    mouse_speed: float = 1.0
    invert: bool = False
    field_of_view: float = 0.0
    reduced_motion: bool = False
    text_size: float = 1.0
    volume: float = 1.0
    captions: bool = False
    language: str = ""
    fullscreen: bool = False
    keys: Keymap = field(default_factory=Keymap)

    def value(self, name: str) -> bool | float | str:
        """Return the value of a name in COMMENTS."""
        return getattr(self, name)  # type: ignore[no-any-return]

    def with_value(self, name: str, value: object) -> "Preferences":
        """Return them with another value of a name in COMMENTS; it must have its type."""
        return replace(self, **{name: value})  # type: ignore[arg-type]

    def changes(self, kind: type) -> dict[str, declare.Value]:
        """Return the settings, of those that a scene's class ``kind`` has, that they change."""
        wanted = dict(STILL) if self.reduced_motion else {}
        if self.field_of_view:
            wanted["camera.fov"] = self.field_of_view
        if self.volume != 1.0:
            wanted["sound.volume"] = self.volume
        if self.captions:
            wanted["sound.captions"] = "on"
        known = declare.fields(kind)
        return {key: value for key, value in wanted.items() if key in known}


LIMITS = {
    "mouse_speed": (0.1, 10.0),
    "field_of_view": (40.0, 100.0),
    "text_size": (1.0, 2.0),
    "volume": (0.0, 4.0),
}
"""Least and greatest value; a field of view of 0 is each view's own."""
COMMENTS = {
    "mouse_speed": Message("times the usual speed of the mouse, 0.1 to 10"),
    "invert": Message("true: the view goes up when the mouse or the stick goes down"),
    "field_of_view": Message("vertical, in degrees, 40 to 100; 0: that of each view"),
    "reduced_motion": Message("true: no bob at each step, and plants that do not sway"),
    "text_size": Message("of help, messages and lists: 1 to 2"),
    "volume": Message("of the sound, 0 to 4; 1 is the usual one"),
    "captions": Message("true: what is heard is shown in words, too"),
    "language": Message('"en" or "fr"; "": that of the system'),
    "fullscreen": Message("true: begin with a full screen"),
}
HEAD = Message(
    "What you want in every walk of landscape. F2 in the walk changes it, too; a walk with --fresh "
    "does without it. A line that is deleted goes back to its default."
)
KEYS_HEAD = Message(
    'Keys of your own, as positions named after a US keyboard, such as forward = ["W", "Up"] or '
    'map = ["F3"]. Actions: {actions}.',
    actions=", ".join(ACTIONS),
)


def folder() -> Path | None:
    """Return the folder of the file; None if nothing is to be kept."""
    given = os.environ.get("LANDSCAPE_CONFIG")
    if given is not None:
        return Path(given) if given else None
    import platformdirs

    found = platformdirs.user_config_path("landscape", appauthor=False)
    return found if found.is_absolute() else None


def written(preferences: Preferences, language: str = "en") -> str:
    """Return the file's text: each value with what it means, in a language."""
    lines = [_comment(HEAD, language)]
    for name, meaning in COMMENTS.items():
        value = json.dumps(preferences.value(name))
        lines.append(f"\n{_comment(meaning, language)}\n{name} = {value}")

    lines.append(f"\n{_comment(KEYS_HEAD, language)}\n[keys]")
    for action, keys in preferences.keys.chosen.items():
        lines.append(f"{action} = {json.dumps([KEY_NAMES[key] for key in keys])}")
    return "\n".join(lines) + "\n"


def _comment(text: Message, language: str) -> str:
    """Return a text as comments of at most 100 characters a line."""
    lines = textwrap.wrap(said(text, language), 98, break_long_words=False)
    return "\n".join(f"# {line}" for line in lines)


def parsed(text: str, path: Path) -> tuple[Preferences, list[Said]]:
    """Return what a file's text says, and a message for each value that is left out.

    ValueError if it is no TOML.
    """
    tables = tomllib.loads(text)
    found = Preferences()
    left_out: list[Said] = []
    for name, value in tables.items():
        if name == "keys":
            continue
        try:
            found = found.with_value(name, _checked(name, value))
        except InputError as error:
            left_out.append(_said(path, error))

    keymap, wrong = _keymap(tables.get("keys", {}), path)
    return replace(found, keys=keymap), left_out + wrong


def _checked(name: str, value: object) -> object:
    """Return the value of a name as Preferences has it; InputError."""
    if name not in COMMENTS:
        raise InputError("{name}: expected one of {names}", name=name, names=", ".join(COMMENTS))
    expected = InputError(
        "{name}: expected {meaning}, not {value}",
        name=name,
        meaning=COMMENTS[name],
        value=short(repr(value)),
    )

    default = next(each.default for each in fields(Preferences) if each.name == name)
    if name in LIMITS:
        low, high = LIMITS[name]
        if not is_number(value) or not (low <= value <= high or value == default):
            raise expected
        return float(value)
    known = LANGUAGES if name == "language" else (True, False)
    if type(value) is not type(default) or value not in known:
        raise expected
    return value


def _keymap(table: object, path: Path) -> tuple[Keymap, list[Said]]:
    """Return the keys that a table of the file chooses, and what is left out of it."""
    left_out: list[Said] = []
    chosen: dict[str, tuple[int, ...]] = {}
    if not isinstance(table, dict):
        error = InputError("keys: expected a table, such as [keys] with lines below it")
        return Keymap(), [_said(path, error)]

    for action, names in table.items():
        try:
            if action not in ACTIONS:
                raise InputError(
                    "keys.{name}: expected one of {names}", name=action, names=", ".join(ACTIONS)
                )
            if not isinstance(names, list) or not names:
                raise InputError('keys.{name}: expected a list such as ["W", "Up"]', name=action)
            keys = tuple(map(key_named, names))
            taken = next(
                (each for each, others in chosen.items() if not set(keys).isdisjoint(others)), ""
            )
            if taken:
                raise InputError(
                    "keys.{name}: expected keys that {other} does not have",
                    name=action,
                    other=taken,
                )
            chosen[action] = keys
        except InputError as error:
            left_out.append(_said(path, error))

    return Keymap(chosen), left_out


def _said(path: Path, error: InputError) -> Message:
    return Message("{path}: {error}", path=path, error=error)


def read() -> tuple[Preferences, list[Said]]:
    """Return what the user's file says, and what is to be said about it.

    A file that is no TOML is renamed, so that it is neither read again nor written over.
    """
    place = folder()
    path = place / FILE if place else None
    try:
        if path is None or not os.path.lexists(path):
            return Preferences(), []
        text = read_bounded(path, MOST_BYTES).decode("utf-8-sig")
        return parsed(text, path)
    except (ValueError, RecursionError) as error:  # TOMLDecodeError and UnicodeDecodeError as well
        assert path is not None
        return Preferences(), [kept_aside(path, error)]
    except InputError as error:
        return Preferences(), [error]


def kept_aside(path: Path, error: Exception) -> Message:
    """Rename a damaged file; return what is said about it."""
    aside = _aside(path)
    if aside is None:
        return Message("{path}: expected TOML ({error}); it is not used", path=path, error=error)
    return Message(
        "{path}: expected TOML ({error}); it is kept as {aside}",
        path=path,
        error=error,
        aside=aside.name,
    )


def _aside(path: Path) -> Path | None:
    """Rename a file; return its new place, None if that is not possible."""
    number = 1
    while os.path.lexists(aside := path.with_name(f"{path.name}.damaged-{number}")):
        number += 1
    try:
        path.rename(aside)
    except OSError:
        return None
    return aside


def keep(preferences: Preferences) -> tuple[bool, list[Said]]:
    """Write the file; return whether it is kept, and what is to be said about the former one.

    One with lines that were not taken, as a newer version may have written, is renamed and not
    written over. InputError if the file cannot be written.
    """
    place = folder()
    if place is None:
        return False, []
    path = place / FILE
    former = read()[1]  # which renames it if it is no TOML
    if former and os.path.lexists(path):
        if (aside := _aside(path)) is None:
            raise InputError(
                "{path}: it has lines that are not taken, and stays as it is", path=path
            )
        former = [
            Message(
                "{path}: not all of it was taken; it is kept as {aside}",
                path=path,
                aside=aside.name,
            )
        ]

    language = preferences.language or choose(os.environ)
    write_whole(path, written(preferences, language).encode())
    return True, former


def kept(preferences: Preferences, language: str) -> str:
    """Write the file; return what is said about it in a language, "" if nothing is kept."""
    try:
        done, former = keep(preferences)
    except InputError as error:
        return said(error, language)
    lines = [words.text(language, "preferences.kept")] if done else []
    return "\n".join((*lines, *(said(message, language) for message in former)))
