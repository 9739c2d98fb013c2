"""Events that a program receives while it is run to a frame: one format for GLFW, GLUT and pygame.

A file holds a JSON list of events, or one event a line. Each is an object with the frame before
which the program receives it, and one of these:

    {"frame": 3, "key": "SPACE", "action": "press", "mods": ["shift"]}
    {"frame": 4, "move": [320, 200]}                         pixels from the window's top left
    {"frame": 5, "button": "left", "action": "press"}        left, right or middle
    {"frame": 6, "scroll": [0, -1]}                          wheel steps, right and up
    {"frame": 7, "resize": [640, 480]}
    {"frame": 9, "close": true}

``action`` is press, release, or, for keys, repeat; press if it is left out. A key has GLFW's name
for it, on a keyboard of the United States: A to Z, 0 to 9, SPACE, ENTER, ESCAPE, TAB, BACKSPACE,
DELETE, INSERT, HOME, END, PAGE_UP, PAGE_DOWN, LEFT, RIGHT, UP, DOWN, F1 to F12, LEFT_SHIFT,
LEFT_CONTROL, LEFT_ALT, KP_0 to KP_9 and so on; or it is a character such as "+". ``mods`` is a list
of shift, control and alt.
"""

import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from framelens.base.errors import InputError, Message, short
from framelens.base.input import read_bounded

Events = str | Path | Iterable[object] | None
"""A file of events, or such objects as it holds; none for None."""

MOST_BYTES = 4 << 20  # chosen
KINDS = ("key", "button", "move", "scroll", "resize", "close")
PRESSED = ("key", "button")
BUTTONS = ("left", "right", "middle")
MODS = ("shift", "control", "alt")
LARGEST = 16384  # pixels, the largest size of a window; that of a texture in Mesa

# The keys that write something, and what: alone, and with shift.
_WRITE = {
    **{chr(code): chr(code + 32) + chr(code) for code in range(ord("A"), ord("Z") + 1)},
    **dict(
        zip("0123456789", ("0)", "1!", "2@", "3#", "4$", "5%", "6^", "7&", "8*", "9("), strict=True)
    ),
    **{"SPACE": "  ", "APOSTROPHE": "'\"", "COMMA": ",<", "MINUS": "-_", "PERIOD": ".>"},
    **{"SLASH": "/?", "SEMICOLON": ";:", "EQUAL": "=+", "LEFT_BRACKET": "[{"},
    **{"BACKSLASH": "\\|", "RIGHT_BRACKET": "]}", "GRAVE_ACCENT": "`~"},
    **{f"KP_{digit}": str(digit) * 2 for digit in range(10)},
    **{"KP_ADD": "++", "KP_SUBTRACT": "--", "KP_MULTIPLY": "**", "KP_DIVIDE": "//"},
    **{"KP_DECIMAL": "..", "KP_EQUAL": "=="},
}
# Control characters, which GLUT and pygame write for these keys.
CONTROL = {
    **{"ESCAPE": "\x1b", "ENTER": "\r", "KP_ENTER": "\r", "TAB": "\t"},
    **{"BACKSPACE": "\x08", "DELETE": "\x7f"},
}
KEYS = {
    *(*_WRITE, *CONTROL, *(f"F{number}" for number in range(1, 13))),
    *("INSERT", "HOME", "END", "PAGE_UP", "PAGE_DOWN", "LEFT", "RIGHT", "UP", "DOWN"),
    *(f"{side}_{key}" for side in ("LEFT", "RIGHT") for key in ("SHIFT", "CONTROL", "ALT")),
    *("LEFT_SUPER", "RIGHT_SUPER", "CAPS_LOCK", "NUM_LOCK", "SCROLL_LOCK", "PAUSE", "MENU"),
    "PRINT_SCREEN",
}
# Characters that name a key: the main keyboard's, and not letters, which name it without shift.
_NAMED = {
    character: (name, bool(shift) and name != "SPACE")
    for name, pair in _WRITE.items()
    if not name.startswith("KP_")
    for shift, character in enumerate(pair)
    if not character.isalpha()
}


@dataclass(frozen=True)
class Event:
    """One event; which fields count depends on ``kind``, one of KINDS."""

    frame: int
    kind: str
    name: str = ""  # of the key or the button
    action: str = "press"
    mods: frozenset[str] = frozenset()
    value: tuple[float, ...] = ()  # of move, scroll and resize

    @property
    def pressed(self) -> bool:
        """Whether a key or button is down after it."""
        return self.action != "release"

    @property
    def text(self) -> str:
        """The text that the key types, without control characters; "" if none."""
        if self.kind != "key" or not self.pressed:
            return ""
        return _WRITE.get(self.name, ("", ""))["shift" in self.mods]


class Queue:
    """The events still to come, and what is held down and where the mouse is after those past."""

    def __init__(self, events: Sequence[Event]) -> None:
        self._coming = sorted(events, key=lambda event: event.frame)
        self.keys: set[str] = set()
        self.buttons: set[str] = set()
        self.mods: frozenset[str] = frozenset()
        self.mouse = (0.0, 0.0)
        self._waited = -1  # the last frame in which the program waited

    def due(self, frame: int) -> list[Event]:
        """Take the events that come before a frame."""
        found = []
        while self._coming and self._coming[0].frame <= frame:
            found.append(self._coming.pop(0))
        return found

    def awaited(self, frame: int) -> list[Event]:
        """Take events for a program that waits in a frame; none if it is to redraw.

        If it waits again without having drawn, it gets those of the next frame that has any.
        """
        again, self._waited = self._waited == frame, frame
        later = again and self._coming
        return self.due(max(frame, self._coming[0].frame) if later else frame)

    def note(self, event: Event) -> None:
        """Note what an event changes; call it just before the program is told of it."""
        if event.kind == "key":
            (self.keys.add if event.pressed else self.keys.discard)(event.name)
            self.mods = event.mods
        elif event.kind == "button":
            (self.buttons.add if event.pressed else self.buttons.discard)(event.name)
            self.mods = event.mods
        elif event.kind == "move":
            self.mouse = float(event.value[0]), float(event.value[1])


def presses(keys: Iterable[str], frame: int = 1) -> list[dict[str, object]]:
    """Return the events of keys that are pressed and released before a frame."""
    actions = ("press", "release")
    return [{"frame": frame, "key": key, "action": action} for key in keys for action in actions]


def read_events(source: Events) -> list[Event]:
    """Return the events of a file, or of a list of objects as in a file; none for None.

    Raises InputError that names the file and the event.
    """
    if source is None:
        return []
    if isinstance(source, (str, Path)):
        where, entries = str(source), _entries(Path(source))
    else:
        where, entries = "events", list(source)
    return [_event(entry, f"{where}: event {at}") for at, entry in enumerate(entries, 1)]


def _entries(path: Path) -> list[object]:
    try:
        text = read_bounded(path, MOST_BYTES).decode()
    except UnicodeDecodeError:
        raise InputError("{path}: is not text; expected events as JSON", path=path) from None

    if text.lstrip().startswith("["):
        try:
            entries = json.loads(text)
        except (ValueError, RecursionError) as error:
            raise InputError("{path}: is not JSON ({error})", path=path, error=error) from None
        return list(entries)

    found = []
    for number, line in enumerate(text.splitlines(), 1):
        if line.strip():
            try:
                found.append(json.loads(line))
            except (ValueError, RecursionError) as error:
                raise InputError(
                    "{path}: line {number} is not JSON ({error})",
                    path=path,
                    number=number,
                    error=error,
                ) from None

    return found


def _kind(entry: Mapping[object, object], where: str) -> str:
    """Return the kind of an event; InputError if it has none, or what has no meaning for it."""
    kinds = [kind for kind in KINDS if kind in entry]
    if len(kinds) != 1:
        raise InputError(
            "{where}: expected exactly one of {names}", where=where, names=", ".join(KINDS)
        )
    (kind,) = kinds
    allowed = {"frame", kind} | ({"action", "mods"} if kind in PRESSED else set())
    for name in entry:
        if name not in allowed:
            raise InputError(
                "{where}: {name} has no meaning for an event of this kind",
                where=where,
                name=short(name),
            )
    return kind


def _mods(mods: object, where: str) -> set[str]:
    """Return which of Shift and the like are held."""
    if not isinstance(mods, list):
        raise InputError(
            '{where}: "mods" is {mods}, expected a list of {names}',
            where=where,
            mods=short(mods),
            names=", ".join(MODS),
        )
    return {_one_of(mod, MODS, "mods", where) for mod in mods}


def _event(entry: object, where: str) -> Event:
    """Check an event; ``where`` names it in the error."""
    if not isinstance(entry, dict):
        raise InputError(
            '{where}: {entry} is not an object such as {{"frame": 3, "key": "SPACE"}}',
            where=where,
            entry=short(entry),
        )

    kind = _kind(entry, where)
    frame = entry.get("frame")
    if type(frame) is not int or frame < 0:
        raise InputError(
            '{where}: "frame" is {frame}, expected a whole number from 0',
            where=where,
            frame=short(frame),
        )
    given = entry[kind]
    if kind == "close":
        if given is not True:
            raise InputError(
                '{where}: "close" is {value}, expected true', where=where, value=short(given)
            )
        return Event(frame, kind)

    if kind not in PRESSED:
        return Event(frame, kind, value=_pair(given, kind, where))
    actions = ("press", "release", "repeat")[: 3 if kind == "key" else 2]
    action = _one_of(entry.get("action", "press"), actions, "action", where)
    held = _mods(entry.get("mods", []), where)
    if kind == "button":
        return Event(frame, kind, _one_of(given, BUTTONS, kind, where), action, frozenset(held))
    name, shifted = _key(given, where)
    return Event(frame, kind, name, action, frozenset(held | ({"shift"} if shifted else set())))


def _key(given: object, where: str) -> tuple[str, bool]:
    """Return a key's name, and whether shift is needed to write the character that named it."""
    if isinstance(given, str):
        if given.upper() in KEYS:
            return given.upper(), False
        if given in _NAMED:
            return _NAMED[given]
    raise InputError(
        '{where}: "key" is {value}, expected a key\'s name such as A or SPACE',
        where=where,
        value=short(given),
    )


def _one_of(given: object, values: Sequence[str], name: str, where: str) -> str:
    if not isinstance(given, str) or given not in values:
        raise InputError(
            '{where}: "{name}" is {value}, expected {names}',
            where=where,
            name=name,
            value=short(given),
            names=" or ".join(values),
        )
    return given


def _pair(given: object, name: str, where: str) -> tuple[float, float]:
    whole = name == "resize"
    kinds = (int,) if whole else (int, float)
    if (
        not isinstance(given, list)
        or len(given) != 2
        or not all(type(value) in kinds and abs(value) <= LARGEST for value in given)
        or (whole and min(given) < 1)
    ):
        expected = Message("two numbers")
        if whole:
            expected = Message("two whole numbers from 1 to {most}", most=LARGEST)
        raise InputError(
            '{where}: "{name}" is {value}, expected {expected}',
            where=where,
            name=name,
            value=short(given),
            expected=expected,
        )
    return given[0], given[1]
