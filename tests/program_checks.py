"""What holds for the frames of programs; run by test_program_tape.py in processes of their own.

The tests' own process has PyOpenGL refuse what students write: lists where arrays are meant.
"""

import re
from pathlib import Path

import numpy as np
from watching import colours

from framelens.gl.framebuffer import read_pixels
from framelens.program.program_tape import on_frame
from framelens.tape.edits import Edits, located_at
from framelens.tape.pixel import history
from framelens.tape.steps import issue
from framelens.tape.tape import Tape

LESSON = Path(__file__).parents[1] / "landscape" / "course" / "lessons" / "text.py"
LANTERN = Path(__file__).parent / "programs" / "lantern.py"
SMALL = """
import glfw
from OpenGL.GL import *

glfw.init()
window = glfw.create_window(64, 48, "small", None, None)
glfw.make_context_current(window)
n = 0
while not glfw.window_should_close(window):
    {clear}
    glColor4f(1, n / 10, 0, 0.5)
    glEnable(GL_BLEND)
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA)
    glRectf(-0.5, -0.5, 0.5, 0.5)
    n += 1
    glfw.swap_buffers(window)
    glfw.poll_events()
"""


def picture(tape: Tape) -> np.ndarray:
    return read_pixels(tape.size)


def every_pixel_is_explained(path: Path = LANTERN, frame: int = 4, backend: str = "auto") -> None:
    """A frame is replayed as it was, and the history of a pixel ends with it."""

    def look(tape: Tape) -> None:
        wanted = picture(tape)
        assert colours(wanted) > 100, "it draws something"
        tape.replay()
        assert np.array_equal(picture(tape), wanted)
        random = np.random.default_rng(frame)
        width, height = tape.size
        for _ in range(12):
            x, y = int(random.integers(width)), int(random.integers(height))
            rows = history(tape, x, y)
            assert rows[-1].pixel.color[:3] == tuple(wanted[y, x])
            for row in rows:
                if row.outcome == "drawn":
                    last = re.findall(r"= \(([^)]*)\)", row.arithmetic)[-1]
                    result = np.array([float(number) for number in last.split(",")]) * 255
                    assert np.abs(result - row.pixel.color[:3]).max() <= 1.0

    on_frame(path, look, frame, backend=backend)


def an_edit_in_a_list_is_the_program_changed(tmp_path: Path) -> None:
    """An edit in a display list draws what the program does with that constant changed."""

    def find(tape: Tape) -> Edits:
        for call in tape.frame:
            for index, inner in enumerate(call.listed):
                if inner.name == "glColor3f" and inner.args[0] == 0.62:
                    place = f"{call.number}.{index}"
                    first = located_at(tape.calls, tape.begin, place)
                    return Edits([first.edit(0, 1.0)])
        raise AssertionError("no such call")

    edits = on_frame(LANTERN, find, 1)
    assert edits.edits[0].key.list is not None
    changed = tmp_path / "lantern.py"
    source = LANTERN.read_text(encoding="utf-8")
    # The edit is of the first light tile, so the program's first light tile is changed.
    line = "                glColor3f(0.62, 0.60, 0.58)"
    assert line in source
    first = "                glColor3f(1.0 if (i, j) == (-12, -12) else 0.62, 0.60, 0.58)"
    changed.write_text(source.replace(line, first), encoding="utf-8")
    edited = on_frame(LANTERN, picture, 1, edits=edits)
    assert edits.missed() == []
    assert np.array_equal(edited, on_frame(changed, picture, 1))


def a_frame_without_a_clear_is_replayed(tmp_path: Path) -> None:
    """A frame that clears nothing is replayed over what was there."""
    path = tmp_path / "small.py"
    path.write_text(SMALL.format(clear="pass"))

    def look(tape: Tape) -> None:
        wanted = picture(tape)
        tape.replay()
        assert np.array_equal(picture(tape), wanted)
        row = history(tape, 32, 24)[-1]
        assert row.pixel.color[:3] == tuple(wanted[24, 32])

    on_frame(path, look, 3)


SHADERS = """
import glfw
from OpenGL.GL import *
from OpenGL.GL.shaders import compileProgram, compileShader

glfw.init()
window = glfw.create_window(64, 48, "shaders", None, None)
glfw.make_context_current(window)
program = compileProgram(
    compileShader("void main() { gl_Position = gl_Vertex; }", GL_VERTEX_SHADER),
    compileShader(
        "uniform float g; void main() { gl_FragColor = vec4(1., g, 0., 1.); }", GL_FRAGMENT_SHADER
    ),
)
while True:
    glClear(GL_COLOR_BUFFER_BIT)
    glColor3f(0, 0, 1)
    glRectf(-1, -1, 0, 1)
    glUseProgram(program)
    glUniform1f(glGetUniformLocation(program, "g"), 0.6)
    glRectf(-0.5, -0.5, 0.5, 0.5)
    glUseProgram(0)
    glRectf(0.8, -1, 1, 1)
    glfw.swap_buffers(window)
"""


def shaders_draw_again_what_they_drew(tmp_path: Path) -> None:
    """The frame that builds shaders is replayed; what comes before they are bound is blue."""
    path = tmp_path / "shaders.py"
    for text in (SHADERS, SHADERS.replace("    glUseProgram(0)\n", "")):
        path.write_text(text)

        def look(tape: Tape) -> None:
            wanted = picture(tape)
            assert wanted[24, 32].tolist() == [255, 153, 0]
            assert wanted[2, 2].tolist() == [0, 0, 255]
            tape.replay()
            assert np.array_equal(picture(tape), wanted)
            assert history(tape, 32, 24)[-1].pixel.color[:3] == (255, 153, 0)
            assert history(tape, 2, 2)[-1].pixel.color[:3] == (0, 0, 255)

        on_frame(path, look, 0)


def lists_are_found_from_the_list_base(tmp_path: Path) -> None:
    """The lists of a glCallLists are those from glListBase on: a letter each, made again."""
    assert tmp_path.is_dir()

    def look(tape: Tape) -> None:
        wanted = picture(tape)
        lists = [call for call in tape.frame if call.name == "glCallLists"]
        assert lists and all(len(c.executed) == len(c.args[-1]) for c in lists)
        assert {call.listed[0].name for call in lists} == {"glBegin"}
        tape.rewind()
        for step in tape.steps():
            issue(step.call)
        assert np.array_equal(picture(tape), wanted)

    on_frame(LESSON, look, 1)


def the_setup_ends_with_the_first_draw(tmp_path: Path) -> None:
    """The pass changes with the first call that draws; the calls are numbered."""
    assert tmp_path.is_dir()
    calls = on_frame(LANTERN, lambda tape: list(tape.calls))
    passes = [call.pass_ for call in calls]
    first = passes.index("main")
    assert calls[first].name == "glClear" and "setup" not in passes[first:]
    assert [call.number for call in calls] == list(range(len(calls)))
    assert {"make_texture", "init", "draw"} <= {call.element for call in calls}
