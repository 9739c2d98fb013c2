"""The keys that each scene uses as it likes, and the rows of the help. No OpenGL.

These are the digits, and letters that a scene has for itself. What they do becomes a changed
setting before a frame is recorded, so a recording does not depend on which key stands for what.
"""

from collections.abc import Sequence

from framelens.base.texts import translator
from landscape.scene.scene import Scene, SceneSettings
from landscape.settings import declare as keys
from landscape.settings.declare import Toggle, Value
from landscape.walk import words
from landscape.walk.keymap import DEFAULT, Keymap
from landscape.walk.keys import Namer, available

BUILDING = ("dig", "place", "pick", "slots")  # rows of the help in a scene of blocks


def help_rows(
    kind: Scene,
    settings: SceneSettings,
    language: str,
    name: Namer,
    keymap: Keymap = DEFAULT,
) -> list[tuple[str, str]]:
    """Return the rows of the help: keys as the keyboard labels them, and what they do.

    Keys that do nothing in the scene are left out; ``name`` says what is printed on a key.
    """
    rows = [
        (
            keymap.labels(binding.action, language, name, kind.letters),
            _help(binding.action, kind.blocks, language),
        )
        for binding in available(settings, bool(kind.fixes), kind.blocks)
    ]
    for row in BUILDING if kind.blocks else ():
        rows.append((words.text(language, f"key.{row}"), words.text(language, f"help.{row}")))
    if kind.carried is not None:
        rows.append((words.text(language, "key.carry"), words.text(language, "help.carry")))
    for letter, toggle in kind.letters.items():
        key = keymap.letter_label(letter, language, name, kind.letters)
        rows.append((key, named(toggle, language)))
    return rows + [(digit, named(toggle, language)) for digit, toggle in kind.digits.items()]


def hint(kind: Scene, language: str, name: Namer, keymap: Keymap = DEFAULT) -> str:
    """Return what is said at the beginning of a walk: which key lists the others, and so on."""
    keys = {each: keymap.labels(each, language, name) for each in ("help", "mouse")}
    key = "hint.blocks" if kind.blocks else "hint"
    return words.text(language, key, letter=keys["help"], mouse=keys["mouse"])


def _help(action: str, blocks: bool, language: str) -> str:
    """Return what a key does; some keys do something else in a scene of blocks."""
    key = f"help.{action}.blocks"
    return words.text(language, key if blocks and key in words.TEXTS else f"help.{action}")


def named(toggle: Toggle, language: str) -> str:
    """Return what a digit or letter changes, in a language."""
    return translator(language, "scenes")(toggle.name, toggle.setting)


def pressed(
    kind: Scene, settings: SceneSettings, switches: Sequence[str], language: str
) -> tuple[tuple[str, ...], dict[str, Value], str]:
    """Return the switches that are the window's, and what the scene's keys among them do.

    The scene's are digits and letters. What they do is the settings to change, by dotted key, and
    a message, "" if there was none of them.
    """
    changes: dict[str, Value] = {}
    message = ""
    own = {**kind.digits, **kind.letters}
    for toggle in (own[name] for name in switches if name in own):
        changed = keys.with_settings(settings, changes)
        value = toggle.next(changed)
        changes[toggle.setting] = value
        message = words.toggled(language, named(toggle, language), value)
    return tuple(name for name in switches if len(name) > 1), changes, message
