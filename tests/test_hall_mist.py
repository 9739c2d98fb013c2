"""The hall's transparent layers: sheets of mist from far to near, two layers of cloud."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hall_pictures import HallPictures
from stage import Stage

from landscape.elements.best.mist.mist_sheets import far_to_near
from landscape.frame import Pose
from landscape.hall import plan
from landscape.hall.mist import BASE, heights, sheet, softened
from landscape.hall.moving_sky import dome

OVER_THE_FLOOR = Pose(1.4, 0.2, 2.3, 25.0, -12.0)
AT_A_WINDOW = Pose(1.9, 0.3, 1.4, 90.0, 8.0)
SHOWN = ("room", "floor", "sky", "mist")
Draw = Callable[..., np.ndarray]


@pytest.fixture
def picture(stage: Stage, hall_pictures: HallPictures) -> Draw:
    """Draws the hall with settings such as mist_sheets=1."""

    def draw(pose: Pose, kt: float = 0.0, **settings: Any) -> np.ndarray:
        given = {name.replace("_", ".", 1): value for name, value in settings.items()}
        return hall_pictures(pose, kt, SHOWN, given)

    return draw


def test_sheets_are_drawn_from_far_to_near_whatever_the_eye_s_height() -> None:
    levels = heights(5)
    for eye in (0.0, 0.03, 0.05, 0.2):
        away = np.abs(levels[far_to_near(levels, eye)] - eye)
        assert (np.diff(away) <= 1e-12).all()
    assert far_to_near(levels, 1.0).tolist() == [0, 1, 2, 3, 4]
    assert far_to_near(levels, 0.0).tolist() == [4, 3, 2, 1, 0]


def test_a_sheet_lies_within_the_walls_faces_up_and_ends_softly() -> None:
    vertices, opacity, triangles = sheet()
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    assert (np.cross(b - a, c - a)[:, 1] > 0).all()
    outermost = (vertices[:, 0] == vertices[:, 0].min()) | (vertices[:, 2] == vertices[:, 2].max())
    assert (opacity[outermost] == 0).all() and opacity.max() == 1.0


def test_mist_is_densest_over_the_pool() -> None:
    vertices, opacity, _ = sheet()
    pool = plan.POOL
    over = (vertices[:, 0] > pool.west - 1e-6) & (vertices[:, 0] < pool.east + 1e-6)
    over &= (vertices[:, 2] > pool.north - 1e-6) & (vertices[:, 2] < pool.south + 1e-6)
    assert over.sum() == 4 and opacity[over].min() == 1.0
    assert opacity[~over].max() < 0.6


def test_clouds_become_mist_without_gaps() -> None:
    clouds = np.zeros((64, 64, 4), np.uint8)
    clouds[:16, :16] = 255
    mist = softened(clouds)
    assert mist.shape == (4, 4, 4) and (mist[..., :3] == 255).all()
    assert mist[0, 0, 3] == 255 and (mist[1:, 1:, 3] == round(255 * BASE)).all()


@pytest.mark.seldom(7, first=5)
def test_one_sheet_is_blended_by_its_alpha_and_its_depth_is_not_written(picture: Draw) -> None:
    none = picture(OVER_THE_FLOOR)
    mist = picture(OVER_THE_FLOOR, mist_enabled=True, mist_sheets=1, mist_density=1.0)
    thin = picture(OVER_THE_FLOOR, mist_enabled=True, mist_sheets=1, mist_density=0.5)
    # Half the opacity is half of the change.
    assert np.abs(mist - none).max() > 40
    assert np.abs((thin - none) - (mist - none) / 2).max() <= 1.5


def test_without_the_order_or_the_mask_the_mist_looks_different(picture: Draw) -> None:
    right = picture(OVER_THE_FLOOR, mist_enabled=True)
    unsorted_ = picture(OVER_THE_FLOOR, mist_enabled=True, mist_sorted=False)
    hidden = picture(OVER_THE_FLOOR, mist_enabled=True, mist_sorted=False, mist_mask=False)
    assert np.abs(right - unsorted_).max() > 5
    assert np.abs(right - hidden).mean() > 2 * np.abs(right - unsorted_).mean()


def test_the_mist_drifts(picture: Draw) -> None:
    then, now = (picture(OVER_THE_FLOOR, kt, mist_enabled=True) for kt in (0.0, 60.0))
    assert np.abs(then - now).max() > 20


def test_the_dome_is_seen_from_within_and_its_clouds_shrink_towards_the_horizon() -> None:
    vertices, _, places, triangles = dome()
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    inwards = (np.cross(b - a, c - a) * -(a + b + c)).sum(axis=1)
    assert (inwards > -1e-4).all()
    by_height = np.linalg.norm(places, axis=1).reshape(-1, 25)
    steps = np.diff(by_height.mean(axis=1))
    assert (steps[:-2] > 0).all() and steps[-4] > 2 * steps[0]


def moved(picture: Draw, **settings: Any) -> np.ndarray:
    then, now = (picture(AT_A_WINDOW, kt, **settings) for kt in (0.0, 300.0))
    return np.abs(then - now)


def test_the_clouds_move_only_outside_the_windows(
    picture: Draw, hall_pictures: HallPictures
) -> None:
    walls = hall_pictures(AT_A_WINDOW, 0.0, ("room", "floor"))
    changed = moved(picture).max(axis=2) > 0
    sky = (walls == walls[changed][0]).all(axis=2)
    assert 300 < changed.sum() <= sky.sum() < 0.5 * sky.size
    assert not (changed & ~sky).any()


@pytest.mark.seldom(13, first=9)
def test_two_layers_move_at_two_speeds_and_lie_in_their_order(picture: Draw) -> None:
    assert moved(picture, sky_layers=0).max() == 0
    assert 0 < moved(picture, sky_layers=1).mean() < moved(picture, sky_layers=2).mean()
    right, wrong = (picture(AT_A_WINDOW, sky_sorted=order) for order in (True, False))
    assert np.abs(right - wrong).max() > 5
