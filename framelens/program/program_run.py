"""A program while it runs: its window, its frames, who watches it, and why it ended.

The modules of the toolkits (program_glfw.py and its like) tell a :class:`Run` what the program does
with its window: that it opens, that a frame begins or is shown, that it is closed. program.py makes
the run.
"""

import os
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from types import FrameType, ModuleType, SimpleNamespace
from typing import Any, Protocol

from framelens.base.arguments import size
from framelens.base.errors import InputError, Message, short
from framelens.gl.contexts.glfw import no_context
from framelens.gl.contexts.software import check_renderer
from framelens.gl.extensions import profile_mask
from framelens.gl.notes import qualified
from framelens.gl.seam import Site, gl, unrecorded, use_lists
from framelens.gl.window_framebuffer import WindowFramebuffer
from framelens.program.program_clock import Clock
from framelens.program.program_events import Event, Queue
from framelens.program.program_process import Unwind
from framelens.program.program_source import ProgramError, Source
from framelens.program.watchdog import Watchdog

# Chosen: turns of a loop that draws without a swap until it counts as one that never swaps.
POLLS = 2

Chain = tuple[tuple[str, int], ...]
"""The lines of a program that led to a call, (function, line), the outermost first."""


EarlyCall = tuple[str, tuple[Any, ...], Any, Site]
"""A call without a context: its function, arguments, result and line."""


Library = ModuleType | SimpleNamespace
"""GLFW as it is, or a copy of what is in it."""


def chain(frame: FrameType | None, path: str) -> Chain:
    """Return the program's lines that led to a call, the outermost first."""
    lines: list[tuple[str, int]] = []
    while frame is not None:
        if frame.f_code.co_filename == path:
            lines.append((qualified(frame.f_code), frame.f_lineno))
        frame = frame.f_back
    return tuple(reversed(lines))


@dataclass
class Showing:
    """How the program shows its frames, which is what a window on a screen goes by.

    ``way`` says what ended the frame: "swap"; "flush", of a single-buffered window; "callback", a
    display callback of GLUT that returned without a swap; "never", a loop that draws, asks for
    events and swaps nothing. ``line`` is the program's line that did so, 0 if none.
    """

    way: str = ""
    line: int = 0
    forced: bool = False  # nobody asked for this redraw: a window would not show it
    stirred: bool = False  # timers, the idle callback or events have come before it
    again: bool = False  # the display callback, or the loop, has shown a frame before this one
    flushed: bool = False  # glFlush or glFinish since the frame began


@dataclass
class Window:
    """The program's window. ``size()`` is that of what it draws to, in pixels.

    ``early``: the first function that was called without a context, in vain, and the line.
    ``resized``: whether the program itself has changed its size since it was opened.
    """

    toolkit: str  # glfw, glut, pygame or qt
    backend: str  # osmesa, egl or cgl: without a screen; glfw: on one
    size: Callable[[], tuple[int, int]]
    double_buffered: bool = True
    hidden: bool = False  # on a screen, and not shown; or without a framebuffer of its own
    core_profile: bool = field(default=False, init=False)  # without fixed function
    early: tuple[str, int] | None = field(default=None, init=False)
    early_calls: list[EarlyCall] = field(default_factory=list, init=False)
    early_line: int = field(default=0, init=False)  # that comes too early, beside the opening one
    showing: Showing = field(default_factory=Showing, init=False)
    resized: bool = field(default=False, init=False)


class Observer(Protocol):
    """Who watches a program. The methods are called inside it, with its context current."""

    def make(self, name: str, function: Callable[..., object]) -> Callable[..., object]:
        """Return what takes the place of an OpenGL function (see framelens.gl.foreign)."""

    def opened(self, window: Window) -> None:
        """Note that the context has just become current, in its default state."""

    def frame_began(self, number: int) -> None:
        """Note that a frame begins."""

    def frame_ended(self, number: int) -> object:
        """Note that a frame is complete and not yet shown: its picture is in the back buffer.

        ``run`` returns what this returns for the last frame.
        """

    def notice(self, text: str) -> None:
        """Take a sentence for the user: shaders, for instance, are not shown."""


class Live(Protocol):
    """A user at the program's window, which then is visible, and a window of GLFW."""

    def attach(self, glfw: Library, window: object, keys: Mapping[int, str]) -> None:
        """Take GLFW as it is, the window, and the names of keys in events, by GLFW's numbers."""

    def events(self, wait: bool = False) -> list[Event]:
        """Return what the user does with the program; ``wait`` until there is something.

        Nothing, where the program is to draw its picture again.
        """


class Host(Protocol):
    """A window that stays, where one program after another is shown; its context is current.

    A program takes its area for the whole window: the lower left part.
    """

    window: object

    def area(self) -> tuple[int, int]:
        """Return the area's size in the window system's coordinates."""

    def pixels(self) -> tuple[int, int]:
        """Return the area's size in pixels."""

    def seconds(self) -> float:
        """Return the true time, by which the program's clock goes."""


class Run:
    """A program while it runs; the toolkits' modules call its methods."""

    def __init__(
        self,
        source: Source,
        frame: int | None,
        events: list[Event],
        backend: str,
        observer: Observer,
        live: Live | None = None,
        host: Host | None = None,
    ) -> None:
        self.source = source
        self.backend = backend
        self.host = host
        self.clock = Clock(host.seconds if host is not None else None)
        self.events = Queue(events)
        self.frames = 0  # that were completed

        self.drew = False  # whether anything was drawn since the last frame's end
        self.window: Window | None = None
        self.drawing = False  # whether the window is open
        self.failure: BaseException | None = None  # what ended the program, if not its frame
        self.result: object = None
        self.reason = ""  # why there is no window, if the toolkit said so
        self.over = False
        self.framebuffer: WindowFramebuffer | None = None  # in the place of the window's own
        self.watchdog: Watchdog | None = None
        self.live = live

        self._frame = frame
        self._observer = observer
        self._noticed: set[str] = set()
        self._early: tuple[str, int] | None = None
        self._early_chain: Chain = ()
        self.early_calls: list[
            tuple[str, tuple[object, ...], object, Site]
        ] = []  # without a context
        self.showing = Showing()
        self._polls = 0  # since the last frame
        self._process = os.getpid()

    def refuse(self, reason: Message) -> Unwind:
        """Return what to raise in the program because it cannot go on."""
        return self.stop(ProgramError("{path}: {reason}", path=self.source.path, reason=reason))

    def stop(self, failure: BaseException) -> Unwind:
        """Return what to raise in the program; ``run`` will raise ``failure``."""
        if self.failure is None and not self.over:
            self.failure = failure
        self.over = True
        return Unwind()

    def check(self) -> None:
        """End the program once more, if it went on after it had been ended."""
        if self.over:
            raise Unwind

    def notice(self, text: str) -> None:
        """Tell the user something, once."""
        if text not in self._noticed:
            self._noticed.add(text)
            with self._watched():
                self._observer.notice(f"{self.source.path}: {text}")

    def open(self, window: Window) -> None:
        """Begin frame 0: the window's context has become current for the first time."""
        self.window = window
        self.drawing = True
        unrecorded.clear()
        window.early, window.early_calls = self._early, self.early_calls
        window.showing = self.showing
        opened_by = chain(sys._getframe(1), str(self.source.path))
        both = zip(self._early_chain, opened_by, strict=False)
        window.early_line = next((early[1] for early, here in both if early != here), 0)

        use_lists({})
        if gl.glGetString(gl.GL_VERSION) is None:
            raise self.refuse(Message("its context has no OpenGL, or {why}", why=no_context()))
        if self.backend == "software":
            check_renderer()
        if window.hidden and WindowFramebuffer.possible():
            self.framebuffer = WindowFramebuffer(window.size(), window.double_buffered)
        window.core_profile = bool(profile_mask() & 1)
        self._tell_what_is_not_seen(window)
        with self._watched():
            self._observer.opened(window)
            self._observer.frame_began(0)
        if self._early is not None:
            name, line = self._early
            opening = self.source.opening
            self.notice(f"line {line}: {name} is called before {opening}, so it has no effect")

    def _tell_what_is_not_seen(self, window: Window) -> None:
        """Give notice of shaders, and of calls past PyOpenGL."""
        if window.core_profile:
            self.notice(
                "asks for a core profile, which has no fixed function; its calls are shown, but "
                "not what shaders do"
            )
        if self.source.past:
            self.notice(f"calls of OpenGL by {self.source.past}, past PyOpenGL, are not seen")

    def closed(self) -> None:
        """Note that the window is about to be closed."""
        self.drawing = False
        WindowFramebuffer.leave()

    def called_early(self, name: str, args: tuple[object, ...], result: object, site: Site) -> None:
        """Note that the program calls OpenGL before it has a context."""
        if site.path != str(self.source.path):
            return
        self.early_calls.append((name, args, result, site))
        if self._early is None:
            self._early = name, site.line
            self._early_chain = chain(sys._getframe(1), str(self.source.path))

    def sized(self, width: object, height: object) -> tuple[int, int]:
        """Return the size of the window that the program asks for; end it if it is too large."""
        try:
            return size((width, height), f"{short(width)}x{short(height)}")
        except InputError as error:
            raise self.refuse(Message("opens a window of {wrong}", wrong=error)) from None

    def second_window(self) -> Unwind:
        """Return what to raise in a program that opens another window."""
        return self.refuse(
            Message("opens two windows; only programs with one can be run to a frame")
        )

    def polled(self) -> None:
        """Note that the program asks for events; a loop that draws and never swaps ends a frame."""
        self._polls += 1
        self.showing.again = False
        alone = self.live is None and self.host is None
        if self._polls > POLLS and self.drawing and self.frames == 0 and self.drew and alone:
            self.end_frame("never")
            self.begin_frame()

    def _line(self) -> int:
        """Return the program's own line that is being executed, 0 if none."""
        at: FrameType | None = sys._getframe(1)
        path = str(self.source.path)
        while at is not None:
            if at.f_code.co_filename == path:
                return at.f_lineno
            at = at.f_back
        return 0

    def end_frame(self, way: str = "swap") -> None:
        """End a frame, in the program's call that shows it and before it does so.

        ``way`` is that of :class:`Showing`.
        """
        if os.getpid() != self._process:
            os._exit(0)  # a copy of the program, which it has made itself
        self.check()
        if self.window is None:
            raise self.refuse(
                Message("shows a frame before {opening}", opening=self.source.opening)
            )
        if not self.drawing:
            raise self.refuse(Message("shows a frame of a window that it has closed"))
        self.showing.way, self.showing.line = way, self._line()
        with self._watched():
            self.result = self._observer.frame_ended(self.frames)
        self.frames += 1
        self.drew = False
        if self._frame is not None and self.frames > self._frame:
            self.over = True
            raise Unwind

    def begin_frame(self) -> None:
        """Begin the next frame, after the last one was shown."""
        self.showing = Showing(again=True)
        if self.window is not None:
            self.window.showing = self.showing
        self._polls = 0
        self.clock.begin_frame(self.frames)
        with self._watched():
            self._observer.frame_began(self.frames)

    @contextmanager
    def _watched(self) -> Iterator[None]:
        """Let the observer work: in true time, without limit; what it raises ends the program."""
        try:
            with self.clock.released(), self.watchdog.paused() if self.watchdog else ExitStack():
                yield
        except BaseException as error:
            raise self.stop(error) from None

    def uses_shaders(self) -> None:
        """Tell the user that shaders are not explained, once."""
        self.notice("uses shaders; its calls are shown, but this tool explains fixed function")

    def draws(self) -> None:
        """Note that the program draws."""
        self.drew = True

    def flushed(self) -> None:
        """End a frame of a single-buffered window; one of GLUT ends with the callback that drew."""
        window = self.window
        self.showing.flushed = True
        if self.drawing and window and not window.double_buffered and window.toolkit != "glut":
            self.end_frame("flush")
            self.begin_frame()

    def failed(self, error: BaseException) -> bool:
        """Let the observer look at what the program had done when it raised an error.

        Return whether it has: then the program counts as run.
        """
        look = getattr(self._observer, "failed", None)
        if look is None or not self.drawing or self.over:
            return False
        with self._watched():
            self.result = look(error)
        self.over = self.result is not None
        return self.over
