"""Programs that draw in Qt's QOpenGLWidget, run to a frame under Xvfb, with nothing shown."""

import importlib.util
import textwrap
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from commands import environment, landscape
from watching import Watcher, screen

Write = Callable[[str], Path]

pytestmark = [
    pytest.mark.window,
    pytest.mark.skipif(
        importlib.util.find_spec("PySide6") is None,
        reason="PySide6 is not installed: pip install PySide6-Essentials",
    ),
]

BEGIN = """
import sys
from PySide6.QtCore import Qt, QTimer
from PySide6.QtOpenGLWidgets import QOpenGLWidget
from PySide6.QtWidgets import QApplication, QMainWindow
from OpenGL.GL import *

class Picture(QOpenGLWidget):
    angle = 0
    def initializeGL(self):
        print("initialize")
        glClearColor(0, 0, 1, 1)
    def resizeGL(self, width, height):
        print("resize", width, height)
        glViewport(0, 0, width, height)
    def paintGL(self):
        glBindFramebuffer(GL_FRAMEBUFFER, self.defaultFramebufferObject())
        glClear(GL_COLOR_BUFFER_BIT)
        glRotatef(self.angle, 0, 0, 1)
        glRectf(-0.5, -0.5, 0.5, 0.5)
"""
END = """
app = QApplication(sys.argv)
window = QMainWindow()
window.resize(64, 48)
window.setCentralWidget(Picture())
window.show()
sys.exit(app.exec())
"""


@pytest.fixture
def watch(tmp_path: Path) -> Iterator[Watcher]:
    """Runs programs in a process that ends with the test: Qt begins once in each."""
    with screen() as name:
        watcher = Watcher(tmp_path, DISPLAY=name)
        yield watcher
        watcher.close()


@pytest.fixture
def write(tmp_path: Path) -> Write:
    """Writes a program with a widget that has further methods, as given."""

    def write(methods: str) -> Path:
        path = tmp_path / "program.py"
        path.write_text(BEGIN + textwrap.indent(textwrap.dedent(methods), "    ") + END)
        return path

    return write


TURNING = """
def __init__(self):
    super().__init__()
    self.timer = QTimer(self)
    self.timer.timeout.connect(self.turn)
    self.timer.start(20)
def turn(self):
    self.angle += 1
    self.update()
"""


def test_a_frame_is_what_paintgl_draws_and_timers_are_held(watch: Watcher, write: Write) -> None:
    path = write(TURNING)
    seen = watch(path, 3)
    assert seen.log[:3] == [["opened", "qt", "glx", 64, 48], ["default state", True], ["began", 0]]
    assert seen.log[-1] == ["ended", 3]
    turns = [call for call in seen.calls if call[0] == "glRotatef"]
    assert turns == [["glRotatef", "3", "0", "0", "1"]]
    assert seen.centre == [255, 255, 255] and seen.colours == 2
    assert seen.err.splitlines() == ["initialize", "resize 64 48"]


EVENTS = """
def timerEvent(self, event):
    print("timer")
    self.repaint()
def keyPressEvent(self, event):
    print("key", event.key() == Qt.Key.Key_Left, event.modifiers() == Qt.ShiftModifier)
    self.startTimer(20)
def mousePressEvent(self, event):
    print("mouse", event.position().x(), event.button() == Qt.LeftButton)
def wheelEvent(self, event):
    print("wheel", event.angleDelta().y())
"""


def test_events_reach_the_widget_and_a_program_that_waits_is_redrawn(
    watch: Watcher, write: Write
) -> None:
    events = [
        {"frame": 1, "key": "LEFT", "mods": ["shift"]},
        {"frame": 2, "move": [20, 30]},
        {"frame": 2, "button": "left"},
        {"frame": 3, "scroll": [0, -1]},
        {"frame": 4, "resize": [80, 60]},
    ]
    seen = watch(write(EVENTS), 4, events=events)
    lines = seen.err.splitlines()
    assert "timer" in lines
    assert [line for line in lines if line != "timer"] == [
        *("initialize", "resize 64 48", "key True True", "mouse 20.0 True", "wheel -120"),
        "resize 80 60",
    ]
    assert seen.size == [80, 60] and seen.names["glViewport"] == 1


FAILURES = {
    "in paintGL": ("def paintGL(self):\n    glEnable(1)\n", "the program raised GLError"),
    "in a handler": (
        "def showEvent(self, event):\n    1 / 0\n",
        "the program raised ZeroDivisionError",
    ),
    "in a timer": (
        "def initializeGL(self):\n    QTimer.singleShot(5, lambda: {}['key'])\n",
        "the program raised KeyError",
    ),
    "a second widget": (
        "def initializeGL(self):\n    self.other = Picture(self)\n",
        "opens two windows",
    ),
    "leaves": (
        "def initializeGL(self):\n    QTimer.singleShot(5, app.quit)\n",
        "ended after 1 frame; frame 3 was asked",
    ),
}


@pytest.mark.parametrize("name", FAILURES)
def test_a_program_that_fails_ends_in_one_line(watch: Watcher, write: Write, name: str) -> None:
    methods, words = FAILURES[name]
    assert words in watch(write(methods), 3).error


def test_a_frame_is_drawn_again(write: Write) -> None:
    path = write(TURNING)
    with screen() as name:
        env = environment(DISPLAY=name)
        for frame in ("0", "2"):
            rows = landscape("pixel", path, "32,24", "--frame", frame, "--json", env=env).json()
            assert [row["name"] for row in rows] == ["glClear", "glRectf"]
            assert rows[-1]["color"][:3] == [255, 255, 255]
        refused = landscape("inspect", path, env=env)
    assert "the inspector shows GLFW, GLUT and pygame programs" in refused.err


def test_qt_without_a_screen_is_refused_in_one_line(write: Write) -> None:
    done = landscape("trace", write(""))
    assert done.status == 3 and "Qt needs X11 for OpenGL (DISPLAY is not set)" in done.err
