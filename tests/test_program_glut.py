"""Programs with a GLUT window, run to a frame under Xvfb by a main loop in Python."""

import textwrap
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from commands import environment, landscape, need_library
from watching import PROGRAMS, Watcher, screen

Write = Callable[[str], Path]

pytestmark = pytest.mark.window

BEGIN = """
import sys, time
from OpenGL.GL import *
from OpenGL.GLUT import *

def display():
    print("display", glutGet(GLUT_ELAPSED_TIME))
    glClear(GL_COLOR_BUFFER_BIT)
    glutSwapBuffers()

glutInit(sys.argv)
glutInitDisplayMode(GLUT_DOUBLE | GLUT_RGB | GLUT_DEPTH)
glutInitWindowSize(64, 48)
glutCreateWindow("test")
glutDisplayFunc(display)
"""


@pytest.fixture(scope="module")
def watch(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Watcher]:
    """Runs programs on one screen, one after the other in one process."""
    need_library("glut")
    with screen() as name:
        watcher = Watcher(tmp_path_factory.mktemp("users"), DISPLAY=name)
        yield watcher
        watcher.close()


@pytest.fixture
def write(tmp_path: Path) -> Write:
    """Writes a program that opens a window first, and goes on as given."""

    def write(rest: str, begin: str = BEGIN) -> Path:
        path = tmp_path / "program.py"
        path.write_text(begin + textwrap.dedent(rest))
        return path

    return write


@pytest.mark.seldom(10, first=5)
def test_the_windmill_turns_by_its_timer_and_repeats(watch: Watcher) -> None:
    first, again, still = (watch(PROGRAMS / "windmill.py", frame) for frame in (3, 3, 0))
    assert first.picture == again.picture != still.picture
    assert first.colours > 500
    assert first.log[0] == ["opened", "glut", "glx", 400, 300]
    assert first.names["glVertex3f"] > 1000  # gluSphere and gluCylinder among them
    assert first.calls[0] == ["glClear", str(0x4100)]


@pytest.mark.seldom(3, first=1)
def test_the_main_loop_tells_the_size_then_draws_and_timers_come_when_they_are_due(
    watch: Watcher, write: Write
) -> None:
    path = write(
        """
        def tick(value):
            print("timer", value, glutGet(GLUT_ELAPSED_TIME))
            if value < 3:
                glutTimerFunc(40, tick, value + 1)
            glutPostRedisplay()
        glutReshapeFunc(lambda w, h: print("reshape", w, h, glutGet(GLUT_WINDOW_WIDTH)))
        glutVisibilityFunc(lambda state: print("visible", state == GLUT_VISIBLE))
        glutTimerFunc(40, tick, 1)
        glutMainLoop()
        """
    )
    assert watch(path, 3).err.splitlines() == [
        *("reshape 64 48 64", "visible True", "display 0", "timer 1 40", "display 40"),
        *("timer 2 80", "display 80", "timer 3 120", "display 120"),
    ]


def test_an_idle_callback_is_called_until_it_asks_for_a_redraw(
    watch: Watcher, write: Write
) -> None:
    path = write(
        """
        last = 0
        def idle():
            global last
            if glutGet(GLUT_ELAPSED_TIME) - last >= 30:
                last = glutGet(GLUT_ELAPSED_TIME)
                glutPostRedisplay()
        glutIdleFunc(idle)
        glutMainLoop()
        """
    )
    times = [int(line.split()[1]) for line in watch(path, 3).err.splitlines()]
    assert times[0] == 0
    assert all(30 <= b - a <= 40 for a, b in zip(times, times[1:], strict=False))


def test_a_program_that_waits_for_somebody_is_redrawn(watch: Watcher, write: Write) -> None:
    assert watch(write("glutMainLoop()"), 4).log[-1] == ["ended", 4]
    assert watch(write("glutIdleFunc(lambda: None)\nglutMainLoop()"), 1).log[-1] == ["ended", 1]


def test_a_frame_of_a_single_buffered_window_ends_with_its_display_callback(
    watch: Watcher, write: Write
) -> None:
    begin = BEGIN.replace("GLUT_DOUBLE", "GLUT_SINGLE").replace("glutSwapBuffers", "glFlush")
    path = write("glClearColor(0, 1, 0, 1)\nglFlush()\nglutMainLoop()", begin)
    seen = watch(path, 1)
    assert seen.names == {"glClear": 1, "glFlush": 1}
    assert seen.centre == [0, 255, 0]


SINGLE = BEGIN.replace("GLUT_DOUBLE", "GLUT_SINGLE").replace("glutSwapBuffers", "glFlush")


def test_a_frame_of_a_single_buffered_window_ends_with_any_callback_that_draws(
    watch: Watcher, write: Write
) -> None:
    idle = watch(write("glutIdleFunc(display)\nglutMainLoop()", SINGLE), 2)
    assert idle.names == {"glClear": 1, "glFlush": 1}
    timer = "glutTimerFunc(20, lambda _: display(), 0)\nglutIdleFunc(lambda: None)\n"
    assert watch(write(f"{timer}glutMainLoop()", SINGLE), 1).err.split() == [
        *("display", "0", "display", "20"),
    ]
    key = watch(
        write("glutKeyboardFunc(lambda *_: display())\nglutMainLoop()", SINGLE),
        1,
        events=[{"frame": 1, "key": "A"}],
    )
    assert key.names == {"glClear": 1, "glFlush": 1}


def test_what_is_drawn_before_the_display_callback_is_of_its_frame(
    watch: Watcher, write: Write
) -> None:
    path = write(
        """
        glRectf(0, 0, 1, 1)
        glutReshapeFunc(lambda w, h: glRectf(0, 0, 1, 1))
        glutTimerFunc(0, lambda _: None, 0)
        glutMainLoop()
        """,
        SINGLE,
    )
    seen = watch(path, 0)
    assert seen.names == {"glRectf": 2, "glClear": 1, "glFlush": 1}


def test_shapes_and_letters_of_glut_are_single_calls(watch: Watcher, write: Write) -> None:
    path = write(
        """
        def display():
            glutSolidTeapot(0.5)
            glutWireCube(1.0)
            glRasterPos2f(0, 0)
            for letter in b"Hi":
                glutBitmapCharacter(GLUT_BITMAP_8_BY_13, letter)
            glutStrokeCharacter(GLUT_STROKE_ROMAN, 65)
            glutSwapBuffers()
        glutDisplayFunc(display)
        glutMainLoop()
        """
    )
    seen = watch(path, 1)
    assert [call[0] for call in seen.calls] == [
        *("glutSolidTeapot", "glutWireCube", "glRasterPos2f"),
        *("glutBitmapCharacter", "glutBitmapCharacter", "glutStrokeCharacter"),
    ]
    assert seen.colours > 1


def test_events_reach_the_callbacks(watch: Watcher, write: Write) -> None:
    path = write(
        """
        def display():
            glutSwapBuffers()
        glutDisplayFunc(display)
        glutKeyboardFunc(lambda *at: print("key", *at, glutGetModifiers()))
        glutKeyboardUpFunc(lambda *at: print("key up", *at))
        glutSpecialFunc(lambda *at: print("special", *at, at[0] == GLUT_KEY_LEFT))
        glutMouseFunc(lambda *at: print("mouse", *at))
        glutMotionFunc(lambda *at: print("motion", *at))
        glutPassiveMotionFunc(lambda *at: print("passive", *at))
        glutReshapeFunc(lambda *at: print("reshape", *at))
        glutMainLoop()
        """
    )

    events = [
        {"frame": 1, "move": [10, 20]},
        {"frame": 1, "key": "w"},
        {"frame": 1, "key": "w", "action": "release"},
        {"frame": 1, "key": "A", "mods": ["shift"]},
        {"frame": 1, "key": "ESCAPE"},
        {"frame": 2, "key": "LEFT"},
        {"frame": 2, "button": "right"},
        {"frame": 2, "move": [11, 21]},
        {"frame": 2, "button": "right", "action": "release"},
        {"frame": 2, "scroll": [0, 1]},
        {"frame": 2, "resize": [100, 60]},
        {"frame": 4, "close": True},
    ]

    seen = watch(path, 3, events=events)
    assert seen.err.splitlines() == [
        *("reshape 64 48", "passive 10 20", "key b'w' 10 20 0", "key up b'w' 10 20"),
        *("key b'A' 10 20 1", "key b'\\x1b' 10 20 0", "special 100 10 20 True"),
        *("mouse 2 0 10 20", "motion 11 21", "mouse 2 1 11 21", "mouse 3 0 11 21"),
        *("mouse 3 1 11 21", "reshape 100 60"),
    ]
    assert seen.size == [100, 60]
    assert "ended after 4 frames; frame 9 was asked" in watch(path, 9, events=events).error


FAILURES = {
    "raises in a callback": (
        "def display():\n    1 / 0\nglutDisplayFunc(display)\nglutMainLoop()\n",
        "line 17: the program raised ZeroDivisionError: division by zero",
    ),
    "leaves": ("glutIdleFunc(glutLeaveMainLoop)\nglutMainLoop()\n", "ended after 1 frame; frame 3"),
    "two windows": ('glutCreateWindow("second")\n', "opens two windows; only programs with one"),
    "a window inside": ("glutCreateSubWindow(1, 0, 0, 9, 9)\n", "opens two windows"),
    "no callback": ("glutDisplayFunc(None)\nglutMainLoop()\n", "has no display callback"),
    "no loop": ("", "ended after no frames; frame 3 was asked"),
}


@pytest.mark.parametrize("name", FAILURES)
def test_a_program_that_fails_ends_in_one_line(watch: Watcher, write: Write, name: str) -> None:
    rest, words = FAILURES[name]
    seen = watch(write(rest), 3)
    assert words in seen.error
    assert ("Traceback" in seen.details) == ("raised" in words)


@pytest.mark.seldom(3, first=2)
def test_a_program_stuck_in_a_callback_is_ended(watch: Watcher, write: Write) -> None:
    stuck = "glutIdleFunc(lambda: time.sleep(0) or stuck())\ndef stuck():\n    while 1: pass\n"
    path = write(stuck + "glutMainLoop()\n")
    watch.ended(path, 3, "completed 1 frame {}; frame 3 was not")


def test_what_freeglut_would_end_the_process_for_is_refused(watch: Watcher, write: Write) -> None:
    begin = BEGIN.replace("glutInit(sys.argv)\n", "")
    assert "calls glutCreateWindow before glutInit" in watch(write("", begin)).error
    begin = BEGIN.replace("GLUT_DEPTH", "GLUT_STEREO")
    assert "what this screen cannot do" in watch(write("", begin)).error


def test_a_glut_program_may_import_pygame_for_its_sound(watch: Watcher, write: Write) -> None:
    pytest.importorskip("pygame")
    path = write(
        """
        pygame.init()
        pygame.mixer.init()
        print(pygame.time.get_ticks(), pygame.time.wait(40), pygame.time.get_ticks())
        glutMainLoop()
        """,
        "import pygame\n" + BEGIN,
    )
    seen = watch(path, 1)
    assert seen.log[0] == ["opened", "glut", "glx", 64, 48]
    assert seen.err.splitlines()[0] == "0 40 40", "pygame's clock is held, too"


def test_the_display_mode_may_be_chosen_before_glutinit(watch: Watcher, write: Write) -> None:
    chosen = "glutInitDisplayMode(GLUT_DOUBLE | GLUT_RGB | GLUT_DEPTH)"
    begin = BEGIN.replace(f"{chosen}\n", "").replace("glutInit(", f"{chosen}\nglutInit(")
    bits = "print(glGetIntegerv(GL_DEPTH_BITS) > 0, glGetBooleanv(GL_DOUBLEBUFFER))\nglutMainLoop()"
    assert watch(write(bits, begin), 1).err.splitlines()[0] == "True 1"


def test_a_program_that_chooses_no_display_mode_has_a_depth_buffer(
    watch: Watcher, write: Write
) -> None:
    begin = BEGIN.replace("glutInitDisplayMode(GLUT_DOUBLE | GLUT_RGB | GLUT_DEPTH)\n", "")
    begin = begin.replace("glutSwapBuffers", "glFlush")
    bits = "print(glGetIntegerv(GL_DEPTH_BITS) > 0, glGetBooleanv(GL_DOUBLEBUFFER))\nglutMainLoop()"
    assert watch(write(bits, begin), 1).err.splitlines()[0] == "True 0"


@pytest.mark.seldom(3, first=2)
@pytest.mark.posix_only("there is always a screen")
def test_glut_without_a_screen_is_refused_in_one_line(tmp_path: Path) -> None:
    need_library("glut")
    watcher = Watcher(tmp_path, XDG_RUNTIME_DIR="/nonexistent")
    error = watcher(PROGRAMS / "windmill.py").error
    watcher.close()
    assert error.endswith("windmill.py: GLUT needs a screen (DISPLAY is not set): use xvfb-run")


@pytest.mark.seldom(3, first=2)
def test_a_glfw_program_with_shapes_of_glut_draws_on_the_screen(
    watch: Watcher, write: Write
) -> None:
    path = write(
        """
        import glfw
        glfw.init()
        window = glfw.create_window(64, 48, "test", None, None)
        glfw.make_context_current(window)
        glutInit(sys.argv)
        glEnable(GL_LIGHTING)
        glEnable(GL_LIGHT0)
        glutSolidSphere(0.8, 16, 16)
        glfw.swap_buffers(window)
        """,
        "import sys\nfrom OpenGL.GL import *\nfrom OpenGL.GLUT import *\n",
    )
    seen = watch(path)
    assert seen.log[0][1:3] == ["glfw", "glfw"]
    assert seen.names["glutSolidSphere"] == 1
    assert seen.colours > 1


@pytest.mark.seldom(10, first=5)
def test_shapes_are_drawn_again_and_calls_are_shown_with_the_programs_lines(write: Write) -> None:
    need_library("glut")
    begin = BEGIN.replace("GLUT_DOUBLE", "GLUT_SINGLE").replace(
        "glutSwapBuffers()", "glutSolidTeapot(0.5)\n    glFlush()"
    )
    path = write("glutMainLoop()", begin)
    with screen() as name:
        env = environment(DISPLAY=name)
        calls = landscape("trace", path, "--frame", "1", "--json", env=env).json()
        shown = [(call["name"], call["source"]) for call in calls[-3:]]
        history = landscape("pixel", path, "32,24", "--frame", "1", "--json", env=env).json()
    assert shown == [
        *(("glClear", "program.py:8"), ("glutSolidTeapot", "program.py:9")),
        ("glFlush", "program.py:10"),
    ]
    assert [row["name"] for row in history] == ["glClear", "glutSolidTeapot"]
    assert history[-1]["color"][:3] == [255, 255, 255]
