"""Programs with a pygame window, run to a frame, without a screen where SDL can draw by EGL."""

import importlib.util
import textwrap
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from commands import need_library
from watching import PROGRAMS, Watcher, screen

Write = Callable[[str], Path]

pytestmark = pytest.mark.skipif(
    importlib.util.find_spec("pygame") is None,
    reason="pygame is not installed: pip install 'landscape-gl[test]'",
)

BEGIN = """
import pygame
from pygame.locals import *
from OpenGL.GL import *
pygame.init()
pygame.display.set_mode((64, 48), OPENGL | DOUBLEBUF)
"""


@pytest.fixture(scope="module")
def watch(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Watcher]:
    """Runs programs without a screen, one after the other in one process."""
    need_library("EGL")
    watcher = Watcher(tmp_path_factory.mktemp("users"))
    seen = watcher(PROGRAMS / "waves.py")
    if "opens no window for OpenGL here" in seen.error:
        pytest.skip(f"this SDL cannot draw without a screen: {seen.error}")
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


@pytest.mark.seldom(10, first=7)
def test_the_waves_move_with_the_held_clock_and_repeat(watch: Watcher) -> None:
    first, again, still = (watch(PROGRAMS / "waves.py", frame) for frame in (5, 5, 0))
    assert first.picture == again.picture != still.picture
    assert first.log[0] == ["opened", "pygame", "egl", 400, 300]
    assert first.log[1] == ["default state", True]
    assert first.names["glDrawElements"] == first.names["glVertexPointer"] == 1
    assert first.colours > 300


@pytest.mark.seldom(10, first=7)
def test_arrow_keys_turn_the_pond(watch: Watcher) -> None:
    held = watch(PROGRAMS / "waves.py", 4, events=[{"frame": 2, "key": "RIGHT"}])
    turns = [float(call[1]) for call in held.calls if call[0] == "glRotatef"]
    assert turns == [9.0]  # frames 2, 3 and 4, three degrees each
    quitting = watch(PROGRAMS / "waves.py", 9, events=[{"frame": 2, "key": "ESCAPE"}])
    assert "ended after 3 frames; frame 9 was asked" in quitting.error


def test_pygames_clocks_are_held(watch: Watcher, write: Write) -> None:
    path = write(
        """
        clock = pygame.time.Clock()
        pygame.time.set_timer(USEREVENT, 30)
        while True:
            events = [event.type == USEREVENT for event in pygame.event.get()]
            print(pygame.time.get_ticks(), clock.tick(20), events)
            pygame.time.wait(5)
            pygame.display.flip()
        """
    )
    assert watch(path, 2).err.splitlines() == ["0 50 []", "55 50 [True]", "105 50 [True, True]"]


def test_events_are_got_and_asked_for(watch: Watcher, write: Write) -> None:
    path = write(
        """
        frame = 0
        while frame < 4:
            for event in pygame.event.get((KEYDOWN, KEYUP, MOUSEMOTION, MOUSEBUTTONDOWN)):
                print(frame, pygame.event.event_name(event.type), event.dict)
            for event in pygame.event.get():
                print(frame, pygame.event.event_name(event.type))
            print(pygame.key.get_pressed()[K_UP], pygame.mouse.get_pos(),
                  pygame.mouse.get_pressed()[0], pygame.mouse.get_rel(), pygame.key.get_mods())
            pygame.display.flip()
            frame += 1
        pygame.event.post(pygame.event.Event(USEREVENT))
        print(pygame.event.peek(USEREVENT), pygame.event.wait().type == USEREVENT)
        print(pygame.event.wait().type == VIDEOEXPOSE, pygame.event.poll().type == NOEVENT)
        """
    )

    events = [
        {"frame": 1, "key": "UP", "mods": ["shift"]},
        {"frame": 2, "key": "UP", "action": "release"},
        {"frame": 2, "move": [3, 4]},
        {"frame": 2, "button": "left"},
        {"frame": 3, "resize": [80, 40]},
        {"frame": 3, "close": True},
    ]

    lines = watch(path, 9, events=events).err.splitlines()
    assert lines[0] == "False (0, 0) False (0, 0) 0"
    assert lines[1].startswith("1 KeyDown {'key': 1073741906, 'mod': 1, 'unicode': ''")
    assert lines[2] == "True (0, 0) False (0, 0) 1"
    assert lines[3].startswith("2 KeyUp {'key': 1073741906, 'mod': 0")
    assert lines[4].startswith("2 MouseMotion {'pos': (3, 4), 'rel': (3, 4), 'buttons': (0, 0, 0)")
    assert lines[5].startswith("2 MouseButtonDown {'pos': (3, 4), 'button': 1")
    assert lines[6] == "False (3, 4) True (3, 4) 0"
    assert lines[7:10] == ["3 VideoResize", "3 Quit", "False (3, 4) True (0, 0) 0"]
    assert lines[10:] == ["True True", "True True"]
    assert watch(path, 3, events=events).size == [80, 40]


def test_the_depth_buffer_is_as_deep_as_on_a_screen(watch: Watcher, write: Write) -> None:
    """Without a screen SDL would take the shallowest that holds the 16 bits of its default."""
    shown = "print(glGetIntegerv(GL_DEPTH_BITS))\npygame.display.flip()"
    assert watch(write(shown)).err.split() == ["24"]
    asked = "pygame.display.gl_set_attribute(GL_DEPTH_SIZE, 16)\n"
    begin = BEGIN.replace("pygame.display.set_mode", asked + "pygame.display.set_mode")
    assert watch(write(shown, begin)).err.split() == ["24"]


def test_a_window_may_be_opened_without_pygame_init(watch: Watcher, write: Write) -> None:
    begin = BEGIN.replace("pygame.init()\n", "")
    assert watch(write("pygame.display.flip()", begin)).log[-1] == ["ended", 0]


FAILURES = {
    "no OpenGL": ("pygame.display.set_mode((64, 48))\n", "without the flag pygame.OPENGL"),
    "raises": ("glEnable(1)\n", "line 7: the program raised GLError"),
}


@pytest.mark.parametrize("name", FAILURES)
def test_a_program_that_fails_ends_in_one_line(watch: Watcher, write: Write, name: str) -> None:
    rest, words = FAILURES[name]
    assert words in watch(write(rest), 3).error


def test_the_stand_in_for_pygames_functions_is_not_in_the_traceback(
    watch: Watcher, write: Write
) -> None:
    seen = watch(
        write("pygame.display.set_mode('wide', OPENGL)\n", BEGIN.replace("(64, 48)", "(9, 9)"))
    )
    assert "line 7: the program raised" in seen.error
    files = [line.split('"')[1] for line in seen.details.splitlines() if "File" in line]
    assert {Path(file).name for file in files} == {"program.py"}


@pytest.mark.seldom(3, first=2)
def test_a_program_that_never_flips_is_ended(watch: Watcher, write: Write) -> None:
    path = write("while True:\n    pygame.event.get()\n")
    watch.ended(path, 3, "completed no frame {}")


def test_osmesa_is_refused_in_one_line(watch: Watcher) -> None:
    error = watch(PROGRAMS / "waves.py", backend="osmesa").error
    assert error.endswith("waves.py: pygame draws by EGL or on a screen, not by OSMesa")


@pytest.mark.seldom(14, first=1)
@pytest.mark.window
def test_the_same_program_runs_on_a_screen(tmp_path: Path) -> None:
    with screen() as name:
        watcher = Watcher(tmp_path, DISPLAY=name)
        seen = watcher(PROGRAMS / "waves.py", 1, backend="glfw")
        watcher.close()
    assert seen.log[0][1:3] == ["pygame", "glfw"]
    assert seen.names["glDrawElements"] == 1 and seen.colours > 300
