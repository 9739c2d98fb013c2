"""Programs with a GLFW window, run to a frame: what they see, what is seen, how they fail."""

import os
import sys
import textwrap
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from commands import TESTS, environment, landscape, need_library, python
from watching import PROGRAMS, Seen, Watcher

from framelens.base.errors import InputError
from framelens.program.program_source import read_source

PATHS = f"{TESTS.parent}{os.pathsep}{TESTS}"
Write = Callable[[str], Path]

BEGIN = """
import glfw
from OpenGL.GL import *
glfw.init()
window = glfw.create_window(64, 48, "test", None, None)
glfw.make_context_current(window)
"""


@pytest.fixture(scope="module")
def watch(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Watcher]:
    """Runs programs without a screen, one after the other in one process."""
    watcher = Watcher(tmp_path_factory.mktemp("users"))
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


@pytest.mark.seldom(10)
def test_a_program_is_watched_from_its_context_to_its_frame(watch: Watcher) -> None:
    seen = watch(PROGRAMS / "lantern.py", 2)
    backend = seen.log[0][2]
    assert seen.log == [
        ["opened", "glfw", backend, 400, 300],
        ["default state", True],
        *(["began", 0], ["ended", 0], ["began", 1], ["ended", 1], ["began", 2], ["ended", 2]),
    ]
    assert seen.names["glCallList"] == 2
    assert seen.names["glMultMatrixd"] == 1  # gluPerspective
    assert seen.names["glNewList"] == 0
    assert seen.colours > 1000
    assert seen.notices == []


def test_a_frame_is_the_same_each_time_and_turns_with_the_held_clock(watch: Watcher) -> None:
    first, again = (watch(PROGRAMS / "lantern.py", 5) for _ in range(2))
    assert first.picture == again.picture
    assert first.calls == again.calls
    assert ["glRotatef", "2.5", "0", "1", "0"] in [
        [call[0], *(f"{float(value):g}" for value in call[1:])]
        for call in first.calls
        if call[0] == "glRotatef"
    ]


def test_what_is_set_up_belongs_to_frame_0(watch: Watcher) -> None:
    seen = watch(PROGRAMS / "lantern.py", 0)
    assert seen.names["glNewList"] == 2
    assert seen.names["glTexImage2D"] == 1
    assert seen.names["glLightfv"] > 3  # glLight is its alias


@pytest.mark.parametrize(
    ("begin", "gl"),
    [
        ("from OpenGL.GL import *", ""),
        ("import OpenGL.GL as gl", "gl."),
        ("from OpenGL import GL", "GL."),
        ("import OpenGL.GL", "OpenGL.GL."),
        ("from OpenGL.GL.VERSION.GL_1_1 import *", ""),
    ],
)
@pytest.mark.sweep(3)
def test_calls_are_seen_however_opengl_is_imported(
    watch: Watcher, write: Write, begin: str, gl: str
) -> None:
    path = write(
        f"""
        {begin}
        while not glfw.window_should_close(window):
            {gl}glClearColor(1, 0.5, 0, 1)
            {gl}glClear({gl}GL_COLOR_BUFFER_BIT)
            glfw.swap_buffers(window)
            glfw.poll_events()
        """,
        BEGIN.replace("from OpenGL.GL import *\n", ""),
    )
    seen = watch(path, 1)
    assert seen.names == {"glClearColor": 1, "glClear": 1}
    assert seen.centre == [255, 128, 0]


def test_only_the_outermost_call_is_noted_and_by_the_name_of_opengl(
    watch: Watcher, write: Write
) -> None:
    seen = watch(
        write(
            """
            import numpy
            from OpenGL.arrays import vbo
            glRotate(10, 0, 0, 1)
            glColor(1, 0, 0)
            glVertex((1, 2, 3))
            glTexParameter(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST)
            glTexImage2Dub(GL_TEXTURE_2D, 0, GL_RGB, 0, GL_RGB, numpy.zeros((2, 2, 3), "B"))
            pixels = glReadPixels(0, 0, 1, 1, GL_RGB, GL_UNSIGNED_BYTE, outputType=int)
            assert pixels.shape == (1, 1, 3), pixels
            with vbo.VBO(numpy.zeros((3, 3), "f")):
                glVertexPointerf(None)
            assert bool(glActiveTexture) and glGenTextures(2).size == 2
            glfw.swap_buffers(window)
            """
        )
    )
    assert [call[0] for call in seen.calls] == [
        *("glRotated", "glColor3d", "glVertex3d", "glTexParameteri", "glTexImage2Dub"),
        *("glReadPixels", "glGenBuffers", "glBindBuffer", "glBufferData", "glVertexPointerf"),
        *("glBindBuffer", "glDeleteBuffers", "glGenTextures"),
    ]


def test_thousands_of_vertices_are_seen_one_by_one(watch: Watcher, write: Write) -> None:
    seen = watch(
        write(
            """
            glBegin(GL_POINTS)
            for i in range(20000):
                glVertex2f(i / 20000, 0)
            glEnd()
            glfw.swap_buffers(window)
            """
        )
    )
    assert seen.names["glVertex2f"] == 20000


def test_the_clock_is_held_and_moves_by_sleeping(watch: Watcher, write: Write) -> None:
    seen = watch(
        write(
            """
            import datetime, random, time
            from time import perf_counter, sleep
            import numpy
            frame = 0
            while True:
                if frame == 3:
                    sleep(2.5)
                first = perf_counter()
                glColor3d(glfw.get_time(), time.time() - 1164974400, perf_counter() - first)
                glNormal3d(random.random(), numpy.random.random(), 0)
                now = datetime.datetime.now(datetime.timezone.utc)
                glVertex3d(now.year, now.second, int(isinstance(now, datetime.datetime)))
                glTexCoord1d(datetime.date.today().year)
                glfw.swap_buffers(window)
                frame += 1
            """
        ),
        3,
    )

    calls = {name: [float(value) for value in values] for name, *values in seen.calls}
    assert calls["glColor3d"] == pytest.approx([2.55, 2.55, 0.0], abs=1e-5)
    assert calls["glVertex3d"] == [2006, 2, 1]
    assert calls["glTexCoord1d"] == [2006]


def test_random_numbers_repeat_and_a_wait_that_reads_the_clock_ends(
    watch: Watcher, write: Write
) -> None:
    path = write(
        """
        import random, time, numpy
        last = time.time()
        while True:
            while time.time() - last < 0.1:
                pass
            last = time.time()
            rng = numpy.random.default_rng()
            glVertex3d(random.random(), numpy.random.random(), rng.random())
            glfw.swap_buffers(window)
        """
    )
    first, again = watch(path, 4), watch(path, 4)
    assert first.calls == again.calls and len(first.calls) == 1


EVENTS = [
    {"frame": 1, "key": "SPACE"},
    {"frame": 1, "key": "+"},
    {"frame": 2, "key": "SPACE", "action": "release"},
    {"frame": 2, "move": [10, 20.5]},
    {"frame": 2, "button": "left", "action": "press", "mods": ["control"]},
    {"frame": 3, "scroll": [0, -1]},
    {"frame": 3, "resize": [80, 40]},
    {"frame": 4, "close": True},
]
LISTENER = """
def tell(*values):
    glGetError()
    print(*values)
glfw.set_key_callback(window, lambda w, key, code, action, mods: tell("key", key, action, mods))
glfw.set_char_callback(window, lambda w, code: tell("char", chr(code)))
glfw.set_cursor_pos_callback(window, lambda w, x, y: tell("move", x, y))
glfw.set_mouse_button_callback(window, lambda w, *rest: tell("button", *rest))
glfw.set_scroll_callback(window, lambda w, x, y: tell("scroll", x, y))
glfw.set_framebuffer_size_callback(window, lambda w, x, y: tell("size", x, y))
frame = 0
while not glfw.window_should_close(window):
    tell(frame, glfw.get_key(window, glfw.KEY_SPACE), *glfw.get_cursor_pos(window),
         glfw.get_mouse_button(window, glfw.MOUSE_BUTTON_LEFT))
    glClear(GL_COLOR_BUFFER_BIT)
    glfw.swap_buffers(window)
    glfw.poll_events()
    frame += 1
glfw.terminate()
"""


def test_events_reach_callbacks_and_what_is_asked_for(watch: Watcher, write: Write) -> None:
    seen = watch(write(LISTENER), 9, events=EVENTS)
    assert seen.out == ""  # standard output is for what our own commands print
    assert seen.err.splitlines() == [
        *("0 0 0.0 0.0 0", "key 32 1 0", "char  ", "key 61 1 1", "char +"),
        *("1 1 0.0 0.0 0", "key 32 0 0", "move 10.0 20.5", "button 0 1 2"),
        *("2 0 10.0 20.5 1", "scroll 0.0 -1.0", "size 80 40", "3 0 10.0 20.5 1"),
    ]
    assert seen.error.endswith("program.py: ended after 4 frames; frame 9 was asked")


def test_a_resized_window_draws_in_its_new_size(watch: Watcher, write: Write) -> None:
    seen = watch(write(LISTENER), 3, events=EVENTS)
    assert seen.size == [80, 40]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("[{]", "is not JSON"),
        ('{"frame": 1, "key": "A"}\n{"frame"', "line 2 is not JSON"),
        ("[3]", "event 1: 3 is not an object"),
        ('[{"frame": 1}]', "event 1: expected exactly one of key, button, move"),
        ('[{"frame": -1, "key": "A"}]', '"frame" is -1, expected a whole number from 0'),
        ('[{"key": "A"}]', '"frame" is None'),
        ('[{"frame": 1, "key": "SPCAE"}]', "\"key\" is 'SPCAE', expected a key's name"),
        ('[{"frame": 1, "key": "A", "action": "hit"}]', "expected press or release or repeat"),
        ('[{"frame": 1, "key": "A", "mods": ["ctrl"]}]', "expected shift or control or alt"),
        ('[{"frame": 1, "move": [1]}]', '"move" is [1], expected two numbers'),
        ('[{"frame": 1, "move": [NaN, 1]}]', "expected two numbers"),
        ('[{"frame": 1, "resize": [0, 5]}]', "expected two whole numbers from 1"),
        ('[{"frame": 1, "key": "A", "when": 2}]', "'when' has no meaning"),
        ('[{"frame": 1, "close": 1}]', "expected true"),
    ],
)
def test_a_bad_list_of_events_is_refused_by_name(
    watch: Watcher, tmp_path: Path, text: str, words: str
) -> None:
    path = tmp_path / "events.json"
    path.write_text(text)
    error = watch(PROGRAMS / "lantern.py", events=str(path)).error
    assert error.startswith(f"{path}: ") and words in error


def test_a_program_finds_its_folder_its_arguments_and_the_users_files(
    watch: Watcher, tmp_path: Path
) -> None:
    (tmp_path / "helper.py").write_text("COLOUR = 0.25\n")
    path = tmp_path / "main.py"
    path.write_text(
        BEGIN
        + "import os, sys, helper\n"
        + "assert __name__ == '__main__' and sys.modules['__main__'].helper is helper\n"
        + "print(sys.argv, os.getcwd(), __file__)\n"
        + "glClearColor(helper.COLOUR, 0, 0, 1)\n"
        + "glfw.swap_buffers(window)\n"
    )
    seen = watch(path, arguments=["--fast", "2"])
    cwd = seen.err.split("] ")[1].split()[0]
    assert seen.err.split("]")[0] == f"[{str(path)!r}, '--fast', '2'"
    assert Path(cwd).is_absolute() and cwd != str(tmp_path)

    # Another program beside another file of that name gets its own.
    other = tmp_path / "other"
    other.mkdir()
    (other / "helper.py").write_text("COLOUR = 0.75\n")
    path.rename(other / "main.py")
    assert watch(other / "main.py").calls == [["glClearColor", "0.75", "0", "0", "1"]]


@pytest.mark.seldom(10, first=2)
def test_calls_without_a_context_have_no_effect(watch: Watcher, write: Write) -> None:
    current, on = "glfw.make_context_current(window)\n", "glEnable(GL_SCISSOR_TEST)\n"
    draw = "glClearColor(1, 1, 1, 1)\nglScissor(0, 0, 1, 1)\nglClear(GL_COLOR_BUFFER_BIT)\n"
    show = "glfw.swap_buffers(window)\n"
    early = write(on + current + draw + show, BEGIN.replace(current, ""))
    if sys.platform == "win32":  # where it raises
        assert "line 6: the program raised GLError: invalid operation (gl" in watch(early).error
        return
    assert watch(early).centre == [255, 255, 255]
    told = landscape("trace", early).err
    assert "line 6: glEnable is called before glfw.make_context_current, so it has" in told
    between = write(current.replace("window", "None") + on + current + draw + show)
    assert watch(between).centre == [255, 255, 255]
    black = "glClear(GL_COLOR_BUFFER_BIT)\n"  # nobody says what is in a new window
    assert watch(write(black + on + draw + show)).centre == [0, 0, 0]


def test_a_program_that_forgets_its_context_is_told_so(watch: Watcher, write: Write) -> None:
    begin = BEGIN.replace("glfw.make_context_current(window)\n", "")
    path = write("glfw.swap_buffers(window)\n", begin)
    assert watch(path).error == f"{path}: shows a frame before glfw.make_context_current"


FAILURES: dict[str, tuple[str, int, str]] = {
    "raises": ("\n1 / 0\n", 0, "line 8: the program raised ZeroDivisionError: division by zero"),
    "exits": ("\nglfw.swap_buffers(window)\nexit()\n", 3, ": ended after 1 frame; frame 3 was"),
    "exits hard": ("\nimport os\nos._exit(3)\n", 0, ": ended after no frames; frame 0 was asked"),
    "two windows": (
        '\nglfw.create_window(9, 9, "second", None, None)\n',
        *(0, ": opens two windows; only programs with one"),
    ),
    "wrong call": ("\nglEnable(12345)\n", 0, "line 8: the program raised GLError: invalid enum"),
    "calls what raises": (
        "\ndef turn():\n    glRotatef(30)\n\nturn()\n",
        *(0, "line 9: the program raised TypeError"),
    ),
    "no package": ("\nimport nothing_of_this_name\n", 0, ": needs the Python package nothing_of"),
}


@pytest.mark.seldom(3)
@pytest.mark.parametrize("name", FAILURES)
def test_a_program_that_fails_ends_in_one_line(watch: Watcher, write: Write, name: str) -> None:
    rest, frame, words = FAILURES[name]
    seen = watch(write(rest), frame)
    assert words in seen.error
    if "raised" in words:
        assert seen.details.startswith('Traceback (most recent call last):\n  File "')
        assert "framelens" not in seen.details.splitlines()[1]
    else:
        assert seen.details == "" or name == "no package"


NOT_PROGRAMS: dict[str, tuple[bytes, str]] = {
    "Python 2": (b'import glfw\nprint "hello"\n', ", line 2: is not Python 3 (Missing paren"),
    "binary": (b"\x00\x01\x02", "source code string cannot contain null bytes"),
    "no window library": (b"print('hello')\n", "imports neither glfw, pygame nor OpenGL.GLUT"),
    "no context": (b"import glfw\nglfw.init()\n", "ended without opening a window for OpenGL"),
}


@pytest.mark.parametrize("name", NOT_PROGRAMS)
def test_what_is_no_opengl_program_is_refused(watch: Watcher, tmp_path: Path, name: str) -> None:
    text, words = NOT_PROGRAMS[name]
    path = tmp_path / "program.py"
    path.write_bytes(text)
    assert words in watch(path).error


# What a program imports and calls, and the toolkit whose window it opens.
OPENED = {
    "GLUT, with pygame's sound": (
        "import pygame\nfrom OpenGL.GLUT import *\nglutCreateWindow('a')\n",
        "glut",
    ),
    "pygame, with GLUT's shapes": (
        "import pygame\nfrom OpenGL.GLUT import *\n"
        "pygame.display.set_mode((9, 9), pygame.OPENGL)\nglutInit()\n",
        "pygame",
    ),
    "GLFW, with GLUT's shapes": (
        "from OpenGL.GLUT import *\nfrom glfw import create_window as make\nglutInit()\n",
        "glfw",
    ),
    "pygame without the flag": ("import pygame\npygame.display.set_mode((9, 9))\n", "pygame"),
    "by a name in a text": (
        "import importlib\np = importlib.import_module('pygame')\nx = __import__('OpenGL.GL')\n",
        "pygame",
    ),
    "Tk, with GLUT's letters": ("import tkinter\nfrom OpenGL.GLUT import *\nglutInit()\n", ""),
    "Qt, with GLUT's letters": (
        "from PyQt6.QtOpenGLWidgets import QOpenGLWidget\nfrom OpenGL.GLUT import *\nglutInit()\n",
        "qt",
    ),
    "pygame, with a dialogue of Tk": (
        "import tkinter, pygame\npygame.display.set_mode((9, 9), pygame.OPENGL)\n",
        "pygame",
    ),
}


@pytest.mark.parametrize("name", OPENED)
def test_the_toolkit_is_the_one_whose_window_is_opened(tmp_path: Path, name: str) -> None:
    text, toolkit = OPENED[name]
    path = tmp_path / "program.py"
    path.write_text(text)
    assert read_source(path).toolkit == toolkit


def test_a_window_may_be_opened_by_a_file_beside_the_program(tmp_path: Path) -> None:
    path = tmp_path / "program.py"
    path.write_text("import pygame\nimport screen\nfrom OpenGL.GLUT import *\n")
    (tmp_path / "screen.py").write_text("from OpenGL.GLUT import *\nglutCreateWindow(b'a')\n")
    assert read_source(path).toolkit == "glut"


OTHERS = {
    "import pyglet": "opens its window with pyglet; programs can be looked into that open it with "
    "GLFW, GLUT or pygame, or draw in a QOpenGLWidget; it may also call OpenGL by pyglet, past",
    "from PyQt5.QtOpenGL import QGLWidget": "opens its window with Qt; programs can be",
    "import pyopengltk": "opens its window with Tk; programs can be",
    "import wx.glcanvas\nfrom OpenGL.GLUT import *": "opens its window with wxPython; programs",
    "import moderngl_window": "opens its window with moderngl-window; programs",
}


@pytest.mark.parametrize("text", OTHERS)
def test_another_toolkit_is_named_in_one_line(watch: Watcher, tmp_path: Path, text: str) -> None:
    path = tmp_path / "program.py"
    path.write_text(text)
    assert f"program.py: {OTHERS[text]}" in watch(path).error


def test_a_program_of_boundless_size_is_refused_unread(tmp_path: Path) -> None:
    path = tmp_path / "long.py"
    path.write_bytes(b"x = 1\n" * 1_000_000)
    with pytest.raises(InputError, match=r"long.py: too large, expected at most 4 MB"):
        read_source(path)


def test_a_missing_program_is_refused(watch: Watcher, tmp_path: Path) -> None:
    missing = watch(tmp_path / "absent.py").error
    assert missing == f"{tmp_path / 'absent.py'}: cannot be read (No such file or directory)"
    assert watch(tmp_path).error == f"{tmp_path}: cannot be read (Is a directory)"


# On Windows nothing interrupts one wait without an end; there the guard ends the process.
LONGEST = 0.1 if sys.platform == "win32" else None
ENDLESS = {
    "before its window": ("import glfw\nwhile True: pass\n", "opened no window for OpenGL {}"),
    "without swapping": (
        BEGIN + "while True:\n    try:\n        glfw.poll_events()\n    except: pass\n",
        "completed no frame {}",
    ),
    "after a frame": (
        f"{BEGIN}glfw.swap_buffers(window)\nimport threading\n"
        f"while True: threading.Event().wait({LONGEST})\n",
        "completed 1 frame {}; frame 2 was not reached",
    ),
}


@pytest.mark.seldom(13, first=5)
@pytest.mark.parametrize("name", ENDLESS)
def test_a_program_that_never_ends_is_ended(watch: Watcher, tmp_path: Path, name: str) -> None:
    text, error = ENDLESS[name]
    path = tmp_path / "program.py"
    path.write_text(text)
    watch.ended(path, 2, error)


def test_a_thread_left_behind_goes_on_and_holds_nothing_up(watch: Watcher, write: Write) -> None:
    path = write(
        """
        import threading, time
        def spin():
            while True:
                time.sleep(0.001)
        threading.Thread(target=spin).start()
        glfw.swap_buffers(window)
        """
    )
    assert watch(path).err == ""
    again = watch(path)  # by now the first thread would have found its names gone
    assert again.error == again.err == ""


def test_a_program_cannot_swallow_its_end(watch: Watcher, write: Write) -> None:
    path = write(
        """
        while not glfw.window_should_close(window):
            try:
                glfw.swap_buffers(window)
            except BaseException:
                pass
        """
    )
    seen = watch(path, 2)
    assert seen.error == "" and seen.log[-1] == ["ended", 2]


@pytest.mark.seldom(10)
def test_a_program_is_ended_in_any_thread(tmp_path: Path) -> None:
    path = tmp_path / "endless.py"
    path.write_text("import glfw\nwhile True: pass\n")
    code = """
import sys, threading
from framelens.program.program_source import read_source
from framelens.base.errors import InputError
from watching import Watch
from framelens.program.program import run
from framelens.base.errors import InputError
def go():
    try:
        run(sys.argv[1], limit=0.3, observer=Watch())
    except InputError as error:
        print(error)
thread = threading.Thread(target=go)
thread.start()
thread.join()
"""
    done = python(code, str(path), env=environment(PYTHONPATH=PATHS))
    assert done.out.endswith(
        "opened no window for OpenGL within 0.3 s, or needs a longer --limit\n"
    ), done.err


def test_what_glu_tessellates_is_seen(watch: Watcher, write: Write) -> None:
    need_library("GLU")
    path = write(
        """
        from OpenGL.GLU import *
        tess = gluNewTess()
        gluTessCallback(tess, GLU_TESS_BEGIN, glBegin)
        gluTessCallback(tess, GLU_TESS_VERTEX, glVertex3dv)
        gluTessCallback(tess, GLU_TESS_END, glEnd)
        gluTessBeginPolygon(tess, None)
        gluTessBeginContour(tess)
        for corner in ((-1, -1, 0), (1, -1, 0), (0, 1, 0)):
            gluTessVertex(tess, corner, corner)
        gluTessEndContour(tess)
        gluTessEndPolygon(tess)
        glfw.swap_buffers(window)
        """
    )
    seen = watch(path)
    assert seen.names == {"glBegin": 1, "glVertex3dv": 3, "glEnd": 1}
    assert seen.centre == [255, 255, 255]


def test_a_program_with_shaders_is_followed_with_a_notice(watch: Watcher, write: Write) -> None:
    path = write(
        """
        shader = glCreateShader(GL_VERTEX_SHADER)
        glShaderSource(shader, "void main() { gl_Position = ftransform(); }")
        glCompileShader(shader)
        program = glCreateProgram()
        glAttachShader(program, shader)
        glLinkProgram(program)
        glUseProgram(program)
        glfw.swap_buffers(window)
        """
    )
    seen = watch(path)
    assert seen.names["glUseProgram"] == 1
    assert [notice.split(": ", 1)[1] for notice in seen.notices] == [
        "uses shaders; its calls are shown, but this tool explains fixed function"
    ]


@pytest.mark.seldom(10)
def test_a_shaders_text_is_traced(write: Write) -> None:
    path = write(
        """
        for text in ("void main() {}", [b"void main() {}"]):
            glShaderSource(glCreateShader(GL_VERTEX_SHADER), text)
        glfw.swap_buffers(window)
        """
    )
    done = landscape("trace", path)
    assert done.status == 0, done.err
    assert done.out.count("glShaderSource(") == 2
    names = [call["name"] for call in landscape("trace", path, "--json").json()]
    assert names.count("glShaderSource") == 2


def test_a_core_profile_is_followed_with_a_notice(watch: Watcher, write: Write) -> None:
    begin = BEGIN.replace(
        "glfw.init()\n",
        "glfw.init()\nglfw.window_hint(glfw.CONTEXT_VERSION_MAJOR, 3)\n"
        "glfw.window_hint(glfw.CONTEXT_VERSION_MINOR, 3)\n"
        "glfw.window_hint(glfw.OPENGL_PROFILE, glfw.OPENGL_CORE_PROFILE)\n",
    )
    seen = watch(write("glClear(GL_COLOR_BUFFER_BIT)\nglfw.swap_buffers(window)\n", begin))
    if seen.log[0][2] != "osmesa":
        pytest.skip("only OSMesa gives a core profile without a screen")
    assert seen.names["glClear"] == 1
    assert "asks for a core profile" in seen.notices[0]


@pytest.mark.seldom(13, first=4)
@pytest.mark.parametrize("backend", ["osmesa", "egl"])
def test_the_same_program_runs_by_osmesa_and_by_egl(tmp_path: Path, backend: str) -> None:
    need_library({"osmesa": "OSMesa", "egl": "EGL"}[backend])
    watcher = Watcher(tmp_path)
    resize: list[Any] = [{"frame": 1, "resize": [200, 100]}]
    seen = watcher(PROGRAMS / "lantern.py", 2, backend=backend, events=resize)
    watcher.close()
    assert seen.log[0][2] == backend
    assert seen.size == [200, 100]
    assert seen.names["glCallList"] == 2
    assert seen.colours > 1000


@pytest.mark.seldom(3)
@pytest.mark.posix_only("there is always a screen")
def test_without_a_screen_the_backend_glfw_is_refused_in_one_line(tmp_path: Path) -> None:
    watcher = Watcher(tmp_path, XDG_RUNTIME_DIR="/nonexistent")
    seen: Seen = watcher(PROGRAMS / "lantern.py", backend="glfw")
    watcher.close()
    assert seen.error.startswith("there is no screen to open a window on (DISPLAY is not set")


def test_a_window_that_is_closed_or_has_an_impossible_size_is_refused(
    watch: Watcher, write: Write
) -> None:
    closed = watch(write("glfw.destroy_window(window)\nglfw.swap_buffers(window)\n"))
    assert closed.error.endswith("shows a frame of a window that it has closed")
    for size in ("-5, 48", "20000, 20000"):
        seen = watch(write("", BEGIN.replace("64, 48", size)))
        assert "opens a window of " in seen.error and "expected from 1x1 to" in seen.error


FANS = """
def fan(size, *colour):
    glBegin(GL_TRIANGLE_FAN)
    if colour:
        glColor3f(*colour)
    for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
        glVertex2f(size * x, size * y)
    glEnd()
thing = 1
"""
DRAWN = """
glClear(GL_COLOR_BUFFER_BIT)
fan(0.8)
fan(0.4, 1, 0, 0)
"""


@pytest.mark.seldom(3)
def test_a_display_list_that_is_executed_while_it_is_compiled_is_seen_as_a_list_and_a_call(
    watch: Watcher, write: Write
) -> None:
    # Mesa 22 ends such a list with an error: its second part has a colour, and the first has none.
    listed = "glNewList(thing, GL_COMPILE_AND_EXECUTE)" + DRAWN + "glEndList()\n"
    plain = watch(write(FANS + DRAWN + "glfw.swap_buffers(window)\n"), 0)
    seen = watch(write(FANS + listed + "glfw.swap_buffers(window)\n"), 0)
    assert seen.error == "" and seen.picture == plain.picture and seen.colours == 3
    names = [call[0] for call in seen.calls]
    assert names[0] == "glNewList" and names[-2:] == ["glEndList", "glCallList"]
    assert watch(write(FANS + listed * 2 + "glfw.swap_buffers(window)\n"), 0).error == ""
