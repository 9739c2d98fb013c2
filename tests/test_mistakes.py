"""Mistakes that are known by what they draw, and stacks that are left fuller than before."""

from pathlib import Path

import numpy as np
import pytest
from solved import solved

from landscape.course.exercise import Grader
from landscape.course.grader.evidence import Frame
from landscape.course.grader.grading import Text
from landscape.course.grader.mistakes import blocks, close, colors, explained, known

RIGHT = Text("right")
TWICE = Text("twice")
LATE = Text("late")


def test_a_mistake_is_known_only_if_it_explains_all_frames() -> None:
    mistakes = [(lambda n: 2 * n, TWICE), (lambda n: n + 1, LATE)]
    same = close(0.1)
    assert known(mistakes, lambda n: n + 1, (0, 1, 2), same).text == LATE  # type: ignore[union-attr]
    assert known(mistakes, lambda n: n + 1 + (n == 2), (0, 1, 2), same) is None


def test_the_explanation_with_the_fewest_mistakes_is_taken() -> None:
    signs = ((1, None), (-1, Text("sign")))
    sums = ((lambda a, b: a + b, None), (lambda a, b: a * b, Text("order")))

    def made(number: int, sign: int, add: object) -> int:
        return add(sign * number, 5)  # type: ignore[operator, no-any-return]

    assert explained((signs, sums), made, lambda n: 5 + n, (1, 2), close(0.1)) == (None, None)
    assert explained((signs, sums), made, lambda n: 5 - n, (1, 2), close(0.1)) == ("sign", None)
    assert explained((signs, sums), made, lambda n: n, (1, 2), close(0.1)) is None


def test_a_picture_of_blocks_is_read_in_their_middles() -> None:
    small = np.array([[[9, 9, 9], [200, 0, 0]], [[0, 200, 0], [90, 90, 90]]], np.uint8)
    frame = Frame(0, small.repeat(6, axis=0).repeat(4, axis=1), [], [])
    assert np.array_equal(blocks(frame, 2, 2), small)
    table = [(10, 9, 8), (199, 1, 0), (0, 200, 0)]
    assert colors(frame, 2, 2, table).tolist() == [[0, 1], [2, -1]]


@pytest.mark.seldom(14, first=1)
@pytest.mark.parametrize("left", ["glPushMatrix()", "glPushAttrib(GL_ENABLE_BIT)", "glFlush()"])
def test_a_stack_that_grows_is_told_though_the_picture_is_right(left: str, tmp_path: Path) -> None:
    code = solved("first_drawing")
    path = tmp_path / "mine.py"
    path.write_text(code.replace("    glBegin(GL_QUADS)\n", f"    {left}\n    glBegin(GL_QUADS)\n"))
    with Grader(100) as grader:
        report = grader.check(path)
    failed = [result.test.key for result in report.results if result.passed is False]
    assert failed == ([] if left == "glFlush()" else ["stacks"])


@pytest.mark.seldom(13, first=11)
def test_what_gl_array_element_draws_counts_and_its_vertices_are_not_looked_at(
    tmp_path: Path,
) -> None:
    code = solved("primitives", "solution2.py")
    one_by_one = """    glBegin(kind)
    for number in range(len(vertices)):
        glArrayElement(number)
    glEnd()
"""
    arrays = "    glDrawArrays(kind, 0, len(vertices))\n"
    assert arrays in code
    path = tmp_path / "mine.py"
    path.write_text(code.replace(arrays, one_by_one))
    with Grader(100) as grader:
        assert grader.check(path).passed
        path.write_text(path.read_text().replace("GL_TRIANGLES, TREES", "GL_LINES, TREES"))
        failed = [result for result in grader.check(path).results if result.passed is False]
    assert [result.test.key for result in failed] == ["picture"]
