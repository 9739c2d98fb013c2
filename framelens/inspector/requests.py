"""The user's requests to the open inspector between two frames, by keys and mouse."""

from framelens.gl.glfw_library import glfw
from framelens.inspector.keys import INSPECTING_REPEATED, Namer, inspect_pick, us_name

Pointing = tuple[str, float, float, float]
"""What the mouse did, at x and y in coordinates of the window, with a number: Inspection._point."""

FINELY = (  # what makes a drag fine
    glfw.KEY_LEFT_SHIFT,
    glfw.KEY_RIGHT_SHIFT,
    glfw.KEY_LEFT_CONTROL,
    glfw.KEY_RIGHT_CONTROL,
)


class Requests:
    """Collects what GLFW reports for the inspector; needs no window.

    ``name`` says what the keyboard prints on a key. It is asked at each press, as the user may
    change the layout.
    """

    def __init__(self, name: Namer = us_name) -> None:
        self._name = name
        self._fine: set[int] = set()  # keys of FINELY that are down
        self._at = 0.0, 0.0  # where the mouse was at the last report
        self.asked: list[str | Pointing] = []

    def key(self, key: int, action: int, mods: int = 0) -> bool:
        """Note that a key went down or up; return whether the inspector has a use for it."""
        if action == glfw.RELEASE:
            self._fine.discard(key)
            return False
        if key in FINELY:
            self._fine.add(key)
        asked = inspect_pick(key, mods, self._name)
        if asked and (action == glfw.PRESS or asked in INSPECTING_REPEATED):
            self.asked.append(asked)
        return bool(asked)

    def button(self, button: int, action: int, mods: int = 0) -> None:
        """Note that a button went down or up.

        There it counts where the mouse was then: now it may be somewhere else already.
        """
        if button == glfw.MOUSE_BUTTON_LEFT:
            what = "press" if action == glfw.PRESS else "release"
            self.asked.append((what, *self._at, float(bool(mods & glfw.MOD_SHIFT))))

    def wheel(self, notches: float) -> None:
        """Note that the wheel was turned, up where ``notches`` is positive; may be a fraction."""
        # Turns of one frame count together: the inspector scrolls what was drawn last.
        last = self.asked[-1] if self.asked else ""
        if isinstance(last, tuple) and last[0] == "wheel":
            self.asked.pop()
            notches += last[3]
        self.asked.append(("wheel", *self._at, notches))

    def motion(self, x: float, y: float, heeded: bool = True) -> None:
        """Note that the mouse is at x, y in coordinates; ``heeded``: the inspector is open."""
        self._at = x, y
        if heeded:
            self.asked.append(("move", x, y, float(bool(self._fine))))

    def release(self) -> None:
        """Release all keys, as when the focus is lost, where their release is not reported."""
        self._fine.clear()

    def take(self) -> list[str | Pointing]:
        """Return what was asked since the last call."""
        asked = self.asked
        self.asked = []
        return asked
