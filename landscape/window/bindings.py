"""The key bindings of the walk: one table of what each key does, its label and its help text.

Keys are positions on the keyboard. GLFW names its key codes after the US layout: KEY_W is the key
labelled Z on an AZERTY keyboard. The help text of a binding is ``help.ACTION`` in words.py.
"""

from dataclasses import dataclass
from typing import Any

import glfw

from landscape import keys
from landscape.window import words

HELD, SWITCH, ORDER = "held", "switch", "order"


@dataclass(frozen=True)
class Binding:
    """Keys and what they do.

    ``kind`` is "held" (acts while a key is down), "switch" (acts on the walk, so recordings keep
    it) or "order" (acts on the window). ``setting`` is the dotted key of the setting that a switch
    toggles.
    """

    action: str
    keys: tuple[int, ...]
    kind: str = SWITCH
    setting: str = ""


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
    Binding("fly", (glfw.KEY_F,)),
    Binding("up_down", (glfw.KEY_SPACE, glfw.KEY_C), HELD),
    Binding("map", (glfw.KEY_M,), setting="overlay.map"),
    Binding("fog", (glfw.KEY_G,), setting="fog.enabled"),
    Binding("reflection", (glfw.KEY_R,), setting="reflection.enabled"),
    Binding("sorting", (glfw.KEY_T,), setting="transparent.sorted"),
    Binding("wireframe", (glfw.KEY_X,)),
    Binding("next_fix", (glfw.KEY_N,)),
    Binding("fix", (glfw.KEY_V,)),
    Binding("fullscreen", (glfw.KEY_F11,), ORDER),
    Binding("screenshot", (glfw.KEY_F12,), ORDER),
    Binding("help", (glfw.KEY_H,)),
    Binding("escape", (glfw.KEY_ESCAPE,), ORDER),
)

SWITCHES = {key: b.action for b in BINDINGS if b.kind == SWITCH for key in b.keys}
ORDERS = {key: b.action for b in BINDINGS if b.kind == ORDER for key in b.keys}
SETTINGS = {b.action: b.setting for b in BINDINGS if b.setting}

NAMED_KEYS = {
    glfw.KEY_LEFT: "key.left",
    glfw.KEY_RIGHT: "key.right",
    glfw.KEY_SPACE: "key.space",
    glfw.KEY_LEFT_SHIFT: "key.left_shift",
    glfw.KEY_ESCAPE: "key.escape",
    glfw.KEY_F11: "key.f11",
    glfw.KEY_F12: "key.f12",
}


def available(settings: Any, fixes: bool) -> tuple[Binding, ...]:
    """Return the bindings that work in a scene with these settings, with or without fixes."""
    known = keys.fields(type(settings))
    return tuple(
        binding
        for binding in BINDINGS
        if (not binding.setting or binding.setting in known)
        and (fixes or binding.action not in ("fix", "next_fix"))
    )


def key_label(key: int, language: str) -> str:
    """Return what the user's keyboard prints on a key; GLFW must be running."""
    if key in NAMED_KEYS:
        return words.text(language, NAMED_KEYS[key])
    # GLFW's key codes of letters are their ASCII codes.
    printed = (glfw.get_key_name(key, 0) or chr(key)).strip()
    return printed.upper() if len(printed.upper()) == 1 else printed
