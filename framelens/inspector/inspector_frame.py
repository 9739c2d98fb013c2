"""The inspector's side of OpenGL: frames drawn with the edits, recorded, and looked into.

With the inspector closed and no edits, a frame is drawn as ever, and nothing is noted.

An edit of a call inside a display list takes effect when that list is compiled again. And an edit
may leave state behind, for instance where a glDisable is left out: so each frame with such edits
begins in the state in which the walk's first frame began. So does each frame that is listed: a call
is not redundant only because the frame before has made it, too.
"""

import contextlib
import time
from collections.abc import Callable, Hashable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from framelens.base.errors import InputError
from framelens.base.output import next_free
from framelens.gl.seam import edited, recording, unnoted
from framelens.inspector.inspector import Inspector
from framelens.inspector.inspector_image import Picture, cross_image, picture
from framelens.state import state
from framelens.tape import edit_files
from framelens.tape.edits import Edit, Edits
from framelens.tape.effects import effects, watch
from framelens.tape.lists import recompile
from framelens.tape.pixel import history
from framelens.tape.tape import Tape

EVERY = 0.25  # chosen: seconds between recordings while the walk goes on
QUIET = 0.3  # chosen: seconds without a change, after which the effects of all calls are read
# What is asked: all draws of a pixel, the one that is seen there, why it or the picture looks so.
ASKED = {"pixel", "under", "why", "why_all"}
# Variables that each frame sets anew, and that depend on where the walker stands.
OF_THE_EYE = ("_MATRIX", "_STACK", "GL_POSITION", "GL_SPOT_DIRECTION", ".equation", "EYE_PLANE")
ARMS = 40  # chosen: arms of the cross-hair that fill the window's height
MARGIN = 48  # chosen: margins of the panel that fill the window's height


def leaks(edits: Sequence[Edit], usual: Mapping[str, object] | None) -> bool:
    """Whether a frame with the edits, just drawn, has left other state behind than is ``usual``.

    State that follows the walker's eye does not count, and a number is set by the same call again.
    """
    if not any(edit.skip or isinstance(edit.value, (str, bool)) for edit in edits):
        return False
    left = state.difference(usual, state.read()) if usual is not None else {"": []}
    return any(not name.endswith(OF_THE_EYE) for name in left)


class Inspection:
    """An inspector, and the frames that it looks into."""

    def __init__(self, given: Sequence[Edit], language: str, rewinds: bool = True) -> None:
        """Begin closed; ``given`` are edits from a file.

        Without ``rewinds`` whoever draws sets the state in which a frame begins.
        """
        self.model = Inspector(given)
        self._language = language
        self._given = list(given)
        self._found: set[int] = set()
        self._edits = Edits(given)
        self.stale = False  # whether the scene was built with other edits than are in force
        self._rewinds = rewinds
        self._first: dict[str, object] | None = None  # the state in which the first frame began
        self._usual: dict[str, object] | None = None  # what frames without edits leave behind
        self._leaks = bool(given)  # whether frames with the edits leave state behind
        self._tape: Tape | None = None
        self._listed: Hashable = None  # what the frame listed was drawn from
        self._recorded = self._changed = 0.0  # when
        self._read = False  # whether the effects have been read
        self.shown: Picture | None = None
        self.letters: dict[str, str] = {}
        self.with_past: Callable[[Tape], Tape] = lambda tape: tape  # a tape, with what came before
        self._size = (0, 0)

    @property
    def open(self) -> bool:
        """Whether the inspector is shown."""
        return self.model.open

    @property
    def holds(self) -> bool:
        """Whether the walk stands still."""
        return self.model.open and self.model.stopped

    def toggle(self, language: str, letter: str) -> bool:
        """Open or close the inspector, in the window's language; return whether it is open.

        ``letter`` is what is printed on the key that does it.
        """
        model = self.model
        model.open = not model.open
        self._language = language

        # The user may have changed the keyboard's layout.
        self.letters = {"letter": letter, "pixel": "O"}
        self._tape, self._listed = None, None
        model.history = None
        if model.open:
            model.stopped = True
            model.wants.add("under")
            model.pixel = None

        return model.open

    def listen(self, asked: Sequence[Any], scale: float) -> bool:
        """Take keys, by their names, and the mouse, in coordinates of ``scale`` pixels.

        Return whether the inspector is to be closed.
        """
        for each in asked:
            if isinstance(each, str):
                self.model.press(each)
            else:
                what, x, y, extra = each
                self._point(what, x * scale, y * scale, extra)
        wants = self.model.wants
        if "save" in wants:
            wants.discard("save")
            self.save()
        closing = "close" in wants
        wants.discard("close")
        return closing

    def missed(self) -> list[str]:
        """Return a line for each edit given that has found no call."""
        watched = Edits(self._given)
        watched.found = self._found | self._edits_found()
        return watched.missed()

    def _edits_found(self) -> set[int]:
        found = [edit for k, edit in enumerate(self._edits.edits) if k in self._edits.found]
        return {k for k, edit in enumerate(self._given) if edit in found}

    # Frames.

    @contextmanager
    def building(self, anew: bool = False) -> Iterator[None]:
        """Let the edits change what the block builds, or draws; ``anew``: all of the scene."""
        self.stale = self.stale and not anew
        with edited(self._edits if self._edits.edits else None):
            yield

    def draw(self, draw: Callable[[], None], shows: Hashable, size: tuple[int, int]) -> None:
        """Draw a frame with the edits, and list its calls if the inspector is open.

        ``shows`` is what the frame depends on, beside the edits.
        """
        self._size = size
        if self._first is None:
            self._first = state.read()
        changed = self.model.edits != self._edits.edits
        if changed:
            self._install()
        listed = self.model.open and self._due(shows)
        if self._rewinds and (changed or listed or self._leaks):
            self._rewind()
        with self.building():
            if listed:
                self._record(draw, size, shows)
            else:
                draw()

        if self._rewinds and changed:
            self._leaks = leaks(self._edits.edits, self._usual)
        if self.model.open:
            self._look(size)

    def _install(self) -> None:
        """Put the edits in force that the model has."""
        before, after = self._edits.edits, self.model.edits
        differ = [edit for edit in (*before, *after) if edit not in before or edit not in after]
        self._found |= self._edits_found()
        if not before:
            self._usual = state.read()
        self._edits = Edits(after)
        recompile({edit.key.list for edit in differ if edit.key.list is not None}, self._edits)
        # What was built in other ways than as a list must be built again.
        self.stale = any(e.key.pass_ == "setup" and e.key.list is None for e in differ)
        self._listed = None
        self._changed = time.monotonic()

    def _rewind(self) -> None:
        """Begin the frame as the first one began."""
        assert self._first is not None
        # An object that was bound then may be gone.
        with contextlib.suppress(state.StateError):
            state.restore(self._first)

    def _due(self, shows: Hashable) -> bool:
        """Whether this frame is to be listed."""
        now = time.monotonic()
        if self._tape is None or self._listed is None or self.model.wants & ASKED:
            return True
        return shows != self._listed and (self.model.stopped or now - self._recorded >= EVERY)

    def _record(self, draw: Callable[[], None], size: tuple[int, int], shows: Hashable) -> None:
        with recording(complete=True) as recorder:
            begins = state.read()
            seen = watch(recorder, self._numbers_shown())
            draw()
        self._tape = Tape(recorder.calls, 0, begins, size)
        self._listed, self._recorded = shows, time.monotonic()
        self._read = False
        self.model.show(recorder.calls, seen)

    def _numbers_shown(self) -> set[int]:
        """Return the numbers of the calls in the picture's list, whose effects are read at once."""
        rows = self.model.rows
        targets = [target for *_, target in (self.shown.boxes if self.shown else ())]
        shown = [rows[t[1]] for t in targets if t[0] == "row" and t[1] < len(rows)]
        return {int(node.place) for node in shown if node.found and "." not in node.place}

    def _look(self, size: tuple[int, int]) -> None:
        """Look into the frame that was drawn, as far as that is asked for."""
        model, tape = self.model, self._tape
        assert tape is not None
        if asked := model.wants & ASKED:
            model.wants -= ASKED
            if asked <= {"pixel", "under"}:
                self._ask(tape, size, listed="pixel" in asked)
            else:
                self._ask_why(tape, size, picture="why_all" in asked)
        now = time.monotonic()
        settled = model.stopped and now - max(self._changed, self._recorded) > QUIET
        if settled and not self._read and tape.size == size:
            self._read = True
            with unnoted():
                model.effects = effects(tape)
            model.version += 1

    def _ask(self, tape: Tape, size: tuple[int, int], listed: bool) -> None:
        """Find out what happened to a pixel, and draw the frame again afterwards."""
        pixel = self._pixel(size)
        with unnoted():
            self.model.ask(history(tape, *pixel), listed)
            tape.replay()

    def _pixel(self, size: tuple[int, int]) -> tuple[int, int]:
        """Return the pixel asked about; it is the one in the middle where none was clicked."""
        pixel = self.model.pixel
        if pixel is None or not (0 <= pixel[0] < size[0] and 0 <= pixel[1] < size[1]):
            pixel = size[0] // 2, size[1] // 2
        self.model.pixel = pixel
        return pixel

    def _ask_why(self, tape: Tape, size: tuple[int, int], picture: bool) -> None:
        """Find out why a pixel, or the picture, looks as it does; then draw the frame again."""
        pixel = None if picture else self._pixel(size)
        with unnoted():
            whole = self.with_past(tape)
            # A walk begins sooner without them.
            from framelens.report.why_report import as_text
            from framelens.why.diagnosis import diagnose

            found = diagnose(whole, pixel, language=self._language)
            first = found.causes[0].call - whole.begin if found.causes else -1
            lines = [line for line in as_text(found, self._language, walk=False) if line]
            self.model.explain(lines, str(first) if first >= 0 else "")
            tape.replay()

    def save(self) -> None:
        """Save the edits under the next free name in the current folder."""
        model = self.model
        if not model.edits:
            return model.say("inspector.nothing")
        try:
            path = next_free("edits", ".json")
        except OSError:
            return model.say("inspector.not_saved")
        try:
            edit_files.write(model.edits, path)
        except InputError:
            Path(path).unlink(missing_ok=True)
            return model.say("inspector.not_saved")
        model.say("saved", name=path.name)

    # The picture and the mouse.

    def image(self, dpi: float) -> tuple[Hashable, Callable[[], np.ndarray]] | None:
        """Return what the picture depends on, and how to make it; None while closed."""
        if not self.model.open:
            return None
        size = self._size

        def make() -> np.ndarray:
            self.shown = picture(self.model, size, dpi, self._language, self.letters)
            return self.shown.image

        return (self.model.version, self._language, tuple(self.letters.items())), make

    def cross(self) -> tuple[int, int, Callable[[], np.ndarray]] | None:
        """Return where the cross-hair is, in pixels from the top left, and how to make it."""
        if not self.model.open:
            return None
        x, y = self.model.pixel or (self._size[0] // 2, self._size[1] // 2)
        return x, y, lambda: cross_image(max(self._size[1] // ARMS, 6))

    def _point(self, what: str, x: float, y: float, extra: float) -> None:
        """Take "press", "move", "release" or "wheel" at x, y in pixels from the top left.

        ``extra`` is how far the wheel turned; elsewhere 1 if Shift is down, or
        Control while it moves.
        """
        model = self.model
        if what == "move":
            model.drag(x, extra > 0)
        elif what == "release":
            model.release(extra > 0)
        elif self.shown is not None:
            height = self.shown.image.shape[0]
            left, top = self._size[1] // MARGIN, self._size[1] - height
            top -= top // 2
            width = self.shown.image.shape[1]
            inside = left <= x < left + width and top <= y < top + height

            if what == "wheel" and inside:
                model.wheel(extra, self.shown.first)
            elif what == "press" and inside:
                target = self.shown.at(x - left, y - top)
                if target is not None:
                    model.click(target, x)
            elif what == "press":
                model.pixel = int(x), int(y)
                model.wants.add("pixel")
