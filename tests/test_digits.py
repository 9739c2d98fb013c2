"""The digit keys: what they change, what they say, and the help's rows for them."""

import chessboard_scene
import glfw
import pytest

from landscape import keys
from landscape.scene import SCENES, scene
from landscape.window.bindings import us_name
from landscape.window.digits import help_rows, pressed
from landscape.window.hands import Hands

pytestmark = pytest.mark.window

BOARD = chessboard_scene.SCENE


def test_both_rows_of_digits_are_switches_and_zero_is_none() -> None:
    hands = Hands()
    for key in (glfw.KEY_1, glfw.KEY_KP_9, glfw.KEY_0):
        hands.key(key, glfw.PRESS)
    assert hands.take()[1] == ("1", "9")


def test_a_digit_changes_its_setting_and_says_so_in_both_languages() -> None:
    settings = BOARD.values(None, {"fog.enabled": True})
    left, changes, message = pressed(BOARD, settings, ("help", "1", "5"), "en")
    assert (left, changes, message) == (("help",), {"fog.enabled": False}, "haze: off")
    assert pressed(BOARD, settings, ("1",), "fr")[2] == "haze\u00a0: non"


def test_a_digit_pressed_twice_between_two_frames_changes_nothing_and_choices_go_round() -> None:
    settings = BOARD.values(None)
    assert pressed(BOARD, settings, ("1", "1"), "en")[1]["fog.enabled"] is settings.fog.enabled
    changes = pressed(BOARD, settings, ("2", "2"), "en")[1]
    once = keys.with_settings(settings, {"fog.mode": keys.next_value(settings, "fog.mode")})
    assert changes == {"fog.mode": keys.next_value(once, "fog.mode")}


def test_the_help_lists_the_digits_of_the_scene() -> None:
    rows = help_rows(BOARD, BOARD.settings, "en", us_name)
    assert rows[-2:] == [("1", "haze"), ("2", "formula of the haze")]
    assert rows[0][0] == "W A S D"


@pytest.mark.parametrize("name", SCENES)
def test_each_digit_of_a_scene_stands_for_a_setting_that_can_be_toggled(name: str) -> None:
    kind = scene(name)
    for digit, toggle in kind.digits.items():
        assert digit in "123456789" and len(digit) == 1
        value = toggle.next(kind.settings)
        changed = keys.with_settings(kind.settings, {toggle.setting: value})
        assert changed != kind.settings and keys.get(changed, toggle.setting) == value
