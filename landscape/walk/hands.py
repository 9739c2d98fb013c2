"""Collect keyboard and mouse input between two frames and turn it into the walker's intent."""

import math
from collections.abc import Collection

from framelens.gl.glfw_library import glfw
from framelens.inspector.keys import us_name
from framelens.inspector.requests import Requests
from framelens.inspector.wheel import Wheel
from landscape.walk.keymap import DEFAULT, Keymap
from landscape.walk.keys import (
    BY_ACTION,
    DIGITS,
    ORDER,
    REPEATED,
    WITH_SHIFT,
    Namer,
    pick,
)
from landscape.walk.walker import Intent

TOOLS = {  # what a mouse button does in a scene of blocks
    glfw.MOUSE_BUTTON_LEFT: "dig",
    glfw.MOUSE_BUTTON_RIGHT: "place",
    glfw.MOUSE_BUTTON_MIDDLE: "pick",
}
OPENING = "preferences", "landmarks", "inspector"  # orders that open what Escape shuts
# Both in coordinates of a display of the usual resolution.
DRAG = 5.0  # chosen; a motion with the button down that is longer is no click
JUMP = 200.0  # chosen; a larger motion between two reports is a pointer jump: clamped


def fineness(window: object) -> float:
    """Return how many of a window's coordinates are one of a display of the usual resolution.

    On Windows and X11 coordinates are pixels, and so smaller on a fine display. On macOS and
    Wayland they are not.
    """
    pixels, width = glfw.get_framebuffer_size(window)[0], glfw.get_window_size(window)[0]
    return max(1.0, max(glfw.get_window_content_scale(window)) * width / max(pixels, 1))


class Hands:
    """Collects what GLFW reports between two frames; needs no window.

    ``name`` says what the keyboard prints on a key. It is asked at each press, as the user may
    change the layout during the walk. ``keymap`` has the keys of each action.
    """

    def __init__(self, name: Namer = us_name, keymap: Keymap = DEFAULT) -> None:
        self._name = name
        self.keymap = keymap
        self.captured = False
        self.listing = False  # whether the list of settings is open
        self.picks: list[str] = []  # what was asked of it, see PICKS
        self.choosing = ""  # the order that has opened a list which has all keys and the mouse
        self.choices: list[int] = []  # keys that were pressed meanwhile
        # Where the mouse was meanwhile, in coordinates, and whether its left button went down.
        self.pointed: list[tuple[float, float, bool]] = []
        self.speed = 1.0  # times which the mouse's motion counts
        self.inverted = False  # whether the view goes up when the mouse goes down
        self.inspecting = False  # whether the inspector is open: it has some keys, and the mouse
        self.requests = Requests(name)  # what is asked of the inspector
        self.orders: list[str] = []
        self._held: set[int] = set()
        self._tapped: set[int] = set()
        self._switches: list[str] = []
        self._look = [0.0, 0.0]

        # In a scene of blocks the buttons dig and build; while the mouse is free, dragging the left
        # one turns the view.
        self.building = False
        self._claimed: Collection[str] = ()  # letters that the scene has for itself
        self._clicked: set[str] = set()
        self._using: set[str] = set()
        self._pressed: tuple[float, float] | None = None  # where a click or a drag began
        self._dragging = False
        self._last: tuple[float, float] | None = None
        self.carrying = False  # whether the right button is down, in a scene where that means it
        self._carried = [0.0, 0.0]  # how far the mouse moved meanwhile, in pixels right and down
        self._at = 0.0, 0.0  # where the mouse was at the last report
        self.fineness = 1.0  # see fineness()
        self._wheel = Wheel()

    def listen(self, window: object) -> None:
        """Note what happens in a GLFW window."""
        glfw.set_key_callback(window, lambda _, key, __, action, mods: self.key(key, action, mods))
        glfw.set_mouse_button_callback(
            window, lambda _, button, action, mods: self.button(button, action, mods)
        )
        glfw.set_scroll_callback(window, lambda _, __, notches: self.wheel(notches))
        self._at = glfw.get_cursor_pos(window)
        self.fineness = fineness(window)
        glfw.set_cursor_pos_callback(window, lambda _, x, y: self.motion(x, y))
        glfw.set_window_focus_callback(window, lambda _, on: self.focus(bool(on)))

    def enter(self, building: bool, claimed: Collection[str]) -> None:
        """Take note of a scene: whether one builds there, and which letters it has for itself."""
        self.building = building
        self._claimed = claimed

    def key(self, key: int, action: int, mods: int = 0) -> None:
        """Note that a key went down or up, with GLFW's bits of Shift and so on.

        Key repeats count only in the list of settings.
        """
        if action == glfw.RELEASE:
            self._held.discard(key)
            self.requests.key(key, action, mods)
        elif self.choosing and self._action(key) != self.choosing:
            self.choices.append(key)
            return
        elif self.inspecting and self.requests.key(key, action, mods):
            return
        elif self.listing and (picked := pick(key, self._name)):
            if action == glfw.PRESS or picked in REPEATED:
                self._pick(picked)
            return

        if action != glfw.PRESS:
            return
        self._held.add(key)
        self._tapped.add(key)
        if key == glfw.KEY_ESCAPE:
            self._escape()
        elif name := self._action(key):
            self._act(name, bool(mods & glfw.MOD_SHIFT))

    def _act(self, name: str, shift: bool) -> None:
        """Note an action: one of the list, an order to the window, or a switch of the walk."""
        if name == "list":
            if not self.inspecting:
                self._pick(name)
            return
        if name == "inspector" and self.listing:
            self._pick("list")
        order = name in BY_ACTION and BY_ACTION[name].kind == ORDER
        to = self.orders if order else self._switches
        to.append(WITH_SHIFT.get(name, name) if shift else name)

    def _escape(self) -> None:
        """Note what Escape asks for: it shuts what will only be opened in the next frame, too."""
        waiting = next((each for each in reversed(self.orders) if each in OPENING), None)
        if waiting is not None:
            self.orders.remove(waiting)
        elif self.captured:
            self.orders.append("release")
        else:
            self.orders.append("quit")

    def switch(self, name: str) -> None:
        """Note a switch as if its key were pressed."""
        self._switches.append(name)

    def pressed(self, name: str) -> int:
        """Return how often the key of a switch was pressed since the last frame."""
        return self._switches.count(name)

    def _pick(self, picked: str) -> None:
        self.picks.append(picked)
        if picked == "list":
            self.listing = not self.listing

    def _action(self, key: int) -> str:
        """Return the switch or order of a key, "" if it has none.

        That of a digit, and of a letter that the scene has for itself, is the character.
        """
        if found := self.keymap.positions.get(key) or DIGITS.get(key):
            return found
        places = self.keymap.places(self._name, self._claimed)
        letters = {place: letter for letter, place in places.items()}
        return self.keymap.letters(self._claimed).get(letters.get(key, ""), "")

    def button(self, button: int, action: int, mods: int = 0) -> None:
        """Capture the mouse at the first click, strike at later ones; or give it to the inspector.

        There it counts where the mouse was then: now it may be somewhere else already.
        """
        if self.inspecting:
            self.requests.button(button, action, mods)
            return
        if self.choosing and action == glfw.PRESS:
            if button == glfw.MOUSE_BUTTON_LEFT:
                self.pointed.append((*self._at, True))
            return

        if self.building:
            if button in TOOLS:
                self._use(TOOLS[button], action == glfw.PRESS)
        elif button == glfw.MOUSE_BUTTON_RIGHT:
            self.carrying, self._last = action == glfw.PRESS, None
        elif button == glfw.MOUSE_BUTTON_LEFT and action == glfw.PRESS:
            if self.captured:
                self._switches.append("strike")
            else:
                self.orders.append("capture")

    def _use(self, tool: str, down: bool) -> None:
        """Note that the button of a tool went down or up in a scene of blocks."""
        if tool == "dig" and not self.captured:
            # Whether it is a click shows when it ends.
            if down:
                self._pressed = self._at
            elif self._pressed is not None and not self._dragging:
                self._clicked.add(tool)
            if not down:
                self._pressed, self._dragging = None, False
        if down and (tool != "dig" or self.captured):
            self._clicked.add(tool)
            self._using.add(tool)
        elif not down:
            self._using.discard(tool)

    def wheel(self, notches: float) -> None:
        """Note that the wheel was turned, up where ``notches`` is positive; may be a fraction."""
        if self.choosing:
            steps = self._wheel.steps(notches)
            self.choices += [glfw.KEY_UP if steps > 0 else glfw.KEY_DOWN] * abs(steps)
        elif self.inspecting:
            self.requests.wheel(notches)
        elif self.building:
            steps = self._wheel.steps(notches)
            self._switches += ["previous_slot" if steps > 0 else "next_slot"] * abs(steps)

    def motion(self, x: float, y: float) -> None:
        """Note that the mouse is at x, y in coordinates; its motion turns the view."""
        self._at = x, y
        self.requests.motion(x, y, heeded=self.inspecting)
        if self.choosing:
            self.pointed = [each for each in self.pointed if each[2]] + [(x, y, False)]
            return
        if self._pressed is not None and not self._dragging:
            self._dragging = math.dist(self._pressed, (x, y)) > DRAG * self.fineness
            self._last = None
        if not self.captured and not self._dragging and not self.carrying:
            return
        if self._last is not None:
            moved = self._carried if self.carrying else self._look
            for axis, way in enumerate((x - self._last[0], y - self._last[1])):
                moved[axis] += max(-JUMP, min(way / self.fineness, JUMP))
        self._last = x, y

    def capture(self, captured: bool) -> None:
        """Start or stop mouse look; the first motion afterwards is dropped."""
        self.captured = captured
        self._last = self._pressed = None
        self._dragging = False

    def focus(self, focused: bool) -> None:
        """Release all keys when the focus is lost, as their release would not be reported."""
        self._last = None
        if not focused:
            self._held.clear()
            self.requests.release()
            self._tapped.clear()
            self._look = [0.0, 0.0]
            self._clicked, self._using = set(), set()
            self._pressed = None
            self._dragging = False
            self.carrying = False
            self._carried = [0.0, 0.0]
            if self.captured:
                self.orders.append("release")

    def carried(self) -> tuple[float, float]:
        """Return how far the mouse moved with the right button down, since the last call."""
        right, down = self._carried
        self._carried = [0.0, 0.0]
        return right, down

    def take(self) -> tuple[Intent, tuple[str, ...]]:
        """Return the intent since the last call, and the names of the switches pressed."""
        down = self._held | self._tapped  # a key tapped between two slow frames counts as well

        def asked(action: str) -> bool:
            return not down.isdisjoint(self.keymap.held(action))

        def pair(plus: str, minus: str) -> float:
            return float(asked(plus)) - float(asked(minus))

        switches = self._switches
        right, below = self.speed * self._look[0], self.speed * self._look[1]
        intent = Intent(
            forward=pair("forward", "backward"),
            right=pair("rightward", "leftward"),
            up=pair("up", "down"),
            turn=pair("turn_right", "turn_left"),
            look=(right, -below if self.inverted else below),
            run=asked("run"),
            strike="strike" in switches,
            # Two presses within a frame cancel out.
            fly=switches.count("fly") % 2 == 1,
            dig="dig" in self._clicked,
            place="place" in self._clicked,
            pick="pick" in self._clicked,
            digging="dig" in self._using,
            placing="place" in self._using,
        )
        self._clicked = set()
        self._tapped = set()
        self._switches = []
        self._look = [0.0, 0.0]
        return intent, tuple(name for name in switches if name not in ("strike", "fly"))
