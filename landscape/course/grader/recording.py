"""Records the solutions for those who have no programs of them (recorded.py).

    python -m landscape.course.grader.recording              # those that have changed
    python -m landscape.course.grader.recording winding      # these

Each is played once: its pictures must be those of the program.
"""

import hashlib
import json
import random
import sys
from collections.abc import Callable, Collection, Iterator, Sequence
from contextlib import ExitStack
from pathlib import Path

import numpy as np

from framelens.base.output import write_whole
from framelens.gl.framebuffer import read_pixels
from framelens.gl.notes import Call
from framelens.gl.seam import begin_pass, outermost, recording, unnoted
from framelens.program.program import run
from framelens.program.program_run import Window
from framelens.spec import spec
from landscape.course import solutions
from landscape.course.exercise import gradings
from landscape.course.grader import recorded
from landscape.course.grader.calls import base
from landscape.course.grader.picture import pictures
from landscape.course.grader.recorded import FILE, PLAYER, Recorded, Take
from landscape.course.grader.trial import Trial, trial
from landscape.course.shelf import NAMES, Exercise, exercise
from landscape.course.solutions import found, runnable

TRIALS = 8  # chosen: a student's grader takes one of them by chance
# Calls that draw inside glBegin and glEnd, which are left out together.
INSIDE = ("glEnd", "glVertex", "glArrayElement", "glEvalCoord", "glEvalPoint")


def runs(of: Exercise) -> list[Trial]:
    """Return what is recorded of a solution: the exercise's own frames, and trials."""
    shown, _hidden = gradings(of)
    code = solutions.whole(found(of.folder), of.folder)
    own = Trial(list(shown.frames), list(shown.events), {})
    return [own, *(trial(code, random.Random(f"{n} {of.name}")) for n in range(TRIALS))]


def source(of: Exercise) -> str:
    """Return the checksum of a solution and of what is recorded of it."""
    drawn = [[list(each.frames), list(each.events)] for each in runs(of)]
    code = solutions.whole(found(of.folder), of.folder)
    data = code.encode() + json.dumps(drawn).encode()
    return hashlib.sha256(data).hexdigest()


def record(of: Exercise) -> bytes:
    """Run a solution; return the bytes of the file that shows what it draws.

    Unrecorded if its calls do not give its pictures again, or cannot be made again.
    """
    with runnable(found(of.folder), of.folder) as path:
        takes = [_recorded(path, each) for each in runs(of)]
    return recorded.packed(Recorded(source(of), takes))


def _recorded(path: Path, drawn: Trial) -> Take:
    """Return a take that plays the same pictures; whole where less does not."""
    for whole in (False, True):
        recorder = _Recorder(drawn.frames, whole)
        with recorder:
            run(path, max(drawn.frames), list(drawn.events) or None, observer=recorder)
        take = Take(recorder.size, drawn, recorder.frames)
        recorded.playing[:] = [take]
        played = pictures(PLAYER, drawn.frames, list(drawn.events) or None)
        if all(map(np.array_equal, recorder.pictures, played)):
            return take
    raise recorded.Unrecorded(f"{path}: its calls do not give its pictures")


class _Recorder(ExitStack):
    """Observes a program: its calls in each frame, and the pictures of those looked at."""

    def __init__(self, wanted: Collection[int], whole: bool) -> None:
        super().__init__()
        self._wanted, self._whole = wanted, whole
        self.size = (0, 0)
        self.frames: list[list[recorded.Call]] = []
        self.pictures: list[np.ndarray] = []

    def make(self, name: str, function: Callable[..., object]) -> Callable[..., object]:
        return outermost(name, function, spec.draws(name))

    def opened(self, window: Window) -> None:
        self._window, self.size = window, window.size()
        self._recorder = self.enter_context(recording(complete=True))
        begin_pass("setup")

    def frame_began(self, number: int) -> None:
        pass

    def frame_ended(self, number: int) -> None:
        looked_at = number in self._wanted
        calls = self._recorder.calls
        self.frames.append(list(_made(calls, looked_at or self._whole)))
        calls.clear()
        if looked_at:
            with unnoted():
                self.pictures.append(read_pixels(self._window.size()))

    def notice(self, text: str) -> None:
        pass


def _made(calls: Sequence[Call], draws: bool) -> Iterator[recorded.Call]:
    """Yield calls as they are made again, without those that only return something."""
    for call in calls:
        drawing = spec.draws(call.name) or base(call.name) in INSIDE
        if spec.is_query(call.name) or (drawing and not draws):
            continue
        yield from call.arrays
        yield call.name, call.args
        if call.compiled is not None:
            yield from _made(call.compiled.calls(), True)


def main(names: Sequence[str]) -> None:
    """Record the solutions that are named, or those that have changed."""
    for name in names or NAMES:
        of = exercise(name)
        path = of.folder / FILE
        if names or not path.exists() or recorded.read(path).source != source(of):
            write_whole(path, record(of))
            print(f"{path}: {path.stat().st_size:,} bytes")


if __name__ == "__main__":
    main(sys.argv[1:])
