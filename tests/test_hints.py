"""What hints say: where a call is missing, and where a picture differs."""

from pathlib import Path

import numpy as np
import pytest

from framelens.base.texts import translator
from landscape.course.exercise import Grader
from landscape.course.grader.evidence import Call, Evidence, Frame
from landscape.course.grader.grading import LEVELS, Text, between, compare, differing, hint

FRENCH = translator("fr", "course")


def call(name: str, *way: tuple[int, str]) -> Call:
    return Call(name, (), way[-1][0] if way else 0, "", way=way)


MAIN = (90, "main")
ARM = call("glEnd", MAIN, (75, "draw_arm"), (31, "glEnd"))
LAMP = call("glBegin", MAIN, (76, "draw_lamp"), (12, "draw_box"), (5, "glBegin"))


@pytest.mark.parametrize(
    ("first", "second", "words"),
    [
        (ARM, LAMP, "between line 75 (draw_arm) and line 76 (draw_lamp)"),
        (
            call("glScalef", MAIN, (71, "glScalef")),
            LAMP,
            "between line 71 (glScalef) and line 76 (draw_lamp)",
        ),
        (LAMP, ARM, "between line 76 (draw_lamp) and line 75 (draw_arm) of the next pass"),
        (ARM, ARM, "between line 31 (glEnd) and line 31 (glEnd) of the next pass"),
        (None, LAMP, "before line 5 (glBegin)"),
        (ARM, call("glEnd"), "after line 31 (glEnd)"),
    ],
)
def test_a_hint_names_two_lines_of_one_function(
    first: Call | None, second: Call | None, words: str
) -> None:
    assert between(first, second).written(str) == words
    assert between(first, second).written(FRENCH) != words


def test_french_hints_have_a_decimal_comma_and_leave_names_and_whole_numbers() -> None:
    told = hint(
        Text("{size:.1f} {ratio:.2f} {file} {line}"),
        size=2.24,
        ratio=np.float32(0.5),
        file="a.py",
        line=1500,
    )
    assert told.written(str) == "2.2 0.50 a.py 1500"
    assert told.written(FRENCH) == "2,2 0,50 a.py 1500"


def test_without_any_line_there_is_no_place() -> None:
    with pytest.raises(ValueError, match="neither"):
        between(None, call("glEnd"))


@pytest.mark.seldom(7, first=6)
def test_the_lines_are_those_that_lead_to_a_call(tmp_path: Path) -> None:
    code = "\n".join(
        [
            "# exercise: winding",
            "import glfw",
            "from OpenGL.GL import *",
            "def draw_face(x):",
            "    glBegin(GL_POINTS)",
            "    glVertex2f(x, 0)",
            "    glEnd()",
            "def draw():",
            "    draw_face(0)",
            "    for x in (0.1, 0.2):",
            "        draw_face(x)",
            "glfw.init()",
            "window = glfw.create_window(64, 48, '', None, None)",
            "glfw.make_context_current(window)",
            "while not glfw.window_should_close(window):",
            "    draw()",
            "    glfw.swap_buffers(window)",
            "    glfw.poll_events()",
            "",
        ]
    )

    path = tmp_path / "mine.py"
    path.write_text(code)
    with Grader(100) as grader:
        work = grader.check(path).work

    assert work is not None
    one, two, three = work.last.draws
    assert one.call.way == [(16, "draw"), (9, "draw_face"), (5, "glBegin")]
    assert between(one, two).written(str) == "between line 9 (draw_face) and line 11 (draw_face)"
    assert between(two, three).values["line"] == 5


def picture(*spots: tuple[float, float]) -> Evidence:
    """A grey picture with a light square at each spot, x and y from 0 to 1 from the top left."""
    pixels = np.full((120, 160, 3), 90, np.uint8)
    for x, y in spots:
        row, column = round(y * 120), round(x * 160)
        pixels[row - 6 : row + 6, column - 6 : column + 6] = 200
    return Evidence(Path("x.py"), [], {0: Frame(0, pixels, [], [])})


COLUMNS = {Text("the first column"): (0, 0, 0.5, 1), Text("the second column"): (0.5, 0, 1, 1)}


@pytest.mark.parametrize(
    ("spots", "place", "french"),
    [
        ([(0.9, 0.1)], "at the top right", "en haut à droite"),
        ([(0.1, 0.9)], "at the bottom left", "en bas à gauche"),
        ([(0.1, 0.5)], "at the left", "à gauche"),
        # Most pixels are at the left and at the right: none is in between.
        ([(0.1, 0.5), (0.9, 0.4), (0.9, 0.6)], "at the right", "à droite"),
    ],
)
def test_a_hint_says_where_the_picture_differs(
    spots: list[tuple[float, float]], place: str, french: str
) -> None:
    found = compare(picture(*spots), picture())
    assert found is not None and f"most of them {place}." in found.written(str)
    assert f"surtout {french}." in found.written(FRENCH)


def test_a_hint_names_the_region_that_differs_most() -> None:
    found = compare(picture((0.9, 0.1), (0.9, 0.5), (0.1, 0.9)), picture(), regions=COLUMNS)
    assert found is not None
    told = found.written(str)
    assert "the difference is at the top right: the second column. 3.0 % of" in told
    assert "en haut à droite\xa0: the second column." in found.written(FRENCH)


def test_a_small_region_counts_by_its_own_pixels() -> None:
    small = {Text("the lamp"): (0.45, 0.4, 0.55, 0.6)}
    wrong = picture((0.5, 0.5))
    assert compare(wrong, picture(), most=0.01) is None
    found = compare(wrong, picture(), most=0.01, regions=small)
    assert found is not None and "in the middle: the lamp. 37.5 %" in found.written(str)
    assert compare(picture(), picture(), most=0, regions=small) is None


def plainly_differing(work: np.ndarray, solution: np.ndarray) -> np.ndarray:
    """Each pixel against the nine around it, as docs/exercises.md says it."""
    padded = np.pad(solution.astype(int), ((1, 1), (1, 1), (0, 0)), mode="edge")
    height, width = work.shape[:2]
    shifted = [padded[y : y + height, x : x + width] for y in range(3) for x in range(3)]
    return np.min([np.abs(each - work).max(axis=2) for each in shifted], axis=0) > LEVELS


@pytest.mark.parametrize("seed", range(6))
def test_pixels_differ_if_no_neighbour_is_like_them(seed: int) -> None:
    rng = np.random.default_rng(seed)
    blocks = rng.integers(0, 256, (12, 16, 3)).repeat(5, axis=0).repeat(5, axis=1)
    solution = blocks.astype(np.uint8)
    work = np.roll(solution, seed % 3, axis=1)
    work[10:30, 10:50] += rng.integers(0, 20 * seed + 1, (20, 40, 3)).astype(np.uint8)
    found = differing(Frame(0, work, [], []), Frame(0, solution, [], []))
    assert np.array_equal(found, plainly_differing(work, solution))
    assert seed < 2 or 0.02 < found.mean() < 0.9
