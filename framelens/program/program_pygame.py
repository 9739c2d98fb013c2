"""pygame for a program that is run to a frame: a hidden window, a held clock, events from a list.

Without a screen, SDL's driver "offscreen" draws by EGL. On one, a framebuffer object stands for the
framebuffer of the hidden window (framelens/gl/window_framebuffer.py). The program sees the events
of the list and those it posts itself; SDL's own are never read.
"""

import importlib.util
import os
import types
from collections.abc import Iterator
from contextlib import contextmanager
from types import ModuleType
from typing import Any

from framelens.base.errors import Message, NoOpenGLError
from framelens.gl.binding import use_platform
from framelens.gl.contexts.glfw import check_thread
from framelens.gl.contexts.software import ask_for_software
from framelens.gl.holders import replaced
from framelens.program.program_clock import Clock, milliseconds
from framelens.program.program_context import prepare, screen
from framelens.program.program_events import CONTROL, KEYS, Event
from framelens.program.program_live import LiveWindow
from framelens.program.program_run import Run, Window
from framelens.program.program_source import need_package

MODULES = ("display", "event", "key", "mouse", "time")
FALLBACK = (800, 600)  # pixels, the size of a window that is to fill the screen; chosen
# Where pygame's name of a key is not GLFW's in small letters; letters and digits are alike.
KEY_NAMES = {
    **{"ENTER": "RETURN", "PAGE_UP": "PAGEUP", "PAGE_DOWN": "PAGEDOWN", "APOSTROPHE": "QUOTE"},
    **{"EQUAL": "EQUALS", "LEFT_BRACKET": "LEFTBRACKET", "RIGHT_BRACKET": "RIGHTBRACKET"},
    **{"GRAVE_ACCENT": "BACKQUOTE", "CAPS_LOCK": "CAPSLOCK", "NUM_LOCK": "NUMLOCK"},
    **{"SCROLL_LOCK": "SCROLLLOCK", "PRINT_SCREEN": "PRINTSCREEN"},
    **{"LEFT_SHIFT": "LSHIFT", "RIGHT_SHIFT": "RSHIFT", "LEFT_CONTROL": "LCTRL"},
    **{"RIGHT_CONTROL": "RCTRL", "LEFT_ALT": "LALT", "RIGHT_ALT": "RALT"},
    **{"LEFT_SUPER": "LSUPER", "RIGHT_SUPER": "RSUPER"},
    **{f"KP_{digit}": f"KP{digit}" for digit in range(10)},
    **{"KP_ADD": "KP_PLUS", "KP_SUBTRACT": "KP_MINUS", "KP_DECIMAL": "KP_PERIOD"},
    **{"KP_EQUAL": "KP_EQUALS"},
}
BUTTON_CODES = {"left": 1, "middle": 2, "right": 3}
# On a screen GLX takes the deepest buffer there is, whatever the program asks; EGL the shallowest.
DEPTH_BITS = 24


@contextmanager
def pygame_program(run: Run) -> Iterator[None]:
    """Prepare pygame and PyOpenGL for a program; replace pygame's functions inside the block."""
    need_package("pygame", run.source.path)
    pygame = _silent()
    stand_in = _Pygame(run, pygame, _choose(run, pygame))
    functions = {id(old): new for old, new in stand_in.functions()}
    with replaced(("pygame",), lambda module, name, value: functions.get(id(value))):
        try:
            yield
        finally:
            run.closed()
            stand_in.quit()


def _silent() -> ModuleType:
    """Import pygame: it prints nothing, and plays into nothing."""
    os.environ["PYGAME_HIDE_SUPPORT_PROMPT"] = "1"
    os.environ["SDL_AUDIODRIVER"] = "dummy"
    import pygame

    return pygame


@contextmanager
def pygame_beside(run: Run) -> Iterator[None]:
    """Hold pygame's clocks in a program whose window another toolkit opens.

    It has pygame for its sound or its pictures. SDL opens no window then.
    """
    if importlib.util.find_spec("pygame") is None:
        yield  # the program's own import will say so
        return
    os.environ["SDL_VIDEODRIVER"] = "dummy"
    pygame = _silent()
    functions = {id(old): new for old, new in _held_times(run, pygame)}
    with replaced(("pygame",), lambda module, name, value: functions.get(id(value))):
        try:
            yield
        finally:
            pygame.quit()


def _held_times(run: Run, pygame: ModuleType) -> Iterator[tuple[object, object]]:
    """Yield each function of pygame that reads the clock or waits, and its held form."""
    clock, times = run.clock, pygame.time

    def wait(duration: int) -> int:
        clock.move(duration / 1000.0)
        return int(duration)

    yield times.Clock, lambda: _HeldClock(clock)
    yield times.get_ticks, lambda: milliseconds(clock)
    yield times.wait, wait
    yield times.delay, wait


def _tried(run: Run, pygame: ModuleType, driver: str, platform: str) -> str:
    """Open a window with a driver of SDL, and bind PyOpenGL to it; return why it fails, or ""."""
    if driver != "native":
        os.environ["SDL_VIDEODRIVER"] = driver
    try:
        pygame.display.quit()
        pygame.display.init()
        pygame.display.set_mode((16, 16), pygame.OPENGL | pygame.HIDDEN)
        use_platform(platform, run.source.checked)
    except (pygame.error, NoOpenGLError) as error:
        return f"{driver}: {error}"
    finally:
        pygame.display.quit()
    return ""


def _choose(run: Run, pygame: ModuleType) -> str:
    """Choose SDL's driver and bind PyOpenGL to the same; return the backend's name."""
    if run.live is not None:
        os.environ["SDL_VIDEODRIVER"] = "dummy"  # the window that is seen is one of GLFW
        prepare("glfw", run.source.checked)
        return "glfw"

    refused = {"osmesa": "OSMesa", "cgl": "CGL"}
    if run.backend in refused:
        raise NoOpenGLError(
            "{path}: pygame draws by EGL or on a screen, not by {library}",
            path=run.source.path,
            library=refused[run.backend],
        )
    if run.backend == "software":
        ask_for_software()
    kind, reason = screen()
    ways = {"egl": ("offscreen", "egl"), "glfw": (kind, {"x11": "glx"}.get(kind, kind))}
    order = ["glfw", "egl"] if "glut" in run.source.modules else ["egl", "glfw"]
    if kind == "native":
        # SDL knows its driver there, and has none that draws by EGL.
        ways, order = {"glfw": ("native", "native")}, ["glfw"]
        check_thread()

    reasons = []
    for backend in order if run.backend in ("auto", "software") else [run.backend]:
        driver, platform = ways.get(backend, ("", ""))
        if not driver:
            reasons.append(reason or "SDL has no EGL on this system")
            continue
        refusal = _tried(run, pygame, driver, platform)
        if not refusal:
            return backend
        reasons.append(refusal)

    why = "; ".join(reasons)
    raise NoOpenGLError(
        "{path}: pygame opens no window for OpenGL here ({why})", path=run.source.path, why=why
    )


class _Pygame:
    """Stands in for pygame; the methods are named after module and function."""

    def __init__(self, run: Run, pygame: ModuleType, backend: str) -> None:
        self._run = run
        self._pygame = pygame
        self._backend = backend
        self._real = types.SimpleNamespace(
            quit=pygame.quit,
            **{name: types.SimpleNamespace(**vars(getattr(pygame, name))) for name in MODULES},
        )

        self._size = FALLBACK
        self._events: list[Any] = []
        self._timers: list[list[Any]] = []  # due, interval, event, how often still
        self._depth_bits = DEPTH_BITS  # to ask for
        self._asked: dict[int, int] = {}  # all that gl_set_attribute asked for
        self._live: LiveWindow | None = None  # the window that the user sees, if there is a user
        self._repeats = False  # whether a key held down is pressed again and again
        self._moved = (0.0, 0.0)  # where the mouse was when get_rel was last asked

        self._codes: dict[str, int] = {
            name: int(
                getattr(pygame, f"K_{KEY_NAMES.get(name, name)}", 0)
                or getattr(pygame, f"K_{name.lower()}", 0)
            )
            for name in KEYS
        }
        self._mods = {"shift": pygame.KMOD_LSHIFT, "control": pygame.KMOD_LCTRL}
        self._mods["alt"] = pygame.KMOD_LALT

    def functions(self) -> Iterator[tuple[object, object]]:
        """Yield each function of pygame that is replaced, and what takes its place."""
        yield from _held_times(self._run, self._pygame)
        for name in vars(type(self)):
            module, _, function = name.partition("_")
            held = getattr(self._real, module, None)
            if hasattr(held, function):
                yield getattr(held, function), getattr(self, name)

    def quit(self) -> None:
        """Close the window and end pygame."""
        if self._live is not None:
            self._live.close()
            self._live = None
        self._real.quit()

    # The window.

    def display_set_mode(
        self, size: Any = (0, 0), flags: int = 0, depth: int = 0, display: int = 0, vsync: int = 0
    ) -> Any:
        pygame, run = self._pygame, self._run
        run.check()
        if not flags & pygame.OPENGL:
            raise run.refuse(Message("opens its pygame window without the flag pygame.OPENGL"))
        self._size = run.sized(*map(int, size[:2])) if size and all(size) else FALLBACK
        if not self._real.display.get_init():
            self._real.display.init()  # so does pygame's own set_mode
        flags &= ~(pygame.FULLSCREEN | getattr(pygame, "SCALED", 0) | pygame.SHOWN)
        if run.live is not None:
            return self._set_live_mode(flags)
        for attribute in (pygame.GL_MULTISAMPLEBUFFERS, pygame.GL_MULTISAMPLESAMPLES):
            self._real.display.gl_set_attribute(attribute, 0)
        self._real.display.gl_set_attribute(pygame.GL_DEPTH_SIZE, self._depth_bits)
        surface = self._real.display.set_mode(self._size, flags | pygame.HIDDEN)
        if run.window is None:
            hidden = self._backend == "glfw"
            run.open(Window("pygame", self._backend, lambda: self._size, hidden=hidden))
        return surface

    def _set_live_mode(self, flags: int) -> Any:
        """Open GLFW's window, or change its size; return a surface of SDL's, which is not seen."""
        pygame, run = self._pygame, self._run
        surface = self._real.display.set_mode(
            self._size, flags & ~(pygame.OPENGL | pygame.DOUBLEBUF)
        )
        if self._live is not None:
            if self._live.pixels() != self._size:
                self._live.resize(self._size)
            return surface

        bits = {"DEPTH_BITS": self._depth_bits}
        for name in ("STENCIL", "ALPHA", "ACCUM_RED", "ACCUM_GREEN", "ACCUM_BLUE", "ACCUM_ALPHA"):
            bits[f"{name}_BITS"] = self._asked.get(getattr(pygame, f"GL_{name}_SIZE"), 0)
        hints = {
            name: self._asked[flag]
            for name, flag in (
                ("CONTEXT_VERSION_MAJOR", pygame.GL_CONTEXT_MAJOR_VERSION),
                ("CONTEXT_VERSION_MINOR", pygame.GL_CONTEXT_MINOR_VERSION),
            )
            if flag in self._asked
        }
        title = self._real.display.get_caption() or ("pygame",)
        self._live = LiveWindow(run, self._size, str(title[0]), bits, hints=hints)
        run.open(self._live.described("pygame"))
        return surface

    def display_set_caption(self, title: object, icontitle: object = None) -> None:
        self._real.display.set_caption(title)
        if self._live is not None:
            self._live.entitle(str(title))

    def display_gl_set_attribute(self, flag: int, value: int) -> None:
        self._asked[flag] = value
        if flag == self._pygame.GL_DEPTH_SIZE:
            self._depth_bits = max(value, DEPTH_BITS) if value else 0
        self._real.display.gl_set_attribute(flag, value)

    def display_flip(self) -> None:
        if self._live is not None:
            self._live.end_frame()
            return
        self._run.end_frame()
        if self._run.framebuffer is None:
            self._real.display.flip()
        self._run.begin_frame()

    def display_update(self, *args: object) -> None:
        self.display_flip()

    def display_toggle_fullscreen(self) -> int:
        return 1

    def display_get_active(self) -> bool:
        return True

    # Time, as far as it is events.

    def time_set_timer(self, event: object, millis: int, loops: int = 0) -> None:
        kind = getattr(event, "type", event)
        self._timers = [timer for timer in self._timers if timer[2].type != kind]
        if millis > 0:
            what = event if hasattr(event, "type") else self._pygame.event.Event(event)
            due = self._run.clock.now + millis / 1000.0
            self._timers.append([due, millis / 1000.0, what, loops or -1])

    # Events.

    def event_pump(self) -> None:
        self._run.check()
        self._run.polled()
        live = self._run.live
        for event in live.events() if live else self._run.events.due(self._run.frames):
            self._deliver(event)
        for timer in self._timers:
            while timer[3] and timer[0] <= self._run.clock.now:
                self._events.append(timer[2])
                timer[0] += timer[1]
                timer[3] -= 1

    def event_get(
        self, eventtype: object = None, pump: object = True, exclude: object = None
    ) -> list[object]:
        if pump:
            self.event_pump()
        taken = [event for event in self._events if _among(event, eventtype, exclude)]
        self._events = [event for event in self._events if event not in taken]
        return taken

    def event_poll(self) -> object:
        self.event_pump()
        return self._events.pop(0) if self._events else self._event("NOEVENT")

    def event_wait(self, timeout: int = 0) -> object:
        self.event_pump()
        if not self._events and timeout:
            self._run.clock.move(timeout / 1000.0)
            return self.event_poll()
        if not self._events:
            live, queue = self._run.live, self._run.events
            for event in live.events(wait=True) if live else queue.awaited(self._run.frames):
                self._deliver(event)
        # A program that waits for somebody is asked to redraw.
        return self._events.pop(0) if self._events else self._event("VIDEOEXPOSE")

    def event_peek(self, eventtype: object = None, pump: object = True) -> object:
        if pump:
            self.event_pump()
        return any(_among(event, eventtype, None) for event in self._events)

    def event_clear(self, eventtype: object = None, pump: object = True) -> None:
        self.event_get(eventtype, pump)

    def event_post(self, event: object) -> bool:
        self._events.append(event)
        return True

    def event_set_grab(self, grab: object) -> None:
        pass

    def key_get_pressed(self) -> object:
        self._run.check()
        return _Pressed({self._codes[name] for name in self._run.events.keys})

    def key_get_mods(self) -> int:
        return sum(self._mods[mod] for mod in self._run.events.mods)

    def key_set_repeat(self, *times: int) -> None:
        self._repeats = bool(times and times[0])

    def key_get_focused(self) -> bool:
        return True

    def mouse_get_pos(self) -> tuple[int, int]:
        x, y = self._run.events.mouse
        return int(x), int(y)

    def mouse_get_rel(self) -> tuple[int, int]:
        (x, y), (old_x, old_y) = self._run.events.mouse, self._moved
        self._moved = self._run.events.mouse
        return int(x - old_x), int(y - old_y)

    def mouse_get_pressed(self, num_buttons: int = 3) -> tuple[bool, ...]:
        down = self._run.events.buttons
        return tuple(name in down for name in ("left", "middle", "right")) + (False,) * (
            num_buttons - 3
        )

    def mouse_get_focused(self) -> bool:
        return True

    def mouse_set_pos(self, *at: Any) -> None:
        x, y = at if len(at) == 2 else at[0]
        self._run.events.mouse = float(x), float(y)

    def mouse_set_visible(self, visible: object) -> bool:
        return True

    def _event(self, kind: str, **values: Any) -> Any:
        return self._pygame.event.Event(getattr(self._pygame, kind), **values)

    def _deliver(self, event: Event) -> None:
        before = self._run.events.mouse
        self._run.events.note(event)
        self._events += getattr(self, f"_{event.kind}")(event, before)

    def _key(self, event: Event, before: tuple[float, float]) -> list[object]:
        if event.action == "repeat" and not self._repeats:
            return []
        written = event.text or CONTROL.get(event.name, "")
        values = {"key": self._codes[event.name], "mod": self.key_get_mods(), "unicode": written}
        found = [self._event("KEYDOWN" if event.pressed else "KEYUP", **values, scancode=0)]
        return found + ([self._event("TEXTINPUT", text=event.text)] if event.text else [])

    def _button(self, event: Event, before: tuple[float, float]) -> list[object]:
        kind = "MOUSEBUTTONDOWN" if event.pressed else "MOUSEBUTTONUP"
        code = BUTTON_CODES[event.name]
        return [self._event(kind, pos=self.mouse_get_pos(), button=code, touch=False)]

    def _move(self, event: Event, before: tuple[float, float]) -> list[object]:
        rel = int(event.value[0] - before[0]), int(event.value[1] - before[1])
        buttons = tuple(map(int, self.mouse_get_pressed()))
        values = {"pos": self.mouse_get_pos(), "rel": rel, "buttons": buttons, "touch": False}
        return [self._event("MOUSEMOTION", **values)]

    def _scroll(self, event: Event, before: tuple[float, float]) -> list[object]:
        x, y = map(int, event.value)
        found = [self._event("MOUSEWHEEL", x=x, y=y, flipped=False, touch=False)]
        if y:
            for kind in ("MOUSEBUTTONDOWN", "MOUSEBUTTONUP"):
                values = {"pos": self.mouse_get_pos(), "button": 4 if y > 0 else 5, "touch": False}
                found.append(self._event(kind, **values))
        return found

    def _resize(self, event: Event, before: tuple[float, float]) -> list[object]:
        width, height = map(int, event.value)
        if self._live is not None:  # the user has done it
            width, height = self._size = self._live.pixels()
            return [self._event("VIDEORESIZE", size=self._size, w=width, h=height)]
        from pygame._sdl2.video import Window as SDLWindow

        SDLWindow.from_display_module().size = self._size = (width, height)
        if self._run.framebuffer is not None:
            self._run.framebuffer.resize(self._size)
        return [self._event("VIDEORESIZE", size=self._size, w=width, h=height)]

    def _close(self, event: Event, before: tuple[float, float]) -> list[object]:
        return [self._event("QUIT")]


def _among(event: Any, kinds: object, excluded: object) -> bool:
    """Return whether an event is of some types, given one or several, or None for all."""

    def within(types: object) -> bool:
        return event.type in (types if isinstance(types, (list, tuple, set)) else (types,))

    return (kinds is None or within(kinds)) and not (excluded is not None and within(excluded))


class _Pressed:
    """The state of the keyboard, asked for by a key's code."""

    def __init__(self, codes: set[int]) -> None:
        self._codes = codes

    def __getitem__(self, code: int) -> bool:
        return code in self._codes

    def __len__(self) -> int:
        return 512  # as pygame's

    def __iter__(self) -> Iterator[bool]:
        return (code in self._codes for code in range(len(self)))


class _HeldClock:
    """pygame.time.Clock on the held clock."""

    def __init__(self, clock: Clock) -> None:
        self._clock = clock
        self._last = clock.now
        self._passed = self._spent = 0

    def tick(self, framerate: float = 0) -> int:
        """Wait until 1/framerate s after the last call; return how many ms after it this is."""
        now = self._clock.read()
        self._spent = int((now - self._last) * 1000.0 + 1e-6)
        if framerate > 0:
            # pygame waits whole milliseconds.
            self._clock.move(self._last + int(1000.0 / framerate) / 1000.0 - now)
        now = self._clock.now
        self._passed = int((now - self._last) * 1000.0 + 1e-6)
        self._last = now
        return self._passed

    tick_busy_loop = tick

    def get_time(self) -> int:
        """Return the milliseconds between the last two calls of tick."""
        return self._passed

    def get_rawtime(self) -> int:
        """Return the same without waiting."""
        return self._spent

    def get_fps(self) -> float:
        """Return the frames in a second."""
        return 1000.0 / self._passed if self._passed else 0.0
