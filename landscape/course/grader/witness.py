"""What is noted of a program while it runs in the sandbox: pictures, calls, and states.

It is sent as evidence_file.py says. A program that did not get to its last frame has "error"
instead: what went wrong, by one of the words of landscape.course.grader.troubles, and the "line" of
the program and other values for its message.
"""

import sys
import tempfile
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack
from functools import cache
from pathlib import Path
from types import FrameType

from framelens.base.errors import InputError, NoOpenGLError
from framelens.gl.framebuffer import read_pixels
from framelens.gl.named import gl_constant
from framelens.gl.notes import Brief, Call
from framelens.gl.seam import begin_pass, briefly, frame_begins, gl, outermost, recording, unnoted
from framelens.program import program
from framelens.program.program_failure import CAUGHT, raised
from framelens.program.program_run import Window
from framelens.program.program_source import ProgramError
from framelens.spec import spec
from framelens.state import state
from landscape.course.grader import recorded
from landscape.course.grader.evidence_file import Writer, only_gives_numbers
from landscape.course.grader.order import Order
from landscape.course.grader.refusals import Refusals
from landscape.course.grader.stream import send
from landscape.course.grader.trial import Trial
from landscape.course.grader.troubles import SENTENCES

MOST_CALLS = 200_000  # chosen: of one frame; a lesson's has a few thousand
MANY_CALLS = "too many calls"
PACKAGE = Path(__file__).resolve().parents[2]  # in which the grader and the solutions are
LONGEST_CALL = 80  # chosen: characters of a call's arguments in a message
# What changes between two draw calls without changing the rest of the state.
UNREAD = ("vertex", "begin_end", "matrix")
MATRICES = {  # by the names of the state
    "GL_MODELVIEW_MATRIX": "GL_MODELVIEW_MATRIX",
    "GL_PROJECTION_MATRIX": "GL_PROJECTION_MATRIX",
    "GL_TEXTURE{unit}.GL_TEXTURE_MATRIX": "GL_TEXTURE_MATRIX",
}


def run(order: Order, answers: int, leave: Callable[[int], object]) -> None:
    """Run a program and send the evidence into a pipe; ``leave`` ends the process."""
    refusals = Refusals(order["path"], tempfile.gettempdir(), order["private"])
    sys.addaudithook(refusals)
    witness = Witness(order["path"], order["frames"], order["calls"], order["again"])

    def end(found: dict[str, object]) -> None:
        try:
            send(answers, found, witness.blobs)
        except MemoryError:
            send(answers, {"error": {"word": "calls"}})
        leave(0)

    def finish() -> None:
        try:
            found = witness.evidence()
        except MemoryError:
            found = {"error": {"word": "calls"}}
        end(found)

    witness.finished = finish
    try:
        with witness:
            program.run(
                order["path"],
                max(order["frames"]),
                order["events"] or None,
                limit=order["seconds"],
                observer=witness,
            )
    except ProgramError as error:
        late = f"within {order['seconds']:g} s" in str(error)
        end({"error": _trouble(error, witness, refusals, late)})
    except KeyboardInterrupt as error:  # its own: there is no keyboard
        failure = raised(Path(order["path"]), error)
        end({"error": _trouble(failure, witness, refusals, late=False)})
    except (InputError, NoOpenGLError) as error:
        end({"error": {"word": "refused", "reason": str(error)}})


def _raised(error: ProgramError, witness: "Witness", refusals: Refusals) -> dict[str, object]:
    """Return the same of an exception that the program has raised."""
    line = _line_of(str(error))
    raised = str(error.values.get("reason", ""))
    if witness.unclosed and "StateError" in raised:
        return {"word": "unclosed", **witness.unclosed}
    if refusals.refused and raised.startswith("PermissionError"):
        return {"word": refusals.refused, "line": line}
    if raised.startswith("PermissionError") and str(PACKAGE) in raised:
        return {"word": "grader", "reason": PACKAGE.name}
    if "MemoryError" in raised:
        return {"word": "calls" if MANY_CALLS in raised else "memory", "line": line}

    trouble = {"line": line, **_exception(raised, error.details)}
    if witness.window is None and "call" in trouble:
        trouble["word"] = "early"  # where calls without a context are errors, as on Windows
    return trouble


def _trouble(
    error: ProgramError, witness: "Witness", refusals: Refusals, late: bool
) -> dict[str, object]:
    """Return what went wrong as a word of troubles.py, and the values of its message."""
    if package := str(error).partition("needs the Python package ")[2]:
        name = package.partition(",")[0].partition(":")[0]
        word = "grader" if name.partition(".")[0] == PACKAGE.name else "package"
        return {"word": word, "reason": name}
    if error.details.strip():
        return _raised(error, witness, refusals)
    reason = str(error).partition(": ")[2]
    for part, word in (
        ("opens two windows", "two_windows"),
        ("imports neither", "no_toolkit"),
        ("opens its window with", "no_toolkit"),
    ):
        if part in reason:
            return {"word": word}
    if "shows a frame before" in reason:
        return {"word": "no_context"}
    if witness.window is None:
        return {"word": "late_window" if late else "no_window"}
    if late:
        return {"word": "late_frame" if witness.ended else "no_frame", "frames": witness.ended}
    if "ended after" in str(error):
        return {"word": "ended", "frames": witness.ended}
    return {"word": "refused", "reason": reason}


def _line_of(message: str) -> int:
    """Return the line in "FILE, line 12: the program raised ..."; 0 without one."""
    digits = message.partition(", line ")[2].partition(":")[0]
    return int(digits) if digits.isdigit() else 0


def _exception(raised: str, details: str) -> dict[str, object]:
    """Return the word for an exception, ``raised`` in one line, and the values of its message."""
    lines = [line.strip() for line in details.strip().splitlines()]
    if lines[-1].startswith(CAUGHT):
        return {"word": "crashed_at", "signal": lines[-1].removeprefix(CAUGHT)}
    if lines[-1] != ")":
        return {"word": "raised", "error": raised[:200]}
    # PyOpenGL writes its errors as GLError( err = 1280, description = b'...', ... ).
    words = dict(line.rstrip(",").split(" = ", 1) for line in lines if " = " in line)
    said = words.get("description", "").strip("b'\"")
    function, given = words.get("baseOperation", "a call"), words.get("cArguments", "()")
    whole = given.endswith(")") and len(given) < LONGEST_CALL  # large arrays fill several lines
    call = function + given.replace(",)", ")") if whole else function
    word = said.replace(" ", "_")
    if word in SENTENCES:
        return {"word": word, "call": call}
    return {"word": "raised", "error": f"GLError: {said}, in {call}"}


def make(name: str, function: Callable[..., object]) -> Callable[..., object]:
    """Return what notes the calls of an OpenGL function."""
    noted = outermost(name, function, spec.draws(name))
    return briefly(name, function, noted) if only_gives_numbers(name) else noted


class Witness(ExitStack):
    """Observes a program (see framelens/program/program_run.py) up to the last of some frames.

    Without ``calls`` it takes only their pictures. With ``again`` it keeps what is needed to draw
    all frames again (recorded.py), as far as that is possible.
    """

    def __init__(
        self, program: str, frames: Sequence[int], calls: bool = True, again: bool = False
    ) -> None:
        super().__init__()
        self._program, self._writer = program, Writer(program)
        self._wanted = set(frames)
        self._records = calls
        self._unnoted = ExitStack()

        self._frames: dict[int, dict[str, object]] = {}
        self._states: list[dict[str, object]] = []
        self._of_call: dict[int, int] = {}  # the index of its state, by the call's identity
        self._ways: dict[int, list[tuple[int, str]]] = {}
        self._changed = True  # whether the state must be read again, and its matrices
        self._moved = True
        self._begin = 0
        self._looking = True
        self._size = 0, 0
        self._again = recorded.Writer() if again and calls else None
        self._made: list[int] = []  # the blobs of all frames, to draw them again

        self.window: Window | None = None
        self.ended = 0  # frames that are complete
        self.unclosed: dict[str, object] = {}  # a call that draws between glBegin and glEnd
        self.finished: Callable[[], None] = lambda: None

    make = staticmethod(make)

    def opened(self, window: Window) -> None:
        """Begin to record."""
        self.window, self._size = window, window.size()
        if not self._records:
            return
        self._recorder = self.enter_context(recording(complete=True))
        self._recorder.before = self._before
        self._recorder.brief = []
        begin_pass("setup")

    def frame_began(self, number: int) -> None:
        """Forget the frames before this one, but for the setup."""
        if not self._records:
            return
        self._looking = number in self._wanted
        if number:
            self._recorder.calls[:] = [c for c in self._recorder.calls if c.pass_ == "setup"]
            self._of_call.clear()
            setup = {id(call) for call in self._recorder.calls}
            self._ways = {key: way for key, way in self._ways.items() if key in setup}
            self._recorder.brief = []
            frame_begins()
        self._begin = len(self._recorder.calls)
        self._changed = True
        # Frames between those that are looked at are not recorded: they only take their time.
        if number and not self._looking and self._again is None:
            self._unnoted.enter_context(unnoted())

    def frame_ended(self, number: int) -> None:
        """Keep the picture and the calls of a frame that is to be looked at."""
        self._unnoted.close()
        self.ended = number + 1
        self._keep()
        if number in self._wanted and self.window is not None:
            size = self.window.size()
            with unnoted():
                pixels = read_pixels(size)
            self._frames[number] = {
                "size": list(size),
                "pixels": self._writer.blobs.add(pixels.tobytes()),
                "calls": self._calls_of_frame(),
            }

        if number == max(self._wanted):
            self.finished()

    def _keep(self) -> None:
        """Keep the frame's calls, to draw them again; or give up, if they cannot be."""
        if self.window is not None and self.window.resized:  # which is no call of OpenGL
            self._again = None
        if self._again is None:
            return
        noted = self._recorder.calls[self._begin :]
        try:
            self._made.append(
                self._again.frame(in_order(noted, self._recorder.brief or (), self._begin))
            )
        except recorded.Unrecorded:
            self._again = None

    def notice(self, text: str) -> None:
        """Take a sentence for the user, of which a grader has no need."""

    @property
    def blobs(self) -> Sequence[bytes]:
        """What is sent beside the evidence."""
        return self._writer.blobs.all

    def evidence(self) -> dict[str, object]:
        """Return all that was noted."""
        first = self._states[0] if self._states else {}
        made = None
        if self._again is not None and self.window is not None:
            take = recorded.said(self._size, Trial(sorted(self._wanted), [], {}), self._made)
            made = self._writer.blobs.add(self._again.written("", [take]))
        others = [
            {name: value for name, value in each.items() if value != first[name]}
            for each in self._states[1:]
        ]
        return {
            "frames": self._frames,
            "setup": self._calls_of_setup(),
            "states": [first, *others],
            "early": self.window.early if self.window is not None else None,
            "made": made,
            **self._writer.written(),
        }

    def _calls_of_frame(self) -> object:
        if not self._records:
            return self._block(())
        calls = self._recorder.calls
        frame = [call for call in calls if call.pass_ != "setup"]
        return self._block(frame, self._recorder.brief or (), len(calls) - len(frame))

    def _calls_of_setup(self) -> object:
        if not self._records:
            return self._block(())
        return self._block([call for call in self._recorder.calls if call.pass_ == "setup"])

    def _block(self, calls: Sequence[Call], brief: Sequence[Brief] = (), before: int = 0) -> object:
        more = {}
        for call in calls:
            found: dict[str, object] = {}
            if id(call) in self._ways:
                found["way"] = self._ways[id(call)]
            if id(call) in self._of_call:
                found["state"] = self._of_call[id(call)]
            if found:
                more[id(call)] = found
        return self._writer.block(calls, more, brief, before)

    def _before(self, call: Call) -> None:
        """Read the state before a call that draws."""
        if len(self._recorder.calls) + len(self._recorder.brief or ()) - self._begin > MOST_CALLS:
            raise MemoryError(MANY_CALLS)
        if not self._looking:
            return

        group, draws = _kind(call.name)
        if group == "vertex":
            return

        self._ways[id(call)] = _way(call, self._program)
        lists = call.name.startswith("glCallList")
        if draws or lists:
            try:
                self._of_call[id(call)] = self._state_now()
            except state.StateError:  # between glBegin and glEnd, where lists may be called
                if not lists:
                    self.unclosed = {"call": call.name, "line": call.site.line}
                    raise
            self._changed = self._changed or lists
            return

        self._moved = self._moved or group == "matrix"
        self._changed = self._changed or group not in UNREAD

    def _state_now(self) -> int:
        """Return the index of the current state among those that were read."""
        if self._changed or not self._states:
            with unnoted():
                self._states.append(state.read())
        elif self._moved:
            with unnoted():
                unit = int(gl.glGetIntegerv(gl.GL_ACTIVE_TEXTURE)) - gl.GL_TEXTURE0
                now = {
                    name.format(unit=unit): gl.glGetFloatv(gl_constant(matrix)).ravel().tolist()
                    for name, matrix in MATRICES.items()
                }
            self._states.append({**self._states[-1], **now})
        self._changed = self._moved = False
        return len(self._states) - 1


def in_order(
    calls: Sequence[Call], brief: Sequence[Brief] = (), before: int = 0
) -> Iterator[recorded.Call | Sequence[recorded.Call]]:
    """Yield calls and those of which there is a short note, as they are made again.

    Those that only return something are left out; those that point to arrays come together.
    ``before``: how many calls the recorder had when the first of ``calls`` was made.
    """
    waiting = 0
    for place, call in enumerate(calls, before):
        while waiting < len(brief) and brief[waiting][0] <= place:
            yield brief[waiting][1], brief[waiting][-1]
            waiting += 1
        if spec.is_query(call.name):
            continue
        if call.arrays:
            yield list(call.arrays)
        yield call.name, call.args
        if call.compiled is not None:
            yield from in_order(call.compiled.calls())
    for note in brief[waiting:]:
        yield note[1], note[-1]


@cache
def _kind(name: str) -> tuple[str, bool]:
    """Return the group of a function, and whether it draws."""
    known = spec.function(name)
    return known.group if known is not None else "", spec.draws(name)


def _way(call: Call, program: str) -> list[tuple[int, str]]:
    """Return the program's lines that lead to a call that is being made, and what each calls."""
    at: FrameType | None = sys._getframe(1)
    while at is not None and at.f_code.co_filename != call.site.path:
        at = at.f_back
    found, called = [], call.name
    while at is not None:
        if at.f_code.co_filename == program:
            found.append((at.f_lineno, called))
            if at.f_code.co_name == "<module>":
                break
        called = at.f_code.co_name
        at = at.f_back
    return found[::-1]
