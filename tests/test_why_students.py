"""`landscape why` on programs as first-year students write them, and on the same ones mended.

Each file of ``student_programs`` holds both. Its first line says which cause is to be named first,
in which frame, and a pixel that is wrong, or null. A line that ends in ``#-`` is only in the broken
program, one that ends in ``#+`` only in the mended one.
"""

import json
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from commands import environment, landscape, python
from watching import screen

from framelens.base.texts import translator
from landscape.course.pages import blocks

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "black.md"
ASKED = re.compile(r"`landscape why (\w+)\.py(?: (\d+),(\d+))?(?: --frame (\d+))?` answers")
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
@pytest.mark.sweep(14)
@pytest.mark.parametrize("path", PROGRAMS, ids=lambda path: path.stem)
def test_the_mistake_of_a_student_is_named_and_its_absence_too(path, display, tmp_path):
    first, *lines = path.read_text(encoding="utf-8").splitlines()
    case = json.loads(first)
    broken, mended = tmp_path / "broken.py", tmp_path / "mended.py"
    broken.write_text(part(lines, "#-", "#+"), encoding="utf-8")
    mended.write_text(part(lines, "#+", "#-"), encoding="utf-8")

    pixels = [None, case["pixel"]] if case["pixel"] else [None]
    asked = json.dumps([case["frame"], pixels, str(broken), str(mended)])
    done = python(CHILD, asked, env=environment(DISPLAY=display))
    assert done.status == 0, done.err[-2000:]
    answers = [json.loads(line) for line in done.out.splitlines() if line.startswith("{")]
    assert len(answers) == 2 * len(pixels)
    for answer in answers[: len(pixels)]:
        assert [cause["cause"] for cause in answer["causes"]][:1] == [case["cause"]], answer
        assert answer["causes"][0]["pixels"] > 0
    assert [answer["causes"] for answer in answers[len(pixels) :]] == [[]] * len(pixels)


def broken_program(path: Path, folder: Path) -> tuple[Path, str]:
    """Write the broken program into a folder; return it with its text."""
    _, *lines = path.read_text(encoding="utf-8").splitlines()
    program = folder / f"{path.stem}.py"
    program.write_text(part(lines, "#-", "#+"), encoding="utf-8")
    return program, program.read_text(encoding="utf-8")


@pytest.mark.posix_only("its tests have no GLUT")
@pytest.mark.sweep(14)
@pytest.mark.parametrize("number", range(11))
def test_the_answers_on_the_page_are_those_of_the_tool(number, display, tmp_path):
    told = blocks(PAGE.read_text(encoding="utf-8"))
    place = [k for k, block in enumerate(told) if ASKED.match(block.text)][number]
    name, x, y, frame = ASKED.match(told[place].text).groups()
    program, text = broken_program(
        Path(__file__).with_name("student_programs") / f"{name}.txt", tmp_path
    )
    for line in told[place - 1].text.splitlines()[1:-1]:
        assert line.strip() in text, "the page shows a line that the program has not"

    words = [str(program), *([f"{x},{y}"] if x else []), "--frame", frame or "0"]
    for language, answers in (("en", "answers, for line"), ("fr", "répond, pour la ligne")):
        env = environment(DISPLAY=display)
        done = landscape("why", *words, "--lang", language, env=env)
        _, cause, sentence, mend = [line.strip() for line in done.out.splitlines() if line][:4]
        line = cause.partition(":")[2].split()[0]
        colon = ":" if language == "en" else " :"
        expected = f"{answers} {line}{colon} {sentence} {mend}"
        shown = translator(language, "docs/black")(told[place].text)
        assert plain(shown).endswith(plain(expected))


def plain(text: str) -> str:
    """Return a text with plain spaces and apostrophes."""
    return re.sub("[\u00a0\u202f]", " ", text).replace("\u2019", "'")
