"""The keys that a scene uses as it likes: what they change and say, and the help's rows."""

from dataclasses import replace

import chessboard_scene
import glfw
import pytest

from framelens.inspector.keys import us_name
from landscape.scene.scene import SCENES, scene
from landscape.settings import declare
from landscape.settings.declare import Toggle
from landscape.walk.digits import help_rows, pressed
from landscape.walk.hands import Hands
from landscape.walk.keymap import DEFAULT
from landscape.walk.keys import BINDINGS, Namer, letters_in

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
    once = declare.with_settings(settings, {"fog.mode": declare.next_value(settings, "fog.mode")})
    assert changes == {"fog.mode": declare.next_value(once, "fog.mode")}


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
        changed = declare.with_settings(kind.settings, {toggle.setting: value})
        assert changed != kind.settings and declare.get(changed, toggle.setting) == value


CLAIMING = replace(
    BOARD,
    letters={"L": Toggle("fog.enabled", "haze"), "K": Toggle("fog.mode", "formula of the haze")},
)
BELOW_W_IS_O = {glfw.KEY_S: "O", glfw.KEY_O: "R", glfw.KEY_V: "K", glfw.KEY_P: "L"}  # as in Dvorak


def dvorak_like(key: int) -> str:
    return BELOW_W_IS_O.get(key, us_name(key))


def test_letters_that_a_scene_has_for_itself_are_switches_and_another_opens_the_list() -> None:
    hands = Hands()
    hands.enter(False, CLAIMING.letters)
    for key in (glfw.KEY_L, glfw.KEY_K, glfw.KEY_G):
        hands.key(key, glfw.PRESS)
    assert hands.take()[1] == ("L", "K", "fog") and not hands.listing
    hands.key(glfw.KEY_O, glfw.PRESS)
    assert hands.listing and hands.picks == ["list"]
    hands.key(glfw.KEY_O, glfw.PRESS)
    assert not hands.listing


def test_a_scene_that_has_no_letters_leaves_the_list_where_it_was() -> None:
    hands = Hands()
    hands.enter(False, CLAIMING.letters)
    hands.enter(False, BOARD.letters)
    for key in (glfw.KEY_K, glfw.KEY_O):
        hands.key(key, glfw.PRESS)
    assert hands.take()[1] == () and not hands.listing
    hands.key(glfw.KEY_L, glfw.PRESS)
    assert hands.listing


def test_a_letter_of_a_scene_changes_its_setting_and_one_of_another_scene_nothing() -> None:
    settings = CLAIMING.values(None, {"fog.enabled": True})
    left, changes, message = pressed(CLAIMING, settings, ("L", "help"), "en")
    assert (left, changes, message) == (("help",), {"fog.enabled": False}, "haze: off")
    assert pressed(BOARD, settings, ("L", "help"), "en") == (("help",), {}, "")


@pytest.mark.parametrize("name", [us_name, dvorak_like])
def test_the_help_shows_each_letter_of_a_scene_and_the_lists_other_key(name: Namer) -> None:
    rows = dict((text, key) for key, text in help_rows(CLAIMING, BOARD.settings, "en", name)[:-2])
    usual = dict((text, key) for key, text in help_rows(BOARD, BOARD.settings, "en", name)[:-2])
    assert rows.keys() - usual.keys() == {"haze", "formula of the haze"}
    assert (rows["haze"], rows["formula of the haze"]) == ("L", "K")
    moved = {text for text in usual if rows[text] != usual[text]}
    assert moved == {"list of settings, to change them"}
    assert len(set(rows.values())) == len(rows)
    if name is us_name:
        assert rows["list of settings, to change them"] == "O"


@pytest.mark.parametrize("name", SCENES)
def test_letters_of_a_scene_leave_each_action_a_key_and_can_be_toggled(name: str) -> None:
    kind = scene(name)
    letters = letters_in(kind.letters)
    actions = {binding.action for binding in BINDINGS if binding.letter}
    assert set(letters.values()) == actions | kind.letters.keys()
    for letter, toggle in kind.letters.items():
        assert DEFAULT.letter_label(letter, "en", us_name, kind.letters) == letter
        value = toggle.next(kind.settings)
        assert declare.with_settings(kind.settings, {toggle.setting: value}) != kind.settings
