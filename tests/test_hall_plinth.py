"""The plinth's own light: under the ball, and without the sun."""

import numpy as np
import pytest

from landscape.elements.sun import direction
from landscape.files.assets import shipped
from landscape.files.images import read_image
from landscape.hall.architecture import hall
from landscape.hall.light import FILE, light_map, placed
from landscape.hall.plinth_light import (
    Ball,
    ambient,
    ball_on_plinth,
    plinth_light,
    sunlight,
    without_sun,
)
from landscape.hall.settings import Settings

SUN = direction(Settings().sun).astype(float)
UP = np.array([0.0, 1.0, 0.0])
BALL = Ball((0.0, 1.0, 0.0), 1.0)  # it stands on the plane y = 0


@pytest.fixture(scope="module")
def baked() -> np.ndarray:
    return light_map(read_image(shipped() / FILE, "RGB"), "hall")


def test_a_ball_takes_the_soft_light_by_the_cube_of_the_distance_of_its_centre() -> None:
    away = np.array([0.0, 0.5, 1.0, 3.0, 30.0])
    places = np.stack([away, 0 * away, 0 * away], axis=-1)
    expected = 1.0 - (1.0 + away**2) ** -1.5
    np.testing.assert_allclose(ambient(places, UP, BALL), expected, atol=1e-12)
    np.testing.assert_array_equal(ambient(places, -UP, BALL), 1.0)


def test_a_ball_hides_the_sun_from_what_lies_behind_it_alone() -> None:
    sun = np.array([0.6, 0.8, 0.0])
    centre = np.array(BALL.centre)
    behind = centre - 2.0 * sun
    before = centre + 2.0 * sun
    edge = behind + np.array([-0.8, 0.6, 0.0])
    beside = behind + 1.2 * np.array([0.0, 0.0, 1.0])
    passed = sunlight(np.stack([behind, before, edge, beside]), sun, BALL)
    np.testing.assert_allclose(passed, [0.0, 1.0, 0.5, 1.0], atol=1e-12)


def test_light_without_the_sun_is_that_of_the_shade() -> None:
    light = np.full((4, 4, 3), 0.2)
    share = np.zeros((4, 4))
    light[:2, :2], share[:2, :2] = 1.5, 0.8
    np.testing.assert_allclose(without_sun(light, share), 0.2)
    np.testing.assert_array_equal(without_sun(light, 0 * share), light)


@pytest.mark.seldom(10, first=6)
@pytest.mark.parametrize("figure, sunlit", [("ball", True), ("dragon", False), ("ball", False)])
def test_only_the_plinth_is_lit_otherwise_and_none_of_it_brighter(
    baked: np.ndarray, figure: str, sunlit: bool
) -> None:
    ball = ball_on_plinth() if figure == "ball" else None
    changed = plinth_light(baked, SUN, ball, sunlit)
    darker = (changed.astype(int) - baked)[..., :3].min(axis=2)
    assert changed.astype(int).max() <= 255 and (changed[..., :3] <= baked[..., :3] + 1).all()
    for lit in placed(hall()):
        if lit.chart is not None and lit.surface.material == "plinth":
            chart = lit.chart
            darker[chart.y : chart.y + chart.height, chart.x : chart.x + chart.width] = 0
    assert (darker == 0).all()


def test_under_the_ball_the_plinth_is_dark(baked: np.ndarray) -> None:
    changed = plinth_light(baked, SUN, ball_on_plinth())
    charts = [lit.chart for lit in placed(hall()) if lit.surface.material == "plinth" and lit.chart]
    top = max(charts, key=lambda chart: chart.width * chart.height)
    y, x = top.y + top.height // 2, top.x + top.width // 2
    assert changed[y, x, :3].max() == 0 < baked[y, x, :3].max()
