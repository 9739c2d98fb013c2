"""GLUT for a program that is run to a frame: a real window, but a main loop in Python.

freeglut opens the window, which needs a screen, and draws its shapes and letters. It is never given
the program's callbacks: the main loop here calls them, by the held clock, so that an exception in
one of them ends the program as it would end any other. A frame ends with glutSwapBuffers, or where
the display callback returns without it; in a window without double buffering, where any callback
returns that has drawn. A program that waits for somebody is asked to redraw.
"""

import os
import re
import sys
import types
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from framelens.base.errors import Message, NoOpenGLError
from framelens.gl import advice, display
from framelens.gl.contexts.glfw import check_thread
from framelens.gl.contexts.software import ask_for_software
from framelens.gl.foreign import library, load_glut
from framelens.gl.holders import replaced
from framelens.program.program_clock import milliseconds
from framelens.program.program_events import CONTROL, Event
from framelens.program.program_live import LiveWindow
from framelens.program.program_run import Run, Window
from framelens.program.program_source import ProgramError

# Functions that only matter to someone who looks at the window.
WITHOUT_EFFECT = (
    *("FullScreen", "FullScreenToggle", "LeaveFullScreen", "PositionWindow", "IconifyWindow"),
    *("HideWindow", "ShowWindow", "PushWindow", "PopWindow", "SetCursor", "IgnoreKeyRepeat"),
    *("SetKeyRepeat", "SetOption"),
)
# Callbacks after which the display callback comes anyway: they and it make one frame.
BEFORE_DISPLAY = ("Reshape", "Visibility", "WindowStatus")
# Functions that need a window of freeglut's own, and their answers where another one is shown.
OF_OWN_WINDOW = {
    **dict.fromkeys(("SetWindow", "SetWindowTitle", "SetIconTitle", "UseLayer", "SetMenu"), None),
    **dict.fromkeys(("AddMenuEntry", "AddSubMenu", "ChangeToMenuEntry", "DestroyMenu"), None),
    **dict.fromkeys(("ChangeToSubMenu", "RemoveMenuItem", "AttachMenu", "DetachMenu"), None),
    **{"GetWindow": 1, "CreateMenu": 1, "GetMenu": 0, "LayerGet": 0},
}
# Of glutInitDisplayMode.
DOUBLE = 2
DEPTH = 16
STEREO = 256
MULTISAMPLE = 128
# The buffers of a window in glutInitDisplayMode and in glutInitDisplayString, as GLFW names them.
BUFFERS = {
    "DEPTH_BITS": (DEPTH, "depth", 24),
    "STENCIL_BITS": (32, "stencil", 8),
    "ALPHA_BITS": (8, "alpha", 8),
    **{f"ACCUM_{each}_BITS": (4, "acc", 16) for each in ("RED", "GREEN", "BLUE", "ALPHA")},
}
FUNCTIONS = re.compile(r"glut\w+Func")
OTHER_FUNCTIONS = {"glutInitErrorFunc", "glutInitWarningFunc"}
SPECIAL = {
    **{f"F{number}": number for number in range(1, 13)},
    **{"LEFT": 100, "UP": 101, "RIGHT": 102, "DOWN": 103, "PAGE_UP": 104, "PAGE_DOWN": 105},
    **{"HOME": 106, "END": 107, "INSERT": 108},
    **{"LEFT_SHIFT": 112, "RIGHT_SHIFT": 113, "LEFT_CONTROL": 114, "RIGHT_CONTROL": 115},
    **{"LEFT_ALT": 116, "RIGHT_ALT": 117},
}
BUTTON_CODES = {"left": 0, "middle": 1, "right": 2}
MODIFIERS = {"shift": 1, "control": 2, "alt": 4}
# Of glutGet.
WINDOW_WIDTH = 102
WINDOW_HEIGHT = 103
DISPLAY_POSSIBLE = 400
ELAPSED_TIME = 700

IDLE = 0.001  # seconds of the held clock that a turn of the loop takes if it draws nothing; chosen
TURN = 0.02  # seconds that a turn of the loop waits for a timer at most, with a user; chosen
PATIENCE = 1000  # turns without a frame until the program is asked to redraw; chosen


@contextmanager
def glut_program(run: Run) -> Iterator[None]:
    """Prepare GLUT and PyOpenGL for a program, and replace GLUT's functions inside the block."""
    if run.backend in ("osmesa", "egl", "cgl"):
        raise NoOpenGLError(
            "{path}: GLUT needs a screen, it cannot draw by {backend}: use --backend glfw",
            path=run.source.path,
            backend=run.backend,
        )
    if run.backend == "software":
        ask_for_software()
    if sys.platform == "linux" and (reason := display.problem("x11", os.environ)):
        raise NoOpenGLError(
            "{path}: GLUT needs a screen ({reason}): use xvfb-run",
            path=run.source.path,
            reason=reason,
        )
    if sys.platform == "darwin":
        check_thread()
    if not load_glut(run.source.checked):
        raise ProgramError(
            "{path}: needs GLUT: {install}", path=run.source.path, install=advice.install("glut")
        )
    stand_in = _Glut(run, library("GLUT"))
    functions = stand_in.functions()

    def choose(module: str, name: str, value: object) -> object:
        # PyOpenGL holds the functions of GLUT itself in a module under raw.
        return functions.get(name) if module.startswith("OpenGL.GLUT") else None

    with replaced(("OpenGL.GLUT",), choose):
        try:
            yield
        finally:
            stand_in.close()


class _Glut:
    """Stands in for GLUT; the methods have the names of GLUT's functions."""

    def __init__(self, run: Run, glut: types.ModuleType) -> None:
        self._run = run
        self._real = types.SimpleNamespace(**vars(glut))
        self._callbacks: dict[str, Callable[..., object] | None] = {}
        self._timers: list[tuple[float, int, Callable[..., object], object]] = []
        self._ordered = 0  # timers so far: those due at once go in their order
        self._window = 0
        self._live: LiveWindow | None = None  # in the place of freeglut's window
        self._bits = {
            name: bits if name == "DEPTH_BITS" else 0 for name, (_, _, bits) in BUFFERS.items()
        }
        self._size = (300, 300)  # GLUT's default
        self._double_buffered = False
        self._posted = True  # whether a redraw is due
        self._reshaped = True  # whether the program has yet to learn the window's size
        self._shown = False  # whether it has learnt that the window is visible
        self._leaving = False
        self._ready = False
        self._quiet = 0  # turns of the loop since the last frame

        # Undo the choices of an earlier program in this process. They may come before glutInit.
        self._real.glutInitDisplayMode(DEPTH)  # freeglut's default
        self._real.glutInitWindowSize(*self._size)
        self._real.glutInitWindowPosition(-1, -1)
        self._forced = False  # whether the redraw that is due was asked for by nobody
        self._stirred = False  # whether a callback that may change something was called

    def functions(self) -> dict[str, object]:
        """Return the functions that take the place of GLUT's, by their names."""
        known = vars(self._real)
        own: dict[str, object] = {
            name: self._setter(name)
            for name in known
            if FUNCTIONS.fullmatch(name) and name not in OTHER_FUNCTIONS
        }
        own |= {f"glut{name}": (lambda *args: None) for name in WITHOUT_EFFECT}
        if self._run.live is not None:
            own |= {f"glut{name}": _answering(value) for name, value in OF_OWN_WINDOW.items()}
            own["glutSetWindowTitle"] = self._entitle
        own |= {name: getattr(self, name) for name in vars(type(self)) if name[0] != "_"}
        return {name: new for name, new in own.items() if name in known}

    def close(self) -> None:
        """Destroy the window."""
        if self._live is not None:
            self._run.closed()
            self._live.close()
            self._live, self._window = None, 0
        if self._window:
            self._run.drawing = False
            self._turn()  # a redraw that still waits would find no callback
            # freeglut destroys a window that is current; what was drawn to it then ends in an error
            # of the X server, which ends the process.
            library("contextdata").cleanupContext()
            if sys.platform == "linux":
                glx = library("GLX")
                glx.glXMakeCurrent(glx.glXGetCurrentDisplay(), 0, None)
            library("raw.GLUT").glutDestroyWindow(self._window)
            self._window = 0
            self._turn()

    def _turn(self) -> None:
        """Let GLUT itself do what is due; macOS's own has another name for it."""
        if self._real.glutMainLoopEvent:
            self._real.glutMainLoopEvent()
        else:
            library("GLUT.osx").glutCheckLoop()

    def _setter(self, name: str) -> Callable[..., object]:
        def set_callback(function: object = None, *args: object) -> None:
            # PyOpenGL takes None and 0 for no callback.
            self._callbacks[name[4:-4]] = function if callable(function) else None

        return set_callback

    def _call(self, callback: str, *args: object) -> bool:
        """Call a callback of the program; return whether it has one."""
        function = self._callbacks.get(callback)
        if function is not None and callback in BEFORE_DISPLAY:
            function(*args)
        elif function is not None:
            self._shows(function, *args)
        return function is not None

    def _shows(self, function: Callable[..., object], *args: object) -> None:
        """Call a function; end the frame if it draws in a window that shows it without a swap."""
        self._run.drew = False
        function(*args)
        if self._run.drew and self._run.drawing and not self._double_buffered:
            self._end_frame()

    def _end_frame(self, swaps: bool = False) -> None:
        """End a frame and begin the next; ``swaps``: its picture is behind the one that is seen."""
        if self._live is not None:
            self._live.end_frame(swaps or not self._double_buffered)
            return
        self._run.end_frame("swap" if swaps else "callback")
        if swaps:
            self._real.glutSwapBuffers()
        self._run.begin_frame()

    # Initialisation and the window.

    def glutInit(self, *args: object) -> object:
        self._run.check()
        self._ready = True
        return self._real.glutInit(*args)

    def glutInitDisplayMode(self, mode: int) -> None:
        self._double_buffered = bool(mode & DOUBLE)
        self._bits = {name: bits if mode & bit else 0 for name, (bit, _, bits) in BUFFERS.items()}
        self._real.glutInitDisplayMode(mode & ~MULTISAMPLE)

    def glutInitDisplayString(self, words: object) -> None:
        text = words.decode() if isinstance(words, bytes) else str(words)
        kept = [word for word in text.split() if not word.startswith("samples")]
        self._double_buffered = "double" in kept
        self._bits = {
            name: bits if any(each.startswith(word) for each in kept) else 0
            for name, (_, word, bits) in BUFFERS.items()
        }
        self._real.glutInitDisplayString(" ".join(kept).encode())

    def glutInitWindowSize(self, width: int, height: int) -> None:
        self._size = self._run.sized(width, height)
        self._real.glutInitWindowSize(width, height)

    def glutCreateWindow(self, title: object) -> int:
        run, real = self._run, self._real
        run.check()
        # freeglut would end the whole process.
        if not self._ready:
            raise run.refuse(Message("calls glutCreateWindow before glutInit"))
        if run.window is not None:
            raise run.second_window()
        if run.live is not None:
            return self._open_live(title)
        if not real.glutGet(DISPLAY_POSSIBLE):
            raise run.refuse(Message("asks glutInitDisplayMode for what this screen cannot do"))
        self._window = real.glutCreateWindow(title)
        real.glutDisplayFunc(_nothing)
        real.glutReshapeFunc(_nothing)
        size = lambda: self._size  # noqa: E731
        run.open(Window("glut", "glx", size, self._double_buffered))
        return self._window

    def _open_live(self, title: object) -> int:
        self._live = LiveWindow(
            self._run, self._size, _text(title), self._bits, self._double_buffered
        )
        self._window = 1
        self._run.open(self._live.described("glut"))
        return self._window

    def _entitle(self, title: object) -> None:
        if self._live is not None:
            self._live.entitle(_text(title))

    def glutCreateSubWindow(self, *args: object) -> int:
        raise self._run.second_window()

    def glutEnterGameMode(self) -> int:
        return self.glutCreateWindow(b"")

    def glutDestroyWindow(self, window: int) -> None:
        self.close()
        self._leaving = True

    def glutReshapeWindow(self, width: int, height: int) -> None:
        self._size = self._run.sized(width, height)
        if self._live is not None:
            self._live.resize(self._size)
        else:
            self._real.glutReshapeWindow(width, height)
            self._turn()  # freeglut only changes the size here
        self._posted = self._reshaped = True

    def glutSwapBuffers(self) -> None:
        self._end_frame(swaps=True)

    def glutPostRedisplay(self) -> None:
        self._posted, self._forced = True, False

    def glutPostWindowRedisplay(self, window: int) -> None:
        self.glutPostRedisplay()

    def glutGet(self, what: int) -> int:
        if what == ELAPSED_TIME:
            return milliseconds(self._run.clock)
        if what in (WINDOW_WIDTH, WINDOW_HEIGHT) and self._window:
            return self._size[what - WINDOW_WIDTH]
        return int(self._real.glutGet(what))

    def glutGetModifiers(self) -> int:
        return sum(MODIFIERS[mod] for mod in self._run.events.mods)

    def glutWarpPointer(self, x: int, y: int) -> None:
        self._run.events.mouse = float(x), float(y)

    # The main loop.

    def glutTimerFunc(self, wait: float, function: Callable[..., object], value: object) -> None:
        self._ordered += 1
        due = self._run.clock.now + max(0.0, wait) / 1000.0
        self._timers.append((due, self._ordered, function, value))

    def glutLeaveMainLoop(self) -> None:
        self._leaving = True

    def glutMainLoop(self) -> None:
        if not self._window:
            raise self._run.refuse(Message("calls glutMainLoop without a window"))
        while not self._leaving:
            self.glutMainLoopEvent()
        if not self._window:
            raise SystemExit(0)  # as freeglut does when the last window was closed

    def glutMainLoopEvent(self) -> None:
        run = self._run
        run.check()
        frames = run.frames
        self._tell_size()
        for event in run.live.events() if run.live else run.events.due(frames):
            self._deliver(event)
        self._call_timers()
        if self._posted and not self._leaving:
            self._display()
        if self._leaving:
            pass
        elif self._call("Idle"):
            self._stirred = True
        elif not self._posted:
            self._wait()

        self._quiet = 0 if run.frames > frames else self._quiet + 1
        if self._quiet:
            run.clock.move(IDLE)
        if self._quiet > PATIENCE and run.live is None:
            self._force()

    def _force(self) -> None:
        """Have the window redrawn, though the program has not asked for it."""
        self._forced = self._forced or not self._posted
        self._posted = True

    def _tell_size(self) -> None:
        if self._reshaped:
            self._reshaped = False
            if not self._call("Reshape", *self._size) and self._shown:
                library("GL").glViewport(0, 0, *self._size)  # so does freeglut
        if not self._shown:
            self._shown = True
            self._call("Visibility", 1)
            self._call("WindowStatus", 1)

    def _call_timers(self) -> None:
        due = sorted(timer for timer in self._timers if timer[0] <= self._run.clock.now + 1e-6)
        for timer in due:
            self._timers.remove(timer)
            self._stirred = True
            self._shows(timer[2], timer[3])

    def _display(self) -> None:
        run = self._run
        self._posted = False
        frames = run.frames
        showing = run.showing
        showing.forced = self._forced
        showing.stirred = self._stirred
        showing.again = False
        self._forced = False
        if not self._call("Display"):
            raise run.refuse(Message("has no display callback: it never calls glutDisplayFunc"))
        if run.frames == frames:
            self._end_frame()
        run.showing.again = False

    def _wait(self) -> None:
        """Pass the time until a timer is due, or ask for a redraw."""
        run = self._run
        if run.live is not None and self._timers:
            run.clock.move(min(TURN, max(0.0, min(self._timers)[0] - run.clock.now)))
        elif run.live is not None:
            events = run.live.events(wait=True)
            for event in events:
                self._deliver(event)
            self._posted |= not events
        elif self._timers:
            self._run.clock.now = max(self._run.clock.now, min(self._timers)[0])
        else:
            self._force()

    # Events.

    def _deliver(self, event: Event) -> None:
        self._stirred = True
        self._run.events.note(event)
        getattr(self, f"_{event.kind}")(event)

    def _place(self) -> tuple[int, int]:
        x, y = self._run.events.mouse
        return int(x), int(y)

    def _key(self, event: Event) -> None:
        way = "" if event.pressed else "Up"
        if event.name in SPECIAL:
            self._call(f"Special{way}", SPECIAL[event.name], *self._place())
            return
        pressed = Event(event.frame, "key", event.name, mods=event.mods)
        text = CONTROL.get(event.name) or pressed.text
        if text and "control" in event.mods and text.isalpha():
            text = chr(ord(text.upper()) - 64)
        if text:
            self._call(f"Keyboard{way}", text.encode("latin-1"), *self._place())

    def _button(self, event: Event) -> None:
        self._call("Mouse", BUTTON_CODES[event.name], int(not event.pressed), *self._place())

    def _move(self, event: Event) -> None:
        self._call("Motion" if self._run.events.buttons else "PassiveMotion", *self._place())

    def _scroll(self, event: Event) -> None:
        up = event.value[1]
        if up and not self._call("MouseWheel", 0, 1 if up > 0 else -1, *self._place()):
            for state in (0, 1):
                self._call("Mouse", 3 if up > 0 else 4, state, *self._place())

    def _resize(self, event: Event) -> None:
        if self._live is not None:  # the user has done it
            self._size = self._live.pixels()
            self._posted = self._reshaped = True
        else:
            self.glutReshapeWindow(int(event.value[0]), int(event.value[1]))
        self._tell_size()

    def _close(self, event: Event) -> None:
        if not self._call("Close"):
            self._call("WMClose")
        self.glutDestroyWindow(self._window)


def _answering(value: object) -> Callable[..., object]:
    return lambda *args: value


def _text(title: object) -> str:
    return title.decode(errors="replace") if isinstance(title, bytes) else str(title)


def _nothing(*args: object) -> None:
    """Take the place of a callback, in freeglut."""
