"""Keys and mouse: what GLFW reports, and the intents and switches made of it."""

import glfw
import pytest

from landscape.window.hands import JUMP, Hands
from landscape.window.walker import Intent

pytestmark = pytest.mark.window

PRESS, RELEASE, REPEAT = glfw.PRESS, glfw.RELEASE, glfw.REPEAT


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


def test_losing_the_focus_releases_keys_and_mouse() -> None:
    hands = Hands()
    hands.capture(True)
    hands.key(glfw.KEY_W, PRESS)
    hands.motion(1.0, 1.0)
    hands.motion(7.0, 1.0)
    hands.focus(False)
    assert (hands.take(), hands.orders) == ((Intent(), ()), ["release"])
