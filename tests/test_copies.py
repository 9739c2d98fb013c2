"""Pairs that share what is rare: found first where they are, and nowhere in an honest class."""

import json
import re
from functools import cache
from pathlib import Path

import jsonschema
import pytest
from folded import each
from solved import solved

from framelens.base.texts import translator
from landscape.course.grader.mutants import mutants
from landscape.course.roster.copies import LEAST, known, pairs, traces
from landscape.course.roster.copies_page import as_json, as_lines, as_section, likenesses
from landscape.course.roster.grades import Graded, Row
from landscape.course.roster.submissions import Submission
from landscape.course.shelf import COURSE, exercise
from landscape.course.solutions import ways

SCHEMA = json.loads(
    (Path(__file__).resolve().parents[1] / "docs/exercises.schema.json").read_text("utf-8")
)

COUNT = 120
NAME = "look_at"
LOOK = re.compile(r"def look\(.*?(?=\ndef )", re.DOTALL)
# Three students' own ways, which nobody else in the class has.
FIRST = '''def along(vector, amount):
    """Scale to a length."""
    size = sum(part * part for part in vector) ** 0.5
    return [amount * part / size for part in vector]


def look(eye, target, up):
    # first I turn everything round, then I walk backwards
    forward = along([target[k] - eye[k] for k in range(3)], 1.0)
    side = along(np.cross(forward, along(up, 1.0)), 1.0)
    above = np.cross(side, forward)
    rows = [*side, 0.0, *above, 0.0, *(-part for part in forward), 0.0, 0.0, 0.0, 0.0, 1.0]
    glMultMatrixd([rows[4 * column + row] for row in range(4) for column in range(4)])
    glTranslated(*(-1.0000001 * part for part in eye))

'''
SECOND = """def look(eye, target, up):
    # heading and pitch, as in my flight simulator from last year
    dx, dy, dz = np.subtract(target, eye)
    heading = np.degrees(np.arctan2(dx, -dz))
    pitch = np.degrees(np.arctan2(dy, np.hypot(dx, dz)))
    roll = 0 if up[0] == 0 else 26.565051
    glRotated(roll, 0, 0, 1)
    glRotated(-pitch, 1, 0, 0)
    glRotated(heading, 0, 1, 0)
    glTranslated(-eye[0], -eye[1], -eye[2])

"""
THIRD = """def basis_from(eye, target, up):
    nose = np.array(target, dtype="f8") - np.array(eye, dtype="f8")
    nose /= max(abs(nose).max(), 1e-9)
    nose /= np.sqrt(nose @ nose)
    ear = np.cross(nose, up)
    return ear / np.sqrt(ear @ ear), nose


def put_into_frame(ear, crown, nose):
    # the nose points at the market, the ear at the river
    grid = np.zeros((4, 4), dtype="f8")
    grid[0, :3], grid[1, :3], grid[2, :3], grid[3, 3] = ear, crown, -nose, 1
    glMultTransposeMatrixd(grid)


def look(eye, target, up):
    ear, nose = basis_from(eye, target, up)
    put_into_frame(ear, np.cross(ear, nose), nose)
    glTranslated(*np.negative(eye))

"""


def with_look(code: str) -> str:
    return LOOK.sub(lambda _found: code, solved(NAME), count=1)


def renamed(code: str) -> str:
    for number, name in enumerate(("along", "vector", "amount", "size", "part", "forward", "side")):
        code = re.sub(rf"\b{name}\b", f"other{number}", code)
    return re.sub(r"\b(above|rows|column)\b", r"my_\1", code.replace("# first I turn", "# turn"))


def reordered(code: str) -> str:
    helper, other, look = re.split(r"(?=^def )", code, flags=re.MULTILINE)[1:]
    return f"{look}\n\n{other.rstrip()}\n\n\n{helper}"


def other_comments(code: str) -> str:
    return re.sub(r"# heading.*", "# angles of the view, from the difference of both points", code)


@cache
def honest(name: str) -> list[str]:
    """Return a class of so many, made from the solutions and the mistakes of an exercise."""
    first, *others = (solved(name, file.name) for file in ways(exercise(name).folder))
    programs = [first, *others, *(mutant.of(first) for mutant in mutants(exercise(name)).values())]
    return [programs[number % len(programs)] for number in range(COUNT)]


@pytest.mark.seldom(13, first=9)
@each("name", ["look_at", "missing_enable", "bresenham"])
def test_an_honest_class_has_no_pair(name: str) -> None:
    students = [str(number) for number in range(COUNT)]
    assert pairs(honest(name), known(exercise(name)), students) == []


@pytest.fixture(scope="module")
def planted() -> list[str]:
    """A class with three originals and a copy of each, at places 10, 20, 30 and 110, 111, 112."""
    programs = list(honest(NAME))
    copies = ((FIRST, renamed), (SECOND, other_comments), (THIRD, reordered))
    for number, (original, disguised) in enumerate(copies):
        programs[10 * number + 10] = with_look(original)
        programs[110 + number] = with_look(disguised(original))
    return programs


@pytest.mark.seldom(10, first=2)
def test_three_planted_copies_are_found_first_and_nothing_else(planted: list[str]) -> None:
    students = [str(number) for number in range(COUNT)]
    found = pairs(planted, known(exercise(NAME)), students)
    assert {(pair.first, pair.second) for pair in found} == {(10, 110), (20, 111), (30, 112)}
    assert min(pair.score for pair in found) > 2 * LEAST
    kinds = {pair.first: {shared.kind for shared in pair.shared} for pair in found}
    assert {"sequence", "number"} <= kinds[10] and "comment" not in kinds[20]
    assert {"comment", "name", "sequence"} <= kinds[30]
    lines = {number: planted[number].splitlines() for number in range(COUNT)}
    for pair in found:
        for shared in pair.shared:
            if shared.kind in ("name", "number"):
                for number, line in zip((pair.first, pair.second), shared.lines, strict=True):
                    assert shared.text in lines[number][line - 1]

    # What the start and the solutions have is subtracted: without that all resemble each other.
    assert pairs(planted[:2], known(exercise(NAME)), students[:2]) == []
    assert len(pairs(planted[:2], set(), students[:2])) == 1
    # What many share is not rare, and two programs of one student are no pair.
    many = [with_look(FIRST) if number % 4 == 0 else code for number, code in enumerate(planted)]
    assert 4 not in {pair.first for pair in pairs(many, known(exercise(NAME)), students)}
    same = ["x" if number in (10, 110) else student for number, student in enumerate(students)]
    assert (10, 110) not in {
        (pair.first, pair.second) for pair in pairs(planted, known(exercise(NAME)), same)
    }


def test_what_is_no_python_is_compared_as_far_as_it_can_be_read() -> None:
    found = traces("wobble = 3.25  # for the bay\ndef f(:\n  '''open")
    assert {("name", "wobble"), ("number", "3.25"), ("comment", "for the bay")} <= set(found)
    assert traces("\0") == {} or traces("\0")


def test_pairs_are_shown_side_by_side_and_never_as_a_verdict(planted: list[str]) -> None:
    def given(number: int) -> Graded:
        row = Row(f"<b>{number}</b>", str(number), f"{number}.py", exercise=NAME)
        return Graded(row, Submission(str(number), data=planted[number].encode()))

    found = likenesses([given(number) for number in (10, 20, 21, 110)], COURSE)
    assert [(each.first.row.id, each.second.row.id) for each in found] == [("10", "110")]

    def plain(text: str, context: str = "") -> str:
        return text

    section = as_section(found, plain)
    assert "It is no verdict" in section and section.count("<pre>") == 2
    assert "<b>" not in section and section.count("<mark>") >= 6
    first, second = as_lines(found, plain)
    assert "It is no verdict" in first and "look_at: <b>10</b> and <b>110</b>: " in second
    (shown,) = as_json(found)
    jsonschema.validate({"submissions": [], "copies": [shown]}, SCHEMA)
    assert shown["students"] == ["<b>10</b>", "<b>110</b>"] and shown["score"] > LEAST
    in_french = as_lines(found, translator("fr", "course"))[1]
    assert in_french.startswith("look_at\u00a0: <b>10</b> et <b>110</b>\u00a0: ")
    assert as_lines([], plain) == ["No two programs share anything rare."]
    for words in (section, first, second):
        assert not re.search(r"cheat|plagiar|copied", words)
