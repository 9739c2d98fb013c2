"""What the tools say where a window would not show the picture, and what leaves no trace in it."""

import pytest
from broken_programs import BROKEN, CLEAR, FLAT, GLFW

from framelens.gl.seam import Call, Site
from framelens.program.program_frame import ProgramFrame
from framelens.program.program_run import Showing, Window
from framelens.program.program_tape import on_frame
from framelens.program.shown import shown_otherwise
from framelens.report.trace_text import as_text
from framelens.state.state import changed
from framelens.tape.pixel import history
from framelens.why.walk import unseen_draws, without_trace

SITE = Site("case.py", 7, "display", "case.py")
RECT = "glRectf(60, 40, 200, 150)\n"


def call(name, *args):
    return Call(name, args, ("display",), "main", SITE)


def told(showing: Showing, double_buffered: bool = True, calls=None) -> list[str]:
    window = Window("glut", "glx", lambda: (10, 10), double_buffered)
    window.showing = showing
    return list(shown_otherwise(window, [call("glRectf")] if calls is None else calls, 0))


@pytest.mark.parametrize(
    ("showing", "double_buffered", "calls", "word"),
    [
        (Showing("callback"), True, None, "without glutSwapBuffers"),
        (Showing("callback"), False, None, "without glFlush"),
        (Showing("never"), True, None, "never swaps"),
        (Showing("swap", 9, again=True), True, [], "swaps once more"),
        (Showing("swap", forced=True, stirred=True), True, None, "glutPostRedisplay"),
        (Showing("swap"), True, [call("glDrawBuffer", 0x0404), call("glRectf")], "front buffer"),
    ],
)
def test_what_a_window_would_not_show_is_told(showing, double_buffered, calls, word):
    (line,) = told(showing, double_buffered, calls)
    assert word in line


@pytest.mark.parametrize(
    ("showing", "double_buffered"),
    [
        (Showing("swap"), True),
        (Showing("callback", flushed=True), False),
        (Showing("swap", forced=True), True),
        (Showing("swap", stirred=True), True),
    ],
)
def test_nothing_is_told_of_a_frame_that_is_shown(showing, double_buffered):
    assert told(showing, double_buffered) == []


def notices(path, frame: int = 0) -> list[str]:
    lines: list[str] = []
    ProgramFrame(str(path), frame=frame, tell=lines.extend).look(lambda tape: None)
    return lines


def written(tmp_path, setup: str, draw: str, swap: str = "    glfw.swap_buffers(window)\n"):
    text = GLFW.format(setup=setup, draw="".join(f"    {line}\n" for line in draw.splitlines()))
    path = tmp_path / "case.py"
    path.write_text(text.replace("    glfw.swap_buffers(window)\n", swap))
    return path


def test_a_loop_that_never_swaps_is_seen_at_once(tmp_path):
    path = written(tmp_path, FLAT, CLEAR + RECT, swap="")
    assert any("never swaps" in line for line in notices(path))
    assert not any("never" in line for line in notices(written(tmp_path, FLAT, CLEAR + RECT)))


def test_a_second_swap_without_a_draw_is_told(tmp_path):
    path = written(tmp_path, FLAT, CLEAR + RECT, swap="    glfw.swap_buffers(window)\n" * 2)
    assert notices(path, 0) == []
    assert any("swaps once more" in line for line in notices(path, 1))


def test_a_call_of_glu_without_effect_is_told(tmp_path):
    path = written(tmp_path, "gluPerspective(60, 240 // 300, 1, 50)\n", CLEAR + RECT)
    (line,) = notices(path)
    assert "gluPerspective(60, 0, 1, 50) has no effect: the aspect is 0" in line


def test_a_viewport_without_area_is_no_initial_one():
    assert changed({"GL_VIEWPORT": [0, 0, 0, 0]})
    assert not changed({"GL_VIEWPORT": [0, 0, 240, 180]})


def test_a_pixel_says_that_its_texture_is_not_used(tmp_path):
    path = tmp_path / "case.py"
    path.write_text(BROKEN["incomplete"].source())
    rows = on_frame(path, lambda tape: history(tape, 120, 90))
    assert "texture 1 is incomplete" in rows[-1].arithmetic
    path.write_text(BROKEN["incomplete"].source(mended=True))
    rows = on_frame(path, lambda tape: history(tape, 120, 90))
    assert "incomplete" not in rows[-1].arithmetic and "texel" in rows[-1].arithmetic


def test_draws_without_trace_are_marked_and_explained(tmp_path):
    path = tmp_path / "case.py"
    path.write_text(BROKEN["behind"].source())
    idle, lines, calls = on_frame(
        path, lambda tape: (without_trace(tape), unseen_draws(tape), list(tape.calls))
    )
    (begin,) = (each for each in calls if each.name == "glBegin")
    assert idle == {str(begin.number)}
    assert "4 behind the eye" in lines[1]
    marked = [line for line in as_text(calls, idle=idle) if "changes no pixel" in line]
    assert len(marked) == 1 and "glBegin" in marked[0]
    path.write_text(BROKEN["behind"].source(mended=True))
    assert on_frame(path, without_trace) == set()
