"""The inspector over a program that knows nothing of it, with real keys under Xvfb."""

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from commands import SECONDS, TESTS, landscape, need_library, refused
from PIL import ImageGrab
from test_window import _wait_for, screen, xdotool

from framelens.tape.edit_files import read

__all__ = ["screen"]  # the fixture
pytestmark = pytest.mark.window
LANTERN = TESTS / "programs" / "lantern.py"
# Programs that tell what is in their windows' middle, and every key that they get. In each the
# rectangle is drawn right after its colour.
DRAWING = """
import sys
from OpenGL.GL import *

log = open(sys.path[0] + "/log.txt", "a")
frame = 0
def draw():
    global frame
    glClear(GL_COLOR_BUFFER_BIT)
    glColor3f(1.0, 0.0, 0.0)
    glRectf(-0.9, -0.9, 0.9, 0.9)
    pixel = glReadPixels(160, 120, 1, 1, GL_RGB, GL_UNSIGNED_BYTE)
    print("frame", frame, *bytes(pixel), file=log, flush=True)
    frame += 1

def pressed(letter):
    print("key", letter.lower(), file=log, flush=True)

"""
GLFW = """
import glfw

glfw.init()
window = glfw.create_window(320, 240, "Telling", None, None)
glfw.make_context_current(window)
glfw.set_key_callback(window, lambda _, key, scan, action, mods: action and pressed(chr(key)))
glClearColor(0.0, 0.0, 1.0, 1.0)
while not glfw.window_should_close(window):
    draw()
    glfw.swap_buffers(window)
    glfw.poll_events()
"""
GLUT = """
from OpenGL.GLUT import *

def display():
    draw()
    glutSwapBuffers()

glutInit(sys.argv)
glutInitDisplayMode(GLUT_DOUBLE | GLUT_RGB)
glutInitWindowSize(320, 240)
glutCreateWindow(b"Telling")
glutCreateMenu(lambda entry: 0)
glutAttachMenu(GLUT_RIGHT_BUTTON)
glutKeyboardFunc(lambda key, x, y: pressed(key.decode()))
glutIdleFunc(glutPostRedisplay)
glutDisplayFunc(display)
glClearColor(0.0, 0.0, 1.0, 1.0)
glutMainLoop()
"""
PYGAME = """
import pygame

pygame.init()
pygame.display.set_mode((320, 240), pygame.OPENGL | pygame.DOUBLEBUF)
pygame.display.set_caption("Telling")
glClearColor(0.0, 0.0, 1.0, 1.0)
clock = pygame.time.Clock()
while True:
    for event in pygame.event.get():
        if event.type == pygame.KEYDOWN:
            pressed(event.unicode)
        if event.type == pygame.QUIT:
            raise SystemExit
    draw()
    pygame.display.flip()
    clock.tick(60)
"""
SHADERS = """
from OpenGL.GL.shaders import compileProgram, compileShader

program = compileProgram(
    compileShader(
        "void main() { gl_Position = gl_Vertex; gl_FrontColor = gl_Color; }", GL_VERTEX_SHADER
    ),
    compileShader("void main() { gl_FragColor = gl_Color; }", GL_FRAGMENT_SHADER),
)
glUseProgram(program)
"""
OPENED = "glfw.make_context_current(window)\n"
# A rectangle that is wound clockwise, and culled.
RECTANGLE = """\
def rectangle():
    glEnable(GL_CULL_FACE)
    glRectf(0.9, -0.9, -0.9, 0.9)

def draw():"""
CULLED = DRAWING.replace("glRectf(-0.9, -0.9, 0.9, 0.9)", "rectangle()")
CULLED = CULLED.replace("def draw():", RECTANGLE)
# With the function that draws its rectangle.
TELLING = {
    "GLFW": DRAWING + GLFW,
    "GLFW, with shaders": DRAWING + GLFW.replace(OPENED, OPENED + SHADERS),
    "GLUT": DRAWING + GLUT,
    "GLUT, single-buffered": DRAWING
    + GLUT.replace("GLUT_DOUBLE", "GLUT_SINGLE").replace("glutSwapBuffers", "glFlush"),
    "pygame": DRAWING + PYGAME,
}


@pytest.mark.seldom(14, first=7)
@pytest.mark.parametrize("name", ["GLFW", "GLUT", "pygame", "GLFW, closed"])
def test_f1_asks_why_a_pixel_looks_so_and_chooses_the_call_to_blame(
    screen: dict[str, str], tmp_path: Path, name: str
) -> None:
    if "GLUT" in name:
        need_library("glut")
    if "pygame" in name:
        pytest.importorskip("pygame")
    toolkit = {"GLUT": GLUT, "pygame": PYGAME}.get(name, GLFW)
    program, log = tmp_path / "telling.py", tmp_path / "log.txt"
    program.write_text(CULLED + toolkit)
    words = [sys.executable, "-m", "landscape", "inspect", str(program)]
    if name.endswith("closed"):
        begin = "import sys; from framelens.inspector.program_inspector import inspect; "
        words = [sys.executable, "-c", begin + "inspect(sys.argv[1], closed=True)", str(program)]
    process = subprocess.Popen(words, env=screen, cwd=tmp_path)

    try:
        _wait_for(lambda: log.exists() and bool(log.read_text()), process, "the first frame")
        window = xdotool(screen, "search", "--sync", "--onlyvisible", "--name", "^Telling")
        xdotool(screen, "windowfocus", "--sync", window)
        xdotool(screen, "mousemove", "--window", window, "160", "120")
        saved = tmp_path / "edits-0001.json"

        def leave_it_out() -> bool:
            """Ask, and leave out the call that is then chosen; nothing is before the answer."""
            xdotool(screen, "key", "F1")
            time.sleep(1.0)
            xdotool(screen, "key", "Delete", "ctrl+s")
            time.sleep(1.0)
            return saved.exists()

        _wait_for(leave_it_out, process, "the edit of the call to blame")
    finally:
        process.kill()
        process.wait()
    (edit,) = read(saved, tmp_path)
    assert edit.skip and edit.key.name == "glEnable"


@pytest.mark.seldom(14, first=4)
@pytest.mark.parametrize("name", TELLING)
def test_the_inspector_stops_a_program_edits_its_calls_and_lets_it_go_on(
    screen: dict[str, str], tmp_path: Path, name: str
) -> None:
    if "GLUT" in name:
        need_library("glut")
    if "pygame" in name:
        pytest.importorskip("pygame")
    program, log = tmp_path / "telling.py", tmp_path / "log.txt"
    program.write_text(TELLING[name])
    words = [sys.executable, "-m", "landscape", "inspect", str(program)]
    process = subprocess.Popen(words, env=screen, cwd=tmp_path)

    def told() -> list[str]:
        return log.read_text().splitlines() if log.exists() else []

    try:
        window = xdotool(screen, "search", "--sync", "--onlyvisible", "--name", "^Telling")
        xdotool(screen, "windowfocus", "--sync", window)
        _wait_for(lambda: bool(told()), process, "the first frame")
        # The cross-hair has found the rectangle, drawn after its colour: one row up, and one value
        # to the right of the red is the green.
        xdotool(screen, "key", "Up", "Tab", "plus", "ctrl+s")
        saved = tmp_path / "edits-0001.json"
        _wait_for(saved.exists, process, "the edits")
        assert told() == ["frame 0 255 0 0"], "the program stands still"
        covered = (20, 20, 60, 40)  # by the panel, which is dark: the rectangle is red
        _wait_for(lambda: bool(_seen(screen, covered)[0] < 128), process, "the panel")
        xdotool(screen, "key", "F12")
        _wait_for(lambda: len(told()) > 3, process, "the frames after it")
        xdotool(screen, "key", "a", "Escape")
        _wait_for(lambda: any(line == "key a" for line in told()), process, "its own key")
        subprocess.run(
            ["xdotool", "windowclose", window], env=screen, check=False, capture_output=True
        )
        process.wait(SECONDS)
    finally:
        process.kill()
        process.wait()
    (edit,) = read(saved, tmp_path)
    assert (edit.key.name, edit.key.function, edit.argument) == ("glColor3f", "draw", 1)
    green = [line for line in told() if line.startswith("frame") and line.split()[3] != "0"]
    assert green, "the edit changes what the program draws"
    shown = [int(word) for word in green[0].split()[2:]]
    assert np.isclose(shown[1], 255 * edit.value, atol=1)
    done = landscape("trace", program, "--edits", saved, "--json", env=screen)
    colours = [call["args"] for call in json.loads(done.out) if call["name"] == "glColor3f"]
    assert colours == [[1.0, edit.value, 0.0]]


WAITING = """
import sys
from OpenGL.GL import *
from OpenGL.GLUT import *

log = open(sys.path[0] + "/log.txt", "a")
def display():
    glRectf(-0.1, -0.1, 0.1, 0.1)
    glFlush()
    pixel = glReadPixels(40, 120, 1, 1, GL_RGB, GL_UNSIGNED_BYTE)
    print("display", *bytes(pixel), file=log, flush=True)

def ticks(count):
    print("tick", count, file=log, flush=True)
    if count < 3:
        glutTimerFunc(150, ticks, count + 1)

glutInit(sys.argv)
glutInitDisplayMode(GLUT_SINGLE)
glutInitWindowSize(320, 240)
glutCreateWindow("Waiting")
glutDisplayFunc(display)
glutTimerFunc(150, ticks, 1)
glClearColor(0.0, 0.0, 1.0, 1.0)
glClear(GL_COLOR_BUFFER_BIT)
glutMainLoop()
"""


@pytest.mark.seldom(13)
def test_a_glut_program_waits_for_its_user_and_keeps_what_it_has_drawn(
    screen: dict[str, str], tmp_path: Path
) -> None:
    need_library("glut")
    program, log = tmp_path / "waiting.py", tmp_path / "log.txt"
    program.write_text(WAITING)
    words = [sys.executable, "-m", "landscape", "inspect", str(program)]
    process = subprocess.Popen(words, env=screen, cwd=tmp_path)

    def told() -> list[str]:
        return log.read_text().splitlines() if log.exists() else []

    try:
        window = xdotool(screen, "search", "--sync", "--onlyvisible", "--name", "^Waiting")
        xdotool(screen, "windowfocus", "--sync", window)
        _wait_for(lambda: bool(told()), process, "the first frame")
        xdotool(screen, "key", "F12")
        _wait_for(lambda: "tick 3" in told(), process, "its timers")
        assert _stands(told), "nothing asks for a second picture"
        xdotool(screen, "key", "F12")
        _wait_for(lambda: len(told()) >= 5, process, "a picture for the inspector to look into")
        xdotool(screen, "key", "F12")
        assert _stands(told)
        # With the inspector open and going on, it draws picture after picture.
        xdotool(screen, "key", "F12", "space")
        _wait_for(lambda: len(told()) > 8, process, "pictures under the panel")
    finally:
        process.kill()
        process.wait()
    pictures = {line for line in told() if line.startswith("display")}
    assert pictures == {"display 0 0 255"}, "the panel has left nothing behind"


UNSEEN = """
import sys
from OpenGL.GL import *
from OpenGL.GLUT import *

def display():
    glClear(GL_COLOR_BUFFER_BIT)
    glFlush()

glutInit(sys.argv)
glutInitDisplayMode(GLUT_DOUBLE)
glutInitWindowSize(320, 240)
glutCreateWindow("Unseen")
glutDisplayFunc(display)
glClearColor(0.0, 0.0, 1.0, 1.0)
glutMainLoop()
"""


@pytest.mark.seldom(13, first=1)
def test_a_picture_that_is_never_swapped_is_seen_in_the_inspector_only(
    screen: dict[str, str], tmp_path: Path
) -> None:
    need_library("glut")
    program = tmp_path / "unseen.py"
    program.write_text(UNSEEN)
    words = [sys.executable, "-m", "landscape", "inspect", str(program)]
    process = subprocess.Popen(words, env=screen, cwd=tmp_path)
    beside_the_panel = (280, 200, 300, 220)
    try:
        window = xdotool(screen, "search", "--sync", "--onlyvisible", "--name", "^Unseen")
        xdotool(screen, "windowfocus", "--sync", window)

        def blue() -> float:
            return float(_seen(screen, beside_the_panel)[2])

        _wait_for(lambda: blue() == 255, process, "the inspector's picture")
        xdotool(screen, "key", "F12")
        _wait_for(lambda: blue() == 0, process, "the black window")
    finally:
        process.kill()
        process.wait()


def _seen(screen: dict[str, str], box: tuple[int, int, int, int]) -> np.ndarray:
    """Return the mean colour of a box of the screen."""
    shot = np.asarray(ImageGrab.grab(xdisplay=screen["DISPLAY"]).convert("RGB").crop(box))
    return np.asarray(shot.reshape(-1, 3).mean(0))


CLEARING = """
import sys
import time
import glfw
from OpenGL.GL import *

glfw.init()
window = glfw.create_window(320, 240, "Clearing", None, None)
glfw.make_context_current(window)
log = open(sys.path[0] + "/log.txt", "a")
glClearColor(0.0, 0.0, 1.0, 1.0)
while not glfw.window_should_close(window):
    glClear(GL_COLOR_BUFFER_BIT)
    print(*bytes(glReadPixels(160, 120, 1, 1, GL_RGB, GL_UNSIGNED_BYTE)), file=log, flush=True)
    glfw.swap_buffers(window)
    glfw.poll_events()
"""


@pytest.mark.seldom(13)
def test_an_edit_of_the_setup_stays_in_force_and_is_undone_in_a_later_frame(
    screen: dict[str, str], tmp_path: Path
) -> None:
    program, log = tmp_path / "clearing.py", tmp_path / "log.txt"
    program.write_text(CLEARING)
    words = [sys.executable, "-m", "landscape", "inspect", str(program)]
    process = subprocess.Popen(words, env=screen, cwd=tmp_path)

    def told() -> list[str]:
        return log.read_text().splitlines() if log.exists() else []

    try:
        window = xdotool(screen, "search", "--sync", "--onlyvisible", "--name", "^Clearing")
        xdotool(screen, "windowfocus", "--sync", window)
        _wait_for(lambda: bool(told()), process, "the first frame")
        # The pass setup, the function, and its first call.
        xdotool(screen, "key", "Home", "Down", "Right", "Down", "equal", "F12")
        _wait_for(lambda: len(told()) > 3, process, "the frames after it")
        assert told()[-1] == "13 0 255"
        xdotool(screen, "key", "F12")
        _wait_for(lambda: _stands(told), process, "the program to stand still")
        xdotool(screen, "key", "ctrl+z", "F12")
        _wait_for(lambda: told()[-1] == "0 0 255", process, "the colour of before")
    finally:
        process.kill()
        process.wait()


def _stands(told: Callable[[], list[str]]) -> bool:
    """Return whether a program tells nothing for half a second."""
    count = len(told())
    time.sleep(0.5)
    return len(told()) == count


@pytest.mark.seldom(3)
def test_a_view_and_a_program_of_another_toolkit_are_refused_in_one_line(tmp_path: Path) -> None:
    refused(landscape("inspect", "fig35e"), "fig35e", "expected the path of a .py program")
    path = tmp_path / "other.py"
    path.write_text("import pyglet\n")
    refused(landscape("inspect", path), "other.py", "opens its window with pyglet")
    refused(landscape("inspect", tmp_path / "none.py"), "none.py")


CORE = """
import glfw
glfw.init()
glfw.window_hint(glfw.CONTEXT_VERSION_MAJOR, 3)
glfw.window_hint(glfw.CONTEXT_VERSION_MINOR, 3)
glfw.window_hint(glfw.OPENGL_PROFILE, glfw.OPENGL_CORE_PROFILE)
window = glfw.create_window(64, 48, "core", None, None)
glfw.make_context_current(window)
glfw.swap_buffers(window)
"""


@pytest.mark.seldom(3)
def test_a_core_profile_is_refused_in_one_line(screen: dict[str, str], tmp_path: Path) -> None:
    path = tmp_path / "core.py"
    path.write_text(CORE)
    refused(landscape("inspect", path, env=screen), "which a core profile lacks; trace and state")


HOSTILE = """
import ctypes, sys
import glfw
from OpenGL.GL import *
glfw.init()
window = glfw.create_window(64, 48, "Hostile", None, None)
glfw.make_context_current(window)
open(sys.path[0] + "/begun.txt", "w").close()
"""
ENDS = {
    "crashes": ("ctypes.string_at(0)", "crashed (SIGSEGV), as OpenGL does where"),
    "takes too much memory": ("b'x' * (10 << 30)", "raised MemoryError (it may take 4096 MB)"),
    "is held up in C until Ctrl-C": ("sum(range(10**13))", "was ended within one call that no"),
}


@pytest.mark.seldom(14, first=6)
@pytest.mark.parametrize("name", ENDS)
def test_a_program_that_cannot_go_on_ends_the_inspector_in_one_line(
    screen: dict[str, str], tmp_path: Path, name: str
) -> None:
    rest, words = ENDS[name]
    program, begun = tmp_path / "hostile.py", tmp_path / "begun.txt"
    program.write_text(HOSTILE + rest)
    code = "from framelens.base import guard\nfrom landscape.cli import main\n"
    code += "guard.GRACE = 0.3\nraise SystemExit(main())"
    process = subprocess.Popen(
        [sys.executable, "-c", code, "inspect", str(program)],
        env=screen,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    try:
        if "Ctrl-C" in name:
            _wait_for(begun.exists, process, "the program")
            time.sleep(0.2)  # until it is within the call
            os.killpg(process.pid, signal.SIGINT)
        told = process.communicate(timeout=SECONDS)[1]
    finally:
        process.kill()
        process.wait()

    first = told.splitlines()[0]
    assert process.returncode == 2 and first.startswith("landscape: ") and words in first
