"""The inspector over a program: `landscape inspect FILE.py`.

The program runs unchanged, in its own window, or, if it is one of GLUT or pygame, in one of GLFW
(framelens/program/program_live.py). F12 opens the inspector, open at first. While
it stops the program, the frame is drawn again and again from its tape, with the edits; while the
program goes on, the edits change its calls as it makes them. The panel is drawn over the finished
picture, in the state of a new context; afterwards the state is what the program left.
"""

import os
import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path
from typing import TextIO

from framelens.base.errors import InputError
from framelens.base.texts import choose
from framelens.gl.contexts.glfw import call_for_pointer
from framelens.gl.named import glfw_constant
from framelens.gl.seam import (
    Call,
    GluCall,
    begin_pass,
    frame_begins,
    gl,
    make_again,
    outermost,
    recording,
    unnoted,
)
from framelens.inspector.inspector_frame import Inspection
from framelens.inspector.keys import system_name
from framelens.inspector.panel import Panel
from framelens.inspector.requests import Requests
from framelens.program.past import Past, followed
from framelens.program.program import run
from framelens.program.program_events import BUTTONS, Event
from framelens.program.program_run import Library, Window
from framelens.spec import spec
from framelens.state import state
from framelens.state.state_reading import Values
from framelens.tape.buffers import Buffers
from framelens.tape.edit_files import read
from framelens.tape.edits import Edit
from framelens.tape.steps import bind_again, binds_shaders, repeatable
from framelens.tape.tape import Tape

FOREVER = 1e9  # seconds that the program may take: the user ends it
PAUSE = 0.02  # chosen: seconds between two pictures of a program that is stopped


def inspect(
    path: str,
    edits: Path | None = None,
    language: str = "",
    arguments: Sequence[str] = (),
    stdin: TextIO | None = None,
    closed: bool = False,
) -> list[str]:
    """Run a program until its window is closed; return lines for the user.

    ``edits`` are in force from the start. ``arguments`` and ``stdin`` are the program's. ``closed``
    begins with the inspector closed; F12 opens it, and F1, too, with the reason why the pixel under
    the pointer looks as it does. Raises as :func:`framelens.program.program.run` does.
    """
    given = read(edits, Path(path).resolve().parent) if edits else []
    inspector = ProgramInspector(given, language or choose(os.environ), path, closed)
    with inspector:
        run(
            path,
            None,
            arguments=arguments,
            stdin=stdin,
            backend="glfw",
            limit=FOREVER,
            observer=inspector,
            live=inspector,
        )

    return [*inspector.notices, *inspector.inspection.missed()]


class ProgramInspector(ExitStack):
    """Watches a program (program/program.py), and stands between its window and its user."""

    def __init__(
        self, given: Sequence[Edit], language: str, path: str = "", closed: bool = False
    ) -> None:
        """Begin open, or ``closed``; ``path`` is the program's, for errors."""
        super().__init__()
        self._closed = closed
        self._records = False  # whether this frame is recorded: not with the inspector closed
        self._path = path
        self.inspection = Inspection(given, language, rewinds=False)
        self.notices: list[str] = []
        self._language = language
        self._requests = Requests(system_name)
        self._glfw: Library
        self._window: object = None
        self._keys: Mapping[int, str] = {}
        self._coming: list[Event] = []

        self._size = (0, 0)
        self._new: state.State = {}  # the state of a new context
        self._setup = Tape((), 0, {}, (0, 0))  # what the program made before its first draw
        self._built: state.State = {}  # the state that this left behind
        self._start: state.State = {}  # that in which the frame began
        self._before: Buffers | None = None  # what the window showed then, if that stays
        self._keeps = False  # whether what is drawn stays from frame to frame
        self._binding: list[Call] = []  # a call of the program that binds shaders
        self._glu: dict[bool, list[GluCall]] = {}  # calls of GLU in the setup, and in the frame
        self._opened: Window | None = None
        self._number_shown = 0
        self.inspection.with_past = self._with_past

    # As framelens/program/program_run.py sees it.

    def make(self, name: str, function: Callable[..., object]) -> Callable[..., object]:
        """Return what notes the calls of an OpenGL function."""
        return outermost(name, function, spec.draws(name))

    def opened(self, window: Window) -> None:
        """Begin with the inspector open."""
        if window.core_profile:
            raise InputError(
                "{path}: the inspector draws its panel with fixed function, which a core "
                "profile lacks; trace and state look into this program",
                path=self._path,
            )
        self._new, self._pixels = state.read(), window.size
        self._keeps = not window.double_buffered
        self._opened = window
        if not self._closed:
            self._toggle()

    def frame_began(self, number: int) -> None:
        """Begin to record a frame, with the edits; the first one is always recorded."""
        inspection = self.inspection
        self._records = not number or inspection.open or bool(inspection.model.edits)
        if not self._records:
            return
        self._start = state.read()
        with unnoted():
            self._before = Buffers.read(self._pixels()) if number and self._keeps else None
        self._recorder = self.enter_context(recording(complete=True))
        self.enter_context(self.inspection.building())
        self._begin(number)

    @staticmethod
    def _begin(number: int) -> None:
        if number:
            frame_begins()
        else:
            begin_pass("setup")

    def frame_ended(self, number: int) -> None:
        """Show the frame under the inspector, until the program is to go on."""
        if not self._records:
            self._listen()
            return
        self._show(self._taped(number), number)

    def _taped(self, number: int) -> Tape:
        """Return the frame that was recorded."""
        self.close()
        self._number_shown = number
        self._glu[number == 0] = list(self._recorder.glu)
        tape = Tape(self._recorder.calls, 0, self._start, self._pixels(), before=self._before)
        if not self._binding:
            self._binding = [call for call in tape.calls if binds_shaders(call.name)][:1]
        if not number:
            setup = [call for call in tape.calls if call.pass_ == "setup"]
            self._setup = Tape(setup, 0, self._start, tape.size)
        return tape

    def _with_past(self, tape: Tape) -> Tape:
        """Return the tape with what was set up before the frame, as far as that is known."""
        window, number = self._opened, self._number_shown
        if window is None:
            return tape

        before = list(self._setup.calls) if number else []
        shift = len(before)
        calls = [*before, *(replace(call, number=call.number + shift) for call in tape.calls)]

        glu = self._glu.get(True, []) if number else []
        glu = [note for note in glu if note.end <= shift]
        glu += [
            replace(note, begin=note.begin + shift, end=note.end + shift)
            for note in self._glu.get(number == 0, [])
        ]

        past = Past(
            window=window,
            showing=window.showing,
            frame=number,
            source=str(Path(self._path).resolve()),
            setters=followed(before),
            first={},
            now={},
            chains={},
            glu=glu,
        )
        return replace(tape, calls=calls, begin=shift, past=past)

    def _show(self, tape: Tape, number: int) -> None:
        """Show a frame under the inspector while that is open; leave its state behind."""
        self._number(tape, number)
        end = state.read()
        covered = False
        panel = Panel("", (), self._dpi())
        while self._listen() and self.inspection.open:
            end = self._build(tape, end)
            self._redraw(tape, number)
            with unnoted():
                self._cover(panel, tape.size)
            covered = True
            if not self.inspection.holds:
                break
            self._glfw.swap_buffers(self._window)
            time.sleep(PAUSE)

        if covered and not self.inspection.open:
            self._redraw(tape, number)
        with unnoted():
            panel.release()
        self._restore(self._build(tape, end))

    def _redraw(self, tape: Tape, number: int) -> None:
        """Draw a frame again from its beginning, with the edits, as the inspector lists it."""
        with unnoted():
            tape.rewind()
            self._bind_shaders(tape.start)
        self.inspection.draw(lambda: self._draw(tape, number), number, tape.size)

    def _restore(self, left: state.State) -> None:
        """Set a state, that of shaders included."""
        state.restore(left)
        with unnoted():
            self._bind_shaders(left)

    def _bind_shaders(self, wanted: Values) -> None:
        bind_again(self._binding, wanted.get("GL_CURRENT_PROGRAM", 0))

    def notice(self, text: str) -> None:
        """Keep a sentence for the user."""
        self.notices.append(text)

    def _number(self, tape: Tape, number: int) -> None:
        """Number the calls as `landscape trace --frame NUMBER` does: after those of the setup."""
        model, before = self.inspection.model, len(self._setup.calls) if number else 0
        model.frame = number
        model.numbers = [before + call.number for call in tape.frame if repeatable(call.name)]

    def _build(self, tape: Tape, end: state.State) -> state.State:
        """Make the setup again if its edits have changed; return the state to leave behind.

        A variable that still is as the setup left it, in the frame's first state and in ``end``,
        gets the value that the setup leaves now.
        """
        if not self.inspection.stale:
            return end
        with unnoted():
            if not self._built:
                self._setup.replay()
                self._built = state.read()
            self._setup.rewind()

        with self.inspection.building(anew=True):
            self._draw(self._setup, 0)
        built = state.read()
        changes = state.difference(self._built, built)
        self._built = built
        if tape.start is not self._setup.start:
            tape.start = _with(tape.start, changes)
        return _with(end, changes)

    def _draw(self, tape: Tape, number: int) -> None:
        """Draw a frame again, with the edits."""
        self._begin(number)
        for call in tape.frame:
            if repeatable(call.name):
                make_again(call)

    def _cover(self, panel: Panel, size: tuple[int, int]) -> None:
        """Draw the panel over the picture, whatever the program's state is."""
        self._restore(self._new)
        gl.glViewport(0, 0, *size)
        panel.draw(size, left=self.inspection.image(panel.dpi), cross=self.inspection.cross())

    def _dpi(self) -> float:
        return float(max(self._glfw.get_window_content_scale(self._window)))

    # The window.

    def attach(self, glfw: Library, window: object, keys: Mapping[int, str]) -> None:
        """Listen to the window."""
        self._glfw = glfw
        self._window = window
        self._keys = keys
        glfw.set_key_callback(window, lambda _, key, __, action, mods: self._key(key, action, mods))
        call_for_pointer(glfw, window, self._button, self._motion, self._scroll)
        self._size = glfw.get_window_size(window)

    def events(self, wait: bool = False) -> list[Event]:
        """Return what the user did with the program; with ``wait``, once there is something."""
        self._listen()
        while wait and not self._coming and not self.inspection.open:
            self._glfw.wait_events_timeout(PAUSE)
            self._listen()
        coming, self._coming = self._coming, []
        return coming

    def _listen(self) -> bool:
        """Take what the user did since; return False if the program must draw a frame now."""
        glfw, window = self._glfw, self._window
        glfw.poll_events()
        size = glfw.get_window_size(window)
        asked = self._requests.take()
        scale = self._pixels()[0] / max(size[0], 1)
        if self.inspection.listen(asked, scale):
            self._toggle()
        if glfw.window_should_close(window):
            self._coming.append(Event(0, "close"))
            return False
        if size != self._size and 0 not in size:
            self._size = size
            self._coming.append(Event(0, "resize", value=size))
            return False
        return True

    def _toggle(self) -> None:
        self.inspection.toggle(self._language, "F12")

    def _key(self, key: int, action: int, mods: int) -> None:
        glfw = self._glfw
        if key == glfw.KEY_F12:
            if action == glfw.PRESS:
                self._toggle()
        elif key == glfw.KEY_F1 and self._closed and not self.inspection.open:
            if action == glfw.PRESS:
                self._ask_under_the_pointer()
        elif self.inspection.open and self._requests.key(key, action, mods):
            return
        elif key in self._keys and not self.inspection.holds:
            self._add("key", self._keys[key], action, mods)

    def _ask_under_the_pointer(self) -> None:
        """Open the inspector with the reason why the pixel under the pointer looks as it does."""
        self._toggle()
        model = self.inspection.model
        x, y = self._glfw.get_cursor_pos(self._window)
        scale = self._pixels()[0] / max(self._size[0], 1)
        model.pixel = int(x * scale), int(y * scale)
        model.wants.discard("under")
        model.wants.add("why")

    def _button(self, button: int, action: int, mods: int) -> None:
        if self.inspection.open:
            self._requests.button(button, action, mods)
            return
        for name in BUTTONS:
            if button == glfw_constant(self._glfw, f"MOUSE_BUTTON_{name.upper()}"):
                self._add("button", name, action, mods)

    def _add(self, kind: str, name: str, action: int, mods: int) -> None:
        glfw = self._glfw
        actions = {glfw.PRESS: "press", glfw.RELEASE: "release", glfw.REPEAT: "repeat"}
        bits = {"shift": glfw.MOD_SHIFT, "control": glfw.MOD_CONTROL, "alt": glfw.MOD_ALT}
        held = frozenset(mod for mod, bit in bits.items() if mods & bit)
        self._coming.append(Event(0, kind, name, actions[action], held))

    def _motion(self, x: float, y: float) -> None:
        self._requests.motion(x, y, heeded=self.inspection.open)
        if not self.inspection.open:
            self._coming.append(Event(0, "move", value=(x, y)))

    def _scroll(self, x: float, y: float) -> None:
        if self.inspection.open:
            self._requests.wheel(y)
        else:
            self._coming.append(Event(0, "scroll", value=(x, y)))


def _with(now: Mapping[str, object], changes: Mapping[str, list[object]]) -> dict[str, object]:
    """Return a state in which the variables with the former values have the new ones."""
    new = {name: after for name, (before, after) in changes.items() if now.get(name) == before}
    return {**now, **new}
