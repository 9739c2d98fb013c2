"""Which keys do what: those of the table in keys.py, but for what the user has chosen.

A chosen key is a position, named as on a US keyboard: "W" is labelled Z on an AZERTY keyboard.
The keys of letters (M for map) are found where they are printed, unless an action has been given
another key.
"""

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from functools import cached_property

from framelens.base.errors import InputError
from framelens.gl.glfw_library import glfw
from framelens.inspector.keys import Namer, us_name
from landscape.walk import words
from landscape.walk.keys import (
    BACKWARD,
    BINDINGS,
    DIGITS,
    DOWN,
    FORWARD,
    HELD,
    LEFTWARD,
    LETTERS,
    NAMED_KEYS,
    RIGHTWARD,
    RUN,
    TURN_LEFT,
    TURN_RIGHT,
    UP,
    layout,
    letter_of,
    letters_in,
)

HELD_KEYS = {
    "forward": FORWARD,
    "backward": BACKWARD,
    "leftward": LEFTWARD,
    "rightward": RIGHTWARD,
    "turn_left": TURN_LEFT,
    "turn_right": TURN_RIGHT,
    "up": UP,
    "down": DOWN,
    "run": RUN,
}
"""The keys that act while they are down, by action."""
ROWS = {
    "walk": ("forward", "leftward", "backward", "rightward"),
    "turn": ("turn_left", "turn_right"),
    "run": ("run",),
    "up_down": ("up", "down"),
}
"""What a row of the help stands for, where it is of keys that act while they are down."""
FIXED = frozenset((glfw.KEY_ESCAPE, glfw.KEY_UNKNOWN, *DIGITS))
"""Keys that cannot be chosen: Escape always leads out, and digits are the scene's."""
SWITCHED = tuple(b.action for b in BINDINGS if b.kind != HELD and b.action != "escape")
ACTIONS = (*HELD_KEYS, *SWITCHED)
"""All actions that can be given another key, in the order of the list."""
KEY_NAMES = {
    getattr(glfw, name): name.removeprefix("KEY_").replace("_", " ").capitalize()
    for name in dir(glfw)
    if name.startswith("KEY_") and name not in ("KEY_LAST", "KEY_UNKNOWN")
}
KEYS_BY_NAME = {name.casefold(): key for key, name in KEY_NAMES.items()}


def key_named(name: object) -> int:
    """Return the key of a name such as "W", "Left shift" or "F5"; InputError if there is none."""
    key = KEYS_BY_NAME.get(name.casefold()) if isinstance(name, str) else None
    if key is None or key in FIXED:
        raise InputError(
            "{name!r}: expected a key of a US keyboard, such as W, Left shift or F5", name=name
        )
    return key


@dataclass(frozen=True)
class Keymap:
    """The keys of each action; ``chosen`` has the user's own, as GLFW's codes."""

    chosen: Mapping[str, tuple[int, ...]] = field(default_factory=dict)

    def held(self, action: str) -> tuple[int, ...]:
        """Return the keys of an action that lasts while one of them is down."""
        return self.chosen.get(action, HELD_KEYS[action])

    @cached_property
    def positions(self) -> dict[int, str]:
        """The switch or order of each key that has one wherever it is printed."""
        keys = {b.action: b.keys for b in BINDINGS if b.action in (*SWITCHED, "escape")}
        keys |= {action: self.chosen[action] for action in keys if action in self.chosen}
        return {key: action for action, each in keys.items() for key in each}

    @cached_property
    def reserved(self) -> frozenset[int]:
        """Keys that no letter may have: they walk, or have been chosen."""
        walking = {key for action in HELD_KEYS for key in self.held(action)}
        return frozenset(walking | set(self.positions))

    def letters(self, claimed: Collection[str]) -> dict[str, str]:
        """Return what each letter stands for in a scene that has ``claimed`` for itself."""
        found = letters_in(claimed)
        return {letter: does for letter, does in found.items() if does not in self.chosen}

    def places(self, name: Namer, claimed: Collection[str]) -> dict[str, int]:
        """Return the key of each letter; ``name`` says what the keyboard prints on a key."""
        taken = frozenset(b.letter for b in BINDINGS if b.letter and b.action in self.chosen)
        wanted = [letter for letter in LETTERS if letter not in taken or letter in claimed]
        return layout(name, self.letters(claimed), wanted, self.reserved)

    def keys_of(self, action: str, name: Namer, claimed: Collection[str] = ()) -> tuple[int, ...]:
        """Return the keys of an action on the user's keyboard."""
        if action in HELD_KEYS:
            return self.held(action)
        if action in self.chosen:
            return self.chosen[action]
        binding = next(b for b in BINDINGS if b.action == action)
        if not binding.letter:
            return binding.keys
        return self.places(name, claimed)[letter_of(binding, claimed)], *binding.keys

    def owner(self, key: int, name: Namer, claimed: Collection[str] = ()) -> str:
        """Return the action that a key has, "" if it is free."""
        for action in ACTIONS:
            if key in self.keys_of(action, name, claimed):
                return action
        return ""

    def with_key(
        self, action: str, key: int, name: Namer, claimed: Collection[str] = ()
    ) -> "Keymap":
        """Return the keys with one that has been chosen for an action.

        InputError names the action that has it already, or says that it cannot be chosen.
        """
        if key in FIXED:
            raise InputError("{action}: this key cannot be chosen", action=action)
        owner = self.owner(key, name, claimed)
        if owner and owner != action:
            raise InputError(
                "{action}: {key} is the key of {owner}",
                action=action,
                key=KEY_NAMES.get(key, str(key)),
                owner=owner,
            )
        return Keymap({**self.chosen, action: (key,)})

    def without(self, action: str) -> "Keymap":
        """Return the keys with an action's own key of the table."""
        return Keymap({each: keys for each, keys in self.chosen.items() if each != action})

    def labels(self, action: str, language: str, name: Namer, claimed: Collection[str] = ()) -> str:
        """Return what is printed on the keys of an action or a row of the help, with spaces."""
        if action in ROWS:
            parts = ROWS[action]
            keys = [key for each in parts for key in self.held(each)[:1]]
        else:
            keys = list(self.keys_of(action, name, claimed))
            if action in LETTERS.values() and action not in self.chosen:
                del keys[1:]  # the letter is easier to remember
        return " ".join(key_label(key, language, name) for key in keys)

    def letter_label(
        self, letter: str, language: str, name: Namer, claimed: Collection[str]
    ) -> str:
        """Return what is printed on the key of a letter that a scene has for itself."""
        return key_label(self.places(name, claimed)[letter], language, name)


def key_label(key: int, language: str, name: Namer) -> str:
    """Return what is printed on a key, or its name where nothing is."""
    if key in NAMED_KEYS:
        return words.text(language, NAMED_KEYS[key])
    return name(key) or us_name(key) or KEY_NAMES.get(key, str(key))


DEFAULT = Keymap()
