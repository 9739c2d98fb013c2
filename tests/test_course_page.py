"""docs/course.md: each heading of a first course has a lesson or a page, in the lecture's order."""

import re

from folded import each
from register import ROOT

from landscape.course import ladder
from landscape.course.lecture import plan as lecture
from landscape.course.pages import blocks, cells
from landscape.course.shelf import NAMES as EXERCISES

PAGE = ROOT / "docs" / "course.md"
PROGRAMS = ROOT / "landscape" / "course" / "lessons" / "programs"
FIRST_COURSE = lecture.COURSE.parent / "first_course.txt"
COUNTS = {"1": 8, "2": 7, "3": 26, "4": 11, "5": 8, "A": 16}  # headings of each chapter
_CODE = re.compile(r"`([^`]+)`")


def rows() -> list[list[str]]:
    """Return the cells of each row that has a section."""
    found = [cells(block.text) for block in blocks(PAGE.read_text("utf-8")) if block.is_row]
    return [row for row in found if re.match(r"[1-5A](\.\d+)*$", row[0])]


def names(cell: str) -> list[str]:
    return _CODE.findall(cell)


def test_every_heading_has_a_row_in_the_order_of_the_text() -> None:
    sections = [row[0] for row in rows()]
    for chapter, count in COUNTS.items():
        assert sum(section[0] == chapter for section in sections) == count, chapter
    places = [[*map(int, section.replace("A", "6").split("."))] for section in sections]
    assert places == sorted(places)
    for before, after in zip(places, places[1:], strict=False):
        assert after[:-1] == before[: len(after) - 1] or len(after) == 1
        assert after[-1] == (before[len(after) - 1] + 1 if len(before) >= len(after) else 1)


@each("row", rows(), ids=lambda row: row[0])
def test_a_heading_names_a_lesson_or_a_page_and_all_that_it_names_exists(row: list[str]) -> None:
    _, heading, lessons, beside = row
    assert heading and names(lessons) + names(beside)
    for name in names(lessons):
        assert ladder.lesson(name).name == name
    for name in names(beside):
        if name.startswith("landscape lecture"):
            words = name.split()
            assert words[2] == FIRST_COURSE.stem
            steps = [step.name for step in lecture.read(FIRST_COURSE).steps]
            assert len(words) == 3 or (words[3] == "--from" and words[4] in steps)
        elif "/" in name:
            assert (ROOT / name).exists(), name
        else:
            both = [PROGRAMS / f"{name}.py", PROGRAMS / f"{name}_glut.py"]
            known = name in EXERCISES or name in ladder.NAMES
            assert known or all(path.exists() for path in both), name


def test_an_exercise_is_named_as_one() -> None:
    for row in rows():
        after = re.search(r"exercises? (.*)", row[3])
        for name in names(after[1]) if after else ():
            assert name in EXERCISES, name


def test_all_programs_of_the_course_stand_beside_a_heading() -> None:
    expected = {path.stem for path in PROGRAMS.glob("*.py") if not path.stem.endswith("_glut")}
    assert expected <= {name for row in rows() for name in names(row[3])}


def test_the_lecture_shows_the_lessons_in_the_order_of_the_headings() -> None:
    wanted = list(dict.fromkeys(name for row in rows() for name in names(row[2])))
    assert [step.name for step in lecture.read(FIRST_COURSE).steps] == wanted
