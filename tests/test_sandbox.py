"""The sandbox: two ways to start a program's process, one outcome; and what fails of ours is told.

What programs may not do is in test_grader.py.
"""

import os
from collections.abc import Iterator
from pathlib import Path

import pytest
from solved import solved

from framelens.base.errors import UnexpectedError
from framelens.system import limits
from landscape.commands.exercise_check import as_json
from landscape.course.exercise import Grader
from landscape.course.grader import sandbox
from landscape.course.grader.evidence import Evidence
from landscape.course.grader.sandbox import Job, Sandbox
from landscape.course.shelf import exercise

SECONDS = 20.0  # a program may take; the machine may be busy with other tests
HEAD = "# exercise: winding\nimport os\nimport glfw\nfrom OpenGL.GL import *\n"
OPEN = """
glfw.init()
window = glfw.create_window(640, 480, "", None, None)
glfw.make_context_current(window)
"""
SOLUTION = solved("winding")
# What becomes of a program: "" if it is graded, else a word of troubles.py.
PROGRAMS = {
    "good": (SOLUTION, ""),
    "wrong": ((exercise("winding").folder / "start.py").read_text(encoding="utf-8"), ""),
    "crashes": (HEAD + OPEN + "import ctypes\nctypes.string_at(0)\n", "crashed_at"),
    "aborts": (HEAD + OPEN + "os.abort()\n", "crashed_at"),
    "takes all memory": (HEAD + OPEN + "data = [bytearray(1 << 28) for _ in range(9)]", "memory"),
    "prints": (SOLUTION.replace("import glfw\n", "import glfw\nprint('x' * 9**8)\n", 1), ""),
    "raises": (HEAD + OPEN + "1 / 0\n", "raised"),
    "raises what Ctrl-C raises": (HEAD + "raise KeyboardInterrupt\n", "raised"),
    "raises what ends the process that asks it": (
        HEAD + "class Odd(Exception):\n    def __str__(self): os._exit(3)\n\nraise Odd\n",
        "raised",
    ),
    "starts a program": (HEAD + "os.system('true')\n", "start"),
}
if hasattr(os, "fork"):
    PROGRAMS["forks"] = (HEAD + "os.fork()\n", "start")
WAYS = ("copied", "started")


@pytest.fixture
def started(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let each program have a Python of its own, as on macOS and Windows."""
    monkeypatch.setattr(limits, "FORKS", False)


@pytest.fixture(params=WAYS)
def way(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> str:
    """Each way to start a process that this system has."""
    if request.param == "started":
        monkeypatch.setattr(limits, "FORKS", False)
    elif not limits.FORKS:
        pytest.skip("this system copies no processes")
    return str(request.param)


@pytest.fixture(scope="module")
def graders() -> Iterator[dict[str, Grader]]:
    """One grader for each way."""
    with Grader(SECONDS) as copied, Grader(SECONDS) as started:
        yield {"copied": copied, "started": started}


@pytest.mark.parametrize("name", PROGRAMS)
@pytest.mark.sweep(14)
def test_a_program_has_the_same_report_in_a_python_of_its_own(
    name: str, graders: dict[str, Grader], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    code, word = PROGRAMS[name]
    path = tmp_path / "mine.py"
    path.write_text(code, encoding="utf-8")
    reports = {"copied": graders["copied"].check(path)}
    monkeypatch.setattr(limits, "FORKS", False)
    reports["started"] = graders["started"].check(path)
    one, other = (as_json(found, lambda text, context="": text) for found in reports.values())
    assert one == other
    error = reports["started"].error
    assert (error["word"] if error is not None else "") == word


@pytest.mark.parametrize(
    ("code", "word", "grace"),
    [
        (OPEN + "while True:\n    pass\n", "no_frame", 300.0),
        (OPEN + "sum(range(10**13))\n", "late", sandbox.GRACE),
    ],
)
@pytest.mark.sweep(12, first=5)
def test_a_loop_is_ended_in_a_python_of_its_own(
    code: str,
    word: str,
    grace: float,
    tmp_path: Path,
    started: None,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    # The program's own second is one of the processor, which may take long on a busy machine.
    monkeypatch.setattr(sandbox, "GRACE", grace)
    path = tmp_path / "mine.py"
    path.write_text(HEAD + code)
    with Grader(1.0) as hasty:
        # A busy machine may not run the solution in time.
        hasty._solutions["winding"] = Evidence(path, [], {})
        error = hasty.check(path).error
    assert error is not None and error["word"] == word


@pytest.mark.seldom(3, first=1)
def test_a_defect_in_the_process_of_a_program_is_told_with_its_traceback(
    way: str, tmp_path: Path
) -> None:
    path = tmp_path / "mine.py"
    path.write_text(SOLUTION, encoding="utf-8")
    defect = r"ended \(ValueError: max.*, in .*witness\.py, line \d+\)"
    with Sandbox() as box, pytest.raises(UnexpectedError, match=defect) as told:
        box.run([Job(str(path), frames=())])
    assert "Traceback" in told.value.details and "witness.py" in told.value.details


def test_a_process_that_cannot_start_says_why(
    way: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PYTHONHASHSEED", "many")
    with (
        Sandbox() as box,
        pytest.raises(UnexpectedError, match=r"\(Fatal Python error.*PYTHONHASHSEED"),
    ):
        box.run([Job(str(tmp_path / "mine.py"), [0])])


def test_a_process_that_is_not_ready_in_time_is_ended(
    started: None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sandbox, "START", 0.01)
    with Sandbox() as box, pytest.raises(UnexpectedError, match="not ready within"):
        box.run([Job(str(tmp_path / "mine.py"), [0])])
