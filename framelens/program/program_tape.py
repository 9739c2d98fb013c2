"""A frame of any PyOpenGL program on tape."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import Any, TextIO, TypeVar

from framelens.gl.seam import (
    Call,
    GluCall,
    begin_pass,
    edited,
    frame_begins,
    outermost,
    recording,
    unnoted,
)
from framelens.program.past import Past, Setters, chains_of
from framelens.program.program import run
from framelens.program.program_run import Window
from framelens.program.shown import shown_otherwise, without_effect
from framelens.spec import spec
from framelens.state import state
from framelens.tape.buffers import Buffers
from framelens.tape.edits import Edits
from framelens.tape.image_rows import Origins, noted
from framelens.tape.tape import Tape

T = TypeVar("T")


def on_frame(
    path: str | Path,
    use: Callable[[Tape], T],
    frame: int = 0,
    events: Any = None,
    edits: Edits | None = None,
    backend: str = "auto",
    limit: float | None = None,
    arguments: Sequence[str] = (),
    stdin: TextIO | None = None,
    past: bool = False,
) -> T:
    """Run a program to the end of a frame; return what ``use`` makes of its tape, in its context.

    What is called before the first call that draws is the setup. The elements are named after the
    program's functions. ``past`` asks for what came before the frame, too, and for a tape of the
    frame in which the program raises an error. Raises as :func:`framelens.program.program.run`
    does.
    """
    kind = _Following if past else _Taping
    with kind(use, str(Path(path)), frame, edits) as taping:
        found: T = run(
            path,
            frame,
            events,
            arguments,
            backend,
            limit,
            stdin=stdin,
            observer=taping,
        )
        return found


class _Taping(ExitStack):
    """Observes a program: records its calls, and makes a tape of the frame that was asked for."""

    def __init__(
        self, use: Callable[[Tape], object], path: str, frame: int, edits: Edits | None
    ) -> None:
        super().__init__()
        self._use = use
        self._path = path
        self._frame = frame
        self._edits = edits
        self._notices: list[str] = []
        self._start: state.State = {}
        self._before: Buffers | None = None
        self._begin = 0

    def make(self, name: str, function: Callable[..., object]) -> Callable[..., object]:
        """Return what notes the calls of an OpenGL function."""
        return outermost(name, function, spec.draws(name))

    def opened(self, window: Window) -> None:
        """Begin to record."""
        self._window = window
        self._recorder = self.enter_context(recording(complete=True))
        self.enter_context(edited(self._edits))
        begin_pass("setup")

    def frame_began(self, number: int) -> None:
        """Forget the frames before this one, but for the setup."""
        if number:
            recorder = self._recorder
            recorder.calls[:] = [c for c in recorder.calls if c.pass_ == "setup"]
            recorder.glu[:] = [note for note in recorder.glu if note.pass_ == "setup"]
            for index, call in enumerate(recorder.calls):
                call.number = index
            frame_begins()
        if number == self._frame:
            self._begin_tape(number)

    def _begin_tape(self, number: int) -> None:
        self._begin = len(self._recorder.calls)
        with unnoted():
            self._start = self._state()
            self._before = Buffers.read(self._window.size()) if number else None

    def frame_ended(self, number: int) -> object:
        """Hand the tape on, if this is the frame that was asked for."""
        if number != self._frame:
            return None
        return self._used(None)

    def _used(self, past: Past | None) -> object:
        calls = self._recorder.calls
        if not calls:
            self._notices.append(f"{self._path}: has called nothing of OpenGL through PyOpenGL")
        told = [
            *shown_otherwise(self._window, calls, self._begin),
            *without_effect([*self._recorder.glu, *_in_lists(calls[self._begin :])]),
        ]
        self._notices += [f"{self._path}: {text}" for text in dict.fromkeys(told)]

        with unnoted():
            tape = Tape(
                calls,
                self._begin,
                self._start,
                self._window.size(),
                self._notices,
                self._before,
                past,
            )
            return self._use(tape)

    def notice(self, text: str) -> None:
        """Keep a sentence for the user."""
        self._notices.append(text)

    def _state(self) -> state.State:
        try:
            return state.read()
        except state.StateError:
            return {}  # without fixed function there is none to be read


def _in_lists(calls: Sequence[Call]) -> Iterator[GluCall]:
    """Yield the calls of GLU in the display lists that calls execute."""
    for call in calls:
        for listing in call.executed:
            yield from listing.glu
            yield from _in_lists(listing.calls())


class _Following(_Taping):
    """Notes besides what came before the frame (see past.py)."""

    def __init__(
        self, use: Callable[[Tape], object], path: str, frame: int, edits: Edits | None
    ) -> None:
        super().__init__(use, path, frame, edits)
        self._setters = Setters()
        self._first: state.State = {}  # in which the first frame began to draw
        self._now: state.State = {}  # in which this frame began to draw
        self._previous: list[Call] = []
        self._number = self._began = 0
        self._images: Origins | None = None

    def make(self, name: str, function: Callable[..., object]) -> Callable[..., object]:
        """Return what notes the calls of an OpenGL function."""
        if self._images is None:  # the toolkit is imported by now, and the program not begun
            self._images = self.enter_context(noted())
        return super().make(name, function)

    def opened(self, window: Window) -> None:
        """Begin to record."""
        super().opened(window)
        self._chains, chained = chains_of(self._path, spec.draws)

        def before(call: Call) -> None:
            chained(call)
            if not self._now and spec.draws(call.name):
                with unnoted():
                    self._now = self._state()
                self._first = self._first or self._now

        self._recorder.before = before

    def frame_began(self, number: int) -> None:
        """Forget the frames before this one, but for which calls set what."""
        self._number = number
        if number:
            calls = self._recorder.calls
            former = calls[self._began :] if number > 1 else list(calls)
            for call in former:
                self._setters.follow(call)
            self._setters.forget(MOST_CHAINED)
            self._previous = former
            self._chains.clear()
            self._now = {}
        super().frame_began(number)
        self._began = len(self._recorder.calls)

    def frame_ended(self, number: int) -> object:
        """Hand the tape on, if this is the frame that was asked for."""
        return None if number != self._frame else self._used(self._past(None))

    def failed(self, error: BaseException) -> object:
        """Hand the tape on as far as it goes: OpenGL has refused a call, which ends the program."""
        if not hasattr(error, "baseOperation"):
            return None  # an error of another kind, which says itself what it is
        if self._number != self._frame:
            self._begin_tape(self._number)  # an earlier frame: only its calls are of use
            self._begin = self._began if self._number else 0
        return self._used(self._past(error))

    def _past(self, error: BaseException | None) -> Past:
        window = self._window
        return Past(
            window,
            window.showing,
            self._number,
            self._path,
            self._setters,
            self._first,
            self._now or self._start,
            self._chains,
            list(self._recorder.glu),
            window.early_calls,
            self._images or {},
            self._previous,
            error,
        )


MOST_CHAINED = 400  # calls of a matrix that are kept from frame to frame; chosen
