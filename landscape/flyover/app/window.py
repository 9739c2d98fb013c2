"""The window of the software fly-over: its pictures, made without OpenGL, on a textured quad."""

import argparse
import math
import os
import time
from collections.abc import Sequence

from framelens.base.errors import InputError
from framelens.base.texts import choose, said
from framelens.gl.contexts.glfw import GLFWContext
from framelens.gl.framebuffer import read_pixels
from framelens.gl.glfw_library import glfw
from framelens.gl.screen_picture import ScreenPicture
from framelens.gl.seam import gl
from framelens.inspector.keys import Namer, system_name
from framelens.inspector.panel import Panel, enlarged
from landscape.flyover.camera import frustum
from landscape.flyover.crew import Crew, processes
from landscape.flyover.environment import Environment
from landscape.flyover.levels import levels
from landscape.flyover.settings import Settings
from landscape.settings import declare
from landscape.settings.declare import with_settings
from landscape.walk import words
from landscape.walk.free_flight import advance, moves
from landscape.walk.hands import Hands
from landscape.walk.keys import pick
from landscape.walk.opening import EMPTY
from landscape.walk.preferences import Preferences
from landscape.walk.screen import FullScreen, hide_cursor, save_screenshot
from landscape.walk.walker import Intent

SIZE = 1024, 768  # chosen: the size at which its speed is stated
# The technique that each digit switches: of the lines, and of the filled ground.
LINES = {
    "1": "flyover.strips",
    "2": "flyover.back_faces",
    "3": "flyover.bounding_volumes",
    "4": "flyover.quad_tree",
    "5": "flyover.detail",
    "6": "flyover.morph",
    "7": "flyover.hidden_lines",
    "8": "flyover.colours",
    "9": "flyover.mode",
}
FILLED = {
    "1": "filled.smooth",
    "2": "filled.levels",
    "3": "filled.fog",
    "4": "filled.shadows",
    "5": "filled.occlusion",
    "6": "filled.reflection",
    "7": "filled.clouds",
    "8": "filled.edges",
    "9": "flyover.mode",
}
# Rows of the help that keys of the walk have, with what they do here.
WALKING = {
    "walk": "flyover.move",
    "turn": "help.turn",
    "up_down": "flyover.up_down",
    "run": "flyover.run",
    "fly": "flyover.free",
    "time": "flyover.pause",
    "next_fix": "flyover.step",
    "fullscreen": "help.fullscreen",
    "screenshot": "help.screenshot",
    "help": "help.help",
    "escape": "help.escape",
}
STEP = 1 / 30  # seconds of flight, chosen: of a single step
SLOWEST, FASTEST = 1 / 16, 16.0  # chosen: times the speed
FACTOR = math.sqrt(2.0)  # chosen: of a key press
LONGEST = 0.25  # seconds, chosen: after a longer pause the flight goes on where it was
COUNTED, SHOWN = 0.5, 2.5  # seconds, chosen: between two counts, and that a message is shown


def show(
    environment: Environment,
    settings: Settings,
    options: argparse.Namespace,
    preferences: Preferences | None = None,
) -> int:
    """Fly until the user closes the window, or for --frames frames; return the exit status.

    ``preferences`` are the user's keys, mouse, language and comfort.
    """
    wishes = preferences or Preferences()
    language = options.lang or wishes.language or choose(os.environ)
    jobs = processes(options.jobs)
    size = options.size or SIZE
    window = Flying(
        environment, settings, size, language, not options.size, jobs, preferences=wishes
    )
    window.time = options.at
    if options.fullscreen or wishes.fullscreen:
        window.fill_screen()
    drawn, begun = 0, time.perf_counter()
    try:
        while (options.frames is None or drawn < options.frames) and window.listen():
            drawn += window.draw()
        seconds = time.perf_counter() - begun
    finally:
        window.close()

    if not options.quiet and drawn:
        told = {
            "frames": f"{drawn:,}",
            "seconds": f"{seconds:.1f}",
            "rate": f"{drawn / seconds:.1f}",
        }
        print(words.text(language, "flyover.mean", **told))

    return 0


class Flying:
    """A window and the flight in it.

    ``headless`` needs no screen: GLFW's null platform, and OSMesa or EGL renders into memory.
    """

    def __init__(
        self,
        environment: Environment,
        settings: Settings,
        size: tuple[int, int],
        language: str,
        enlarged: bool = False,
        jobs: int = 1,
        headless: bool = False,
        preferences: Preferences | None = None,
    ) -> None:
        """Open the window, and let ``jobs`` processes draw; InputError, NoOpenGLError."""
        wishes = preferences or Preferences()
        self.settings, self._language = settings, language
        self.terrain = environment.field(settings.flyover)
        self.flight = environment.flight(self.terrain, settings.flyover)
        self.time = 0.0  # seconds along the path
        self.camera = self.flight.camera(0.0)
        self.paused = self.free = False
        self.speed = 1.0  # times the speed that is set
        self.crew = Crew(self.terrain, jobs)
        try:
            self.context: GLFWContext | None = GLFWContext(
                size, "landscape", True, False, "headless" if headless else "auto", enlarged
            )
        except BaseException:
            self.crew.close()
            raise

        self._headless = headless
        self._help = False
        self._shoot = False
        self._begun = False  # whether a picture has been drawn
        self._message = ""
        self._until = 0.0
        self._counted = ""
        self._picture = ScreenPicture()
        window = self.context.window
        glfw.set_window_title(window, f"landscape, {environment.name}")
        if not headless:
            glfw.swap_interval(1)
        self.hands = Hands(system_name, wishes.keys)
        self.hands.speed, self.hands.inverted = wishes.mouse_speed, wishes.invert
        self.hands.listen(window)
        glfw.set_key_callback(window, lambda _, key, __, action, mods: self.key(key, action, mods))
        self._dpi, self._larger = max(glfw.get_window_content_scale(window)), wishes.text_size
        self._panel = Panel(self._word("flyover.title"), (), self._dpi)
        self._full_screen = FullScreen(self.context.size)
        self._last = self._since = glfw.get_time()
        self._frames = 0
        self._hint()
        self._wait()  # the ground's light is computed for the first picture

    def _hint(self) -> None:
        """Say with which key the others are listed."""
        letter = self.hands.keymap.labels("help", self._language, system_name)
        self._say(self._word("hint", letter=letter))

    def _word(self, key: str, **values: str) -> str:
        return words.text(self._language, key, **values)

    def _say(self, message: str) -> None:
        self._message, self._until = message, glfw.get_time() + SHOWN

    def key(self, key: int, action: int, mods: int = 0) -> None:
        """Note a key: plus and minus change the speed, Hands knows the others."""
        way = {"more": FACTOR, "less": 1 / FACTOR}.get(pick(key, system_name))
        if way is None:
            self.hands.key(key, action, mods)
            # There is no list of settings here, which would have the next keys for itself.
            self.hands.listing, self.hands.picks = False, []
        elif action != glfw.RELEASE:
            self.speed = min(max(self.speed * way, SLOWEST), FASTEST)
            self._say(self._word("flyover.at_speed", speed=f"{self.speed:.2g}"))

    def listen(self) -> bool:
        """Follow keys and mouse since the last frame; return False when the flight is to end."""
        assert self.context is not None
        glfw.poll_events()
        now = glfw.get_time()
        seconds, self._last = min(now - self._last, LONGEST), now
        orders, self.hands.orders = self.hands.orders, []
        for order in orders:
            if order == "quit" and self._help == (self.hands.pressed("help") % 2 == 1):
                return False
            self._obey(order)
        intent, switches = self.hands.take()
        self.advance(intent, switches, seconds)
        return not glfw.window_should_close(self.context.window)

    def _obey(self, order: str) -> None:
        assert self.context is not None
        if order in ("capture", "release"):
            hide_cursor(self.context.window, order == "capture")
            self.hands.capture(order == "capture")
        elif order == "quit":
            self.hands.switch("help")  # who reads it wants to be back in the flight
        elif order == "screenshot":
            self._shoot = True
        elif order == "fullscreen":
            self.fill_screen()

    def fill_screen(self) -> None:
        """Fill the screen with the window, or put it back."""
        assert self.context is not None
        if not self._full_screen.toggle(self.context.window):
            self._say(self._word("no_monitor"))

    def advance(self, intent: Intent, switches: Sequence[str], seconds: float) -> None:
        """Go on for some seconds: along the path, or where keys and mouse fly."""
        for switch in switches:
            self._switch(switch)
        if intent.fly or (moves(intent) and not self.free):
            self.free = not self.free or moves(intent)
            self._say(self._word("flyover.is_free" if self.free else "flyover.on_path"))
        if self.free:
            speed = self.settings.flyover.speed * self.speed
            self.camera = advance(self.camera, intent, self.terrain, speed, seconds)
            return
        if not self.paused:
            self.time += seconds * self.speed
        self.camera = self.flight.camera(self.time)

    def _switch(self, name: str) -> None:
        digits = FILLED if self.settings.flyover.mode == "filled" else LINES
        if name in digits:
            key = digits[name]
            value = declare.next_value(self.settings, key)
            if value == "filled":
                self._wait()  # the ground's light is computed once
            self.settings = with_settings(self.settings, {key: value})
            self._say(words.toggled(self._language, self._word(f"flyover.{key}"), value))
        elif name == "help":
            self._help = not self._help
        elif name == "time":
            self.paused = not self.paused
            self._say(self._word("flyover.paused" if self.paused else "flyover.goes_on"))
        elif name in ("next_fix", "previous_fix"):
            self.paused = True
            self.time += STEP if name == "next_fix" else -STEP

    def _wait(self) -> None:
        """Say over the last picture, if there is one, that what follows takes a moment."""
        assert self.context is not None
        if 0 in self.context.pixels():
            return
        self.context.make_current()
        gl.glViewport(0, 0, *self.context.pixels())
        if not self._begun:
            gl.glClearColor(*(part / 255 for part in EMPTY), 1.0)
            gl.glClear(gl.GL_COLOR_BUFFER_BIT)
        self._panel.dpi = enlarged(self.context.pixels(), self._dpi, self._larger)
        self._panel.draw(self.context.pixels(), message=self._word("loading"))
        self.context.show()
        self.context.glfw.poll_events()

    def rows(self, name: Namer = system_name) -> list[tuple[str, str]]:
        """Return the rows of the help: keys, and what they do."""
        found = [
            (self.hands.keymap.labels(action, self._language, name), self._word(text))
            for action, text in WALKING.items()
        ]
        found.append(("+ -", self._word("flyover.speed")))
        digits = FILLED if self.settings.flyover.mode == "filled" else LINES
        return found + [(each, self._word(f"flyover.{key}")) for each, key in digits.items()]

    def draw(self) -> bool:
        """Draw a frame and show it; return False, and wait a little, in a window without area."""
        assert self.context is not None
        size = self.context.pixels()
        if 0 in size:
            glfw.wait_events_timeout(LONGEST)
            return False
        self.context.make_current()
        gl.glViewport(0, 0, *size)
        self._keep_detail(size)
        drawn = self.crew.draw(self.camera, self.settings, size)
        if not self._begun:
            self._begun = True
            self._hint()  # it could not be read while the first picture was drawn
        self._picture.draw(drawn.rgba)
        if self._shoot:
            self._shoot = False
            name = save_screenshot(read_pixels(size))
            self._say(self._word("saved", name=name) if name else self._word("not_saved"))

        now = glfw.get_time()
        self._count(drawn.counts, now)
        if self._help:
            self._panel.set_rows(self.rows())
        message = self._message if now < self._until else self._counted
        self._panel.dpi = enlarged(size, self._dpi, self._larger)
        self._panel.draw(size, self._help, message)
        self.context.show()
        return True

    def _keep_detail(self, size: tuple[int, int]) -> None:
        """Draw less far away again where too much would be drawn in a window of this size.

        What the flight began with is not changed: then it is an InputError.
        """
        ours = self.settings.flyover
        if ours.detail or ours.mode == "filled" or not self._begun:
            return
        try:
            levels(self.terrain, self.camera, frustum(ours, size), ours)
        except InputError as error:
            self.settings = with_settings(self.settings, {"flyover.detail": True})
            self._say(said(error, self._language))

    def _count(self, counts: dict[str, int], now: float) -> None:
        """Count a frame; twice a second, say how fast it goes and how many lines there are."""
        self._frames += 1
        if now - self._since < COUNTED:
            return
        rate = f"{self._frames / (now - self._since):.0f}"
        key = "flyover.lines" if "lines" in counts else "flyover.ground"
        shown = {name.replace(" ", "_"): f"{count:,}" for name, count in counts.items()}
        self._counted = self._word(key, rate=rate, **shown)
        self._frames, self._since = 0, now

    def close(self) -> None:
        """Release the window and end what draws for it; may be called twice."""
        self.crew.close()
        if self.context is not None:
            self._panel.release()
            self._picture.release()
            self.context.release()
            self.context = None
