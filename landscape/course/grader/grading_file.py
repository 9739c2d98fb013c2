"""Reading a grading.py, and a hidden.py: the frames to look at, the events, and the tests.

Both have the form that grading.py of this room describes. The tests of hidden.py are not shown to
students; they look at frames of their own, after events of their own.
"""

import traceback
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from runpy import run_path
from typing import Any

from framelens.base.errors import InputError
from framelens.base.input import read_bounded
from framelens.program.program_events import read_events
from landscape.course.grader.grading import MOST, Test, tests_of
from landscape.course.not_python import not_python

MOST_ELSEWHERE = 0.05  # chosen: more hides a part of the picture
PICTURE = "picture"  # the test that every exercise has
LAST_FRAME = 1000  # chosen: of FRAMES; a program has some seconds to get there
MOST_BYTES = 1 << 20  # chosen: of a file


@dataclass(frozen=True)
class Grading:
    """The contents of a grading file: the ``frames`` that are checked, ``events`` and ``tests``.

    ``elsewhere``: the fraction of the pixels that may differ in a trial (trial.py).
    """

    frames: Sequence[int]
    events: Sequence[dict[str, object]]
    tests: Sequence[Test]
    elsewhere: float = MOST


def read_grading(path: Path, hidden: bool = False) -> Grading:
    """Read a grading.py; InputError names the file, and the name in it that is wrong.

    With ``hidden`` it is a hidden.py: its tests are marked as hidden, and none need be of the
    picture.
    """
    names = names_of(path)
    tests = [replace(test, hidden=hidden) for test in tests_of(names)]
    keys = [test.key for test in tests]
    for number, test in enumerate(tests):
        for needed in test.needs:
            if needed.key not in keys[:number]:
                raise InputError(
                    "{path}: {test}: needs {needed}, which must stand before it",
                    path=path,
                    test=test.key,
                    needed=needed.key,
                )

    if not tests:
        raise InputError("{path}: expected a function with @test above it", path=path)
    if PICTURE not in keys and not hidden:
        raise InputError(
            "{path}: {name}: expected a test of this name, which compares the pictures",
            path=path,
            name=PICTURE,
        )
    return Grading(_frames(path, names), _events(path, names), tests, _elsewhere(path, names))


def names_of(path: Path) -> Mapping[str, object]:
    """Run a file of an exercise and return its names; InputError says in which line it fails."""
    read_bounded(path, MOST_BYTES)

    try:
        return run_path(str(path))
    except SyntaxError as error:
        raise not_python(path, error) from None
    except (Exception, SystemExit) as error:
        lines = [
            entry.lineno for entry in traceback.extract_tb(error.__traceback__) if _is(entry, path)
        ]
        raise InputError(
            "{path}, line {line}: raised {kind}: {reason}",
            path=path,
            line=lines[-1] if lines else 1,
            kind=type(error).__name__,
            reason=" ".join(str(error).split()),
        ) from None


def _is(entry: traceback.FrameSummary, path: Path) -> bool:
    return entry.filename == str(path)


def _frames(path: Path, names: Mapping[str, Any]) -> Sequence[int]:
    found = names.get("FRAMES")
    wanted = isinstance(found, Sequence) and not isinstance(found, str) and len(found) > 0
    if not wanted or not all(_is_frame(each) for each in found or ()):
        raise InputError(
            "{path}: FRAMES: expected numbers of frames from 0 to {last}, such as (0, 30)",
            path=path,
            last=LAST_FRAME,
        )
    return tuple(found or ())


def _is_frame(value: object) -> bool:
    return isinstance(value, int) and not isinstance(value, bool) and 0 <= value <= LAST_FRAME


def _events(path: Path, names: Mapping[str, object]) -> Sequence[dict[str, object]]:
    found = names.get("EVENTS", ())
    if not isinstance(found, Sequence) or isinstance(found, str):
        raise InputError("{path}: EVENTS: expected a list of events", path=path)
    try:
        read_events(found)
    except InputError as error:
        raise InputError("{path}: EVENTS: {error}", path=path, error=error) from None
    return found


def _elsewhere(path: Path, names: Mapping[str, Any]) -> float:
    found = names.get("ELSEWHERE", MOST)
    if type(found) not in (int, float) or not 0 <= found <= MOST_ELSEWHERE:
        raise InputError(
            "{path}: ELSEWHERE: expected a fraction of the pixels from 0 to {most}, such as 0.004",
            path=path,
            most=MOST_ELSEWHERE,
        )
    return float(found)
