"""Keys and mouse: what GLFW reports, and the intents and switches made of it."""

from types import SimpleNamespace

import glfw
import pytest

from framelens.inspector.keys import inspect_pick, us_name
from framelens.inspector.wheel import Wheel
from landscape.walk import hands as hands_module
from landscape.walk.hands import JUMP, Hands
from landscape.walk.keymap import DEFAULT
from landscape.walk.keys import (
    LETTERS,
    UNDER_THE_HAND,
    Namer,
    layout,
    pick,
)
from landscape.walk.walker import Intent

pytestmark = pytest.mark.window

PRESS = glfw.PRESS
RELEASE = glfw.RELEASE
REPEAT = glfw.REPEAT


def test_keys_make_intents_by_their_positions() -> None:
    hands = Hands()
    for key, intent in (
        (glfw.KEY_W, Intent(forward=1)),
        (glfw.KEY_UP, Intent(forward=1)),
        (glfw.KEY_S, Intent(forward=-1)),
        (glfw.KEY_DOWN, Intent(forward=-1)),
        (glfw.KEY_A, Intent(right=-1)),
        (glfw.KEY_D, Intent(right=1)),
        (glfw.KEY_LEFT, Intent(turn=-1)),
        (glfw.KEY_RIGHT, Intent(turn=1)),
        (glfw.KEY_SPACE, Intent(up=1)),
        (glfw.KEY_PAGE_UP, Intent(up=1)),
        (glfw.KEY_C, Intent(up=-1)),
        (glfw.KEY_PAGE_DOWN, Intent(up=-1)),
        (glfw.KEY_LEFT_SHIFT, Intent(run=True)),
    ):
        hands.key(key, PRESS)
        assert hands.take() == hands.take() == (intent, ())
        hands.key(key, RELEASE)
        assert hands.take() == (Intent(), ())


def keyboard(us: str, printed: str) -> Namer:
    """Return what a keyboard prints where a US one prints ``us``; elsewhere it is alike."""
    changed = dict(zip(us, printed, strict=True))
    return lambda key: changed.get(us_name(key), us_name(key))


AZERTY = keyboard("QWAZM;,6-", "AZQW,M;-)")
COLEMAK = keyboard("ERTYUIOP;SDFGJKLN", "FPGJLUY;ORSTDNEIK")
DVORAK = keyboard("QWERTYUIOPASDFGHJKL;ZXCVBNM,./'-=[]", "',.PYFGCRLAOEUIDHTNS;QJKXBMWVZ-[]/=")
GREEK = keyboard("QWERTYUIOPASDFGHJKLZXCVBNM", ";ΣΕΡΤΥΘΙΟΠΑΣΔΦΓΗΞΚΛΖΧΨΩΒΝΜ")


def test_a_letter_that_stands_for_a_word_is_the_key_it_is_printed_on() -> None:
    hands = Hands(AZERTY)
    hands.key(glfw.KEY_M, PRESS)
    assert hands.take() == (Intent(), ()), "this key prints a comma"
    hands.key(glfw.KEY_SEMICOLON, PRESS)
    assert hands.take() == (Intent(), ("map",))
    assert DEFAULT.labels("map", "fr", AZERTY) == "M"
    assert DEFAULT.labels("walk", "fr", AZERTY) == "Z Q S D"


def test_a_key_under_the_walking_hand_walks_whatever_is_printed_on_it() -> None:
    # Colemak prints R where a US keyboard prints S, and F where it prints E.
    hands = Hands(COLEMAK)
    hands.key(glfw.KEY_S, PRESS)
    hands.key(glfw.KEY_E, PRESS)
    assert hands.take() == (Intent(forward=-1, strike=True), ())
    for letter, action in (("R", "reflection"), ("F", "fly")):
        key = layout(COLEMAK)[letter]
        assert key not in UNDER_THE_HAND and COLEMAK(key) not in LETTERS
        assert DEFAULT.labels(action, "en", COLEMAK) == COLEMAK(key)
    hands.key(layout(COLEMAK)["R"], PRESS)
    assert hands.take()[1] == ("reflection",)


@pytest.mark.parametrize("name", [us_name, AZERTY, COLEMAK, DVORAK, GREEK, lambda key: ""])
def test_every_letter_has_a_key_of_its_own_on_every_keyboard(name: Namer) -> None:
    keys = layout(name)
    assert keys.keys() == LETTERS.keys()
    assert len(set(keys.values())) == len(keys)
    assert UNDER_THE_HAND.isdisjoint(keys.values())
    for key in keys.values():
        assert DEFAULT.labels("help", "en", name) and (name(key) or us_name(key))


def test_letters_that_no_key_prints_stay_where_a_us_keyboard_has_them() -> None:
    assert layout(GREEK) == {letter: ord(letter) for letter in LETTERS}
    assert DEFAULT.labels("map", "en", GREEK) == "Μ"


def test_the_letters_follow_a_layout_that_changes_during_the_walk() -> None:
    printed = [us_name]
    hands = Hands(lambda key: printed[0](key))
    hands.key(glfw.KEY_M, PRESS)
    printed[0] = AZERTY
    hands.key(glfw.KEY_M, PRESS)
    hands.key(glfw.KEY_SEMICOLON, PRESS)
    assert hands.take()[1] == ("map", "map")


def test_shift_and_the_key_of_the_next_fix_choose_the_one_before() -> None:
    hands = Hands()
    hands.key(glfw.KEY_N, PRESS)
    hands.key(glfw.KEY_N, PRESS, glfw.MOD_SHIFT)
    hands.key(glfw.KEY_J, PRESS, glfw.MOD_SHIFT)
    assert hands.take()[1] == ("next_fix", "previous_fix", "go_to_fix")


def test_opposite_keys_cancel() -> None:
    hands = Hands()
    for key in (glfw.KEY_W, glfw.KEY_S, glfw.KEY_A):
        hands.key(key, PRESS)
    assert hands.take()[0] == Intent(forward=0, right=-1)


def test_a_key_tapped_between_two_frames_counts_for_one_frame() -> None:
    hands = Hands()
    hands.key(glfw.KEY_W, PRESS)
    hands.key(glfw.KEY_W, RELEASE)
    assert hands.take()[0] == Intent(forward=1)
    assert hands.take()[0] == Intent()


def test_key_repeats_do_not_trigger_a_switch_again() -> None:
    hands = Hands()
    for action in (PRESS, REPEAT, REPEAT, RELEASE):
        hands.key(glfw.KEY_G, action)
        hands.key(glfw.KEY_E, action)
    assert hands.take() == (Intent(strike=True), ("fog",))
    assert hands.take() == (Intent(), ())


def test_two_presses_of_the_fly_key_in_a_frame_cancel() -> None:
    hands = Hands()
    hands.key(glfw.KEY_F, PRESS)
    assert hands.take()[0].fly
    for _ in range(2):
        hands.key(glfw.KEY_F, PRESS)
    assert not hands.take()[0].fly


def test_the_first_click_captures_and_the_next_strikes() -> None:
    hands = Hands()
    hands.button(glfw.MOUSE_BUTTON_LEFT, PRESS)
    assert (hands.orders, hands.take()) == (["capture"], (Intent(), ()))
    hands.capture(True)
    hands.button(glfw.MOUSE_BUTTON_RIGHT, PRESS)
    assert not hands.take()[0].strike
    hands.button(glfw.MOUSE_BUTTON_LEFT, PRESS)
    assert hands.take()[0].strike


def test_the_captured_mouse_turns_the_view_except_by_its_first_motion_or_jumps() -> None:
    hands = Hands()
    hands.motion(5.0, 5.0)
    assert hands.take()[0].look == (0, 0)
    hands.capture(True)
    hands.motion(900.0, -700.0)
    assert hands.take()[0].look == (0, 0)
    hands.motion(903.0, -702.0)
    hands.motion(904.0, -702.0)
    assert hands.take()[0].look == (4, -2)
    hands.motion(9000.0, -9000.0)
    assert hands.take()[0].look == (JUMP, -JUMP)
    hands.capture(True)
    hands.motion(0.0, 0.0)
    assert hands.take()[0].look == (0, 0)


def test_escape_first_releases_the_mouse_and_then_quits() -> None:
    hands = Hands()
    hands.capture(True)
    hands.key(glfw.KEY_ESCAPE, PRESS)
    hands.capture(False)
    hands.key(glfw.KEY_ESCAPE, PRESS)
    assert hands.orders == ["release", "quit"]


@pytest.mark.parametrize("key", [glfw.KEY_F2, glfw.KEY_B, glfw.KEY_I])
def test_escape_shuts_what_is_only_opened_in_the_next_frame(key: int) -> None:
    hands = Hands()
    hands.key(key, PRESS)
    hands.key(glfw.KEY_ESCAPE, PRESS)
    assert hands.orders == []
    hands.key(glfw.KEY_ESCAPE, PRESS)
    assert hands.orders == ["quit"]


def test_losing_the_focus_releases_keys_and_mouse() -> None:
    hands = Hands()
    hands.capture(True)
    hands.key(glfw.KEY_W, PRESS)
    hands.motion(1.0, 1.0)
    hands.motion(7.0, 1.0)
    hands.focus(False)
    assert (hands.take(), hands.orders) == ((Intent(), ()), ["release"])


def test_while_the_list_is_open_the_arrows_choose_and_letters_still_walk() -> None:
    hands = Hands()
    hands.key(glfw.KEY_L, PRESS)
    for key in (glfw.KEY_UP, glfw.KEY_DOWN, glfw.KEY_SPACE, glfw.KEY_PAGE_UP, glfw.KEY_W):
        hands.key(key, PRESS)
    assert hands.take() == (Intent(forward=1), ())
    assert hands.picks == ["list", "up", "down", "switch", "previous_group"]
    hands.key(glfw.KEY_L, PRESS)
    hands.key(glfw.KEY_RIGHT, PRESS)
    assert hands.take()[0] == Intent(forward=1, turn=1)
    assert hands.picks[-1] == "list"


def test_a_key_held_in_the_list_repeats_only_where_that_makes_sense() -> None:
    hands = Hands()
    hands.key(glfw.KEY_L, PRESS)
    for key in (glfw.KEY_KP_ADD, glfw.KEY_ENTER):
        for action in (PRESS, REPEAT, REPEAT, RELEASE):
            hands.key(key, action)
    assert hands.picks == ["list", "more", "more", "more", "switch"]


def test_an_arrow_held_when_the_list_opens_and_released_in_it_no_longer_walks() -> None:
    hands = Hands()
    hands.key(glfw.KEY_UP, PRESS)
    hands.key(glfw.KEY_L, PRESS)
    hands.take()
    hands.key(glfw.KEY_UP, RELEASE)
    assert hands.take()[0] == Intent()


def test_escape_closes_the_list_first() -> None:
    hands = Hands()
    hands.key(glfw.KEY_L, PRESS)
    hands.key(glfw.KEY_ESCAPE, PRESS)
    assert (hands.picks, hands.orders) == (["list", "list"], [])
    hands.key(glfw.KEY_ESCAPE, PRESS)
    assert hands.orders == ["quit"]


GERMAN = keyboard("-=]/ZY", "ß´+-YZ")


@pytest.mark.parametrize(
    ("name", "signs"),
    [
        (us_name, {"=": "more", "-": "less"}),
        (AZERTY, {"=": "more", "6": "less"}),
        (GERMAN, {"]": "more", "/": "less"}),
        (lambda key: "", {"=": "more", "-": "less"}),
    ],
)
def test_plus_and_minus_are_where_they_are_printed(name: Namer, signs: dict[str, str]) -> None:
    found = {chr(key): pick(key, name) for key in range(33, 97) if pick(key, name)}
    assert found == signs
    assert pick(glfw.KEY_KP_ADD, name) == "more" and pick(glfw.KEY_KP_SUBTRACT, name) == "less"


def test_shift_that_types_the_plus_sign_makes_no_step_finer() -> None:
    key = glfw.KEY_EQUAL  # on a US keyboard and a French one
    assert inspect_pick(key, glfw.MOD_SHIFT, us_name) == inspect_pick(key, 0, us_name) == "more"
    assert inspect_pick(key, glfw.MOD_CONTROL, us_name) == "more_fine"
    assert inspect_pick(glfw.KEY_MINUS, glfw.MOD_CONTROL, us_name) == "less_fine"


def test_ten_tenths_of_a_notch_are_one_step_and_the_other_way_begins_anew() -> None:
    wheel = Wheel()
    steps = [wheel.steps(0.1) for _ in range(20)]
    assert steps == [*[0] * 9, 1] * 2, "ten reports of a trackpad are a notch"
    assert [wheel.steps(0.9), wheel.steps(-0.9), wheel.steps(-0.2)] == [0, 0, -1]
    assert [wheel.steps(1.0), wheel.steps(-2.0), wheel.steps(0.0)] == [1, -2, 0]


def test_a_trackpad_goes_on_by_a_kind_of_block_for_each_whole_notch() -> None:
    hands = Hands()
    hands.enter(True, "")
    for _ in range(12):
        hands.wheel(-0.1)
    assert hands.take()[1] == ("next_slot",)
    hands.wheel(2.0)
    assert hands.take()[1] == ("previous_slot", "previous_slot")


def test_turns_of_the_wheel_within_a_frame_reach_the_inspector_as_one() -> None:
    hands = Hands()
    hands.inspecting = True
    hands.motion(30.0, 40.0)
    hands.wheel(0.25)
    hands.wheel(0.5)
    assert hands.requests.asked[1:] == [("wheel", 30.0, 40.0, 0.75)]


@pytest.mark.parametrize(
    ("system", "scale", "pixels", "expected"),
    [("Windows at 150 %", 1.5, 200, 1.5), ("Retina", 2.0, 400, 1.0), ("usual", 1.0, 200, 1.0)],
)
def test_the_mouse_is_as_fast_on_a_fine_display_whatever_its_coordinates_are(
    system: str, scale: float, pixels: int, expected: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    window = SimpleNamespace(
        get_framebuffer_size=lambda _: (pixels, pixels),
        get_window_size=lambda _: (200, 200),
        get_window_content_scale=lambda _: (scale, scale),
    )
    monkeypatch.setattr(hands_module, "glfw", window)
    assert hands_module.fineness(None) == expected, system


def test_a_motion_turns_the_view_by_what_it_is_on_a_display_of_usual_resolution() -> None:
    turned = []
    for fine in (1.0, 1.5):
        hands = Hands()
        hands.fineness = fine
        hands.capture(True)
        hands.motion(0.0, 0.0)
        hands.motion(30.0 * fine, -12.0 * fine)
        turned.append(hands.take()[0].look)
    assert turned[0] == turned[1] != (0.0, 0.0)
