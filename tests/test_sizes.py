"""The window's sizes: enlarged where the display is fine, and followed in a replay."""

import os
import shutil
import subprocess
from collections.abc import Iterator

import pytest
from commands import end, environment, python

from framelens.gl.glfw_library import glfw
from landscape.walk import sizes
from landscape.walk.recording import Tick
from landscape.walk.sizes import PATIENCE, Resizer
from landscape.walk.walker import Intent

pytestmark = pytest.mark.window

TICK = Tick(0.1, Intent(), (), (320, 240))


class Window:
    """A window that takes what it is told, or nothing; in its place stands GLFW."""

    def __init__(self, scale: float = 1.0, full: bool = False) -> None:
        self.size = (100, 100)
        self.scale = scale
        self.full = full
        self.now = 0.0
        self.asked: list[tuple[int, int]] = []

    def get_window_monitor(self, _: object) -> bool:
        return self.full

    def get_time(self) -> float:
        return self.now

    def get_window_size(self, _: object) -> tuple[int, int]:
        return self.size

    def set_window_size(self, _: object, width: int, height: int) -> None:
        self.asked.append((width, height))

    @property
    def pixels(self) -> tuple[int, int]:
        return round(self.size[0] * self.scale), round(self.size[1] * self.scale)


def followed(window: Window, monkeypatch: pytest.MonkeyPatch, seconds: float) -> Resizer:
    """Follow TICK for some seconds; return the resizer."""
    monkeypatch.setattr(sizes, "glfw", window)
    resizer = Resizer()
    while window.now <= seconds:
        tick = resizer.follow(window, TICK, window.pixels)
        window.now += 0.1
    assert tick.size == (window.pixels if resizer.refused or window.full else TICK.size)
    return resizer


def test_a_window_is_asked_once_for_the_size_in_its_own_coordinates(monkeypatch) -> None:
    window = Window(scale=2.0)
    assert followed(window, monkeypatch, 0.5).refused is None
    assert window.asked == [(160, 120)]


def test_a_window_that_does_not_take_the_size_is_drawn_at_its_own_and_told(monkeypatch) -> None:
    window = Window()
    assert followed(window, monkeypatch, PATIENCE + 0.3).refused == ((320, 240), (100, 100))
    assert window.asked == [(320, 240)]


def test_a_full_screen_window_keeps_its_size_without_a_word(monkeypatch) -> None:
    window = Window(full=True)
    assert followed(window, monkeypatch, 2 * PATIENCE).refused is None
    assert window.asked == []


@pytest.fixture(scope="module")
def fine_screen() -> Iterator[dict[str, str]]:
    """An environment with a screen of 1600x1000 pixels and 192 dots per inch."""
    for tool in ("Xvfb", "xprop"):
        if shutil.which(tool) is None:
            pytest.skip(f"{tool} is not installed")
    read, write = os.pipe()
    command = ["Xvfb", "-displayfd", str(write), "-screen", "0", "1600x1000x24", "-noreset"]
    server = subprocess.Popen(
        [*command, "-nolisten", "tcp"], pass_fds=[write], stderr=subprocess.DEVNULL
    )
    os.close(write)
    try:
        with os.fdopen(read) as pipe:
            screen = environment(DISPLAY=f":{pipe.readline().strip()}")
        words = ["xprop", "-root", "-f", "RESOURCE_MANAGER", "8s", "-set", "RESOURCE_MANAGER"]
        subprocess.run([*words, "Xft.dpi:\t192"], env=screen, check=True)
        yield screen
    finally:
        end(server)


@pytest.mark.seldom(3)
def test_a_window_is_larger_on_a_fine_screen_unless_its_size_is_asked_for(fine_screen) -> None:
    code = """
import sys
from framelens.gl.contexts.glfw import GLFWContext
for size, enlarged in (((300, 200), True), ((300, 200), False), ((1000, 500), True)):
    context = GLFWContext(size, enlarged=enlarged)
    print(context.size, context.glfw.get_window_size(context.window))
    context.release()
"""
    done = python(code, env=fine_screen)
    assert done.status == 0, done.err
    assert done.out.splitlines() == [
        "(600, 400) (600, 400)",
        "(300, 200) (300, 200)",
        "(1600, 800) (1600, 800)",  # no larger than the screen
    ]


def test_glfw_has_the_functions_that_these_tests_replace() -> None:
    names = ("get_window_monitor", "get_time", "get_window_size", "set_window_size")
    assert all(hasattr(glfw, name) for name in names)
