"""`landscape why` on programs as first-year students write them, and on the same ones mended.

Each file of ``student_programs`` holds both. Its first line says which cause is to be named first,
in which frame, and a pixel that is wrong, or null. A line that ends in ``#-`` is only in the broken
program, one that ends in ``#+`` only in the mended one.
"""

import json
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from watching import screen

ROOT = Path(__file__).resolve().parents[1]
PROGRAMS = sorted(Path(__file__).with_name("student_programs").glob("*.txt"))
CHILD = """
import json, sys
from framelens.program.program_frame import ProgramFrame
from framelens.report.why_report import find
frame, pixels, *paths = json.loads(sys.argv[1])
for path in paths:
    for pixel in pixels:
        found = find(ProgramFrame(path, frame=frame), tuple(pixel) if pixel else None, limit=60.0)
        print(json.dumps(found.as_json("en"), default=str))
"""


@pytest.fixture(scope="module")
def display() -> Iterator[str]:
    """The name of a screen, without which GLUT opens no window."""
    with screen() as name:
        yield name


def part(lines: list[str], kept: str, left_out: str) -> str:
    """Return the lines without those that end in ``left_out``, and without the mark ``kept``."""
    chosen = [line for line in lines if not line.endswith(left_out)]
    return "\n".join(line.removesuffix(kept).rstrip() for line in chosen) + "\n"


@pytest.mark.posix_only("its tests have no GLUT")
@pytest.mark.sweep(7, first=3)
@pytest.mark.parametrize("path", PROGRAMS, ids=lambda path: path.stem)
def test_the_mistake_of_a_student_is_named_and_its_absence_too(path, display, tmp_path):
    first, *lines = path.read_text(encoding="utf-8").splitlines()
    case = json.loads(first)
    broken, mended = tmp_path / "broken.py", tmp_path / "mended.py"
    broken.write_text(part(lines, "#-", "#+"), encoding="utf-8")
    mended.write_text(part(lines, "#+", "#-"), encoding="utf-8")

    pixels = [None, case["pixel"]] if case["pixel"] else [None]
    asked = json.dumps([case["frame"], pixels, str(broken), str(mended)])
    done = subprocess.run(
        [sys.executable, "-c", CHILD, asked],
        capture_output=True,
        text=True,
        timeout=120,
        env={**os.environ, "PYTHONPATH": str(ROOT), "DISPLAY": display},
    )
    assert done.returncode == 0, done.stderr[-2000:]
    answers = [json.loads(line) for line in done.stdout.splitlines() if line.startswith("{")]
    assert len(answers) == 2 * len(pixels)
    for answer in answers[: len(pixels)]:
        assert [cause["cause"] for cause in answer["causes"]][:1] == [case["cause"]], answer
        assert answer["causes"][0]["pixels"] > 0
    assert [answer["causes"] for answer in answers[len(pixels) :]] == [[]] * len(pixels)
