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
from commands import SECONDS, TESTS, landscape, refused
from test_window import _wait_for, screen, xdotool

from landscape.capture.edit_files import read

__all__ = ["screen"]  # the fixture
pytestmark = pytest.mark.window
LANTERN = TESTS / "programs" / "lantern.py"
# A program that tells what is in its window's middle, and every key that it gets.
TELLING = """
import sys
import time
import glfw
from OpenGL.GL import *

glfw.init()
window = glfw.create_window(320, 240, "Telling", None, None)
glfw.make_context_current(window)
log = open(sys.path[0] + "/log.txt", "a")
def on_key(_, key, scancode, action, mods):
    print("key", key, action, file=log, flush=True)

glfw.set_key_callback(window, on_key)
glClearColor(0.0, 0.0, 1.0, 1.0)
frame = 0
while not glfw.window_should_close(window):
    glClear(GL_COLOR_BUFFER_BIT)
    glColor3f(1.0, 0.0, 0.0)
    glRectf(-0.9, -0.9, 0.9, 0.9)
    pixel = glReadPixels(160, 120, 1, 1, GL_RGB, GL_UNSIGNED_BYTE)
    print("frame", frame, *bytes(pixel), file=log, flush=True)
    frame += 1
    glfw.swap_buffers(window)
    glfw.poll_events()
print("end", file=log, flush=True)
"""


def test_the_inspector_stops_a_program_edits_its_calls_and_lets_it_go_on(
    screen: dict[str, str], tmp_path: Path
) -> None:
    program, log = tmp_path / "telling.py", tmp_path / "log.txt"
    program.write_text(TELLING)
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
        xdotool(screen, "key", "F12")
        _wait_for(lambda: len(told()) > 3, process, "the frames after it")
        xdotool(screen, "key", "a", "Escape")
        _wait_for(lambda: any(line == "key 65 1" for line in told()), process, "its own key")
        subprocess.run(
            ["xdotool", "windowclose", window], env=screen, check=False, capture_output=True
        )
        process.wait(SECONDS)
    finally:
        process.kill()
        process.wait()
    (edit,) = read(saved, tmp_path)
    assert (edit.key.name, edit.key.function, edit.argument) == ("glColor3f", "<module>", 1)
    green = [line for line in told() if line.startswith("frame") and line.split()[3] != "0"]
    assert green, "the edit changes what the program draws"
    shown = [int(word) for word in green[0].split()[2:]]
    assert np.isclose(shown[1], 255 * edit.value, atol=1)
    done = landscape("trace", program, "--edits", saved, "--json")
    colours = [call["args"] for call in json.loads(done.out) if call["name"] == "glColor3f"]
    assert colours == [[1.0, edit.value, 0.0]]


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


def test_a_view_and_a_program_of_another_toolkit_are_refused_in_one_line(tmp_path: Path) -> None:
    refused(landscape("inspect", "fig35e"), "fig35e", "expected the path of a .py program")
    path = tmp_path / "glut.py"
    path.write_text("from OpenGL.GLUT import *\n")
    refused(landscape("inspect", path), "glut.py", "the inspector show GLFW programs")
    refused(landscape("inspect", tmp_path / "none.py"), "none.py")


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


@pytest.mark.parametrize("name", ENDS)
def test_a_program_that_cannot_go_on_ends_the_inspector_in_one_line(
    screen: dict[str, str], tmp_path: Path, name: str
) -> None:
    rest, words = ENDS[name]
    program, begun = tmp_path / "hostile.py", tmp_path / "begun.txt"
    program.write_text(HOSTILE + rest)
    code = "from landscape.capture import guard\nfrom landscape.cli import main\n"
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
