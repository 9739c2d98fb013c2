"""The fly-over's window: the picture on a quad, the flight along the path, free flight, keys."""

import argparse
import math
import re
from collections.abc import Iterator

import numpy as np
import pytest
from commands import need_library

from framelens.gl.framebuffer import read_pixels
from framelens.gl.glfw_library import glfw
from framelens.inspector.keys import us_name
from landscape.flyover import frame
from landscape.flyover.app.window import FILLED, LINES, Flying, show
from landscape.flyover.camera import Camera
from landscape.flyover.environment import open_environment
from landscape.flyover.settings import PRESETS, Settings
from landscape.settings.declare import get, next_value, with_settings
from landscape.walk import words
from landscape.walk.free_flight import LEAST, STEEPEST, advance, moves
from landscape.walk.keymap import Keymap
from landscape.walk.opening import EMPTY
from landscape.walk.preferences import Preferences
from landscape.walk.walker import Intent

SIZE = (96, 72)


@pytest.fixture(scope="module")
def flying() -> Iterator[Flying]:
    """A window on GLFW's null platform, at the beginning of the flight over the island."""
    need_library("OSMesa")
    settings = with_settings(Settings(), PRESETS["best"])
    window = Flying(open_environment("island"), settings, SIZE, "en", headless=True)
    yield window
    window.close()


def press(window: Flying, key: int, mods: int = 0) -> None:
    window.key(key, glfw.PRESS, mods)
    window.key(key, glfw.RELEASE)


def test_the_window_shows_the_picture_pixel_for_pixel(flying: Flying) -> None:
    flying.advance(Intent(), (), 0.5)
    flying._until = flying._counted = ""  # type: ignore[assignment]
    assert flying.context is not None
    size = flying.context.pixels()
    drawn = frame.draw(flying.terrain, flying.camera, flying.settings, size)
    flying.context.make_current()
    flying._picture.draw(drawn.rgba)
    assert np.array_equal(read_pixels(size), drawn.picture) and drawn.picture.std() > 5


def test_the_flight_follows_the_path_pauses_and_goes_by_steps(flying: Flying) -> None:
    flying.free = False
    flying.paused = False
    flying.time = 0.0
    flying.advance(Intent(), (), 2.0)
    assert flying.camera == flying.flight.camera(2.0)
    flying.advance(Intent(), ("time",), 2.0)
    assert flying.paused and flying.camera == flying.flight.camera(2.0)
    flying.advance(Intent(), ("next_fix",), 2.0)
    assert flying.camera == flying.flight.camera(2.0 + 1 / 30)
    flying.advance(Intent(), ("previous_fix", "time"), 0.0)
    assert not flying.paused and flying.time == pytest.approx(2.0)


def test_plus_and_minus_change_how_fast_it_goes(flying: Flying) -> None:
    flying.free = False
    flying.paused = False
    flying.time = 0.0
    flying.speed = 1.0
    press(flying, glfw.KEY_KP_ADD)
    press(flying, glfw.KEY_KP_ADD)
    flying.advance(Intent(), (), 1.0)
    assert flying.time == pytest.approx(2.0)
    for _ in range(30):
        press(flying, glfw.KEY_MINUS)
    assert flying.speed == 1 / 16


def test_keys_of_flight_leave_the_path_and_f_returns_to_it(flying: Flying) -> None:
    flying.free = False
    flying.paused = False
    flying.time = 1.0
    flying.advance(Intent(), (), 0.0)
    on_path = flying.camera
    flying.advance(Intent(forward=1.0), (), 0.1)
    assert flying.free and flying.camera != on_path and flying.time == 1.0
    flying.advance(Intent(fly=True), (), 0.0)
    assert not flying.free and flying.camera == on_path


def test_each_digit_switches_a_technique_and_says_so(flying: Flying) -> None:
    start = flying.settings
    try:
        for mode, digits in (("lines", LINES), ("filled", FILLED)):
            for digit, key in digits.items():
                flying.settings = with_settings(start, {"flyover.mode": mode})
                wanted = next_value(flying.settings, key)
                press(flying, glfw.KEY_0 + int(digit))
                assert flying.listen()
                assert get(flying.settings, key) == wanted != get(start, key) or key.endswith(
                    "mode"
                )
                assert words.text("en", f"flyover.{key}") in flying._message
    finally:
        flying.settings = start


def test_the_help_lists_every_key_in_both_languages(flying: Flying) -> None:
    for mode, digits in (("lines", LINES), ("filled", FILLED)):
        flying.settings = with_settings(flying.settings, {"flyover.mode": mode})
        for language in ("en", "fr"):
            flying._language = language
            rows = dict(flying.rows(us_name))
            assert rows.keys() >= {"W A S D", "P", "N", "F", "+ -", *digits}
            assert all(rows.values())
    flying._language = "en"
    flying.settings = with_settings(flying.settings, {"flyover.mode": "lines"})


def test_escape_ends_the_flight(flying: Flying) -> None:
    press(flying, glfw.KEY_ESCAPE)
    assert not flying.listen() and flying.listen()


def test_escape_shuts_the_list_of_keys_before_it_ends_the_flight(flying: Flying) -> None:
    for keys in [glfw.KEY_H], [glfw.KEY_ESCAPE], [glfw.KEY_H, glfw.KEY_ESCAPE]:
        for key in keys:
            press(flying, key)
        assert flying.listen()
        assert flying._help == (keys == [glfw.KEY_H])
    press(flying, glfw.KEY_ESCAPE)
    assert not flying.listen()


def test_the_window_says_that_it_loads_until_there_is_a_picture() -> None:
    need_library("OSMesa")
    window = Flying(open_environment("island"), Settings(), SIZE, "en", headless=True)
    try:
        assert window.context is not None
        window.context.make_current()
        loading = read_pixels(window.context.pixels())
        assert (loading[0, 0] == EMPTY).all(), "it is not black"
        assert loading.max() > 200, "with letters on it"
        window._until = 0.0  # as after a first picture that took long
        window.draw()
        assert window._message == "H: keys" and window._until > glfw.get_time()
    finally:
        window.close()


def test_free_flight_goes_where_the_camera_looks_and_never_into_the_ground(flying: Flying) -> None:
    camera = Camera(100.0, 100.0, 500.0, 0.3, math.radians(30), math.radians(90))
    moved = advance(camera, Intent(forward=1.0), flying.terrain, 10.0, 1.0)
    assert (moved.x, moved.theta_x) == (pytest.approx(100.0), 0.0)
    assert moved.y == pytest.approx(100 + 10 * math.cos(math.radians(30)))
    assert moved.z == pytest.approx(500 - 10 * math.sin(math.radians(30)))
    right = advance(camera, Intent(right=1.0), flying.terrain, 10.0, 1.0)
    assert right.x == pytest.approx(90.0)  # it looks along +y, whose right hand is -x
    steep = advance(camera, Intent(look=(0.0, 1e6)), flying.terrain, 10.0, 1.0)
    assert steep.theta_y == STEEPEST
    down = advance(steep, Intent(forward=1.0), flying.terrain, 1e4, 10.0)
    assert down.z == pytest.approx(float(flying.terrain.height(down.x, down.y)) + LEAST)
    assert moves(Intent(turn=-1.0)) and moves(Intent(look=(0.0, 1.0))) and not moves(Intent())


def test_it_ends_after_the_frames_that_are_asked_for(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    drawn = []

    class Window:
        def __init__(self, *given: object, preferences: Preferences) -> None:
            self.given, self.time = given, 0.0

        def listen(self) -> bool:
            return True

        def draw(self) -> bool:
            drawn.append((*self.given, self.time))
            return len(drawn) % 2 == 0  # every other time it has no area

        def fill_screen(self) -> None:
            drawn.append("filled")

        def close(self) -> None:
            drawn.append("closed")

    monkeypatch.setattr("landscape.flyover.app.window.Flying", Window)
    options = argparse.Namespace(
        lang="fr", size=None, frames=2, at=2.5, jobs=3, fullscreen=False, quiet=False
    )
    assert show(open_environment("island"), Settings(), options) == 0
    assert len(drawn) == 5 and drawn[-1] == "closed" and drawn[0][3] == "fr"
    assert drawn[0][-2:] == (options.jobs, options.at)
    assert re.match(r"2 images en [\d.]+ s.*images/s en moyenne\n", capsys.readouterr().out)
    drawn.clear()
    options.fullscreen, options.quiet = True, True
    assert show(open_environment("island"), Settings(), options) == 0
    assert drawn[0] == "filled" and capsys.readouterr().out == ""


def test_it_heeds_the_preferences_and_has_no_list_of_settings() -> None:
    need_library("OSMesa")
    keys = Keymap({"forward": (glfw.KEY_I,), "help": (glfw.KEY_F3,)})
    wishes = Preferences(mouse_speed=2.0, invert=True, text_size=2.0, keys=keys)
    window = Flying(
        open_environment("island"), Settings(), SIZE, "en", headless=True, preferences=wishes
    )
    try:
        assert (window.hands.speed, window.hands.inverted) == (2.0, True)
        assert window._message.startswith("F3")
        assert ("I A S D", window._word("flyover.move")) in window.rows(us_name)
        press(window, glfw.KEY_L)
        window.listen()
        for key, forward in ((glfw.KEY_W, 0.0), (glfw.KEY_I, 1.0)):
            window.key(key, glfw.PRESS)
            assert window.hands.take()[0].forward == forward
            window.key(key, glfw.RELEASE)
        press(window, glfw.KEY_LEFT)
        assert window.hands.take()[0].turn == -1.0
        window.draw()
        assert window._panel.dpi > window._dpi
    finally:
        window.close()


@pytest.mark.seldom(3, first=1)
def test_in_a_window_too_wide_for_it_the_detail_is_not_taken_away() -> None:
    need_library("OSMesa")
    settings = with_settings(Settings(), {"flyover.mode": "lines"})
    window = Flying(open_environment("island"), settings, SIZE, "en", headless=True)
    try:
        window.advance(Intent(), ("5",), 0.1)
        assert window.draw() and not window.settings.flyover.detail
        window.context.resize((760, 40))  # type: ignore[union-attr]
        assert window.draw() and window.settings.flyover.detail
        assert "flyover.far_undetailed: expected at most" in window._message
    finally:
        window.close()


def test_escape_right_after_the_key_of_the_list_ends_the_flight(flying: Flying) -> None:
    assert flying.listen()
    press(flying, glfw.KEY_L)
    press(flying, glfw.KEY_ESCAPE)
    assert not flying.listen()
