"""What the grader knows of a program: the calls and the draws of its frames."""

from collections.abc import Iterator

import numpy as np
import pytest

from landscape.course.exercise import Grader
from landscape.course.grader.evidence import Evidence

PROGRAM = """# exercise: winding
import glfw
from OpenGL.GL import *
glfw.init()
window = glfw.create_window(64, 48, '', None, None)
glfw.make_context_current(window)
glNewList(1, GL_COMPILE)
glBegin(GL_LINES)
glColor3ub(255, 0, 51)
glVertex2f(1, 2)
glNormal3f(0, 1, 0)
glVertex(3, 4, 5)
glEnd()
glEndList()
glColor3f(0.5, 0.5, 0.5)
while not glfw.window_should_close(window):
    glBegin(GL_TRIANGLES)
    glVertex2f(-1, 0)
    glTexCoord2f(0.25, 0.5)
    for x in (0.5, 1):
        glColor3fv((0, x, 0))
        glVertex3f(x, 1, -1)
    glEnd()
    glCallList(1)
    glBegin(GL_POINTS)
    glVertex4d(1, 2, 3, 2)
    glEnd()
    glfw.swap_buffers(window)
    glfw.poll_events()
"""


@pytest.fixture(scope="module")
def work(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Evidence]:
    path = tmp_path_factory.mktemp("work") / "mine.py"
    path.write_text(PROGRAM)
    with Grader(100) as grader:
        found = grader.check(path).work
    assert found is not None
    yield found


def test_each_vertex_of_a_draw_has_what_was_current_when_it_was_given(work: Evidence) -> None:
    for frame in work.frames.values():
        triangle, lines, point = frame.draws
        assert [draw.mode for draw in frame.draws] == ["GL_TRIANGLES", "GL_LINES", "GL_POINTS"]
        assert triangle.vertices.tolist() == [[-1, 0, 0, 1], [0.5, 1, -1, 1], [1, 1, -1, 1]]
        assert triangle.colors[1:].tolist() == [[0, 0.5, 0, 1], [0, 1, 0, 1]]
        assert triangle.texture[1:].tolist() == [[0.25, 0.5, 0, 1]] * 2
        assert lines.vertices.tolist() == [[1, 2, 0, 1], [3, 4, 5, 1]]
        assert np.allclose(lines.colors, [1, 0, 0.2, 1])
        assert lines.normals[1].tolist() == [0, 1, 0]
        assert point.vertices.tolist() == [[1, 2, 3, 2]]
        assert np.allclose(point.colors, [1, 0, 0.2, 1]), "the list's is current after it"
    first = work.frame(0).draws[0]
    assert first.colors[0].tolist() == [0.5, 0.5, 0.5, 1] and first.texture[0].tolist()[:2] == [
        0,
        0,
    ]


def test_calls_are_in_their_order_with_the_lines_of_the_program(work: Evidence) -> None:
    found = [(call.name, call.line) for call in work.last.calls]
    assert found == [
        *(("glBegin", 17), ("glVertex2f", 18), ("glTexCoord2f", 19)),
        *(("glColor3fv", 21), ("glVertex3f", 22)) * 2,
        *(("glEnd", 23), ("glCallList", 24)),
        *(("glBegin", 8), ("glColor3ub", 9), ("glVertex2f", 10), ("glNormal3f", 11)),
        *(("glVertex3d", 12), ("glEnd", 13)),
        *(("glBegin", 25), ("glVertex4d", 26), ("glEnd", 27)),
    ]
    given = {call.name: list(call.args) for call in work.last.calls}
    assert given["glTexCoord2f"] == [0.25, 0.5] and given["glVertex4d"] == [1, 2, 3, 2]


def test_calls_are_found_by_name_and_arguments_in_the_setup_and_in_frames(work: Evidence) -> None:
    frames = len(work.frames)
    assert [call.line for call in work.find("glColor")] == [15, *[21, 21, 9] * frames]
    assert [call.line for call in work.find("glVertex", 1)] == [22, 10, 26] * frames
    assert len(work.find("glEnd")) == 3 * frames and work.find("glVertex2f", 7) == []


@pytest.mark.seldom(13, first=11)
def test_the_texture_matrix_of_a_draw_is_the_one_that_it_is_drawn_with(
    tmp_path_factory: pytest.TempPathFactory,
) -> None:
    scaled = """    glClear(GL_COLOR_BUFFER_BIT)
    glMatrixMode(GL_TEXTURE)
    glScalef(3, 2, 1)
    glBegin(GL_TRIANGLES)
"""
    path = tmp_path_factory.mktemp("scaled") / "mine.py"
    path.write_text(PROGRAM.replace("    glBegin(GL_TRIANGLES)\n", scaled, 1))
    with Grader(100) as grader:
        found = grader.check(path).work
    assert found is not None
    state = found.frame(0).draws[0].state
    matrix = np.reshape(state["GL_TEXTURE0.GL_TEXTURE_MATRIX"], (4, 4))
    assert matrix.diagonal().tolist() == [3, 2, 1, 1]


CONVENIENT = """# exercise: winding
import glfw
import numpy as np
from OpenGL.GL import *
glfw.init()
window = glfw.create_window(64, 48, '', None, None)
glfw.make_context_current(window)
glEnableClientState(GL_VERTEX_ARRAY)
glVertexPointerf([(0, 0), (1, 0), (1, 1), (0, 1)])
while not glfw.window_should_close(window):
    glDrawElementsui(GL_TRIANGLES, [0, 1, 2, 0, 2, 3])
    glEnableClientState(GL_COLOR_ARRAY)
    glColorPointerub(np.array([(255, 0, 51)] * 4, np.uint8))
    glDrawArrays(GL_QUADS, 0, 4)
    glDisableClientState(GL_COLOR_ARRAY)
    glfw.swap_buffers(window)
    glfw.poll_events()
"""


@pytest.mark.seldom(10, first=8)
def test_the_vertices_of_pyopengls_conveniences_are_known(
    tmp_path_factory: pytest.TempPathFactory,
) -> None:
    path = tmp_path_factory.mktemp("convenient") / "mine.py"
    path.write_text(CONVENIENT)
    with Grader(100) as grader:
        found = grader.check(path).work
    assert found is not None
    for frame in found.frames.values():
        triangles, quad = frame.draws
        assert triangles.vertices[:, :2].tolist() == [
            [0, 0],
            [1, 0],
            [1, 1],
            [0, 0],
            [1, 1],
            [0, 1],
        ]
        assert quad.vertices.shape == (4, 4) and np.allclose(quad.colors, [1, 0, 0.2, 1])
