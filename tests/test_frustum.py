"""The camera's view frustum: what is in it, and when two eye poses are near each other."""

from dataclasses import replace

import numpy as np
import pytest
from sprite_stage import looking
from stage import project

from landscape.frame import Pose
from landscape.geometry.culling import ball_in_view, in_view, is_near


@pytest.mark.seldom(10, first=2)
@pytest.mark.parametrize("pose", [Pose(20, 3, 20, 33, -12), Pose(20, 6, 20, 200, -70)])
def test_nothing_in_the_picture_is_left_out(pose: Pose) -> None:
    frame = looking(pose)
    rng = np.random.default_rng(8)
    places, radii = rng.random((4000, 3)) * (40, 6, 40), rng.random(4000)
    kept = in_view(frame, places, radii)
    for place in places[~kept][::9]:
        offsets = rng.normal(size=(40, 3))
        around = (
            place
            + offsets
            / np.linalg.norm(offsets, axis=1)[:, None]
            * radii[np.flatnonzero((places == place).all(axis=1))[0]]
        )
        for point in around[frame.depth(around) < -0.01]:
            column, row = project(pose, tuple(point))
            assert not (0 <= column < 160 and 0 <= row < 120)
    assert 0.01 < kept.mean() < 0.6


def test_the_eye_is_near_until_it_has_moved_or_turned_too_far() -> None:
    then = looking(Pose(5.0, 1.0, 5.0, 30.0, -10.0))
    for change, near in (
        ({"x": 5.05}, True),
        ({"x": 5.05, "y": 1.05}, False),
        ({"yaw": 33.0}, True),
        ({"yaw": 35.0}, False),
        ({"pitch": -13.5}, True),
        ({"pitch": -15.0}, False),
        ({"yaw": 33.0, "pitch": -13.5}, False),
    ):
        assert is_near(then, looking(replace(then.pose, **change))) == near, change
    assert not is_near(then, replace(then, size=(120, 160)))
    assert is_near(then, then, 0.0, 0.0)
    assert not is_near(then, looking(replace(then.pose, x=5.001)), 0.0, 0.0)
    # Straight down the line of sight stays where it is; the window turns all the same.
    down = looking(Pose(5.0, 1.0, 5.0, 0.0, -90.0))
    assert not is_near(down, looking(replace(down.pose, yaw=10.0)))


def test_one_ball_is_tested_as_many_balls_are() -> None:
    frame = looking(Pose(20.0, 3.0, 20.0, 33.0, -12.0))
    rng = np.random.default_rng(3)
    places, sizes = rng.random((300, 3)) * (40, 6, 40), rng.random(300)
    one_by_one = [
        ball_in_view(frame, place, radius)
        for place, radius in zip(places.tolist(), sizes.tolist(), strict=True)
    ]
    assert one_by_one == in_view(frame, places, sizes).tolist()
    assert 0.05 < np.mean(one_by_one) < 0.6
