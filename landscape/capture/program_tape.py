"""A frame of any PyOpenGL program on tape."""

from collections.abc import Callable, Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import Any, TextIO, TypeVar

from landscape.capture import spec, state
from landscape.capture.buffers import Buffers
from landscape.capture.edits import Edits
from landscape.capture.program import Window, run
from landscape.capture.tape import Tape
from landscape.gl.calls import begin_pass, edited, frame_begins, outermost, recording, unnoted

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
) -> T:
    """Run a program to the end of a frame; return what ``use`` makes of its tape, in its context.

    What is called before the first call that draws is the setup. The elements are named after the
    program's functions. Raises as :func:`landscape.capture.program.run` does.
    """
    with _Taping(path, use, frame, edits) as taping:
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
        self, path: str | Path, use: Callable[[Tape], Any], frame: int, edits: Edits | None
    ) -> None:
        super().__init__()
        self._path = path
        self._use, self._frame, self._edits = use, frame, edits
        self._notices: list[str] = []
        self._start: state.State = {}
        self._before: Buffers | None = None
        self._begin = 0

    def make(self, name: str, function: Callable[..., Any]) -> Callable[..., Any]:
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
            self._recorder.calls[:] = [c for c in self._recorder.calls if c.pass_ == "setup"]
            for index, call in enumerate(self._recorder.calls):
                call.number = index
            frame_begins()
        if number == self._frame:
            self._begin = len(self._recorder.calls)
            with unnoted():
                self._start = self._state()
                self._before = Buffers.read(self._window.size()) if number else None

    def frame_ended(self, number: int) -> Any:
        """Hand the tape on, if this is the frame that was asked for."""
        if number != self._frame:
            return None
        if not self._recorder.calls:
            self._notices.append(f"{self._path}: has called nothing of OpenGL through PyOpenGL")
        with unnoted():
            tape = Tape(
                self._recorder.calls, self._begin, self._start, self._window.size(),
                self._notices, self._before,
            )  # fmt: skip
            return self._use(tape)

    def notice(self, text: str) -> None:
        """Keep a sentence for the user."""
        self._notices.append(text)

    def _state(self) -> state.State:
        try:
            return state.read()
        except state.StateError:
            return {}  # without fixed function there is none to be read
