"""What is noted of a program while it runs in the sandbox: pictures, calls, and states.

The evidence is a file of JSON, and a file of pixels for each frame that is looked at. It says

- "frames": number to {"size", "pixels" (a file's name), "setup" and "calls"};
- "states": OpenGL's state at the calls that draw, by the names of capture/state.py; the first is
  whole, the others are what differs from it;
- "early": null, or the first function that was called without a context, in vain, and the line;
- "error", if the program did not get that far: what went wrong, by one of the words of
  landscape.course.troubles, and the "line" of the program and other values for its message.

A call is {"name", "args", "line", "function", "own", "way", "state", "inside", "arrays"}. "own"
says whether the line is the program's, not that of a module it imports; "way" holds the lines of
the program that lead to the call, from the outermost, each with the function that it calls; "state"
is an index of "states"; "inside" holds the calls of a display list, "arrays" the pointer calls of a
draw call that reads vertex arrays.
"""

import json
import sys
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from functools import cache
from pathlib import Path
from types import FrameType
from typing import Any

import numpy as np

from landscape.capture import program, spec, state
from landscape.capture.program import Window
from landscape.capture.program_source import ProgramError
from landscape.course.refusals import Refusals
from landscape.course.troubles import SENTENCES
from landscape.errors import InputError
from landscape.gl.calls import begin_pass, frame_begins, gl, outermost, recording, unnoted
from landscape.gl.framebuffer import read_pixels
from landscape.gl.notes import Call, plain, shown

LONGEST = 30_000  # chosen: numbers of an array that are kept
MOST_CALLS = 200_000  # chosen: of one frame; a lesson's has a few thousand
LONGEST_CALL = 80  # chosen: characters of a call's arguments in a message
# What changes between two draw calls without changing the rest of the state.
UNREAD = ("vertex", "begin_end", "matrix")
MATRICES = ("GL_MODELVIEW_MATRIX", "GL_PROJECTION_MATRIX", "GL_TEXTURE_MATRIX")


def run(job: dict[str, Any], answer: Path, leave: Callable[[int], Any]) -> None:
    """Run a program and write the evidence; ``leave`` ends the process."""
    refusals = Refusals(job["path"], job["folder"])
    sys.addaudithook(refusals)
    witness = Witness(job["frames"], answer.parent)

    def end(found: dict[str, Any]) -> None:
        answer.write_text(json.dumps(found))
        leave(0)

    witness.finished = lambda: end(witness.evidence())
    try:
        with witness:
            program.run(
                job["path"], max(job["frames"]), job["events"] or None, limit=job["seconds"],
                observer=witness,
            )  # fmt: skip
    except ProgramError as error:
        late = f"within {job['seconds']:g} s" in str(error)
        end({"error": _trouble(error, witness, refusals, late)})
    except InputError as error:
        end({"error": {"word": "refused", "reason": str(error)}})


def _trouble(
    error: ProgramError, witness: "Witness", refusals: Refusals, late: bool
) -> dict[str, Any]:
    """Return what went wrong as a word of troubles.py, and the values of its message."""
    if package := str(error).partition("needs the Python package ")[2]:
        return {"word": "package", "reason": package.partition(",")[0].partition(":")[0]}
    raised = error.details.strip().splitlines()
    if raised:
        line = _line_of(str(error))
        if refusals.refused and raised[-1].startswith("PermissionError"):
            return {"word": refusals.refused, "line": line}
        if "MemoryError" in raised[-1]:
            return {"word": "memory", "line": line}
        return {"line": line, **_exception(error.details)}
    if "shows a frame before" in str(error):
        return {"word": "no_context"}
    if witness.window is None:
        return {"word": "late_window" if late else "no_window"}
    if late:
        return {"word": "late_frame" if witness.ended else "no_frame", "frames": witness.ended}
    if "ended after" in str(error):
        return {"word": "ended", "frames": witness.ended}
    reason = str(error).partition(": ")[2]
    for part, word in (("opens two windows", "two_windows"), ("imports neither", "no_toolkit")):
        if part in reason:
            return {"word": word}
    return {"word": "refused", "reason": reason}


def _line_of(message: str) -> int:
    """Return the line in "FILE, line 12: the program raised ..."; 0 without one."""
    digits = message.partition(", line ")[2].partition(":")[0]
    return int(digits) if digits.isdigit() else 0


def _exception(details: str) -> dict[str, Any]:
    """Return the word for what a traceback ends with, and the values of its message."""
    lines = [line.strip() for line in details.strip().splitlines()]
    if lines[-1] != ")":
        return {"word": "raised", "error": lines[-1][:200]}
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


def make(name: str, function: Callable[..., Any]) -> Callable[..., Any]:
    """Return what notes the calls of an OpenGL function."""
    return outermost(name, function, spec.draws(name))


class Witness(ExitStack):
    """Observes a program (see capture/program.py) up to the last of some frames."""

    def __init__(self, frames: Sequence[int], folder: Path) -> None:
        super().__init__()
        self._wanted, self._folder = set(frames), folder
        self._unnoted = ExitStack()
        self._frames: dict[int, dict[str, Any]] = {}
        self._states: list[dict[str, Any]] = []
        self._of_call: dict[int, int] = {}  # the index of its state, by the call's identity
        self._ways: dict[int, list[tuple[int, str]]] = {}
        self._changed = True  # whether the state must be read again, and its matrices
        self._moved = True
        self._begin = 0
        self.window: Window | None = None
        self.ended = 0  # frames that are complete
        self.finished: Callable[[], None] = lambda: None

    make = staticmethod(make)

    def opened(self, window: Window) -> None:
        """Begin to record."""
        self.window = window
        self._recorder = self.enter_context(recording(complete=True))
        self._recorder.before = self._before
        begin_pass("setup")

    def frame_began(self, number: int) -> None:
        """Forget the frames before this one, but for the setup."""
        self._looking = number in self._wanted
        if number:
            self._recorder.calls[:] = [c for c in self._recorder.calls if c.pass_ == "setup"]
            self._of_call.clear()
            setup = {id(call) for call in self._recorder.calls}
            self._ways = {key: way for key, way in self._ways.items() if key in setup}
            frame_begins()
        self._begin = len(self._recorder.calls)
        self._changed = True
        # Frames between those that are looked at are not recorded: they only take their time.
        if number and not self._looking:
            self._unnoted.enter_context(unnoted())

    def frame_ended(self, number: int) -> None:
        """Keep the picture and the calls of a frame that is to be looked at."""
        self._unnoted.close()
        self.ended = number + 1
        if number in self._wanted and self.window is not None:
            size = self.window.size()
            with unnoted():
                pixels = read_pixels(size)
            name = f"frame-{number}.rgb"
            (self._folder / name).write_bytes(pixels.tobytes())
            calls = self._recorder.calls
            setup = [c for c in calls if c.pass_ == "setup"]
            self._frames[number] = {
                "size": list(size),
                "pixels": name,
                "setup": [self._written(call) for call in setup],
                "calls": [self._written(call) for call in calls if call.pass_ != "setup"],
            }
        if number == max(self._wanted):
            self.finished()

    def notice(self, text: str) -> None:
        """Take a sentence for the user, of which a grader has no need."""

    def evidence(self) -> dict[str, Any]:
        """Return all that was noted."""
        first = self._states[0] if self._states else {}
        others = [state.difference(first, each) for each in self._states[1:]]
        states = [first, *({name: pair[1] for name, pair in each.items()} for each in others)]
        return {
            "frames": self._frames,
            "states": states,
            "early": self.window.early if self.window is not None else None,
        }

    def _before(self, call: Call) -> None:
        """Read the state before a call that draws."""
        if len(self._recorder.calls) - self._begin > MOST_CALLS:
            raise MemoryError
        group, draws = _kind(call.name)
        if group == "vertex":
            return
        self._ways[id(call)] = _way(call)
        if draws or call.name.startswith("glCallList"):
            self._of_call[id(call)] = self._state_now()
            self._changed = self._changed or call.name.startswith("glCallList")
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
                matrices = {n: gl.glGetFloatv(getattr(gl, n)).ravel().tolist() for n in MATRICES}
            now = {name: value for name, value in matrices.items() if name in self._states[-1]}
            self._states.append({**self._states[-1], **now})
        self._changed = self._moved = False
        return len(self._states) - 1

    def _written(self, call: Call) -> dict[str, Any]:
        site = call.site
        found: dict[str, Any] = {
            "name": call.name,
            "args": _arguments(call.name, call.args) if call.args else [],
            "line": site.line,
            "function": site.function,
            "own": _program() == site.path,
        }
        if id(call) in self._ways:
            found["way"] = self._ways[id(call)]
        if id(call) in self._of_call:
            found["state"] = self._of_call[id(call)]
        # Not for each glArrayElement: thousands of them would write the arrays thousands of times.
        if call.arrays and spec.draws(call.name):
            found["arrays"] = [[name, _arguments(name, args)] for name, args in call.arrays]
        if call.executed:
            found["inside"] = [self._written(inner) for inner in call.listed]
        return found


@cache
def _kind(name: str) -> tuple[str, bool]:
    """Return the group of a function, and whether it draws."""
    known = spec.function(name)
    return known.group if known is not None else "", spec.draws(name)


def _program() -> Any:
    return sys.modules["__main__"].__dict__.get("__file__")


def _way(call: Call) -> list[tuple[int, str]]:
    """Return the program's lines that lead to a call that is being made, and what each calls."""
    at: FrameType | None = sys._getframe(1)
    while at is not None and at.f_code.co_filename != call.site.path:
        at = at.f_back
    path, found, called = _program(), [], call.name
    while at is not None:
        if at.f_code.co_filename == path:
            found.append((at.f_lineno, called))
        called = at.f_code.co_name
        at = at.f_back
    return found[::-1]


def _arguments(name: str, args: tuple[Any, ...]) -> list[Any]:
    """Return the arguments as JSON: enumerants by name, arrays whole if they are not too long."""
    if name in ("glClear", "glPushAttrib"):
        return shown(name, args)
    return [_argument(value) for value in args]


def _argument(value: Any) -> Any:
    if type(value) in (float, int):
        return value
    if isinstance(value, (bytes, bytearray)):
        return {"bytes": len(value)}
    if hasattr(value, "_length_") and hasattr(value, "_type_"):
        value = list(value)
    if isinstance(value, (list, tuple, np.ndarray)):
        try:
            array = np.asarray(value)
        except ValueError:
            return plain(str(type(value)))
        if array.dtype.kind in "biuf" and array.size <= LONGEST:
            return array.tolist()
        return {"shape": list(array.shape)}
    return plain(value)
