"""Qt for a program that is run to a frame: it draws in a QOpenGLWidget, and nothing is shown.

Qt's platform `offscreen` makes the window and, under X11, its context. The widget draws into a
framebuffer object in the place of its own (framelens/gl/window_framebuffer.py), and only when the
event loop here, in Python, asks it to: after `update()`, or where the program waits. Timers go by
the held clock. A frame ends where paintGL returns.
"""

import importlib
import itertools
import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, SupportsInt

from framelens.base.errors import NoOpenGLError
from framelens.gl import display
from framelens.gl.binding import use_platform
from framelens.gl.contexts.software import ask_for_software
from framelens.gl.holders import replaced
from framelens.gl.raw import raw
from framelens.program.program_events import CONTROL, Event
from framelens.program.program_run import Run, Window
from framelens.program.program_source import QT, ProgramError, need_package

FRAMEBUFFER, BLEND = 0x8D40, 0x0BE2
# What Qt says of its platform, and no user need know.
NOT_SAID = ("not supported on this platform", "This plugin does not support")
PATIENCE = 1000  # turns without a frame until the widget is asked to redraw; chosen
# Where Qt's name of a key is not GLFW's in another spelling.
KEY_NAMES = {
    **{"ENTER": "Return", "KP_ENTER": "Enter", "LEFT_BRACKET": "BracketLeft"},
    **{"RIGHT_BRACKET": "BracketRight", "GRAVE_ACCENT": "QuoteLeft", "PRINT_SCREEN": "Print"},
    **{f"{side}_{key}": key.title() for side in ("LEFT", "RIGHT") for key in ("SHIFT", "ALT")},
    **{f"{side}_CONTROL": "Control" for side in ("LEFT", "RIGHT")},
    **{f"KP_{digit}": str(digit) for digit in range(10)},
}
MODIFIERS = {"shift": "ShiftModifier", "control": "ControlModifier", "alt": "AltModifier"}


@contextmanager
def qt_program(run: Run) -> Iterator[None]:
    """Prepare Qt and PyOpenGL for a program, and replace Qt's classes inside the block."""
    path = run.source.path
    if run.live is not None:
        raise ProgramError(
            "{path}: the inspector shows GLFW, GLUT and pygame programs; trace, pixel, "
            "state and strip look into this one",
            path=path,
        )

    if sys.platform != "linux" or run.backend in ("osmesa", "egl", "cgl"):
        raise NoOpenGLError(
            "{path}: a program with Qt is drawn by X11's OpenGL only, on Linux", path=path
        )
    if run.backend == "software":
        ask_for_software()
    if reason := display.problem("x11", os.environ):
        raise NoOpenGLError(
            "{path}: Qt needs X11 for OpenGL ({reason}): use xvfb-run", path=path, reason=reason
        )
    binding = next(name for name in QT if name in run.source.modules)
    need_package(binding, path)
    use_platform("glx", run.source.checked)
    os.environ["QT_QPA_PLATFORM"] = "offscreen"
    stand_in = _Qt(run, binding)
    classes = stand_in.classes()
    told, sys.excepthook = sys.excepthook, lambda kind, error, at: stand_in.fail(error)
    try:
        with replaced((binding,), lambda module, name, value: classes.get(id(value))):
            yield
    finally:
        sys.excepthook = told
        stand_in.close()


class _Qt:
    """Stands in for Qt, as far as time, events and drawing are concerned."""

    def __init__(self, run: Run, binding: str) -> None:
        self.run = run
        self.core, self.gui, self.widgets = (
            importlib.import_module(f"{binding}.{name}")
            for name in ("QtCore", "QtGui", "QtWidgets")
        )
        self._held_in: Any = self.widgets
        if not hasattr(self.widgets, "QOpenGLWidget"):  # since Qt 6
            self._held_in = importlib.import_module(f"{binding}.QtOpenGLWidgets")
        self.core.qInstallMessageHandler(_say)
        self.timers: list[HeldTimer] = []
        self.numbers = itertools.count(1)  # for timers without a QTimer
        self.due = True  # whether the widget is to draw
        self.leaving = False
        self._app: Any = None
        self.found: Any = None  # the widget that was made first
        self._widget: Any = None  # the same, once it has drawn
        self._failure: BaseException | None = None
        self._blends = False  # whether the program has enabled blending
        self._inside = False  # whether a method of the program's widget runs

    def classes(self) -> dict[int, type]:
        """Return the classes that take the place of Qt's, by the identities of those."""
        return {
            id(self._held_in.QOpenGLWidget): _widget(self, self._held_in.QOpenGLWidget),
            id(self.widgets.QApplication): _application(self, self.widgets.QApplication),
            id(self.core.QTimer): type("QTimer", (HeldTimer,), {"qt": self}),
        }

    def fail(self, error: BaseException) -> None:
        """Note what the program raised in a method that Qt called."""
        self._failure = self._failure or error
        self.leaving = True

    def close(self) -> None:
        """End Qt; its widget goes with its context."""
        self.run.closed()
        self.found = self._widget = None
        if self._app is not None and hasattr(self._app, "shutdown"):
            self._app.shutdown()
        self._app = None

    # Drawing, in the widget's context.

    def initialized(self, widget: object, method: Callable[..., object]) -> None:
        """Call initializeGL, if the program does: Qt calls it for contexts that do not last."""
        if self._inside:
            method(widget)

    def resized(
        self, widget: object, method: Callable[..., object], width: int, height: int
    ) -> None:
        """Call resizeGL, once the widget has been initialized."""
        if self._inside:
            method(widget, width, height)
        elif widget is self._widget:
            self._bind()
            if self.run.framebuffer is not None:
                self.run.framebuffer.resize((max(int(width), 1), max(int(height), 1)))
            self._call(method, widget, width, height)

    def painted(self, widget: object, method: Callable[..., object]) -> None:
        """Call paintGL, which draws a frame."""
        if self._inside:
            method(widget)
        elif not self.leaving:
            self._call(self._paint, widget, method)

    def _call(self, method: Callable[..., object], *args: object) -> None:
        self._inside = True
        try:
            method(*args)
        except BaseException as error:
            self.fail(error)
        finally:
            self._inside = False

    def _paint(self, widget: object, method: Callable[..., object]) -> None:
        if self.run.window is None:
            self._open(widget)
        elif widget is not self._widget:
            raise self.run.second_window()
        self._bind()
        # Qt enables blending, to put the picture of its window together.
        (raw.glEnable if self._blends else raw.glDisable)(BLEND)
        method(widget)
        self._blends = bool(raw.glIsEnabled(BLEND))
        self.run.end_frame()
        raw.glViewport(0, 0, *self._size())  # so does Qt before each call of paintGL
        self.run.begin_frame()

    def _open(self, widget: Any) -> None:
        self._widget = widget
        width, height = self._size()
        raw.glDisable(BLEND)
        self.run.open(Window("qt", "glx", self._size, hidden=True))
        widget.initializeGL()
        widget.resizeGL(width, height)

    def _size(self) -> tuple[int, int]:
        return max(int(self._widget.width()), 1), max(int(self._widget.height()), 1)

    def _bind(self) -> None:
        """Let the widget draw into its stand-in, which Qt has unbound."""
        framebuffer = self.run.framebuffer
        if framebuffer is not None:
            raw.glBindFramebuffer(FRAMEBUFFER, framebuffer.name)

    # The event loop.

    def begin(self, app: object) -> None:
        """Note the program's application."""
        self._app = app

    def loop(self) -> int:
        """Run until the program leaves, or has drawn its frame."""
        quiet = 0
        self.leaving = self._failure is not None
        while not self.leaving:
            self.run.check()
            frames = self.run.frames
            for event in self.run.events.due(frames):
                self._deliver(event)
            for timer in sorted(self.timers, key=lambda each: each.at):
                if timer.at <= self.run.clock.now + 1e-6:
                    timer.fire()
            self._app.processEvents()
            if self.due and self.found is not None and not self.leaving:
                self.due = False
                self.found.grabFramebuffer()
            quiet = 0 if self.run.frames > frames else quiet + 1
            self._wait(quiet)

        if self._failure is not None:
            raise self._failure
        return 0

    def _wait(self, quiet: int) -> None:
        """Pass the time until a timer is due, or ask for a redraw."""
        if self.found is None and quiet > PATIENCE:
            self.leaving = True  # it has no widget that draws
        elif not self.timers or quiet > PATIENCE:
            self.due = True
        elif not self.due:
            clock = self.run.clock
            clock.now = max(clock.now, min(timer.at for timer in self.timers))

    # Events.

    def _deliver(self, event: Event) -> None:
        before = self.run.events.mouse
        self.run.events.note(event)
        if self._widget is not None:
            getattr(self, f"_{event.kind}")(event, before)

    def _named(self, enumeration: str, name: str, of: Any = None) -> Any:
        """Return a value of an enumeration, which older bindings hold without its name."""
        holder = of or self.core.Qt
        return getattr(getattr(holder, enumeration, holder), name, None) or getattr(holder, name)

    def _mods(self) -> Any:
        found = self._named("KeyboardModifier", "NoModifier")
        for mod in self.run.events.mods:
            found |= self._named("KeyboardModifier", MODIFIERS[mod])
        return found

    def _send(self, event: Any, target: Any = None) -> None:
        self._app.sendEvent(target or self._widget, event)

    def _key(self, event: Event, before: tuple[float, float]) -> None:
        kind = self._named("Type", "KeyPress" if event.pressed else "KeyRelease", self.core.QEvent)
        name = KEY_NAMES.get(event.name) or event.name.title().replace("_", "")
        written = event.text or (CONTROL.get(event.name, "") if event.pressed else "")
        key = self._named("Key", f"Key_{name}")
        sent = self.gui.QKeyEvent(kind, key, self._mods(), written, event.action == "repeat")
        self._send(sent, self._app.focusWidget())

    def _mouse(self, kind: str, button: Any) -> None:
        x, y = self.run.events.mouse
        held = self._named("MouseButton", "NoButton")
        for name in self.run.events.buttons:
            held |= self._named("MouseButton", f"{name.title()}Button")
        place = self.core.QPointF(x, y)
        event = self._named("Type", kind, self.core.QEvent)
        self._send(self.gui.QMouseEvent(event, place, place, button, held, self._mods()))

    def _button(self, event: Event, before: object) -> None:
        button = self._named("MouseButton", f"{event.name.title()}Button")
        self._mouse("MouseButtonPress" if event.pressed else "MouseButtonRelease", button)

    def _move(self, event: Event, before: object) -> None:
        self._mouse("MouseMove", self._named("MouseButton", "NoButton"))

    def _scroll(self, event: Event, before: object) -> None:
        place, turned = self.core.QPointF(*self.run.events.mouse), self.core.QPoint
        steps = turned(*(int(120 * value) for value in event.value))
        phase = self._named("ScrollPhase", "NoScrollPhase")
        button = self._named("MouseButton", "NoButton")
        self._send(
            self.gui.QWheelEvent(
                place, place, turned(0, 0), steps, button, self._mods(), phase, False
            )
        )

    def _resize(self, event: Event, before: tuple[float, float]) -> None:
        self._widget.window().resize(*map(int, event.value))
        self.due = True

    def _close(self, event: Event, before: tuple[float, float]) -> None:
        self._widget.window().close()
        self.leaving = True


def _say(kind: object, place: object, text: str) -> None:
    if sys.stderr is not None and not any(words in text for words in NOT_SAID):
        print(text, file=sys.stderr)


METHODS: dict[str, Callable[..., None]] = {
    "initializeGL": _Qt.initialized,
    "resizeGL": _Qt.resized,
    "paintGL": _Qt.painted,
}


def _widget(qt: _Qt, real: Any) -> type:
    """Return the class that a program's widget derives from."""

    class QOpenGLWidget(real):  # type: ignore[misc]
        def __init_subclass__(cls, **options: object) -> None:
            super().__init_subclass__(**options)
            for name, method in list(vars(cls).items()):
                if name in METHODS:
                    setattr(cls, name, _through(qt, METHODS[name], method))
                elif name.endswith("Event"):
                    setattr(cls, name, _caught(qt, method))

        def __init__(self, *args: object, **options: object) -> None:
            super().__init__(*args, **options)
            if qt.found is not None:
                raise qt.run.second_window()
            qt.found = self

        def paintGL(self) -> None:
            qt.painted(self, lambda widget: None)

        def paintEvent(self, event: object) -> None:
            """Draw nothing: the event loop asks for it."""

        def update(self, *area: object) -> None:
            qt.due = True

        repaint = update

        def defaultFramebufferObject(self) -> int:
            return 0

        def startTimer(self, interval: SupportsInt, *kind: object) -> int:
            timer = HeldTimer(self, qt=qt)
            number = timer.number = next(qt.numbers)
            timer.timeout.connect(lambda: self.timerEvent(qt.core.QTimerEvent(number)))
            timer.start(interval)
            return number

        def killTimer(self, number: int) -> None:
            for timer in list(qt.timers):
                if timer.number == number:
                    timer.stop()

    return QOpenGLWidget


def _through(qt: _Qt, through: Callable[..., None], method: Callable[..., object]) -> object:
    def called(self: object, *args: object) -> None:
        through(qt, self, method, *args)

    return called


def _caught(qt: _Qt, method: Callable[..., object]) -> object:
    """Return a method that Qt calls, which lets no exception through to Qt."""

    def called(self: object, *args: object) -> object:
        try:
            return method(self, *args)
        except BaseException as error:
            qt.fail(error)
            return None

    return called


def _application(qt: _Qt, real: Any) -> type:
    """Return the class of a program's application, with the event loop here."""

    class QApplication(real):  # type: ignore[misc]
        def __init__(self, *args: object) -> None:
            super().__init__(*args)
            qt.begin(self)

        def exec(self, *args: object) -> int:
            return qt.loop()

        exec_ = exec

        @staticmethod
        def quit() -> None:
            qt.leaving = True

        @staticmethod
        def exit(status: int = 0) -> None:
            qt.leaving = True

    return QApplication


class HeldTimer:
    """QTimer by the held clock."""

    qt: _Qt

    def __init__(
        self,
        parent: object = None,
        interval: SupportsInt = 0,
        timeout: Callable[[], object] | None = None,
        singleShot: bool = False,
        qt: _Qt | None = None,
    ) -> None:
        if qt is not None:
            self.qt = qt
        self.number = 0  # of one that startTimer began
        self.timeout = _Signal()
        self.at = 0.0  # when it is due, in seconds of the clock
        self._interval, self._once = int(interval), singleShot
        if timeout is not None:
            self.timeout.connect(timeout)

    def start(self, interval: SupportsInt | None = None) -> None:
        """Begin, with another interval in milliseconds if one is given."""
        if interval is not None:
            self._interval = int(interval)
        self.at = self.qt.run.clock.now + self._interval / 1000.0
        if self not in self.qt.timers:
            self.qt.timers.append(self)

    def stop(self) -> None:
        """End."""
        if self in self.qt.timers:
            self.qt.timers.remove(self)

    deleteLater = stop

    def fire(self) -> None:
        """Call what is connected; what that raises ends the program."""
        if self not in self.qt.timers:
            return
        # One without an interval comes after each turn of the loop.
        self.at = max(self.at, self.qt.run.clock.now) + max(self._interval, 1) / 1000.0
        if self._once:
            self.stop()
        try:
            self.timeout.emit()
        except BaseException as error:
            self.qt.fail(error)

    def isActive(self) -> bool:
        """Return whether it runs."""
        return self in self.qt.timers

    def interval(self) -> int:
        """Return the interval in milliseconds."""
        return self._interval

    def setInterval(self, interval: SupportsInt) -> None:
        """Set the interval in milliseconds."""
        self._interval = int(interval)

    def isSingleShot(self) -> bool:
        """Return whether it fires once only."""
        return self._once

    def setSingleShot(self, once: bool) -> None:
        """Let it fire once only."""
        self._once = once

    def setTimerType(self, kind: object) -> None:
        """Do nothing: the held clock is exact."""

    @classmethod
    def singleShot(cls, interval: SupportsInt, *rest: Any) -> None:
        """Call the last argument once, after an interval."""
        timer = cls(singleShot=True)
        timer.timeout.connect(rest[-1])
        timer.start(interval)


class _Signal:
    """A signal without arguments."""

    def __init__(self) -> None:
        self._connected: list[Callable[[], object]] = []

    def connect(self, function: Callable[[], object], *kind: object) -> None:
        """Let ``function`` be called."""
        self._connected.append(function)

    def disconnect(self, function: Callable[[], object] | None = None) -> None:
        """Let it be called no more; without one, none is."""
        self._connected = [each for each in self._connected if function not in (None, each)]

    def emit(self) -> None:
        """Call all functions."""
        for function in list(self._connected):
            function()
