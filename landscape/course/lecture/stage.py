"""A lecture's window: it stays while the steps change, and has the lecture's keys and pictures.

What plays a step draws into the area at the lower left (lecture_layout.py). ``cover`` then draws
the rest: the caption, the code, and over all of it the list of the steps or a strip.
"""

import time
import types
from typing import Protocol

import numpy as np

from framelens.gl.apart import apart
from framelens.gl.contexts.glfw import GLFWContext, call_for_pointer
from framelens.gl.objects import forget_objects
from framelens.gl.seam import unnoted
from framelens.inspector.wheel import Wheel
from framelens.state import state
from landscape.course.lecture import texts
from landscape.course.lecture.image import caption_image, code_image
from landscape.course.lecture.layout import Layout, arranged
from landscape.course.lecture.list import StepList
from landscape.course.lecture.plan import Lecture, Step
from landscape.course.lecture.plates import Plates

WINDOW = (1280, 720)  # chosen: of a lecture that began in full screen and leaves it
FASTEST = 0.01  # chosen: seconds that a frame takes at least, where the screen does not wait
WHEEL = 3  # chosen: lines of code that a notch of the wheel goes


class Player(Protocol):
    """A player of a step. Places are in coordinates of the area, from its top left."""

    def key(self, key: int, action: int, mods: int) -> None:
        """Take a key."""

    def button(self, button: int, action: int, mods: int) -> None:
        """Take a button of the mouse."""

    def motion(self, x: float, y: float) -> None:
        """Take a motion of the mouse."""

    def scroll(self, x: float, y: float) -> None:
        """Take the mouse's wheel."""

    def inspect(self) -> None:
        """Open or close the inspector."""

    def escape(self) -> bool:
        """Close what the step itself has open; return whether there was something."""


class Stage(GLFWContext):
    """The window. ``index`` is the step's, ``to`` where the user wants to go: -1 is the end."""

    def __init__(
        self, lecture: Lecture, index: int, size: tuple[int, int] | None, screen: int
    ) -> None:
        """Open the window, on the whole of a screen unless it has a size; NoOpenGLError."""
        super().__init__(
            size or WINDOW,
            texts.heading(lecture),
            True,
            size is None,
            checked=True,
            monitor=screen,
        )

        # While a program runs, the module's functions are not GLFW's own.
        self.glfw = types.SimpleNamespace(**vars(self.glfw))
        self.glfw.set_window_attrib(self.window, self.glfw.AUTO_ICONIFY, False)
        self.glfw.swap_interval(1)
        self.lecture, self.index = lecture, index
        self.to: int | None = None
        self.player: Player | None = None
        self.wants_strip = False
        self.changed = False  # whether something is to be seen that was not drawn yet
        self.stood = 0.0  # seconds in which the steps stood still
        self._new = state.read()
        self.plates = Plates()
        self._strip: np.ndarray | None = None
        self._list = StepList(lecture)
        self._coding: bool | None = None  # what the user has chosen; None: as the lecture says
        self._first: int | None = None  # the first line of code shown, where the user has scrolled
        self._wheel = Wheel()
        self._shown_at = 0.0
        self._at = 0.0, 0.0
        self._windowed = (60, 60, *self.size)
        self._source: list[str] = []
        self._layout: tuple[object, tuple[Layout, str]] | None = None
        self.listen()

    # The window.

    def release(self) -> None:
        """Do nothing: what plays a step does not close the window."""

    def close(self) -> None:
        """Close the window."""
        super().release()

    def whole(self) -> tuple[int, int]:
        """Return the window's size in pixels."""
        size: tuple[int, int] = self.glfw.get_framebuffer_size(self.window)
        return max(size[0], 1), max(size[1], 1)

    def scale(self) -> float:
        """Return how many pixels one of the window system's coordinates is."""
        return float(self.whole()[0] / max(self.glfw.get_window_size(self.window)[0], 1))

    def pixels(self) -> tuple[int, int]:
        """Return the area's size in pixels."""
        return self.layout.area

    def area(self) -> tuple[int, int]:
        """Return the area's size in the window system's coordinates."""
        scale = self.scale()
        return round(self.layout.area[0] / scale), round(self.layout.area[1] / scale)

    def seconds(self) -> float:
        """Return the time without that in which the steps stood still."""
        return time.monotonic() - self.stood

    @property
    def step(self) -> Step:
        """The step that is shown."""
        return self.lecture.steps[self.index]

    @property
    def coded(self) -> bool:
        """Whether the code is shown."""
        return self.step.runs and (
            self.step.code is not None if self._coding is None else self._coding
        )

    @property
    def layout(self) -> Layout:
        """Where the window has what."""
        return self._arranged()[0]

    def _arranged(self) -> tuple[Layout, str]:
        """Return the layout, and the caption that fits into it."""
        shows = self.whole(), self.scale(), self.coded, self.index
        if self._layout is None or self._layout[0] != shows:
            size, scale, coded, _ = shows
            title, captions = texts.title(self.step), texts.captions(self.step)
            self._layout = shows, arranged(size, coded, scale, title, captions)
        return self._layout[1]

    # Steps.

    def begin(self, index: int) -> None:
        """Begin a step, in a context that is as a new one."""
        self.index = index
        self.to = None
        self.player = None
        self._first = None
        self.wants_strip = False
        self._strip = None
        self._source = self.step.source()
        self.settle()

    def settle(self) -> None:
        """Make the context as a new one: a program that has ended leaves state and objects."""
        with unnoted():
            state.restore(self._new)
            forget_objects()
        self.lists = {}
        self.make_current()

    @property
    def leaving(self) -> bool:
        """Whether the step is to end."""
        return self.to is not None

    @property
    def holds(self) -> bool:
        """Whether a strip is shown, and the step stands still."""
        return self._strip is not None and not self.leaving

    def go(self, index: int) -> None:
        """Leave the step for another one, if there is one of this number."""
        if 0 <= index < len(self.lecture.steps):
            self.to = index
            self._list.open = False

    def show_strip(self, strip: np.ndarray) -> None:
        """Show a strip, uint8 (h, w, 4), in all of the window, until the user closes it."""
        began = time.monotonic()
        self._strip, self.wants_strip = strip, False
        while self.holds:
            self.poll()
            self.show()
        self.stood += time.monotonic() - began

    # What is drawn.

    def cover(self) -> None:
        """Draw the lecture's pictures over that of the step."""
        size = self.whole()
        self.changed = False
        with unnoted(), apart(size):
            if self._strip is not None:
                strip = self._strip
                self.plates.draw("strip", (0, 0), id(strip), lambda: strip)
                return
            self._cover_edges(size)
            if self._list.open:
                shows = (*size, self._list.chosen, self.index, self._list.foot)
                self.plates.draw("list", (0, 0), shows, lambda: self._list.image(size, self.index))

    def _cover_edges(self, size: tuple[int, int]) -> None:
        where, caption = self._arranged()
        place = f"{self.index + 1}/{len(self.lecture.steps)}"
        said = place, texts.title(self.step), caption
        self.plates.draw(
            "caption",
            (0, size[1] - where.caption[1]),
            (where.caption, size, *said),
            lambda: caption_image(where.caption, size[1], *said),
        )
        if where.code is not None:
            box = where.code
            name = self.step.called
            marked = texts.marked(self.step)
            self.plates.draw(
                "code",
                (size[0] - box[0], 0),
                (box, self.index, self._first),
                lambda: code_image(box, name, self._source, marked, self._first),
            )

    def show(self) -> None:
        """Show what was drawn, with the lecture's pictures."""
        self.cover()
        self.pace()
        self.glfw.swap_buffers(self.window)
        self.listen()  # a walk begins by listening to its window itself

    def pace(self) -> None:
        """Wait where frames follow each other faster than any screen shows them."""
        time.sleep(max(FASTEST - (time.monotonic() - self._shown_at), 0.0))
        self._shown_at = time.monotonic()

    # What the user does.

    def poll(self) -> None:
        """Take what the user did since."""
        self.glfw.poll_events()
        if self.glfw.window_should_close(self.window):
            self.to = -1

    def listen(self) -> None:
        """Listen to the window."""
        glfw, window = self.glfw, self.window
        glfw.set_key_callback(window, lambda _, key, __, action, mods: self._key(key, action, mods))
        glfw.set_char_callback(window, lambda _, code: self._letter(chr(code)))
        call_for_pointer(glfw, window, self._button, self._motion, self._scroll)

    def _key(self, key: int, action: int, mods: int) -> None:
        glfw = self.glfw
        if self._list.open and action != glfw.RELEASE:
            if key in (glfw.KEY_ENTER, glfw.KEY_KP_ENTER):
                self.go(self._list.chosen)
                return
            if self._list.press(glfw, key):
                self.changed = True
                return

        steps = {
            glfw.KEY_PAGE_DOWN: self.index + 1,
            glfw.KEY_PAGE_UP: self.index - 1,
            glfw.KEY_HOME: 0,
            glfw.KEY_END: len(self.lecture.steps) - 1,
            glfw.KEY_F5: self.index,
        }
        own = {
            glfw.KEY_F1: self._toggle_list,
            glfw.KEY_F2: self._toggle_code,
            glfw.KEY_F3: self._toggle_strip,
            glfw.KEY_F11: self._toggle_full,
            glfw.KEY_F12: self._inspect,
            glfw.KEY_ESCAPE: self._escape,
        }
        if key in steps or key in own:
            if action == glfw.PRESS:
                self.changed = True
                if key in own:
                    own[key]()
                else:
                    self.go(steps[key])
        elif self.player is not None and (action == glfw.RELEASE or not self._busy):
            self.player.key(key, action, mods)

    def _letter(self, letter: str) -> None:
        if self._list.open:
            self._list.type(letter)
            self.changed = True

    @property
    def _busy(self) -> bool:
        """Whether keys and the mouse are the lecture's own now."""
        return self._list.open or self._strip is not None

    def _toggle_list(self) -> None:
        self._list.toggle(self.index)
        self._strip = None

    def _toggle_code(self) -> None:
        if self.step.runs:
            self._coding, self._first = not self.coded, None

    def _toggle_strip(self) -> None:
        if self._strip is not None:
            self._strip = None
        elif self.player is not None:
            self.wants_strip = True
            self._list.open = False

    def _toggle_full(self) -> None:
        glfw, window = self.glfw, self.window
        if glfw.get_window_monitor(window):
            glfw.set_window_monitor(window, None, *self._windowed, 0)
        elif monitor := glfw.get_primary_monitor():
            self._windowed = (*glfw.get_window_pos(window), *glfw.get_window_size(window))
            mode = glfw.get_video_mode(monitor)
            sides = mode.size.width, mode.size.height
            glfw.set_window_monitor(window, monitor, 0, 0, *sides, mode.refresh_rate)

    def _inspect(self) -> None:
        if self.player is not None and self._strip is None:
            self._list.open = False
            self.player.inspect()

    def _escape(self) -> None:
        if self._busy or self.wants_strip:
            self._list.open = False
            self._strip = None
            self.wants_strip = False
        elif self.player is None or not self.player.escape():
            self.to = -1

    # The mouse.

    def cursor(self) -> tuple[tuple[float, float], tuple[int, int]]:
        """Return where the cursor is in the area, and the area's size, in coordinates."""
        x, y = self.glfw.get_cursor_pos(self.window)
        return (x, y - self._top()), self.area()

    def _top(self) -> float:
        """Return how far the area's top is below the window's, in coordinates."""
        return (self.whole()[1] - self.layout.area[1]) / self.scale()

    def _button(self, button: int, action: int, mods: int) -> None:
        glfw = self.glfw
        x, y = (place * self.scale() for place in self._at)
        if self._list.open:
            on = self._list.at(x, y)
            if on is not None and action == glfw.PRESS and button == glfw.MOUSE_BUTTON_LEFT:
                self.go(on)
        elif self.player is not None and not self._busy:
            above = self._at[1] < self._top() or x >= self.layout.area[0]
            if not above or action == glfw.RELEASE:
                self.player.button(button, action, mods)

    def _motion(self, x: float, y: float) -> None:
        self._at = x, y
        if self.player is not None and not self._busy:
            self.player.motion(x, y - self._top())

    def _scroll(self, x: float, y: float) -> None:
        if self._busy or self.player is None:
            return
        if self.coded and self._at[0] * self.scale() >= self.layout.area[0]:
            lines = self._wheel.steps(y * WHEEL)
            if lines:
                first = (self._first or 1) - lines
                self._first, self.changed = min(max(first, 1), len(self._source)), True
        else:
            self.player.scroll(x, y)
