"""A lecture in its window, with real keys under Xvfb."""

import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from commands import SECONDS
from PIL import ImageGrab
from test_window import _wait_for, screen, xdotool

__all__ = ["screen"]  # the fixture
pytestmark = pytest.mark.window

# A program that writes down what it finds in its context, its size, the time, and its keys.
TELLING = """
import time
import glfw
from OpenGL.GL import *

glfw.init()
window = glfw.create_window(640, 480, "Telling", None, None)
glfw.make_context_current(window)
def tell(*words):
    with open(__file__ + ".txt", "a") as log:
        print(*words, file=log)

def on_key(_, key, scancode, action, mods):
    if action == glfw.PRESS:
        tell("key", key, glfw.get_key(window, key))

glfw.set_key_callback(window, on_key)
glfw.set_framebuffer_size_callback(window, lambda _, *size: tell("resized", *size))
glfw.set_mouse_button_callback(window, lambda *_: tell("button", *glfw.get_cursor_pos(window)))
tell("new", glIsEnabled(GL_FOG), glIsTexture(1), glIsList(1), glIsBuffer(1),
     glGetIntegerv(GL_MODELVIEW_STACK_DEPTH), glGetIntegerv(GL_ATTRIB_STACK_DEPTH),
     glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_WIDTH))
glEnable(GL_FOG)
glPushMatrix()
glPushAttrib(GL_ALL_ATTRIB_BITS)
glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 4, 4, 0, GL_RGB, GL_UNSIGNED_BYTE, bytes(48))
glBindTexture(GL_TEXTURE_2D, glGenTextures(1))
glNewList(glGenLists(1), GL_COMPILE)
glEndList()
glBindBuffer(GL_ARRAY_BUFFER, glGenBuffers(1))
frame = 0
began = time.perf_counter()
while not glfw.window_should_close(window):
    glViewport(0, 0, *glfw.get_framebuffer_size(window))
    glDisable(GL_FOG)
    glClearColor(0.0, 0.0, 1.0, 1.0)
    glClear(GL_COLOR_BUFFER_BIT)
    glColor3f(1.0, 0.0, 0.0)
    glRectf(-0.9, -0.9, 0.9, 0.9)
    glEnable(GL_FOG)
    pixel = bytes(glReadPixels(160, 120, 1, 1, GL_RGB, GL_UNSIGNED_BYTE))
    times = glfw.get_time(), time.perf_counter() - began
    tell("frame", frame, *glfw.get_framebuffer_size(window), *times, *pixel)
    frame += 1
    glfw.swap_buffers(window)
    glfw.poll_events()
"""
WAITING = TELLING.replace("glfw.poll_events()", "glfw.wait_events()")
FAILING = 'import glfw\nglfw.init()\nraise ValueError("no such thing")\n'
LECTURE = """title: A lecture of tests

one.py
The first program.
keys: SPACE
note: Say hello.

waiting.py

failing.py
title: This one fails

one.py
title: The first once more
code: glRectf
"""


class Shown:
    """A lecture that is being shown, and what it has written so far."""

    def __init__(self, screen: dict[str, str], folder: Path, process: subprocess.Popen) -> None:
        self._screen = screen
        self._folder = folder
        self.process = process
        name = "A lecture of tests"
        self.window = xdotool(screen, "search", "--sync", "--onlyvisible", "--name", f"^{name}")
        xdotool(screen, "windowfocus", "--sync", self.window)

    def press(self, *keys: str) -> None:
        xdotool(self._screen, "key", *keys)

    def mouse(self, *words: str) -> None:
        xdotool(self._screen, "mousemove", "--window", self.window, *words)

    def notes(self) -> str:
        return (self._folder / "out.txt").read_text(encoding="utf-8")

    def errors(self) -> str:
        return (self._folder / "err.txt").read_text(encoding="utf-8")

    def told(self, program: str, kind: str) -> list[list[str]]:
        path = self._folder / f"{program}.txt"
        lines = path.read_text().splitlines() if path.exists() else []
        return [line.split()[1:] for line in lines if line.split()[0] == kind]

    def clocks(self, program: str) -> list[tuple[float, float]]:
        """Return the program's time and the real time at each of its frames, in seconds."""
        return [(float(line[3]), float(line[4])) for line in self.told(program, "frame")]

    def wait(self, condition, what: str) -> None:
        _wait_for(condition, self.process, what)

    def goes_on(self, program: str) -> None:
        """Wait until the program has drawn two more frames."""
        count = len(self.told(program, "frame"))
        self.wait(lambda: len(self.told(program, "frame")) >= count + 2, "two more frames")

    def draws(self) -> bool:
        """Return whether a walk draws: until then the window is of one grey, with few words."""
        picture = ImageGrab.grab(xdisplay=self._screen["DISPLAY"])
        return len(picture.getcolors(1 << 24) or ()) > 1000

    def stands(self, program: str) -> None:
        """Wait until the program has drawn nothing for half a second."""
        seen: list[int] = []

        def still() -> bool:
            seen.append(len(self.told(program, "frame")))
            return len(seen) > 10 and len(set(seen[-11:])) == 1

        self.wait(still, "the program to stand still")


@contextmanager
def _shown(screen: dict[str, str], folder: Path, text: str, *words: str) -> Iterator[Shown]:
    for name, code in (("one", TELLING), ("waiting", WAITING), ("failing", FAILING)):
        (folder / f"{name}.py").write_text(code)
    path = folder / "lecture.txt"
    path.write_text(text)
    command = [sys.executable, "-W", "error", "-m", "landscape", "lecture", str(path), *words]
    with (folder / "out.txt").open("w") as out, (folder / "err.txt").open("w") as err:
        process = subprocess.Popen(command, env=screen, cwd=folder, stdout=out, stderr=err)
        try:
            yield Shown(screen, folder, process)
        finally:
            process.kill()
            process.wait()


@pytest.mark.seldom(14, first=4)
def test_steps_follow_each_other_in_one_window_each_in_a_new_opengl(
    screen: dict[str, str], tmp_path: Path
) -> None:
    with _shown(screen, tmp_path, LECTURE) as shown:
        shown.wait(lambda: bool(shown.told("one.py", "key")), "the key of the lecture's file")
        assert shown.told("one.py", "key") == [["32", "1"]]
        assert "[1/4] one.py" in shown.notes() and "Say hello." in shown.notes()
        shown.press("a")
        shown.wait(lambda: ["65", "1"] in shown.told("one.py", "key"), "the program's own key")
        frame = shown.told("one.py", "frame")[-1]
        assert frame[1:3] == ["800", "533"] and frame[5:] == ["255", "0", "0"]
        shown.wait(lambda: shown.clocks("one.py")[-1][1] > 1.0, "a second")
        # A program that is held up between reading the two clocks finds the second one later.
        ahead = [time - real for time, real in shown.clocks("one.py")]
        half = len(ahead) // 2
        assert max(ahead[:half]) == pytest.approx(max(ahead[half:]), abs=0.1), "the time is true"
        shown.press("Next")
        shown.wait(lambda: bool(shown.told("waiting.py", "frame")), "the second program")
        new = ["0"] * 4 + ["1", "0", "0"]
        found = [" ".join(line).replace("False", "0") for line in shown.told("waiting.py", "new")]
        assert found == [" ".join(new)], "nothing of the first program is left"
        shown.press("b")
        shown.wait(lambda: ["66", "1"] in shown.told("waiting.py", "key"), "a program that waits")
        shown.press("Next")
        shown.wait(lambda: "[3/4] This one fails" in shown.notes(), "the third step")
        shown.wait(lambda: "no such thing" in shown.errors(), "its error")
        shown.press("Next")
        shown.wait(lambda: "[4/4] The first once more" in shown.notes(), "the fourth step")
        shown.wait(lambda: shown.told("one.py", "frame")[-1][1] == "432", "the code beside it")
        windows = xdotool(screen, "search", "--onlyvisible", "--name", "^A lecture of tests")
        assert windows == shown.window, "the window has stayed"
        shown.press("Prior")
        shown.wait(lambda: shown.notes().count("[3/4]") == 2, "the step before")
        shown.press("Home")
        shown.wait(lambda: shown.notes().count("[1/4]") == 2, "the first step")
        shown.press("Escape")
        assert shown.process.wait(SECONDS) == 0

    line = f"landscape: {tmp_path}/failing.py, line 3: the program raised ValueError: no such thing"
    assert shown.errors().startswith(line)


@pytest.mark.seldom(3)
def test_the_list_the_code_the_strip_and_the_inspector_open_and_close(
    screen: dict[str, str], tmp_path: Path
) -> None:
    with _shown(screen, tmp_path, LECTURE, "--lang", "fr", "--size", "640x480") as shown:
        shown.goes_on("one.py")
        assert shown.told("one.py", "frame")[-1][1:3] == ["640", "426"]
        shown.press("F2")
        shown.wait(lambda: bool(shown.told("one.py", "resized")), "the code")
        assert shown.told("one.py", "resized") == [["346", "260"]]
        shown.press("F2")
        shown.wait(lambda: len(shown.told("one.py", "resized")) == 2, "the code to go")
        # In the area 100 below its top, which is 54 below the window's.
        shown.mouse("200", "154", "click", "1")
        shown.wait(lambda: bool(shown.told("one.py", "button")), "the mouse")
        assert shown.told("one.py", "button")[0] == ["200.0", "100.0"]
        shown.press("F3")
        shown.stands("one.py")
        count, before = len(shown.told("one.py", "frame")), shown.clocks("one.py")[-1]
        shown.press("Escape")
        shown.goes_on("one.py")
        after = shown.clocks("one.py")[count]
        stood = (after[1] - before[1]) - (after[0] - before[0])
        assert stood > 0.3, "the time stood still with the program"
        shown.press("F12")
        shown.stands("one.py")
        shown.press("a")
        shown.press("Escape")
        shown.goes_on("one.py")
        assert ["65", "1"] not in shown.told("one.py", "key"), "the inspector had the keys"
        shown.press("F1", "w", "a", "Return")
        shown.wait(lambda: "[2/4] waiting.py" in shown.notes(), "the step from the list")
        assert "C’est la dernière étape" not in shown.notes()
        shown.press("F1", "End", "Return")
        shown.wait(lambda: "C’est la dernière étape" in shown.notes(), "the last step")
        shown.press("F1", "Escape", "Escape")
        assert shown.process.wait(SECONDS) == 0

    assert shown.errors() == ""


@pytest.mark.seldom(14, first=9)
def test_a_view_is_walked_and_taken_apart(screen: dict[str, str], tmp_path: Path) -> None:
    text = "title: A lecture of tests\n\nfig13a\n\none.py\n"
    with _shown(screen, tmp_path, text, "--size", "480x320") as shown:
        shown.wait(lambda: "[1/2]" in shown.notes(), "the view")
        shown.press("Up")
        # While the view is being opened, Escape would end the lecture.
        shown.wait(shown.draws, "the view's first picture")
        for key in ("F3", "Escape", "F12", "Escape", "h", "Next"):
            shown.press(key)
        shown.goes_on("one.py")
        shown.press("Prior")
        shown.wait(lambda: shown.notes().count("[1/2]") == 2, "the view again")
        shown.press("Escape")
        assert shown.process.wait(SECONDS) == 0
    assert shown.errors() == ""
