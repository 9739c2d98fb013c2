"""GLFW for a program that is run to a frame: a hidden window, a held clock, events from a list.

Without a screen, GLFW's null platform gives the window and OSMesa draws in it, or EGL does, into a
buffer of the window's size. On a screen the window is hidden, and a framebuffer object of the size
that the program asks for stands for its own (framelens/gl/window_framebuffer.py); so it does with
CGL, which has none. The program's callbacks are never given to GLFW: they are called here, when it
polls for events.
"""

import types
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from framelens.base.errors import NoOpenGLError
from framelens.gl.contexts import egl, osmesa
from framelens.gl.contexts.cgl import CGLContext
from framelens.gl.contexts.egl import EGLContext
from framelens.gl.contexts.glfw import check_thread
from framelens.gl.holders import replaced
from framelens.gl.named import glfw_constant
from framelens.gl.raw import raw
from framelens.program.program_context import bind
from framelens.program.program_events import BUTTONS, KEYS, MODS, Event
from framelens.program.program_run import Run, Window
from framelens.program.program_source import need_package

# Functions that set a callback; those for errors and devices are GLFW's own.
CALLBACKS = (
    *("window_pos", "window_size", "window_close", "window_refresh", "window_focus"),
    *("window_iconify", "window_maximize", "framebuffer_size", "window_content_scale"),
    *("key", "char", "char_mods", "mouse_button", "cursor_pos", "cursor_enter", "scroll", "drop"),
)
# Functions that a hidden window cannot perform and a picture does not need.
WITHOUT_EFFECT = (
    *("show_window", "hide_window", "focus_window", "iconify_window", "maximize_window"),
    *("restore_window", "request_window_attention", "set_window_pos", "set_window_icon"),
    *("set_cursor", "set_window_opacity", "post_empty_event", "swap_interval"),
    *("set_window_aspect_ratio", "set_window_size_limits", "set_window_attrib"),
)


@contextmanager
def glfw_program(run: Run) -> Iterator[None]:
    """Prepare GLFW and PyOpenGL for a program, and replace GLFW's functions inside the block."""
    need_package("glfw", run.source.path)
    from framelens.gl.glfw_library import glfw

    stand_in = _Glfw(run, glfw, bind(run.source, run.backend))
    functions = {id(getattr(glfw, name)): new for name, new in stand_in.functions().items()}
    with replaced(("glfw",), lambda module, name, value: functions.get(id(value))):
        try:
            yield
        finally:
            stand_in.terminate()


class _Glfw:
    """Stands in for GLFW. The public methods have the names of GLFW's functions."""

    def __init__(self, run: Run, glfw: types.ModuleType, backend: str) -> None:
        self._run = run
        self._real = types.SimpleNamespace(**vars(glfw))
        self._backend = backend
        self._host = run.host
        self._own: EGLContext | CGLContext | None = None  # the context, where GLFW makes none
        self._window: object = None
        self._size = 0, 0  # that the program has asked for
        self._current: object = None  # the window, while its context of EGL is current
        self._callbacks: dict[str, Callable[..., object]] = {}
        self._closing = False
        self._started = 0.0  # where get_time counts from, in seconds of the held clock
        self._modes: dict[int, int] = {}
        self._double_buffered = True
        self._keys = {glfw_constant(glfw, f"KEY_{key}"): key for key in KEYS}
        self._codes = {key: code for code, key in self._keys.items()}
        self._mods = {mod: getattr(glfw, f"MOD_{mod.upper()}") for mod in MODS}

    def functions(self) -> dict[str, object]:
        """Return the functions that take the place of GLFW's, by their names."""
        known = vars(self._real)
        own = {name: getattr(self, name) for name in vars(type(self)) if name[0] != "_"}
        own |= {f"set_{name}_callback": self._setter(name) for name in CALLBACKS}
        own |= {name: (lambda *args: None) for name in WITHOUT_EFFECT}
        return {name: new for name, new in own.items() if name in known}

    def _setter(self, name: str) -> Callable[..., object]:
        def set_callback(window: Any, function: Any) -> Any:
            before = self._callbacks.get(name)
            self._callbacks[name] = function
            return before

        return set_callback

    def _call(self, callback: str, *args: object) -> None:
        function = self._callbacks.get(callback)
        if function is not None:
            function(self._window, *args)

    # The library, its window and its context.

    def init(self) -> bool:
        real = self._real
        self._run.check()
        if self._host is not None:
            return True
        if self._backend != "glfw":
            real.init_hint(real.PLATFORM, real.PLATFORM_NULL)
        else:
            check_thread()
        if not real.init():
            raise self._run.stop(NoOpenGLError("GLFW cannot open the screen that DISPLAY names"))
        self._started = self._run.clock.now
        return True

    def init_hint(self, hint: int, value: int) -> None:
        if hint != self._real.PLATFORM:
            self._real.init_hint(hint, value)

    def terminate(self) -> None:
        self.destroy_window(self._window)
        if self._host is None:
            self._real.terminate()

    def default_window_hints(self) -> None:
        self._double_buffered = True
        self._real.default_window_hints()

    def window_hint(self, hint: int, value: int) -> None:
        if hint == self._real.DOUBLEBUFFER:
            self._double_buffered = bool(value)
        self._real.window_hint(hint, value)

    def _hint(self) -> None:
        """Ask for a window of the backend's kind, without antialiasing; only a live one is seen."""
        real = self._real
        real.window_hint(real.VISIBLE, self._run.live is not None)
        real.window_hint(real.SAMPLES, 0)
        if self._backend == "osmesa":
            real.window_hint(real.CONTEXT_CREATION_API, real.OSMESA_CONTEXT_API)
        elif self._backend != "glfw":
            real.window_hint(real.CLIENT_API, real.NO_API)
        else:
            real.window_hint(real.CONTEXT_CREATION_API, real.NATIVE_CONTEXT_API)

    def create_window(
        self, width: int, height: int, title: object, monitor: object, share: object
    ) -> object:
        real = self._real
        self._run.check()
        if self._run.window is not None or self._window is not None:
            raise self._run.second_window()
        if self._host is not None:
            self._run.sized(width, height)
            self._window = self._host.window
            if self._run.live is not None:
                self._run.live.attach(real, self._window, self._keys)
            return self._window

        self._hint()
        self._size = self._run.sized(width, height)
        self._window = real.create_window(*self._size, title, None, None)
        if self._backend == "osmesa":
            osmesa.leave()
        if not self._window:
            self._run.reason = f"GLFW: {real.get_error()[1]!s}"
        elif self._run.live is not None:
            self._run.live.attach(real, self._window, self._keys)

        return self._window

    def destroy_window(self, window: object) -> None:
        if self._window:
            self._run.closed()
            if self._host is not None:
                self._real.set_input_mode(self._window, self._real.CURSOR, self._real.CURSOR_NORMAL)
                self._window = None
                return
            if self._own is not None:
                self._own.release()
            elif self._backend == "osmesa" and self._run.window is not None:
                # Mesa crashes if a context goes before it has drawn everything.
                self._real.make_context_current(self._window)
                raw.glFinish()
            self._real.destroy_window(self._window)
        self._window = self._own = None

    def make_context_current(self, window: object) -> None:
        self._run.check()
        if self._backend in ("osmesa", "glfw"):
            self._real.make_context_current(window)
            if not window and self._backend == "osmesa":
                osmesa.leave()
        elif window:
            self._own = self._own or self._context(window)
            self._own.make_current()
        elif self._own is not None:
            self._own.leave()
        self._current = window
        if window and self._run.window is None:
            self._run.open(self._described(window))

    def _context(self, window: object) -> EGLContext | CGLContext:
        if self._backend == "cgl":
            return CGLContext()
        return EGLContext(self._real.get_framebuffer_size(window))

    def _described(self, window: Any) -> Window:
        unseen = self._host is None and self._run.live is None
        hidden = self._backend == "cgl" or (self._backend == "glfw" and unseen)
        doubled = self._double_buffered or self._own is not None or self._host is not None
        size = (lambda: self._size) if hidden else lambda: self.get_framebuffer_size(window)
        return Window("glfw", self._backend, size, doubled, hidden)

    def get_current_context(self) -> object:
        return self._current if self._own else self._real.get_current_context()

    def get_proc_address(self, name: str) -> object:
        if self._backend != "egl":
            return self._real.get_proc_address(name)
        return egl.library().eglGetProcAddress(name.encode())

    def swap_buffers(self, window: object) -> None:
        self._run.end_frame()
        if self._own is None and self._run.framebuffer is None:
            self._real.swap_buffers(self._window)
        self._run.begin_frame()

    def get_framebuffer_size(self, window: object) -> tuple[int, int]:
        if self._host is not None:
            return self._host.pixels()
        if self._run.framebuffer is not None:
            return self._size
        width, height = self._real.get_framebuffer_size(self._window)
        return width, height

    def get_window_content_scale(self, window: object) -> object:
        if self._run.framebuffer is not None:
            return 1.0, 1.0
        return self._real.get_window_content_scale(self._window)

    def get_window_size(self, window: object) -> object:
        if self._host is not None:
            return self._host.area()
        return self._real.get_window_size(self._window)

    def set_window_title(self, window: object, title: object) -> None:
        if self._host is None:
            self._real.set_window_title(self._window, title)

    def set_window_size(self, window: object, width: int, height: int) -> None:
        if self._host is None:
            if self._run.window is not None:
                self._run.window.resized = True
            self._change_size(width, height)

    def _change_size(self, width: int, height: int) -> None:
        real = self._real
        width, height = self._run.sized(width, height)
        real.set_window_size(self._window, width, height)
        real.poll_events()  # where there is a screen, the size changes only now
        self._size = width, height
        if self._run.framebuffer is not None:
            self._run.framebuffer.resize(self._size)
        elif isinstance(self._own, EGLContext):
            self._own.resize(self._size)
        elif self._run.drawing:
            raw.glFinish()  # Mesa may still draw into the old buffer, which now goes
            real.make_context_current(self._window)  # OSMesa gets a buffer of the new size
        self._tell_size(width, height)

    def _tell_size(self, width: int, height: int) -> None:
        self._call("window_size", width, height)
        self._call("framebuffer_size", *self.get_framebuffer_size(self._window))
        self._call("window_refresh")

    def set_window_monitor(
        self, window: object, monitor: object, x: int, y: int, width: int, height: int, rate: int
    ) -> None:
        self.set_window_size(window, width, height)

    def get_window_monitor(self, window: object) -> object:
        return None

    def get_window_attrib(self, window: object, attribute: int) -> int:
        real = self._real
        if attribute in (real.VISIBLE, real.FOCUSED, real.HOVERED):
            return int(real.TRUE)
        if attribute == real.ICONIFIED:
            return int(real.FALSE)
        return int(real.get_window_attrib(self._window, attribute))

    def window_should_close(self, window: object) -> bool:
        self._run.check()
        return self._closing

    def set_window_should_close(self, window: object, value: bool) -> None:
        self._closing = bool(value)

    # Time.

    def get_time(self) -> float:
        return self._run.clock.read() - self._started

    def set_time(self, seconds: float) -> None:
        self._started = self._run.clock.now - seconds

    def get_timer_value(self) -> int:
        return round(self._run.clock.read() * 10**9)

    def get_timer_frequency(self) -> int:
        return 10**9

    # Events.

    def poll_events(self) -> None:
        self._run.check()
        self._run.polled()
        live = self._run.live
        self._deliver(live.events() if live else self._run.events.due(self._run.frames))

    def wait_events(self) -> None:
        self._run.check()
        self._run.polled()
        live = self._run.live
        events = live.events(wait=True) if live else self._run.events.awaited(self._run.frames)
        if events:
            self._deliver(events)
        else:
            self._call("window_refresh")  # so that a program that waits draws again

    def wait_events_timeout(self, seconds: float) -> None:
        if self._host is not None:
            self._real.wait_events_timeout(seconds)
        self._run.clock.move(seconds)
        self.poll_events()

    def _deliver(self, events: list[Event]) -> None:
        for event in events:
            self._run.events.note(event)
            getattr(self, f"_{event.kind}")(event)

    def _action(self, event: Event) -> tuple[int, int]:
        action = getattr(self._real, event.action.upper())
        return action, sum(self._mods[mod] for mod in event.mods)

    def _key(self, event: Event) -> None:
        action, mods = self._action(event)
        code = self._codes[event.name]
        self._call("key", code, self._real.get_key_scancode(code), action, mods)
        if event.text and not event.mods & {"control", "alt"}:
            self._call("char", ord(event.text))
            self._call("char_mods", ord(event.text), mods)

    def _button(self, event: Event) -> None:
        button = glfw_constant(self._real, f"MOUSE_BUTTON_{event.name.upper()}")
        self._call("mouse_button", button, *self._action(event))

    def _move(self, event: Event) -> None:
        self._call("cursor_pos", *map(float, event.value))

    def _scroll(self, event: Event) -> None:
        self._call("scroll", *map(float, event.value))

    def _resize(self, event: Event) -> None:
        if self._host is None:
            self._change_size(*map(int, event.value))
        else:
            self._tell_size(*self._host.area())

    def _close(self, event: Event) -> None:
        self._closing = True
        self._call("window_close")

    def get_key(self, window: object, key: int) -> int:
        down = self._keys.get(key) in self._run.events.keys
        return int(self._real.PRESS if down else self._real.RELEASE)

    def get_mouse_button(self, window: object, button: int) -> int:
        names = {glfw_constant(self._real, f"MOUSE_BUTTON_{n.upper()}"): n for n in BUTTONS}
        down = names.get(button) in self._run.events.buttons
        return int(self._real.PRESS if down else self._real.RELEASE)

    def get_cursor_pos(self, window: object) -> tuple[float, float]:
        return self._run.events.mouse

    def set_cursor_pos(self, window: object, x: float, y: float) -> None:
        self._run.events.mouse = float(x), float(y)

    def get_input_mode(self, window: object, mode: int) -> int:
        default = self._real.CURSOR_NORMAL if mode == self._real.CURSOR else 0
        return self._modes.get(mode, int(default))

    def set_input_mode(self, window: object, mode: int, value: int) -> None:
        self._modes[mode] = value
        if self._host is not None and mode == self._real.CURSOR:
            self._real.set_input_mode(self._window, mode, value)
