"""The light that the mouse carries in the hall, and the texture whose contrast changes."""

import math

import numpy as np
import pytest
from hall_pictures import HallPictures
from stage import Stage

from framelens.gl.glfw_library import glfw
from landscape.hall import plan
from landscape.hall.digits import AWAY, HIGH, LOW, TURN, carried
from landscape.hall.settings import Settings
from landscape.settings.declare import get, with_settings
from landscape.walk.hands import Hands


def test_a_drag_carries_the_light_around_the_statue_and_up_and_down() -> None:
    settings = with_settings(Settings(), carried(Settings(), 0.0, -1e4))
    x, y, z = settings.shadow.flame
    assert y == HIGH and carried(settings, 0.0, 1e4)["shadow.flame"][1] == LOW  # type: ignore[index]
    assert math.dist((x, z), plan.STATUE) == pytest.approx(AWAY)
    around = carried(settings, 36000.0 / TURN, 0.0)["shadow.flame"]
    assert around == pytest.approx(settings.shadow.flame)
    assert get(settings, "shadow.casters") == "all"


def test_only_a_drag_with_the_right_button_carries_and_it_turns_no_view() -> None:
    hands = Hands()
    hands.capture(True)
    for x in (10.0, 14.0):
        hands.motion(x, 5.0)
    assert hands.carried() == (0.0, 0.0) and hands.take()[0].look == (4.0, 0.0)
    hands.button(glfw.MOUSE_BUTTON_RIGHT, glfw.PRESS)
    for x in (20.0, 27.0):
        hands.motion(x, 8.0)
    assert hands.carried() == (7.0, 0.0) and hands.carried() == (0.0, 0.0)
    assert hands.take()[0].look == (0.0, 0.0)
    hands.button(glfw.MOUSE_BUTTON_RIGHT, glfw.RELEASE)
    hands.motion(40.0, 8.0)
    assert hands.carried() == (0.0, 0.0)


@pytest.mark.seldom(14, first=8)
def test_one_texture_changes_and_comes_back_exactly(
    stage: Stage, hall_pictures: HallPictures
) -> None:
    def drawn(**tone: object) -> np.ndarray:
        settings = {f"tone.{name}": value for name, value in tone.items()}
        return hall_pictures("hall_texture", only=("room", "floor"), settings=settings)

    plain = drawn()
    wall = drawn(texture="wall", texture_contrast=0.0, texture_brightness=0.0) != plain
    assert 0.1 < wall.any(axis=2).mean() < 0.7
    floor = drawn(texture="floor", texture_contrast=2.0) != plain
    assert floor.any() and not (floor & wall).any(axis=2).mean() > 0.02
    np.testing.assert_array_equal(drawn(), plain)
