"""The solutions stay with teachers: what students install has their calls, not their programs."""

import argparse
import ctypes
import json
import shutil
import tomllib
from pathlib import Path

import numpy as np
import pytest
from folded import each
from solved import solved

from framelens.base.errors import InputError
from landscape.commands import exercise_solution
from landscape.commands.exercise_check import as_text
from landscape.course import exercise as exercises
from landscape.course import solutions
from landscape.course.exercise import Grader
from landscape.course.grader import recorded, stream
from landscape.course.grader.recording import source
from landscape.course.grader.trial import Trial
from landscape.course.shelf import NAMES, exercise

ROOT = Path(__file__).parents[1]
PATIENCE = 100.0  # seconds a program may take here: the machine may be busy with other tests


@pytest.mark.parametrize("target", ["wheel", "sdist"])
def test_no_solution_is_in_the_package(target: str) -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    patterns = project["tool"]["hatch"]["build"]["targets"][target]["exclude"]
    left_out = {path for pattern in patterns for path in ROOT.glob(pattern.lstrip("/!"))}
    for name in NAMES:
        folder = exercise(name).folder
        programs = {*folder.glob("solution*.py"), folder / "mutants.py"}
        assert len(programs) >= 3 and programs <= left_out
        assert folder / recorded.FILE not in left_out and folder / "start.py" not in left_out


@pytest.mark.seldom(13, first=2)
@each("name", NAMES)
def test_the_calls_are_those_of_the_solution_as_it_is(name: str) -> None:
    found = exercise(name)
    assert recorded.read(found.folder / recorded.FILE).source == source(found), (
        "python -m landscape.course.grader.recording"
    )


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.sweep(14, first=10)
def test_without_solutions_the_grader_draws_their_calls(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(exercises, "solution_of", lambda folder: None)
    folder = exercise(name).folder
    with Grader(PATIENCE) as grader:
        report = grader.check(folder / "solution.py")
        assert report.passed, as_text(report, lambda text, context="": text)
        assert report.difference == 0
        assert grader.check(folder / "solution2.py").passed
        assert grader.check(folder / "start.py").passed is False


def test_teachers_are_told_where_the_solutions_are(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    shutil.copytree(
        exercise("winding").folder,
        tmp_path / "winding",
        ignore=shutil.ignore_patterns("solution*.py", "mutants.py"),
    )
    options = argparse.Namespace(name="winding", way=1, exercises=tmp_path)
    monkeypatch.delenv(solutions.FOLDER, raising=False)
    with pytest.raises(InputError, match=r"in a checkout.*LANDSCAPE_SOLUTIONS"):
        exercise_solution.run(options)
    monkeypatch.setenv(solutions.FOLDER, str(exercise("winding").folder.parent))
    assert exercise_solution.run(options) == 0
    text = solved("winding")
    assert capsys.readouterr().out == text
    options.way = 2
    assert exercise_solution.run(options) == 0
    assert capsys.readouterr().out == solved("winding", "solution2.py")
    options.way = 5
    with pytest.raises(InputError, match="--way 5: expected 1 to 4"):
        exercise_solution.run(options)


def test_a_damaged_file_of_calls_is_an_input_error(tmp_path: Path) -> None:
    path = tmp_path / recorded.FILE
    shutil.copy(exercise("winding").folder / recorded.FILE, path)
    data = path.read_bytes()
    for damaged in (b"", data[:-9], data[:200] + bytes(9) + data[209:], b"{}"):
        path.write_bytes(damaged)
        with pytest.raises(InputError, match="expected the calls of a solution"):
            recorded.read(path)


def test_calls_are_read_as_they_were_written(tmp_path: Path) -> None:
    path = tmp_path / recorded.FILE
    arguments = (1, 2.5, None, b"x", [np.float32(1.5)], np.eye(2, dtype=np.float32))
    take = recorded.Take((8, 8), Trial([0], [], {}), [[("glFogf", arguments)]])
    path.write_bytes(recorded.packed(recorded.Recorded("", [take])))
    (frame,) = recorded.read(path).takes[0].frames
    ((function, args),) = frame
    assert function == "glFogf" and args[:5] == (1, 2.5, None, b"x", [1.5])
    assert args[5].dtype == np.float32 and (args[5] == np.eye(2)).all()


OBJECTS = {"array": 1, "type": "O", "shape": [1]}


@each(
    "call",
    [
        *(["system", 1], ["glMapBuffer", 1], ["glFogf", {"offset": 1 << 40}], ["glFogf", OBJECTS]),
        *(["glFogf", {"bytes": 9}], ["glFogf", {}], [], "glFogf", None),
    ],
)
def test_only_functions_of_opengl_are_called_and_with_numbers(call: object) -> None:
    writer = recorded.Writer()
    made = writer.frame([("glEnd", ())])
    writer.blobs.add(bytes(8))
    take = recorded.said((8, 8), Trial([0], [], {}), [made])
    assert recorded.parsed(writer.written("", [take])) is not None
    writer.calls.append(call)
    assert recorded.parsed(writer.written("", [take])) is None


@each("argument", [1 << 40, ctypes.c_void_p(1 << 40), object(), np.array([None]), {}])
def test_what_cannot_be_made_again_is_not_recorded(argument: object) -> None:
    with pytest.raises(recorded.Unrecorded):
        recorded.Writer().frame([("glFogf", (argument,))])


@each("size", [(0, 6), (8, 0), (-1, 6), (recorded.MOST_SIDE + 1, 6), (8, recorded.MOST_SIDE + 1)])
def test_a_window_has_a_possible_size(size: tuple[int, int]) -> None:
    def sent(size: tuple[int, int]) -> bytes:
        return recorded.Writer().written("", [recorded.said(size, Trial([0], [], {}), [])])

    assert recorded.parsed(sent(size)) is None
    for possible in ((1, 1), (recorded.MOST_SIDE, recorded.MOST_SIDE)):
        assert recorded.parsed(sent(possible)) is not None


def test_arrays_are_pointed_to_again_only_where_that_has_changed(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    pointing = [("glVertexPointer", (3, 5126, 0, [1.0]))]
    draw, disable = ("glDrawArrays", (4, 0, 3)), ("glDisableClientState", (0x8074,))
    writer = recorded.Writer()
    frame = writer.frame([pointing, draw, pointing, draw, disable, pointing, draw])
    assert np.frombuffer(writer.blobs.all[frame], np.int32).tolist() == [0, 1, 1, 2, 0, 1]
    monkeypatch.setattr(recorded, "MOST_CALLS", 4)
    writer.frame([("glEnd", ())])
    with pytest.raises(recorded.Unrecorded):
        writer.frame([("glFlush", ())])


@each("sizes", [[-1, 3], [1.0, 1], [True, 1], [1], [1, 2], ["1", 1], [2, 1]])
def test_blobs_that_are_not_as_long_as_is_said_are_no_answer(sizes: list[object]) -> None:
    def sent(sizes: list[object]) -> bytes:
        text = json.dumps({"blobs": sizes}).encode()
        return stream.LENGTH.pack(len(text)) + text + b"ab"

    assert stream.received(sent([1, 1])) is not None and stream.received(sent([2])) is not None
    assert stream.received(sent(sizes)) is None


def test_a_text_that_is_too_long_is_no_answer(monkeypatch: pytest.MonkeyPatch) -> None:
    data = b"".join(stream.parts({"a": 1}))
    monkeypatch.setattr(stream, "MOST_TEXT", len(data) - stream.LENGTH.size)
    assert stream.received(data) is not None
    monkeypatch.setattr(stream, "MOST_TEXT", len(data) - stream.LENGTH.size - 1)
    assert stream.received(data) is None
