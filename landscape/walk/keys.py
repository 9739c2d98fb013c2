"""The key bindings of the walk: one table of what each key does, its label and its help text.

The keys under the walking hand are positions: GLFW names its key codes after the US layout, so
KEY_W is the key labelled Z on an AZERTY keyboard. A key that stands for a word (M for map) is the
one with that letter printed on it, wherever it is; :func:`layout` finds it. The help text of a
binding is ``help.ACTION`` in words.py. What the user has chosen instead is in keymap.py.
"""

from collections.abc import Collection
from dataclasses import dataclass

from framelens.gl.glfw_library import glfw
from framelens.inspector.keys import PRINTING, Namer, sign
from landscape.settings import declare as keys

HELD = "held"
SWITCH = "switch"
ORDER = "order"


@dataclass(frozen=True)
class Binding:
    """Keys and what they do.

    ``kind`` is "held" (acts while a key is down), "switch" (acts on the walk, so recordings keep
    it) or "order" (acts on the window). ``setting`` is the key of the setting that a switch
    toggles, or whose next value it takes. ``keys`` are positions. With a ``letter`` the key is the
    one that this letter is printed on, and ``keys`` do the same. In a scene that has this letter
    for itself (Scene.letters), the one that ``elsewhere`` is printed on stands for it.
    """

    action: str
    keys: tuple[int, ...] = ()
    kind: str = SWITCH
    setting: str = ""
    letter: str = ""
    elsewhere: str = ""


FORWARD, BACKWARD = (glfw.KEY_W, glfw.KEY_UP), (glfw.KEY_S, glfw.KEY_DOWN)
LEFTWARD, RIGHTWARD = (glfw.KEY_A,), (glfw.KEY_D,)
TURN_LEFT, TURN_RIGHT = (glfw.KEY_LEFT,), (glfw.KEY_RIGHT,)
UP, DOWN = (glfw.KEY_SPACE, glfw.KEY_PAGE_UP), (glfw.KEY_C, glfw.KEY_PAGE_DOWN)
RUN = (glfw.KEY_LEFT_SHIFT,)

BINDINGS = (
    Binding("walk", (glfw.KEY_W, glfw.KEY_A, glfw.KEY_S, glfw.KEY_D), HELD),
    Binding("turn", (*TURN_LEFT, *TURN_RIGHT), HELD),
    Binding("run", RUN, HELD),
    Binding("strike", (glfw.KEY_E,)),
    Binding("fly", letter="F"),
    Binding("up_down", (glfw.KEY_SPACE, glfw.KEY_C), HELD),
    Binding("map", letter="M", setting="overlay.map"),
    Binding("fog", letter="G", setting="fog.enabled"),
    Binding("reflection", letter="R", setting="reflection.enabled"),
    Binding("sorting", letter="T", setting="transparent.sorted"),
    Binding("time", letter="P", setting="time"),
    Binding("mute", letter="U", setting="sound.muted"),
    Binding("wireframe", letter="X"),
    Binding("next_fix", letter="N"),
    Binding("fix", letter="V"),
    Binding("go_to_fix", letter="J"),
    Binding("mouse", (glfw.KEY_TAB,), ORDER),
    Binding("save", (glfw.KEY_F5,), ORDER),
    Binding("list", letter="L", elsewhere="O"),
    Binding("preferences", (glfw.KEY_F2,), ORDER),
    Binding("landmarks", letter="B", kind=ORDER),
    Binding("inspector", letter="I", kind=ORDER),
    Binding("fullscreen", (glfw.KEY_F11,), ORDER),
    Binding("screenshot", (glfw.KEY_F12,), ORDER),
    Binding("help", (glfw.KEY_F1,), letter="H"),
    Binding("escape", (glfw.KEY_ESCAPE,), ORDER),
)

POSITIONS = {key: b.action for b in BINDINGS if b.kind != HELD for key in b.keys}
LETTERS = {b.letter: b.action for b in BINDINGS if b.letter}
BY_ACTION = {b.action: b for b in BINDINGS}
SETTINGS = {b.action: b.setting for b in BINDINGS if b.setting}
# A scene says what these do in it (Scene.digits); both rows of digits count.
DIGITS = {key + n: str(n) for key in (glfw.KEY_0, glfw.KEY_KP_0) for n in range(1, 10)}
WITH_SHIFT = {"next_fix": "previous_fix"}  # what a switch does while Shift is held

# Keys while the list of settings is open; those in REPEATED repeat while held.
PICKS = {
    glfw.KEY_UP: "up",
    glfw.KEY_DOWN: "down",
    glfw.KEY_LEFT: "previous_group",
    glfw.KEY_RIGHT: "next_group",
    glfw.KEY_PAGE_UP: "previous_group",
    glfw.KEY_PAGE_DOWN: "next_group",
    glfw.KEY_HOME: "first",
    glfw.KEY_END: "last",
    glfw.KEY_KP_ADD: "more",
    glfw.KEY_KP_SUBTRACT: "less",
    glfw.KEY_ENTER: "switch",
    glfw.KEY_KP_ENTER: "switch",
    glfw.KEY_SPACE: "switch",
    glfw.KEY_BACKSPACE: "default",
    glfw.KEY_ESCAPE: "list",
}
REPEATED = ("up", "down", "previous_group", "next_group", "more", "less")

UNDER_THE_HAND = frozenset(
    (*FORWARD, *BACKWARD, *LEFTWARD, *RIGHTWARD, *UP, *DOWN, glfw.KEY_E, *RUN)
)
NAMED_KEYS = {
    glfw.KEY_UP: "key.up",
    glfw.KEY_DOWN: "key.down",
    glfw.KEY_PAGE_UP: "key.page_up",
    glfw.KEY_PAGE_DOWN: "key.page_down",
    glfw.KEY_LEFT: "key.left",
    glfw.KEY_RIGHT: "key.right",
    glfw.KEY_SPACE: "key.space",
    glfw.KEY_LEFT_SHIFT: "key.left_shift",
    glfw.KEY_ESCAPE: "key.escape",
    glfw.KEY_TAB: "key.tab",
    glfw.KEY_F2: "key.f2",
    glfw.KEY_F5: "key.f5",
    glfw.KEY_F11: "key.f11",
    glfw.KEY_F12: "key.f12",
}


def letters_in(claimed: Collection[str]) -> dict[str, str]:
    """Return what each letter stands for in a scene that has some for itself: an action, or itself.

    ``claimed`` are the letters that the scene has for itself.
    """
    actions = {letter_of(each, claimed): each.action for each in BINDINGS if each.letter}
    return actions | {letter: letter for letter in claimed}


def letter_of(binding: Binding, claimed: Collection[str]) -> str:
    """Return the letter of a binding in a scene that has ``claimed`` for itself."""
    return binding.elsewhere if binding.letter in claimed else binding.letter


def layout(
    name: Namer,
    more: Collection[str] = (),
    letters: Collection[str] = tuple(LETTERS),
    reserved: Collection[int] = UNDER_THE_HAND,
) -> dict[str, int]:
    """Return the key of each of ``letters`` on a keyboard; ``name`` says what a key prints.

    Letters in ``more`` have a key, too, without taking that of another.

    A key under the walking hand, or another ``reserved`` one, has a duty of its own. A letter that
    is printed there, or on no key (on a Greek keyboard), takes the key at the letter's place on a
    US keyboard, or, if that key has another duty, the first free one; so every letter has a key,
    and the help shows which.
    """
    free = {key: name(key) for key in PRINTING if key not in reserved}
    found: dict[str, int] = {}
    for wanted in (letters, [letter for letter in more if letter not in letters]):
        for letter in wanted:
            key = next((key for key, printed in free.items() if printed == letter), None)
            if key is not None:
                found[letter] = key
                del free[key]
        for letter in wanted:
            if letter not in found:
                others = (key for key in free if chr(key).isalpha())
                found[letter] = ord(letter) if ord(letter) in free else next(others)
                del free[found[letter]]

    return found


def pick(key: int, name: Namer) -> str:
    """Return what a key does in the open list of settings, "" if nothing.

    Signs are where they are printed: the plus key, or the one that prints = without Shift. On a
    keyboard that prints neither, their places on a US keyboard stand for them.
    """
    if key in PICKS:
        return PICKS[key]
    return sign(key, name, UNDER_THE_HAND)


def available(settings: object, fixes: bool, blocks: bool = False) -> tuple[Binding, ...]:
    """Return the bindings that work in a scene with these settings, with or without fixes.

    ``blocks``: in a scene of blocks.
    """
    known = keys.fields(type(settings))
    return tuple(
        binding
        for binding in BINDINGS
        if (not binding.setting or binding.setting in known)
        and (fixes or binding.action not in ("fix", "next_fix", "go_to_fix"))
        and (blocks or binding.action not in ("mouse", "save"))
    )
