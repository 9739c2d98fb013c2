"""The window: what GLFW reports becomes what the walker intends, and the loop that draws.

Keys are places on the keyboard, by GLFW's codes, which are named after a US keyboard: KEY_W is the
Z of an AZERTY one. Every frame is a :class:`Tick`, live or from a recording, and nothing else moves
the walk: so a recorded walk is reproduced to the pixel.
"""

import itertools
import os
import time
from collections.abc import Iterable, Iterator
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Any

import glfw
import numpy as np

from landscape.errors import InputError
from landscape.files.assets import Assets
from landscape.files.output import save_png
from landscape.gallery.fixes import FIXES
from landscape.gl.calls import gl
from landscape.gl.context import GLFWContext
from landscape.gl.framebuffer import read_pixels
from landscape.island import ELEMENTS, SEED, Island, Moment
from landscape.keys import get, with_settings
from landscape.settings import Settings
from landscape.views import VIEWS
from landscape.window import words as texts
from landscape.window.panel import Panel
from landscape.window.recording import MAX_SECONDS, Plan, Recorder, Tick, read
from landscape.window.walker import (
    Intent,
    advance,
    aimed,
    animal_obstacles,
    castle_obstacles,
    start,
)

SIZE = (1280, 720)  # chosen: window coordinates
JUMP = 200.0  # chosen: pixels; a mouse that went farther between two reports was put there
SHOWN = 2.0  # seconds a message stays
FADE = 0.5  # chosen: seconds of these in which it goes
REST = 0.05  # chosen: seconds between looks at a window that shows nothing

FORWARD, BACKWARD = (glfw.KEY_W, glfw.KEY_UP), (glfw.KEY_S, glfw.KEY_DOWN)
LEFTWARD, RIGHTWARD = (glfw.KEY_A,), (glfw.KEY_D,)
TURN_LEFT, TURN_RIGHT = (glfw.KEY_LEFT,), (glfw.KEY_RIGHT,)
UP, DOWN = (glfw.KEY_SPACE, glfw.KEY_PAGE_UP), (glfw.KEY_C, glfw.KEY_PAGE_DOWN)
RUN = (glfw.KEY_LEFT_SHIFT,)

# Switches go into the recording, orders to the window do not.
SWITCHES = {
    glfw.KEY_E: "strike",
    glfw.KEY_F: "fly",
    glfw.KEY_M: "map",
    glfw.KEY_X: "wireframe",
    glfw.KEY_G: "fog",
    glfw.KEY_R: "reflection",
    glfw.KEY_T: "sorting",
    glfw.KEY_N: "next_fix",
    glfw.KEY_V: "fix",
    glfw.KEY_H: "help",
}
ORDERS = {glfw.KEY_F11: "fullscreen", glfw.KEY_F12: "screenshot"}
SETTINGS = {
    "map": "overlay.map",
    "fog": "fog.enabled",
    "reflection": "reflection.enabled",
    "sorting": "transparent.sorted",
}
HELP = (
    ("help.walk", (glfw.KEY_W, glfw.KEY_A, glfw.KEY_S, glfw.KEY_D)),
    ("help.turn", (*TURN_LEFT, *TURN_RIGHT)),
    ("help.run", RUN),
    ("help.strike", (glfw.KEY_E,)),
    ("help.fly", (glfw.KEY_F,)),
    ("help.up_down", (glfw.KEY_SPACE, glfw.KEY_C)),
    ("help.map", (glfw.KEY_M,)),
    ("help.fog", (glfw.KEY_G,)),
    ("help.reflection", (glfw.KEY_R,)),
    ("help.sorting", (glfw.KEY_T,)),
    ("help.wireframe", (glfw.KEY_X,)),
    ("help.next_fix", (glfw.KEY_N,)),
    ("help.fix", (glfw.KEY_V,)),
    ("help.fullscreen", (glfw.KEY_F11,)),
    ("help.screenshot", (glfw.KEY_F12,)),
    ("help.help", (glfw.KEY_H,)),
    ("help.escape", (glfw.KEY_ESCAPE,)),
)
NAMED_KEYS = {
    glfw.KEY_LEFT: "key.left",
    glfw.KEY_RIGHT: "key.right",
    glfw.KEY_SPACE: "key.space",
    glfw.KEY_LEFT_SHIFT: "key.left_shift",
    glfw.KEY_ESCAPE: "key.escape",
    glfw.KEY_F11: "key.f11",
    glfw.KEY_F12: "key.f12",
}


def key_label(key: int, language: str) -> str:
    """Return what the user's keyboard prints on a key; GLFW must be running."""
    if key in NAMED_KEYS:
        return texts.text(language, NAMED_KEYS[key])
    # GLFW's codes of letters are those of ASCII.
    printed = (glfw.get_key_name(key, 0) or chr(key)).strip()
    return printed.upper() if len(printed.upper()) == 1 else printed


class Hands:
    """Collects what GLFW reports between two frames; needs no window."""

    def __init__(self) -> None:
        self.captured = False
        self.orders: list[str] = []
        self._held: set[int] = set()
        self._tapped: set[int] = set()
        self._switches: list[str] = []
        self._look = [0.0, 0.0]
        self._last: tuple[float, float] | None = None

    def key(self, key: int, action: int) -> None:
        """A key went down or up; one that repeats says nothing new."""
        if action == glfw.RELEASE:
            self._held.discard(key)
        if action != glfw.PRESS:
            return
        self._held.add(key)
        self._tapped.add(key)
        if key in SWITCHES:
            self._switches.append(SWITCHES[key])
        elif key in ORDERS:
            self.orders.append(ORDERS[key])
        elif key == glfw.KEY_ESCAPE:
            self.orders.append("release" if self.captured else "quit")

    def button(self, button: int, action: int) -> None:
        """The first click captures the mouse, later ones strike."""
        if button == glfw.MOUSE_BUTTON_LEFT and action == glfw.PRESS:
            if self.captured:
                self._switches.append("strike")
            else:
                self.orders.append("capture")

    def motion(self, x: float, y: float) -> None:
        """The mouse is at x, y in pixels; how far it went turns the head."""
        if not self.captured:
            return
        if self._last is not None:
            for axis, way in enumerate((x - self._last[0], y - self._last[1])):
                self._look[axis] += max(-JUMP, min(way, JUMP))
        self._last = x, y

    def capture(self, captured: bool) -> None:
        """Begin or end to look by the mouse; the first motion after that is the cursor's jump."""
        self.captured = captured
        self._last = None

    def focus(self, focused: bool) -> None:
        """Let everything go when another window gets the keys: no release would be reported."""
        self._last = None
        if not focused:
            self._held.clear()
            self._tapped.clear()
            self._look = [0.0, 0.0]
            if self.captured:
                self.orders.append("release")

    def take(self) -> tuple[Intent, tuple[str, ...]]:
        """Return what was asked for since the last call: intent and switches."""
        down = self._held | self._tapped  # a key tapped between two slow frames counts as well

        def pair(plus: Iterable[int], minus: Iterable[int]) -> float:
            return float(not down.isdisjoint(plus)) - float(not down.isdisjoint(minus))

        switches = self._switches
        intent = Intent(
            forward=pair(FORWARD, BACKWARD),
            right=pair(RIGHTWARD, LEFTWARD),
            up=pair(UP, DOWN),
            turn=pair(TURN_RIGHT, TURN_LEFT),
            look=(self._look[0], self._look[1]),
            run=not down.isdisjoint(RUN),
            strike="strike" in switches,
            # Twice in one frame is not at all.
            fly=switches.count("fly") % 2 == 1,
        )
        self._tapped, self._switches, self._look = set(), [], [0.0, 0.0]
        return intent, tuple(name for name in switches if name not in ("strike", "fly"))


class Walk:
    """A window, the island in it, and the walker; use as ``with Walk(...) as walk``.

    ``backend`` "osmesa" needs no screen: GLFW's null platform, drawn into memory.
    """

    def __init__(
        self, plan: Plan, assets: Assets, backend: str = "auto", fullscreen: bool = False
    ) -> None:
        """Open the window and build the island; InputError and NoOpenGLError as they say."""
        self.headless = backend == "osmesa"
        self.settings = plan.settings
        self.kt = plan.kt
        self.seconds = 0.0
        self._language = plan.language
        self._wireframe, self._help, self._message, self._until = plan.wireframe, False, "", 0.0
        self._note, self._shoot = "", False
        self._fix, self._assets, self._seed = 0, assets, plan.seed
        self._windowed = (60, 60, *plan.size)
        self._size = (0, 0)
        self.hands = Hands()
        self._island: Island | None = None
        self._panel: Panel | None = None
        self._context: GLFWContext | None = GLFWContext(
            plan.size, "landscape", True, fullscreen, self.headless
        )
        try:
            self._open(plan, assets)
        except BaseException:
            self.close()
            raise

    def _open(self, plan: Plan, assets: Assets) -> None:
        assert self._context is not None
        limits = gl.glGetIntegerv(gl.GL_MAX_VIEWPORT_DIMS)
        if any(side > limit for side, limit in zip(plan.size, limits, strict=True)):
            raise InputError(
                f"--size {plan.size[0]}x{plan.size[1]}: expected at most "
                f"{limits[0]}x{limits[1]} on this OpenGL"
            )
        self.window = self._context.window
        if not self.headless:
            glfw.swap_interval(1)
        self._island = Island(plan.settings, assets, plan.seed, plan.only)
        field, castle = self._island.ground.field, self._island.castle
        self.walker = start(plan.pose, field, plan.settings)
        there, values = plan.only, plan.settings
        self._obstacles = animal_obstacles(
            values.rabbit if "rabbit" in there else None,
            values.dragon if "dragon" in there else None,
            field,
        )
        if castle is not None:
            self._obstacles += castle_obstacles(values.castle, castle.base[1])
        labels = [(" ".join(self._label(k) for k in keys), text) for text, keys in HELP]
        rows = [(keys, texts.text(self._language, text)) for keys, text in labels]
        self._panel = Panel(texts.text(self._language, "help.title"), rows)
        self._say(texts.text(self._language, "hint", letter=self._label(glfw.KEY_H)))
        glfw.set_key_callback(
            self.window, lambda _, key, __, action, ___: self.hands.key(key, action)
        )
        glfw.set_mouse_button_callback(
            self.window, lambda _, button, action, __: self.hands.button(button, action)
        )
        glfw.set_cursor_pos_callback(self.window, lambda _, x, y: self.hands.motion(x, y))
        glfw.set_window_focus_callback(self.window, lambda _, on: self.hands.focus(bool(on)))
        self._last = self._counted_from = glfw.get_time()
        self._counted = 0

    def _label(self, key: int) -> str:
        return key_label(key, self._language)

    def _say(self, message: str) -> None:
        """Show a message for SHOWN seconds of the walk."""
        self._message, self._until = message, self.seconds + SHOWN

    def resting(self) -> bool:
        """Tell whether the window shows nothing, minimised or without area; wait a little then."""
        glfw.poll_events()
        shut = 0 in glfw.get_framebuffer_size(self.window)
        iconified = glfw.get_window_attrib(self.window, glfw.ICONIFIED)
        if glfw.window_should_close(self.window) or not (shut or iconified):
            return False
        # GLFW's own waiting does not wait on the null platform.
        time.sleep(REST)
        self._last = glfw.get_time()
        return True

    def listen(self) -> Tick | None:
        """Return the next frame as the user wants it, or None to leave."""
        glfw.poll_events()
        orders, self.hands.orders = self.hands.orders, []
        for order in orders:
            self._obey(order)
        if glfw.window_should_close(self.window):
            return None
        now = glfw.get_time()
        seconds, self._last = now - self._last, now
        intent, switches = self.hands.take()
        if self.hands.captured and not self.settings.walk.mouse_relative:
            cursor, size = glfw.get_cursor_pos(self.window), glfw.get_window_size(self.window)
            look = aimed(self.walker, cursor, size, self.settings.walk.mouse)
            intent = replace(intent, look=look)
        note, self._note = self._note, ""
        width, height = glfw.get_framebuffer_size(self.window)
        seconds = min(max(seconds, 0.0), MAX_SECONDS)
        return Tick(seconds, intent, switches, (width, height), note)

    def follow(self, tick: Tick) -> Tick | None:
        """Make the window ready for a recorded frame; None if the user leaves instead."""
        live = self.listen()
        if live is None:
            return None
        if live.size != tick.size:
            glfw.set_window_size(self.window, *tick.size)
        if not self.headless:
            # Not faster than it was walked.
            time.sleep(max(tick.seconds - live.seconds, 0.0))
            self._last = glfw.get_time()
        return tick

    def _obey(self, order: str) -> None:
        """Do to the window what no recording needs to know."""
        if order == "quit":
            glfw.set_window_should_close(self.window, True)
        elif order == "screenshot":
            self._shoot = True
        elif order == "fullscreen":
            self._toggle_fullscreen()
        else:
            captured = order == "capture"
            # The cursor's own place counts where the mouse is not relative: it stays to be seen.
            hidden = captured and self.settings.walk.mouse_relative
            mode = glfw.CURSOR_DISABLED if hidden else glfw.CURSOR_NORMAL
            glfw.set_input_mode(self.window, glfw.CURSOR, mode)
            self.hands.capture(captured)

    def _toggle_fullscreen(self) -> None:
        if glfw.get_window_monitor(self.window):
            windowed: Any = None
            glfw.set_window_monitor(self.window, windowed, *self._windowed, 0)
        elif monitor := glfw.get_primary_monitor():
            place, size = glfw.get_window_pos(self.window), glfw.get_window_size(self.window)
            self._windowed = (*place, *size)
            mode = glfw.get_video_mode(monitor)
            glfw.set_window_monitor(
                self.window, monitor, 0, 0, mode.size.width, mode.size.height, mode.refresh_rate
            )
        else:
            self._note = texts.text(self._language, "no_monitor")
        self.hands.capture(self.hands.captured)

    def advance(self, tick: Tick) -> None:
        """Let a frame's time pass: the clock, the switches, the walker."""
        assert self._island is not None
        self.seconds += tick.seconds
        self.kt += tick.seconds * self.settings.clock.kt_per_second
        for name in tick.actions:
            self._switch(name)
        if tick.note:
            self._say(tick.note)
        field, flying = self._island.ground.field, self.walker.flying
        self.walker = advance(
            self.walker, tick.intent, tick.seconds, field, self._obstacles, self.settings
        )
        if self.walker.flying != flying:
            self._tell("fly", self.walker.flying)
        self._size = tick.size

    def _switch(self, name: str) -> None:
        """Turn a switch; those of the settings need no element built anew."""
        assert self._island is not None
        if name == "help":
            self._help = not self._help
        elif name == "next_fix":
            self._fix = (self._fix + 1) % len(FIXES)
            self._tell_fix()
        elif name == "fix":
            self._apply_fix()
        elif name == "wireframe":
            self._wireframe = not self._wireframe
            self._tell(name, self._wireframe)
        else:
            key = SETTINGS[name]
            on = not get(self.settings, key)
            self.settings = with_settings(self.settings, {key: on})
            self._island.apply(self.settings)
            self._tell(name, on)

    def _apply_fix(self) -> None:
        """Turn the chosen remedy on or off; what is built from its settings is built anew."""
        assert self._island is not None
        fix = FIXES[self._fix]
        changes = fix.off if self._has_fix() else fix.on
        self.settings = with_settings(self.settings, changes)
        former = self._island
        self._island = Island(self.settings, self._assets, self._seed, tuple(former.shown))
        former.release()
        self._tell_fix()

    def _has_fix(self) -> bool:
        """Tell whether the settings are those of the chosen remedy."""
        wanted = with_settings(self.settings, FIXES[self._fix].on)
        return wanted == self.settings

    def _tell_fix(self) -> None:
        """Say which remedy is chosen, and whether it is on."""
        fix = FIXES[self._fix]
        state = texts.text(self._language, "fix.on" if self._has_fix() else "fix.off")
        self._say(f"{fix.name}  {fix.title}: {state}")

    def _tell(self, name: str, on: bool) -> None:
        self._say(texts.text(self._language, f"{name}.{'on' if on else 'off'}"))

    def draw(self) -> None:
        """Draw the frame, words included, into the window's back buffer."""
        assert self._island is not None and self._panel is not None and self._context is not None
        # OSMesa takes a buffer of the new size, and a lost context its window, when made current.
        self._context.make_current()
        walker = self.walker
        self._island.draw(
            Moment(walker.pose, self._size, self.kt, walker.step, walker.stroke, self._wireframe)
        )
        left = self._until - self.seconds
        message = self._message if left > 0 else ""
        self._panel.draw(self._size, self._help, message, min(max(left, 0.0) / FADE, 1.0))

    def pixels(self) -> np.ndarray:
        """Return the frame drawn and not yet presented, uint8 (h, w, 3), top row first."""
        return read_pixels(self._size)

    def present(self) -> None:
        """Show the frame; save it first if asked to; count frames in the title."""
        if self._shoot:
            self._shoot = False
            self._note = self._save()
        glfw.swap_buffers(self.window)
        self._counted += 1
        elapsed = glfw.get_time() - self._counted_from
        if elapsed >= 1.0:
            rate = self._counted / elapsed
            glfw.set_window_title(self.window, f"landscape  {rate:.0f} fps")
            self._counted, self._counted_from = 0, glfw.get_time()

    def _save(self) -> str:
        """Save the frame under the next free name in the current folder; return what to say."""
        try:
            path = next_free("screenshot", ".png")
        except OSError:
            return texts.text(self._language, "not_saved")
        try:
            save_png(self.pixels(), path)
        except InputError:
            path.unlink(missing_ok=True)
            return texts.text(self._language, "not_saved")
        return texts.text(self._language, "saved", name=path.name)

    def close(self) -> None:
        """Release the words, the island and the window, in this order; may be called twice."""
        for owner in (self._panel, self._island, self._context):
            if owner is not None:
                owner.release()
        self._panel = self._island = self._context = None

    def __enter__(self) -> "Walk":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def next_free(stem: str, suffix: str, folder: Path | None = None) -> Path:
    """Make an empty file STEM-0001SUFFIX, or the next that does not exist; OSError if none can."""
    for number in itertools.count(1):
        path = (folder or Path()) / f"{stem}-{number:04}{suffix}"
        with suppress(FileExistsError):
            path.open("x").close()
            return path
    raise AssertionError("count() does not end")


def run(
    walk: Walk,
    ticks: Iterator[Tick] | None = None,
    recorder: Recorder | None = None,
    frames: int | None = None,
) -> int:
    """Walk live, or through ``ticks``, for at most ``frames``; return how many were drawn."""
    drawn = 0
    while frames is None or drawn < frames:
        if walk.resting():
            continue
        if ticks is None:
            tick = walk.listen()
        else:
            coming = next(ticks, None)
            tick = coming and walk.follow(coming)
        if tick is None:
            break
        if 0 in tick.size:
            continue
        if recorder is not None:
            recorder.add(tick)
        walk.advance(tick)
        walk.draw()
        walk.present()
        drawn += 1
    return drawn


def walk(
    settings: Settings,
    assets: Assets,
    view: str = "fig35e",
    size: tuple[int, int] = SIZE,
    fullscreen: bool = False,
    record: Path | None = None,
    replay: Path | None = None,
    frames: int | None = None,
    backend: str = "auto",
    only: tuple[str, ...] = ELEMENTS,
    seed: int = SEED,
    wireframe: bool = False,
    quiet: bool = False,
) -> int:
    """Walk the island in a window until the user leaves; return the exit status.

    Of ``view`` only the place and kt count: its switches are for stills.
    A replay takes everything but ``assets``, ``backend``, ``fullscreen`` and ``frames`` from its
    file. InputError and NoOpenGLError say what is wrong.
    """
    if backend == "egl":
        raise InputError("--backend egl: it opens no window; expected auto, glfw or osmesa")
    if backend == "osmesa" and frames is None and replay is None:
        raise InputError("--backend osmesa: no window to leave by; expected --frames as well")
    ticks = None
    if replay is not None:
        plan, recorded = read(replay)
        ticks = iter(recorded)
    else:
        named = VIEWS[view]
        plan = Plan(
            settings=settings,
            view=view,
            pose=named.pose,
            size=size,
            kt=named.kt,
            seed=seed,
            only=tuple(e for e in ELEMENTS if e in only),
            wireframe=wireframe,
            language=texts.language(os.environ),
        )
    recorder = Recorder(record, plan) if record is not None else None
    try:
        with Walk(plan, assets, backend, fullscreen) as opened:
            run(opened, ticks, recorder, frames)
    finally:
        # After Ctrl-C or an error the walk so far is worth keeping, to see what led there.
        kept = recorder is not None and recorder.finish()
    if kept and not quiet:
        print(record)
    return 0
