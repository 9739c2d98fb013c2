"""A step that is a program: it runs live in the area, with its own keys, until the user leaves.

A frame is recorded only where somebody looks into it: under the inspector, with edits in force, for
a strip; and the first one, with which the inspector makes the setup again.
"""

import time
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from framelens.base.errors import InputError
from framelens.gl.seam import unnoted
from framelens.inspector.panel import Panel
from framelens.inspector.program_inspector import FOREVER, PAUSE, ProgramInspector
from framelens.program.program import run
from framelens.program.program_events import Event, presses
from framelens.program.program_run import Library, Window
from framelens.report.strip import Request, on_screen
from framelens.state import state
from framelens.tape.tape import Tape
from landscape.course.lecture.image import message_image
from landscape.course.lecture.stage import Stage

FIRST = 1  # the frame before which the keys of a step are pressed


class Leave(Exception):
    """Ends a program because the user leaves its step."""


def play(stage: Stage, file: Path, keys: Sequence[str], language: str) -> list[str]:
    """Run a program on the stage until the user leaves it, or it ends; return notices.

    Raises as :func:`framelens.program.program.run` does.
    """
    player = ProgramPlayer(stage, keys, language)
    try:
        with player:
            run(file, None, backend="glfw", limit=FOREVER, observer=player, live=player, host=stage)
    except Leave:
        pass
    return player.notices


def strip(tape: Tape, stage: Stage, name: str, language: str) -> np.ndarray:
    """Return the strip of a frame that fills the stage, uint8 (h, w, 4), and draw it again.

    Where there is none to be made, the picture says why.
    """
    size = stage.whole()
    try:
        with unnoted():
            drawn = on_screen(tape, name, Request(language=language), size)
    except InputError as error:
        return message_image(size, size[1], str(error))
    with unnoted():
        tape.replay()
    return np.asarray(drawn.convert("RGBA"))


class ProgramPlayer(ProgramInspector):
    """Watches a program and its user, as the inspector does; closed at first."""

    def __init__(self, stage: Stage, keys: Sequence[str], language: str) -> None:
        super().__init__([], language)
        self._stage, self._pressed = stage, keys
        self._recording = False

    # As framelens/program/program_run.py sees it.

    def opened(self, window: Window) -> None:
        """Note the state of a new context."""
        self._new, self._pixels = state.read(), window.size

    def frame_began(self, number: int) -> None:
        """Record the frame if somebody will look into it."""
        if number == FIRST:
            self._coming += [
                Event(0, "key", str(event["key"]), str(event["action"]))
                for event in presses(self._pressed)
            ]
        looked_into = self.inspection.open or self.inspection.model.edits
        self._recording = bool(not number or looked_into or self._stage.wants_strip)
        if self._recording:
            super().frame_began(number)

    def frame_ended(self, number: int) -> None:
        """Show the frame with the lecture's pictures; end the program if the user leaves."""
        stage = self._stage
        tape = self._taped(number) if self._recording else None
        if tape is not None and stage.wants_strip and number:
            self._show_strip(tape, number)
        elif tape is not None:
            began = time.monotonic()
            self._show(tape, number)
            if self.inspection.holds:
                stage.stood += time.monotonic() - began
        if stage.leaving:
            raise Leave
        if tape is None or not self.inspection.open:
            stage.cover()
        stage.pace()

    def _show_strip(self, tape: Tape, number: int) -> None:
        end = state.read()
        picture = strip(tape, self._stage, self._stage.step.name, self._language)
        self._stage.show_strip(picture)
        with unnoted():
            tape.replay()
            state.restore(end)

    def _cover(self, panel: Panel, size: tuple[int, int]) -> None:
        super()._cover(panel, size)
        self._stage.cover()

    # The window.

    def attach(self, glfw: Library, window: object, keys: Mapping[int, str]) -> None:
        """Take what the stage passes on."""
        self._glfw = glfw
        self._window = window
        self._keys = keys
        self._size = self._stage.area()
        self._stage.player = self

    def events(self, wait: bool = False) -> list[Event]:
        """Return what the user did with the program; none if it is to draw again."""
        self._listen()
        while wait and not self._coming and not self._stage.changed:
            self._glfw.wait_events_timeout(PAUSE)
            self._listen()
        coming, self._coming = self._coming, []
        return coming

    def _listen(self) -> bool:
        stage = self._stage
        stage.poll()
        asked = self._requests.take()
        if self.inspection.listen(asked, stage.scale()):
            self._toggle()
        if stage.leaving:
            self._coming.append(Event(0, "close"))
            return False
        if (size := stage.area()) != self._size:
            self._size = size
            self._coming.append(Event(0, "resize", value=size))
            return False
        return not stage.wants_strip

    # As the stage sees it.

    def key(self, key: int, action: int, mods: int) -> None:
        """Give a key to the inspector or to the program."""
        self._key(key, action, mods)

    def button(self, button: int, action: int, mods: int) -> None:
        """Give a button to the inspector or to the program."""
        self._button(button, action, mods)

    def motion(self, x: float, y: float) -> None:
        """Give a motion to the inspector or to the program."""
        self._motion(x, y)

    def scroll(self, x: float, y: float) -> None:
        """Give the wheel to the inspector or to the program."""
        self._scroll(x, y)

    def inspect(self) -> None:
        """Open or close the inspector."""
        self._toggle()

    def escape(self) -> bool:
        """Close the inspector if it is open."""
        was_open = self.inspection.open
        if was_open:
            self._toggle()
        return was_open
