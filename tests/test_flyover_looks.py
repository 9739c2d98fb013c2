"""What filled mode bakes for an environment: clouds, layers of rock, shadows, kinds of land."""

import math

import numpy as np
import pytest

from landscape.flyover import clouds, ground, rock, sunlight
from landscape.flyover.look import sun_direction


def test_clouds_have_soft_edges_and_are_bright_above_and_dark_below() -> None:
    tangent = np.tan(np.radians(np.linspace(8, 70, 128)))[:, None]
    azimuth = np.linspace(0, math.tau, 512, endpoint=False)
    amount, light = clouds.clouds(tangent, azimuth, sun_direction(215.0, 32.0))
    assert amount.shape == light.shape == (128, 512)
    assert amount.min() >= 0 and amount.max() <= 1 and light.min() >= 0 and light.max() <= 1.001
    # Both are there, and what is neither is as much as the clouds.
    assert (amount < 0.1).mean() > 0.2 and (amount > 0.9).mean() > 0.1
    assert ((amount > 0.1) & (amount < 0.9)).mean() > 0.5 * (amount > 0.9).mean()
    solid = light[amount > 0.9]
    assert np.percentile(solid, 99) - np.percentile(solid, 1) > 0.2


@pytest.mark.seldom(5, first=4)
def test_layers_of_rock_are_others_elsewhere_and_mountains_are_folded() -> None:
    made = rock.rock(True)
    picture = made.texels[: rock.SIDE**2].reshape(rock.SIDE, -1).astype(float)
    here = picture[:, 100]
    beside = picture[:, 101]
    there = picture[:, 612]
    assert np.corrcoef(here, beside)[0, 1] > 0.6 > 0.4 > abs(np.corrcoef(here, there)[0, 1])
    assert np.abs(picture[0] - picture[-1]).mean() < 3 * np.abs(picture[0] - picture[1]).mean()
    assert abs(made.texels[-1] - picture.mean()) < 2
    plateau, range_ = (np.abs(np.diff(rock.dip(folded))) for folded in (False, True))
    assert np.median(range_) > 2 * np.median(plateau)


def test_a_shadow_on_a_wall_has_no_teeth() -> None:
    # A wall rises along x, six texels a texel; the shadow of a slanting crest falls on it.
    x, y = np.meshgrid(np.arange(128.0), np.arange(128.0))
    heights = np.clip(6 * (x - 60), 0, 60)
    heights[:, 20:24] = 25 + 0.25 * y[:, 20:24]
    lit = sunlight.sun_light(heights.astype(np.float32), np.array([-0.8, 0, 0.6]))
    wall = lit[20:100, 62:66]
    assert lit[20, 40] == 0 and lit[20, 75] == 1
    assert np.abs(np.diff(wall, axis=0)).max() < 0.12


def test_land_is_a_plateau_a_mountain_range_or_an_island() -> None:
    x, y = np.meshgrid(np.arange(64.0), np.arange(64.0))
    cone = np.maximum(40 - 1.3 * np.hypot(x - 32, y - 32), 0)
    assert ground.character(np.where(abs(x - 32) < 6, 0, 40.0), 4.0) == (1, 0)
    assert ground.character(cone + 5, 4.0) == (0, 1)
    assert ground.character(np.maximum(cone, 25) - 25, 1.0) == (0, 0)
    assert ground.character(cone, 50.0) == (0, 0)
