"""The gamepad: what sticks and buttons ask for, with states that no driver has to report."""

import math
from collections.abc import Iterator
from pathlib import Path

import glfw
import pytest

from landscape.walk import pad as pads
from landscape.walk.pad import DEAD, LOOK, RIGHT_TRIGGER, Pad, PadState, pushed, steered
from landscape.walk.walker import Intent

REST = PadState()
A, B, X = (getattr(glfw, f"GAMEPAD_BUTTON_{name}") for name in "ABX")


def states(*each: PadState | None) -> Pad:
    coming: Iterator[PadState | None] = iter(each)
    return Pad(lambda: next(coming))


def with_axes(**axes: float) -> PadState:
    names = ("left_x", "left_y", "right_x", "right_y", "left", "right")
    rest = dict(zip(names, REST.axes, strict=True))
    return PadState(axes=tuple((rest | axes).values()))


def test_a_stick_has_a_dead_zone_and_reaches_one() -> None:
    assert pushed(0.0, DEAD) == pushed(math.nan, 0.0) == (0.0, 0.0)
    assert pushed(0.0, -1.0) == (0.0, -1.0)
    assert math.hypot(*pushed(1.0, 1.0)) == pytest.approx(1.0)
    assert 0.0 < pushed(0.5, 0.0)[0] < 0.25


def test_the_left_stick_walks_and_the_right_one_looks() -> None:
    state = with_axes(left_y=-1.0, right_x=1.0)
    intent = steered(Intent(), state, [], 0.5, 0.1)
    assert intent.forward == 1.0 and intent.right == 0.0
    assert intent.look == pytest.approx((LOOK * 0.5 / 0.1, 0.0))  # pixels of 0.1 degrees
    both = steered(Intent(forward=1.0), state, [], 0.5, 0.0)
    assert both.forward == 1.0 and both.look == (0.0, 0.0)  # the mouse is off


def test_a_button_counts_once_and_a_trigger_is_a_button() -> None:
    down = PadState(frozenset((X,)))
    pad = states(REST, down, down, REST, None, with_axes(right=1.0), with_axes(right=1.0))
    assert [pad.take()[1] for _ in range(5)] == [[], ["strike"], [], [], []]
    state, done, _ = pad.take()
    assert RIGHT_TRIGGER in state.buttons and done == ["dig"]
    digging = steered(Intent(), state, done, 0.1, 0.1, blocks=True)
    assert digging.dig and digging.digging and not digging.run
    state, done, _ = pad.take()
    held = steered(Intent(), state, done, 0.1, 0.1, blocks=True)
    assert held.digging and not held.dig
    assert steered(Intent(), state, done, 0.1, 0.1) == Intent(run=True)


def test_in_a_list_buttons_are_keys_and_nobody_walks() -> None:
    pad = states(PadState(frozenset((A, B)), (1.0,) * 6))
    state, done, keys = pad.take(listing=True)
    assert state == REST and done == [] and keys == [glfw.KEY_ENTER, glfw.KEY_ESCAPE]


def test_a_jump_lasts_while_its_button_is_down() -> None:
    assert steered(Intent(), PadState(frozenset((A,))), [], 0.1, 0.1) == Intent(up=1.0)


def test_mappings_come_from_the_environment_and_the_user_s_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    told: list[str] = []
    monkeypatch.setattr(pads.glfw, "update_gamepad_mappings", told.append, raising=False)
    monkeypatch.setenv("LANDSCAPE_CONFIG", str(tmp_path))
    monkeypatch.delenv("SDL_GAMECONTROLLERCONFIG", raising=False)
    pads.add_mappings()
    assert told == []
    (tmp_path / pads.DATABASE).write_bytes(b"0300,Pad\xe9,a:b0,\0\n")
    monkeypatch.setenv("SDL_GAMECONTROLLERCONFIG", "0301,Other,a:b1,")
    pads.add_mappings()
    assert told == ["0301,Other,a:b1,\n0300,Pad\N{REPLACEMENT CHARACTER},a:b0,\n"]
