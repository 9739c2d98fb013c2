"""The window: from a frame's input to its picture on the screen.

Every frame (loop.py) advances the walk by one :class:`Tick`, live or from a recording. Nothing else
does, so a replay reproduces a recorded walk to the pixel.
"""

import math
import os
import time
from collections.abc import Callable, Hashable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from functools import partial
from typing import Self

import numpy as np

from framelens.base.errors import InputError, NoOpenGLError
from framelens.base.texts import choose, said, translator
from framelens.gl.contexts.glfw import HEADLESS, GLFWContext
from framelens.gl.framebuffer import read_pixels
from framelens.gl.glfw_library import glfw
from framelens.inspector.inspector_frame import Inspection
from framelens.inspector.keys import system_name
from framelens.inspector.panel import Panel, enlarged
from framelens.system import give_back
from framelens.tape.edits import Edit
from landscape.elements.element import watched
from landscape.files.assets import Assets
from landscape.geometry.doors import Door
from landscape.scene.landmarks import LANDMARKS
from landscape.scene.scene import Diveable, Moment, scene
from landscape.settings import declare
from landscape.settings.declare import Value
from landscape.walk import pad, words
from landscape.walk.builder import SWITCHES, Builder, WorldFile
from landscape.walk.digits import help_rows, hint, pressed
from landscape.walk.hands import Hands
from landscape.walk.hearing import Hearing, captioned, heard, loudness
from landscape.walk.keys import SETTINGS
from landscape.walk.landmarks import Found, Search, title_of
from landscape.walk.landmarks_list import LandmarksList, Teller, nothing_told
from landscape.walk.last import LastWalk, first_picture
from landscape.walk.last import keep as keep_last
from landscape.walk.list_image import line_at, list_image, text_image
from landscape.walk.opening import covering
from landscape.walk.pad import Pad, PadState, steered
from landscape.walk.place import Place, Places, at_doors, list_picture
from landscape.walk.preferences import Preferences, kept
from landscape.walk.preferences_list import PreferencesList
from landscape.walk.recording import MAX_SECONDS, Plan, Tick
from landscape.walk.screen import FrameRate, FullScreen, hide_cursor, save_screenshot
from landscape.walk.settings_list import Page
from landscape.walk.sizes import Resizer, check_viewport
from landscape.walk.speaker import Speaker
from landscape.walk.start_command import start_command
from landscape.walk.steady import Steady
from landscape.walk.waiting import Waiting, with_alpha
from landscape.walk.walker import Intent, Walker, aimed, start

SHOWN = 2.0  # seconds for which a message is shown, at least
READ = 0.06  # chosen: seconds in which a character of a message is read
FADE = 0.5  # chosen: seconds, at the end of that time, in which the message fades out
TIDY = 0.5  # chosen: seconds of the walk after a change in which another one may follow
REST = 0.05  # chosen: seconds between checks of a window that is minimised or has no area


class Walk:
    """A window, a scene in it, and the walker; use as ``with Walk(...) as walk``.

    The backends "osmesa" and "egl" need no screen: on GLFW's null platform they render into memory.
    """

    def __init__(
        self,
        plan: Plan,
        assets: Assets,
        backend: str = "auto",
        fullscreen: bool = False,
        fps: float = 0.0,
        enlarged: bool = False,
        edits: Sequence[Edit] = (),
        context: GLFWContext | None = None,
        world: WorldFile | None = None,
        preferences: Preferences | None = None,
        speaker: Callable[[], Speaker] | None = None,
        titled: bool = False,
        keeps: bool = False,
        found: Found | None = None,
        tells: Teller = nothing_told,
        run_command: Callable[[Sequence[str]], int] = start_command,
    ) -> None:
        """Open the scene, and its window unless ``context`` is one; InputError, NoOpenGLError.

        Left (waiting.py) is raised if the user leaves before the scene is there.
        Frames are drawn with less detail where that keeps ``fps`` frames per second; 0 draws all.
        ``edits`` change single OpenGL calls; ``world`` keeps blocks that are changed;
        ``preferences`` are the user's keys, mouse and comfort, None for those of a user without
        any; ``speaker`` opens what the sound comes from, None for a walk without a device. With
        ``titled`` Escape leads back to the title instead of closing the window, which stays open;
        with ``keeps`` the walk is kept as the last one, and preferences that are changed are kept,
        too. ``found`` are the landmarks that have been found; without it nobody looks for them.
        ``tells`` has the texts of their lessons, and ``run_command`` runs one.
        """
        self.headless = backend in (*HEADLESS, "headless")
        self.place = Place(scene(plan.scene), plan.settings, plan.preset or None)
        self.place.begin_with(plan.view)
        self._places, self._door = Places(plan), ""
        self.kt = plan.kt
        self.seconds = self._stood = 0.0  # that the walk went on, and stood still
        self._language = plan.language
        self._wireframe = plan.wireframe
        self._help = False
        self._message = ""
        self._until = 0.0
        self._note = ""
        self._shoot = False
        self._row = ""
        self._done = ""
        self._assets, self._seed = assets, plan.seed
        self.resizer = Resizer()
        self._size = (0, 0)
        self.hands = Hands(system_name)
        self._pad = Pad()
        self._pad_state = PadState()
        self.wishes = PreferencesList(preferences or Preferences())
        self._keeps_wishes = keeps and preferences is not None
        self._heed(self.wishes.preferences)
        self.landmarks = LandmarksList(found or Found(), tells)
        self._search = Search() if found is not None else None
        self._unsaid: list[str] = []  # landmarks that have been found and not been named yet
        self._run_command = run_command
        self._builder = Builder(world, plan.language)
        self.hearing = Hearing(speaker)
        self._panel: Panel | None = None
        self.steady = Steady(fps)
        self.to_title = False  # whether the user has asked for the title
        self._titled, self._keeps = titled, keeps
        self._begun = plan.view
        self._tidy_at = math.inf  # when memory that was freed goes back to the system
        self._waiting: Waiting | None = None
        self._context: GLFWContext | None = context or GLFWContext(
            plan.size, "landscape", True, fullscreen, backend, enlarged
        )
        self.inspection = Inspection(edits, plan.language)
        self._full_screen = FullScreen(self._context.size)

        try:
            self._open(plan)
        except BaseException:
            self.close()
            raise

    def _open(self, plan: Plan) -> None:
        assert self._context is not None
        check_viewport(plan.size)
        self.window = self._context.window
        if not self.headless:
            glfw.swap_interval(1)
        self.hands.listen(self.window)
        pad.add_mappings()

        self._dpi = max(glfw.get_window_content_scale(self.window))
        self._panel = Panel(self._word("help.title"), self._help_rows(), self._dpi)

        self._first = first_picture(plan.view, plan.scene, plan.pose)
        self._wait("loading")
        with self.inspection.building(), self._progress():
            self.place.open(self._assets, self._seed, plan.only)
            self._builder.opened(self.place.land)

        self.walker = start(plan.pose, self.place.scene, plan.settings)
        self._say(hint(self.place.kind, self._language, system_name, self.hands.keymap))
        self._last = glfw.get_time()
        self._rate = FrameRate(self._named(self.place.kind.title))

    def _wait(self, text: str, **values: str) -> None:
        """Say that what follows takes a moment, over the last picture if there is one."""
        assert self._panel is not None and self._context is not None
        if 0 in (size := self._context.pixels()):
            return
        if not self.place.is_open or size != self._size:
            behind = np.asarray(covering(self._first, size))
        else:
            # An earlier message would show under this one. The picture stands still for a while.
            until, self._until = self._until, 0.0
            self.draw(whole=True)
            self._until = until
            behind = with_alpha(self.pixels())
        kind = self.place.kind
        message = self._word(text, **values)
        self._waiting = Waiting(self._context, self._panel, message, behind, self._leaves)
        self._waiting.expected = len(kind.slots) or len(kind.elements)
        self._waiting.show(self._language)
        glfw.poll_events()

    @contextmanager
    def _progress(self) -> Iterator[None]:
        """Say how far the block is with building a scene, if :meth:`_wait` was called."""
        waiting, self._waiting = self._waiting, None
        if waiting is None:
            yield
            return
        try:
            with watched(partial(waiting.step, self._language)):
                yield
        finally:
            waiting.release()

    def _leaves(self) -> bool:
        """Return whether the user asks to leave."""
        while "quit" in self.hands.orders:
            self.hands.orders.remove("quit")
            self.obey("quit")
        return self.to_title or bool(glfw.window_should_close(self.window))

    def _word(self, key: str, **values: str) -> str:
        return words.text(self._language, key, **values)

    def _say(self, message: str) -> None:
        """Show a message for SHOWN seconds of the walk, a long one until it can be read."""
        lasts = max(SHOWN, READ * len(message))
        self._message, self._until = message, self.seconds + self._stood + lasts

    def resting(self) -> bool:
        """Return whether the window is minimised or has no area; if so, wait a little."""
        glfw.poll_events()
        shut = 0 in glfw.get_framebuffer_size(self.window)
        iconified = glfw.get_window_attrib(self.window, glfw.ICONIFIED)
        if glfw.window_should_close(self.window) or not (shut or iconified):
            return False
        # glfw.wait_events returns at once on the null platform.
        time.sleep(REST)
        self._last = glfw.get_time()
        return True

    def listen(self) -> Tick | None:
        """Return the next frame's input, or None if the user leaves."""
        assert self._context is not None
        glfw.poll_events()
        orders, self.hands.orders = self.hands.orders, []
        self.hands.enter(self.place.kind.blocks, self.place.kind.letters)
        for order in orders:
            self.obey(order)
        if self.to_title or glfw.window_should_close(self.window):
            return None

        seconds = self._lap()
        intent, keys = self._taken(seconds)
        if self._inspect(self._context.scale()):
            # The walk stands still while a frame is looked into.
            self._stood += seconds
            seconds, intent = 0.0, Intent()

        keys = self._builder.switches(self.place.land, keys)
        place = self.place
        switches, toggled, said = pressed(place.kind, place.settings, keys, self._language)
        changes = self._changes({**toggled, **self._choose()})
        self._choose_landmark()
        self._find()
        note = self._note or said
        self._note = ""

        seconds = min(max(seconds, 0.0), MAX_SECONDS)
        row = place.chooser.row
        return Tick(seconds, intent, switches, self._context.pixels(), note, row, changes)

    def _take_pad(self) -> list[str]:
        """Note the gamepad's state; return what its buttons do, besides orders and keys."""
        listing = bool(self.hands.choosing) or self.hands.listing
        self._pad_state, done, keys = self._pad.take(listing)
        if self.wishes.preferences.invert:
            axes = self._pad_state.axes
            self._pad_state = replace(self._pad_state, axes=(*axes[:3], -axes[3], *axes[4:]))
        for key in keys:
            self.hands.key(key, glfw.PRESS)
            self.hands.key(key, glfw.RELEASE)
        for order in done:
            if order in pad.ORDERS:
                self.obey(order)
        return done

    def _choose(self) -> dict[str, Value]:
        """Carry out the keys pressed in the list of preferences; return what settings change."""
        before = self.wishes.preferences
        if not self.wishes.open:
            return {}

        for line in self._clicked(self._wishes_page()):
            self._point(self.wishes, *line)
        pressed, self.hands.choices = self.hands.choices, []
        for key in pressed:
            self.wishes.key(key, system_name, self.place.kind.letters)
        if not self.wishes.open:
            self._keep()

        after = self.wishes.preferences
        if after == before:
            return {}
        self._heed(after)
        if after.language != before.language:
            self._language = after.language or choose(os.environ)

        kind = type(self.place.settings)
        former, wanted = before.changes(kind), after.changes(kind)
        usual = {
            key: declare.get(self.place.chooser.defaults, key) for key in former.keys() - wanted
        }
        return {**wanted, **usual}

    def _clicked(self, page: Page) -> list[tuple[int, bool]]:
        """Return the lines of a list to which the mouse has gone, and whether they were clicked."""
        assert self._panel is not None and self._context is not None
        scale, dpi = self._context.scale(), self._panel.dpi
        pointed, self.hands.pointed = self.hands.pointed, []
        found = (
            (line_at(page, self._size, dpi, x * scale, y * scale), down) for x, y, down in pointed
        )
        return [(line, down) for line, down in found if line is not None]

    @staticmethod
    def _point(chooser: PreferencesList | LandmarksList, line: int, down: bool) -> None:
        """Choose a line of a list, and do with it what Enter does if it was clicked."""
        chooser.point(line)
        if down:
            chooser.choose()

    def _choose_landmark(self) -> None:
        """Carry out the keys pressed in the list of landmarks; run the lesson that is asked for."""
        if not self.landmarks.open:
            return
        if self.landmarks.reading:
            if any(down for _, _, down in self.hands.pointed):
                self.landmarks.choose()
            self.hands.pointed = []
        else:
            page = self.landmarks.page(self._language, self.place, self.walker)
            for line in self._clicked(page):
                self._point(self.landmarks, *line)
        pressed, self.hands.choices = self.hands.choices, []
        for key in pressed:
            self.landmarks.key(key)
        if not self.landmarks.open:
            self.hands.choosing = ""
        lesson, self.landmarks.asked = self.landmarks.asked, ""
        if lesson:
            self._run_lesson(lesson)

    def _run_lesson(self, lesson: str) -> None:
        """Run a lesson in a window of its own, while this one is away and the walk stands still."""
        assert self._context is not None
        self.hands.focus(False)
        glfw.hide_window(self.window)
        status = self._run_command(["lesson", lesson, "--lang", self._language])
        glfw.show_window(self.window)
        self._context.make_current()
        self._last = glfw.get_time()
        if status:
            self._note = self._word("title.failed")

    def _find(self) -> None:
        """Note the landmarks that the walker has come to, and name one when nothing else is said.

        What is said becomes part of the frame: a replay says it, too, whatever has been found.
        """
        if self._search is None:
            return
        found = self.landmarks.found
        for name in self._search.reached(self.place, self.walker):
            if name not in found.names:
                self._unsaid.append(name)
                if wrong := found.add(name, self._language):
                    self._note = said(wrong, self._language)
        silent = not self._note and self._until <= self.seconds + self._stood
        silent = silent and not self.hands.choosing
        if self._unsaid and silent:
            name = self._unsaid.pop(0)
            landmark = next(each for each in LANDMARKS if each.name == name)
            claimed = self.place.kind.letters
            key = self.hands.keymap.labels("landmarks", self._language, system_name, claimed)
            what = title_of(landmark, self._language)
            self._note = self._word("landmarks.found", what=what, letter=key)

    def _heed(self, preferences: Preferences) -> None:
        """Take the user's keys and mouse."""
        self.hands.keymap = preferences.keys
        self.hands.speed, self.hands.inverted = preferences.mouse_speed, preferences.invert

    def _keep(self) -> None:
        """Leave the list, and keep the preferences in the user's file if they came from there."""
        self.hands.choosing = ""
        if self._keeps_wishes:
            self._note = kept(self.wishes.preferences, self._language)

    def _help_rows(self) -> list[tuple[str, str]]:
        place, keymap = self.place, self.hands.keymap
        return help_rows(place.kind, place.settings, self._language, system_name, keymap)

    def _lap(self) -> float:
        """Return the seconds since the last call."""
        last, self._last = self._last, glfw.get_time()
        return self._last - last

    def _aimed(self, intent: Intent) -> Intent:
        """Return an intent that looks where the pointer is: in 2006 its position set the view."""
        walk = self.place.settings.walk
        if not self.hands.captured or walk.mouse_relative:
            return intent
        assert self._context is not None
        return replace(intent, look=aimed(self.walker, *self._context.cursor(), walk.mouse))

    def _changes(self, toggled: Mapping[str, Value]) -> dict[str, Value]:
        """Return the settings that the list, keys (``toggled``) and a drag have changed, by key."""
        picks, self.hands.picks = self.hands.picks, []
        settings = self.place.settings
        changes = {**self.place.chooser.follow(picks, settings), **toggled}

        drag = self.hands.carried()
        carried = self.place.kind.carried
        if carried is not None and any(drag):
            changes |= carried(declare.with_settings(settings, changes), *drag)
        return changes

    def follow(self, tick: Tick) -> Tick | None:
        """Prepare the window for a recorded frame; return None if the user leaves."""
        live = self.listen()
        if live is None:
            return None
        tick = self.resizer.follow(self.window, tick, live.size)
        if not self.headless:
            # A replay is no faster than the walk was.
            time.sleep(max(tick.seconds - live.seconds, 0.0))
            self._last = glfw.get_time()
        return tick

    def obey(self, order: str) -> None:
        """Carry out an order to the window; recordings do not contain orders."""
        if order == "quit" and self._helps():
            self.hands.switch("help")  # who reads it wants to be back in the walk
        elif order == "quit" and self._titled:
            self.to_title = True
        elif order == "quit":
            glfw.set_window_should_close(self.window, True)
        elif order == "screenshot":
            self._shoot = True
        elif order == "fullscreen":
            done = self._full_screen.toggle(self.window)
            self._note = self._note if done else self._word("no_monitor")
            self.hands.capture(self.hands.captured)
        elif order == "inspector":
            self._toggle_inspector()
        elif order in ("preferences", "landmarks"):
            self._open_list(order)
        elif order == "save":
            self._note = self._builder.save(self.place.land)
        else:
            captured = not self.hands.captured if order == "mouse" else order == "capture"
            # With an absolute mouse (2006) the cursor's position matters, so it stays visible.
            hide_cursor(self.window, captured and self.place.settings.walk.mouse_relative)
            self.hands.capture(captured)

    def _open_list(self, order: str) -> None:
        """Open or shut the list of an order, which has all keys and the mouse meanwhile."""
        self._close_help()
        if self.hands.captured:
            self.obey("release")
        opened = self.wishes if order == "preferences" else self.landmarks
        opened.toggle()
        self.hands.choosing = order if opened.open else ""
        self.hands.choices, self.hands.pointed = [], []
        if order == "preferences" and not opened.open:
            self._keep()

    def _helps(self) -> bool:
        """Whether the list of keys is shown once the switches noted so far are done."""
        return self._help != (self.hands.pressed("help") % 2 == 1)

    def _close_help(self) -> None:
        """Close the list of keys, which would hide what is opened."""
        if self._helps():
            self.hands.switch("help")

    def _inspect(self, scale: float) -> bool:
        """Give the inspector its keys and the mouse; return whether it stops the walk."""
        asked = self.hands.requests.take()
        if self.inspection.listen(asked, scale):
            self.obey("inspector")
        if self.inspection.stale and self.place.is_open:
            # What was left behind is opened with the edits when it is entered again.
            self._places.release()
            with self.inspection.building(anew=True):
                self._rebuild()
        return self.inspection.holds

    def _taken(self, seconds: float) -> tuple[Intent, tuple[str, ...]]:
        """Return what keys, mouse and pad ask of the walker, and which actions they name."""
        done = self._take_pad()
        intent, keys = self.hands.take()
        intent = self._aimed(intent)
        look, blocks = self.place.settings.walk.mouse, self.place.kind.blocks
        intent = steered(intent, self._pad_state, done, seconds, look, blocks)
        return intent, keys + tuple(n for n in done if n not in (*pad.ORDERS, *pad.TOOLS))

    def _tell_of_walker(self, before: Walker) -> None:
        """Say what has begun or ended since the frame before: to fly, to swim, the map's edge."""
        if self.walker.flying != before.flying:
            self._tell("fly", self.walker.flying)
        elif self.walker.swimming != before.swimming:
            self._tell_swimming()

        if self.walker.at_edge and not before.at_edge:
            self._say(self._word("edge"))
        if self.walker.escapes > before.escapes:
            self._say(self._word("let_out"))

    def _toggle_inspector(self) -> None:
        """Open or close the inspector, which needs the mouse."""
        self._close_help()
        letter = self.hands.keymap.labels("inspector", self._language, system_name)
        self.hands.inspecting = self.inspection.toggle(self._language, letter)
        if self.hands.captured:
            self.obey("release")

    def advance(self, tick: Tick) -> None:
        """Advance the clock, the switches and the walker by one frame."""
        self.seconds += tick.seconds
        self.kt += tick.seconds * self.place.settings.clock.kt_per_second
        for name in tick.actions:
            self._switch(name)
        if tick.row != self._row or tick.changes:
            self._change(tick)
        if tick.note:
            self._say(tick.note)
        before = self.walker
        self.walker = self.place.moved(before, tick.intent, tick.seconds)
        if said := self._builder.advance(self.place.land, self.walker, tick):
            self._say(said)
        if saved := self._builder.saved(self.place.land, tick.seconds):
            self._note = saved
        self._tell_of_walker(before)
        self._size = tick.size
        self._try_doors(tick.intent)
        self._hear()

    def _tell_swimming(self) -> None:
        """Say that one swims, and by which keys one dives where that is possible; or walks."""
        walker, scene = self.walker, self.place.scene
        at = walker.x, walker.z
        dives = isinstance(scene, Diveable) and scene.bed(*at) < float(scene.height(*at))
        if not (walker.swimming and dives and walker.body is None):
            self._tell("swim", walker.swimming)
            return
        keymap = self.hands.keymap
        fly = keymap.labels("fly", self._language, system_name)
        down = keymap.labels("down", self._language, system_name)
        self._say(self._word("swim.dive", fly=fly, down=down.partition(" ")[0]))

    def _hear(self) -> None:
        """Let the walker hear this frame, and see in words what he hears if he wants to."""
        shown = captioned(self.place.settings)
        if self.hearing.plays(loudness(self.place.settings)) or shown:
            now = heard(self.place, self.walker, self.kt, self._builder)
            self.hearing.hear(now, self.seconds, shown)
        else:
            self.hearing.forget()

    def _try_doors(self, intent: Intent) -> None:
        """Say where a door leads that the walker has come up to, or go through it."""
        entered, faced = at_doors(self.place.doors, self.walker, intent)
        if entered is not None:
            self._pass(entered, intent)
        elif (faced.name if faced else "") != self._door:
            self._door = faced.name if faced else ""
            if faced is not None:
                self._say(self._named(faced.says) if faced.open else self._word("shut"))

    def _pass(self, door: Door, intent: Intent) -> None:
        """Go through a door. The scene that is left stays open, to come back to at once."""
        left, place = self.place, self._places.behind(door)
        self._wait("opening", place=self._named(place.kind.title))
        try:
            with self.inspection.building(), self._progress():
                self._places.enter(place, self._assets, self._seed)
        except (InputError, NoOpenGLError) as error:
            self.walker = start(door.way_out, left.scene, left.settings)
            self._say(str(error))
            return
        self._places.leave(left)
        self.place, self._door = place, door.to
        self._tidy_later()
        self.walker = start(place.way_in(door, intent), place.scene, place.settings)
        self._rate = FrameRate(self._named(place.kind.title))
        self._say(self._named(place.kind.title))
        self.draw()  # the first frame takes longest: it is drawn once more to be shown
        self._last = glfw.get_time()

    def _named(self, text: str) -> str:
        """Return what a scene calls something, in the user's language."""
        return translator(self._language, "scenes")(text)

    def _switch(self, name: str) -> None:
        """Carry out a switch."""
        if name == "help":
            self._help, self._until = not self._help, 0.0  # the hint has been taken
        elif name == "wireframe":
            self._wireframe = not self._wireframe
            self._tell(name, self._wireframe)
        elif name in SWITCHES:
            self._builder.switch(self.place.land, name)
        elif name in ("fix", "next_fix", "previous_fix", "go_to_fix"):
            if self.place.kind.fixes:
                self._switch_fix(name)
        elif SETTINGS[name] in declare.fields(type(self.place.settings)):
            value = declare.next_value(self.place.settings, SETTINGS[name])
            if not self._apply({SETTINGS[name]: value}):
                return
            if name == "mute":
                self._places.give({SETTINGS[name]: value})  # it is muted behind a door, too
            self._tell(name, value)

    def _apply(self, changes: Mapping[str, object]) -> bool:
        """Change settings; open the scene again if it cannot take them as it is.

        If it cannot be opened with them, as blocks were changed on a land that would be another,
        say so, and return False: it is as before.
        """
        try:
            with self.inspection.building():
                self.place.apply(changes, self._rebuild)
        except InputError as error:
            self._say(said(error, self._language))
            return False
        self._tidy_later()
        return True

    def _rebuild(self) -> None:
        """Open the scene again."""
        self._wait("rebuilding")
        with self._progress():
            self.place.open(self._assets, self._seed)
        self._tidy_later()

    def _tidy_later(self) -> None:
        """Give memory back soon: what was built again has left as much behind as it takes."""
        self._tidy_at = self.seconds + TIDY

    def _tidy(self) -> None:
        """Give memory back if that is due. It takes about as long as a frame."""
        if self.seconds >= self._tidy_at:
            self._tidy_at = math.inf
            give_back()

    def _change(self, tick: Tick) -> None:
        """Show the list with its chosen row, and make the changes that were asked for there."""
        if tick.row and not self._row:
            self._help = False  # it would hide the list
        if tick.row != self._row:
            self._row, self._done = tick.row, ""
        if not tick.changes:
            return
        before = self.place.scene
        if not self._apply(tick.changes):
            return
        self._places.give(tick.changes)
        self._done = self._word("list.taken" if self.place.scene is before else "list.rebuilt")

    def _at_left(self) -> tuple[Hashable, Callable[[], np.ndarray]] | None:
        """Return what the picture at the left depends on, and how to make it.

        It is that of the inspector, or of a list.
        """
        assert self._panel is not None
        if self.hands.choosing:
            return self._choosing(self._panel.dpi)
        if self.inspection.open or not self._row:
            return self.inspection.image(self._panel.dpi)
        shown = self._row, self._done, self._language
        return list_picture(self.place, *shown, self._size, self._panel.dpi)

    def _wishes_page(self) -> Page:
        return self.wishes.page(self._language, system_name, self.place.kind.letters)

    def _choosing(self, dpi: float) -> tuple[Hashable, Callable[[], np.ndarray]]:
        """Return what the picture of the open list depends on, and how to make it."""
        if self.landmarks.reading:
            texts = self.landmarks.text(self._language)
            return (texts, dpi), lambda: text_image(texts, self._size, dpi)
        if self.wishes.open:
            page = self._wishes_page()
        else:
            page = self.landmarks.page(self._language, self.place, self.walker)
        return (page, dpi), lambda: list_image(page, self._size, dpi)

    def _switch_fix(self, name: str) -> None:
        """Choose a fix, go where it shows, or turn it on or off; then show its name and state."""
        way = {"next_fix": 1, "previous_fix": -1}.get(name, 0)
        fix = self.place.choose_fix(way)
        on_foot = not self.walker.flying
        if name == "go_to_fix":
            self.walker = start(fix.pose(False), self.place.scene, self.place.settings)
        on = declare.with_settings(self.place.settings, fix.on) == self.place.settings
        if name == "fix":
            if not self._apply(fix.off if on else fix.on):
                return
            on = not on
        says = words.fix_state(self._language, fix.name, fix.title, on)
        if on_foot and self.walker.flying:
            # Whoever does not know would rise at the first jump.
            claimed = self.place.kind.letters
            letter = self.hands.keymap.labels("fly", self._language, system_name, claimed)
            says = self._word("in_flight", says=says, letter=letter)
        self._say(says)

    def _tell(self, name: str, value: declare.Value) -> None:
        self._say(words.state(self._language, name, value))

    @property
    def moment(self) -> Moment:
        """The moment of the next frame, with all its detail."""
        steps = self.walker.step, self.walker.stroke
        return Moment(self.walker.pose, self._size, self.kt, *steps, self._wireframe, walking=True)

    def draw(self, whole: bool = False) -> None:
        """Draw the frame and the panel into the window's back buffer; ``whole``: in all detail."""
        assert self._panel is not None and self._context is not None

        # Making the context current gives OSMesa a buffer of the window's new size.
        self._context.make_current()
        moment = self.moment
        scene, shows = self.place.scene, self.place.shows(moment)

        # A screenshot has all the detail, and so has what the inspector looks into.
        whole = whole or self._shoot or self.inspection.open
        draw = partial(self.steady.draw, moment, scene.draw, whole, shows)
        self.inspection.draw(draw, (moment, *shows), self._size)
        if self._help:
            # The user may have changed the keyboard's layout.
            self._panel.set_rows(self._help_rows(), self._word("help.title"))

        self._draw_panel(self._panel)

    def _draw_panel(self, panel: Panel) -> None:
        """Draw what stands over the frame: the help, the message, lists, the bar of blocks."""
        scene = self.place.scene
        larger = self.wishes.preferences.text_size
        panel.dpi = enlarged(self._size, self._dpi, larger)
        left = max(self._until - self.seconds - self._stood, 0.0)
        if self.hands.choosing:
            left = 0.0  # a long message would lie over the list
        message, opacity = self._message if left else "", min(left / FADE, 1.0)

        cross = self.inspection.cross()
        bar = self._builder.bar(self.place.land, scene.shown, self._size)
        at_left = self._at_left()
        if self._help:
            at_left = cross = None  # neither could be read over the other
        panel.draw(
            self._size,
            self._help,
            message,
            opacity,
            at_left,
            cross,
            bar,
            opaque=self._shows_map(),
            covered=self._builder.covered(self.place.land, self._size),
            right=self.hearing.picture(self._language, self._size, panel.dpi),
        )

    def _shows_map(self) -> bool:
        """Whether the map is drawn, which would show through a list."""
        settings = self.place.settings
        known = "overlay.map" in declare.fields(type(settings))
        shown = "map" in self.place.scene.shown
        return shown and known and declare.get(settings, "overlay.map") is True

    def pixels(self) -> np.ndarray:
        """Return the frame drawn but not yet presented, uint8 (h, w, 3), top row first."""
        return read_pixels(self._size)

    def present(self) -> None:
        """Save the frame if asked to, then show it; update the frame rate in the title."""
        if self._shoot:
            self._shoot = False
            name = save_screenshot(self.pixels())
            self._note = self._word("saved", name=name) if name else self._word("not_saved")
        self.steady.show(self.window)
        self._rate.count(self.window)
        self._tidy()

    def close(self) -> None:
        """Save the world, or raise InputError; release all, in order; may be called twice."""
        try:
            self._keep_last()
            self._builder.leave()
        finally:
            window = None if self._titled else self._context
            owners = self._panel, self.steady, self._places, self.place, window
            for owner in (self.hearing, *owners):
                if owner is not None:
                    owner.release()
            self._panel = self._context = None
            give_back()  # the title, if the walk began there, goes on

    def _keep_last(self) -> None:
        """Keep what is seen, and where, for the title and for the next walk's first picture."""
        keeps, self._keeps = self._keeps, False
        if not keeps or self._context is None or not self.place.is_open or 0 in self._size:
            return
        if self._context.pixels() != self._size:
            return
        kind = self.place.kind
        begun = kind.named(self._begun) is not None
        self._help = False
        self._until = 0.0
        self._row = ""
        self.hands.choosing = ""
        self.hearing.forget()
        if self.inspection.open:
            self.obey("inspector")
        self.draw(whole=True)
        view = self._begun if begun else kind.start
        keep_last(self.pixels(), LastWalk(view, self.walker.pose))

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
