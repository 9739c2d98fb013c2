"""A gamepad: its sticks walk and look, its buttons do what keys do.

GLFW knows where sticks and buttons of many gamepads are. Lines of the community's database for
others are read from the environment variable SDL_GAMECONTROLLERCONFIG and from the file
``gamecontrollerdb.txt`` beside the user's preferences. What the pad asks for becomes part of the
frame's intent, so a recording does not depend on how it was steered.
"""

import math
import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from framelens.base.input import read_bounded
from framelens.gl.glfw_library import glfw
from landscape.walk.preferences import folder
from landscape.walk.walker import Intent

DATABASE = "gamecontrollerdb.txt"
MOST_BYTES = 4 << 20  # chosen: four times the community's database
DEAD = 0.2  # chosen: how far a stick may lie aside at rest, of 1
LOOK = 150.0  # chosen: degrees per second, the stick pushed home
PRESSED = 0.5  # chosen: how far a trigger is pressed, of 1, when it counts as a button

# The triggers count as buttons of these numbers; GLFW's own are smaller.
LEFT_TRIGGER, RIGHT_TRIGGER = 100, 101
# A button's action during the walk: an order, a switch or a part of the intent.
BUTTONS = {
    glfw.GAMEPAD_BUTTON_X: "strike",
    glfw.GAMEPAD_BUTTON_Y: "fly",
    glfw.GAMEPAD_BUTTON_B: "release",
    glfw.GAMEPAD_BUTTON_BACK: "map",
    glfw.GAMEPAD_BUTTON_START: "help",
    glfw.GAMEPAD_BUTTON_LEFT_BUMPER: "previous_slot",
    glfw.GAMEPAD_BUTTON_RIGHT_BUMPER: "next_slot",
    glfw.GAMEPAD_BUTTON_DPAD_UP: "preferences",
    glfw.GAMEPAD_BUTTON_DPAD_LEFT: "landmarks",
    glfw.GAMEPAD_BUTTON_DPAD_DOWN: "screenshot",
    LEFT_TRIGGER: "place",
    RIGHT_TRIGGER: "dig",
}
ORDERS = (
    "release",
    "preferences",
    "landmarks",
    "screenshot",
)  # those of them that are orders to the window
TOOLS = ("strike", "fly", "dig", "place")  # those that are part of the intent
# What it does, as a key, while a list or the title is open.
IN_A_LIST = {
    glfw.GAMEPAD_BUTTON_DPAD_UP: glfw.KEY_UP,
    glfw.GAMEPAD_BUTTON_DPAD_DOWN: glfw.KEY_DOWN,
    glfw.GAMEPAD_BUTTON_DPAD_LEFT: glfw.KEY_KP_SUBTRACT,
    glfw.GAMEPAD_BUTTON_DPAD_RIGHT: glfw.KEY_KP_ADD,
    glfw.GAMEPAD_BUTTON_A: glfw.KEY_ENTER,
    glfw.GAMEPAD_BUTTON_B: glfw.KEY_ESCAPE,
    glfw.GAMEPAD_BUTTON_X: glfw.KEY_BACKSPACE,
    glfw.GAMEPAD_BUTTON_Y: glfw.KEY_F2,
    glfw.GAMEPAD_BUTTON_START: glfw.KEY_F1,
}


@dataclass(frozen=True)
class PadState:
    """Which buttons are down, and where the six axes are, -1 to 1; triggers rest at -1."""

    buttons: frozenset[int] = frozenset()
    axes: tuple[float, ...] = (0.0, 0.0, 0.0, 0.0, -1.0, -1.0)


def read_state() -> PadState | None:
    """Return the state of the first gamepad that GLFW knows, None if there is none."""
    for number in range(glfw.JOYSTICK_1, glfw.JOYSTICK_LAST + 1):
        if glfw.joystick_present(number) and glfw.joystick_is_gamepad(number):
            state = glfw.get_gamepad_state(number)
            if state is not None:
                down = (k for k, button in enumerate(state.buttons) if button == glfw.PRESS)
                return PadState(frozenset(down), tuple(state.axes))
    return None


def add_mappings() -> None:
    """Tell GLFW about gamepads of the user's own; InputError if the file cannot be read."""
    lines = os.environ.get("SDL_GAMECONTROLLERCONFIG", "")
    place = folder()
    if place is not None and (place / DATABASE).exists():
        text = read_bounded(place / DATABASE, MOST_BYTES)
        lines += "\n" + text.decode("utf-8", "replace").replace("\0", "")
    if lines.strip():
        glfw.update_gamepad_mappings(lines)


def pushed(x: float, y: float) -> tuple[float, float]:
    """Return a stick's place without its dead zone, at most 1 from the middle, finer near it."""
    away = math.hypot(x, y)
    if not away > DEAD:  # also where a driver reports no number
        return 0.0, 0.0
    strength = min((away - DEAD) / (1.0 - DEAD), 1.0)
    return x / away * strength**2, y / away * strength**2


class Pad:
    """Follows a gamepad from frame to frame; ``read`` returns its state, None without one."""

    def __init__(self, read: Callable[[], PadState | None] = read_state) -> None:
        self._read = read
        self._before = PadState()

    def take(self, listing: bool = False) -> tuple[PadState, list[str], list[int]]:
        """Return the state, what the buttons pressed since the last call do, and as which keys.

        While a list is open (``listing``) buttons are keys, and else they do what BUTTONS says.
        """
        state = self._read() or PadState()
        pressed = (axis > 2 * PRESSED - 1 for axis in state.axes[4:6])
        both = zip((LEFT_TRIGGER, RIGHT_TRIGGER), pressed, strict=False)
        triggers = frozenset(button for button, down in both if down)
        state = replace(state, buttons=state.buttons | triggers)
        fresh = sorted(state.buttons - self._before.buttons)
        self._before = state
        if listing:
            return PadState(), [], [IN_A_LIST[button] for button in fresh if button in IN_A_LIST]
        return state, [BUTTONS[button] for button in fresh if button in BUTTONS], []


def steered(
    intent: Intent,
    state: PadState,
    done: Sequence[str],
    seconds: float,
    mouse: float,
    blocks: bool = False,
) -> Intent:
    """Return an intent with what a gamepad asks for in a frame of ``seconds``.

    ``mouse`` is in degrees per pixel: the right stick looks as the mouse does. In a scene of
    ``blocks`` the triggers dig and place; elsewhere the right one runs. ``done`` is what the
    buttons do, see :meth:`Pad.take`.
    """
    right, back = pushed(*state.axes[0:2])
    across, down = pushed(*state.axes[2:4])
    pixels = LOOK * seconds / mouse if mouse > 0 else 0.0
    left_trigger, right_trigger = (k in state.buttons for k in (LEFT_TRIGGER, RIGHT_TRIGGER))
    jumps = glfw.GAMEPAD_BUTTON_A in state.buttons
    sinks = glfw.GAMEPAD_BUTTON_RIGHT_THUMB in state.buttons

    return replace(
        intent,
        forward=max(-1.0, min(intent.forward - back, 1.0)),
        right=max(-1.0, min(intent.right + right, 1.0)),
        up=max(-1.0, min(intent.up + jumps - sinks, 1.0)),
        look=(intent.look[0] + across * pixels, intent.look[1] + down * pixels),
        run=(
            intent.run
            or glfw.GAMEPAD_BUTTON_LEFT_THUMB in state.buttons
            or (right_trigger and not blocks)
        ),
        strike=intent.strike or "strike" in done,
        fly=intent.fly != ("fly" in done),
        dig=intent.dig or (blocks and "dig" in done),
        digging=intent.digging or (blocks and right_trigger),
        place=intent.place or (blocks and "place" in done),
        placing=intent.placing or (blocks and left_trigger),
    )
