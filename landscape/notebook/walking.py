"""The process of a walk in a cell: it takes what the user did, and answers with a frame."""

from collections.abc import Mapping
from dataclasses import replace
from multiprocessing.connection import Connection
from typing import Any

import numpy as np

from framelens.base.errors import InputError, NoOpenGLError, UnexpectedError, located
from framelens.gl.glfw_library import glfw
from landscape.files.assets import Assets
from landscape.walk.app import Walk
from landscape.walk.hands import Hands
from landscape.walk.pace import FPS
from landscape.walk.recording import Plan

LONGEST = 0.1  # chosen: seconds that a frame lasts; the walk stands still while no page asks
SMALLEST, LARGEST = 64, 1920  # chosen: pixels of a side of the picture
NOTCH = 100.0  # pixels that a page's wheel scrolls by a notch
# The keys that a page does not call as GLFW does, and is asked for by position or sign.
KEYS = {
    **{" ": "SPACE", "+": "KP_ADD", "-": "KP_SUBTRACT", ",": "COMMA", ".": "PERIOD"},
    **{"/": "SLASH", "=": "EQUAL", "ArrowLeft": "LEFT", "ArrowRight": "RIGHT"},
    **{"ArrowUp": "UP", "ArrowDown": "DOWN", "PageUp": "PAGE_UP", "PageDown": "PAGE_DOWN"},
    **{"Shift": "LEFT_SHIFT", "Control": "LEFT_CONTROL", "Alt": "LEFT_ALT"},
}
MODS = {"Shift": glfw.MOD_SHIFT, "Control": glfw.MOD_CONTROL, "Alt": glfw.MOD_ALT}
BUTTONS = {1: glfw.MOUSE_BUTTON_LEFT, 2: glfw.MOUSE_BUTTON_RIGHT, 3: glfw.MOUSE_BUTTON_MIDDLE}

Event = Mapping[str, Any]
"""An event as jupyter_rfb sends it."""


def serve(pipe: Connection, plan: Plan, backend: str) -> None:
    """Draw a frame for each list of events, until the other side has closed the pipe.

    What is raised is sent, too, and is the last answer.
    """
    try:
        with Walk(plan, Assets(), "headless" if backend == "auto" else backend, fps=FPS) as walk:
            while True:
                for event in pipe.recv():
                    take(walk, event)
                pipe.send(frame(walk))
    except (EOFError, OSError):
        return
    except (InputError, NoOpenGLError) as error:
        pipe.send(error)
    except Exception as error:
        pipe.send(UnexpectedError(located(error)))


def frame(walk: Walk) -> np.ndarray:
    """Go on by a frame, and return its picture: uint8 (h, w, 3), the top row first."""
    tick = walk.listen()
    if tick is None:  # Escape closes a window; a cell stays
        glfw.set_window_should_close(walk.window, False)
        tick = walk.listen()
    assert tick is not None
    walk.advance(replace(tick, seconds=min(tick.seconds, LONGEST)))
    walk.draw()
    picture = walk.pixels()
    walk.present()
    return picture


def _press(hands: Hands, event: Event, down: bool) -> None:
    """Give the hands a button of the mouse that went down or up."""
    button = BUTTONS.get(event["button"])
    turns = button == glfw.MOUSE_BUTTON_LEFT and not hands.building and not hands.inspecting
    if turns:
        hands.capture(down)
    elif button is not None:
        hands.button(button, glfw.PRESS if down else glfw.RELEASE, mods(event))


def take(walk: Walk, event: Event) -> None:
    """Give an event to the walk's hands.

    A page cannot hold the pointer: the view turns while its left button is down, as it does in a
    scene of blocks by itself.
    """
    kind, hands = event["type"], walk.hands

    if kind in ("key_down", "key_up"):
        if (code := key_code(str(event["key"]))) is not None:
            action = glfw.PRESS if kind == "key_down" else glfw.RELEASE
            hands.key(code, action, mods(event))
    elif kind in ("pointer_down", "pointer_up"):
        point(walk, event)
        _press(hands, event, kind == "pointer_down")
    elif kind == "pointer_move":
        point(walk, event)
    elif kind == "wheel":
        hands.wheel(-event["dy"] / NOTCH)
    elif kind == "pointer_leave" and not event.get("buttons"):
        hands.focus(False)
    elif kind == "resize":
        sides = (round(event["width"]), round(event["height"]))
        glfw.set_window_size(walk.window, *(min(max(n, SMALLEST), LARGEST) for n in sides))


def point(walk: Walk, event: Event) -> None:
    """Move the window's pointer, and tell the hands."""
    place = float(event["x"]), float(event["y"])
    glfw.set_cursor_pos(walk.window, *place)
    walk.hands.motion(*place)


def mods(event: Event) -> int:
    """Return GLFW's bits of the modifiers that are down."""
    return sum(MODS.get(name, 0) for name in event.get("modifiers", ()))


def key_code(key: str) -> int | None:
    """Return GLFW's code of a key by a page's name for it; None where GLFW has none.

    A page says what a key writes, so letters are followed, not positions.
    """
    name = KEYS.get(key, key.upper())
    code = getattr(glfw, f"KEY_{name}", None)
    return code if isinstance(code, int) else None
