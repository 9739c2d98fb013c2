"""A camera's path: through its places, over the ground, around what stands there, evenly."""

import math

import numpy as np
import pytest

from landscape.geometry.camera_path import AROUND, CLEAR, HOLD, Travel, smoothed, through
from landscape.geometry.obstacle_grid import ObstacleGrid
from landscape.geometry.obstacles import Tower, Wall
from landscape.geometry.quaternion import from_angles, to_angles

ACROSS = np.array([(0.0, 0.3, 0.0), (10.0, 0.3, 0.0), (11.0, 0.3, 6.0)])


def flat(x: float, z: float) -> float:
    return 0.0


def hill(x: float, z: float) -> float:
    return 1.5 * math.exp(-((x - 5.0) ** 2 + z * z) / 2)


def bends(points: np.ndarray) -> np.ndarray:
    """Return the angles in degrees between the steps of a path."""
    steps = np.diff(points, axis=0)
    steps /= np.linalg.norm(steps, axis=1, keepdims=True)
    return np.degrees(np.arccos(np.clip((steps[1:] * steps[:-1]).sum(axis=1), -1, 1)))


def test_the_path_goes_through_its_places_without_corners() -> None:
    path = through(ACROSS, flat)
    assert np.array_equal(path.points[path.stops], ACROSS)
    assert bends(path.points).max() < 3.0


def test_places_at_unequal_distances_make_no_loop() -> None:
    # Where the parameter runs alike between all places, the short step is overshot.
    places = np.array([(0.0, 1.0, 0.0), (8.0, 1.0, 0.0), (8.2, 1.0, 0.0), (16.0, 1.0, 0.0)])
    assert (np.diff(through(places, flat).points[:, 0]) > 0.0).all()


def test_the_path_leads_over_a_hill_and_not_through_it() -> None:
    path = through(ACROSS, hill)
    above = np.array([y - hill(x, z) for x, y, z in path.points])
    assert above.min() > CLEAR - 1e-6
    assert np.array_equal(path.points[path.stops], ACROSS)
    assert bends(path.points).max() < 12.0


def test_a_place_just_above_the_ground_stays_there() -> None:
    low = ACROSS - (0.0, 0.25, 0.0)
    path = through(low, flat)
    assert np.array_equal(path.points[path.stops], low)
    assert path.points[:, 1].max() > CLEAR - 1e-6


@pytest.mark.parametrize("trees", [False, True])
def test_the_path_leads_around_what_is_higher_than_it(trees: bool) -> None:
    tower = Tower(8.0, 0.05, 0.3, 9.0)
    row = np.array([(8.0, 0.05, 0.3, 9.0)])
    path = through(ACROSS, flat, ObstacleGrid((), row) if trees else (tower,))
    gaps = np.array([tower.gap(x, z)[0] for x, _, z in path.points])
    assert gaps.min() > 0.9 * AROUND
    assert path.points[:, 1].max() < 2.0


def test_a_wall_across_the_path_is_flown_over() -> None:
    wall = Wall(5.0, 0.0, 3.0, 0.1, math.pi / 2, 1.0)
    path = through(ACROSS, flat, (wall,))
    inside = np.array([wall.gap(x, z)[0] < 0.0 for x, _, z in path.points])
    assert inside.any() and (path.points[inside, 1] > 1.0).all()


def test_the_camera_begins_and_ends_at_rest_in_its_views() -> None:
    turns = [from_angles(350.0, 0.0, 0.0), from_angles(90.0, -20.0, 0.0), from_angles(60, 5, 0)]
    travel = Travel(through(ACROSS, flat), turns, np.array([5.0, 4.0]))
    assert travel.seconds == pytest.approx(9.0 + 2 * HOLD)
    for time_s, place, yaw in ((0.0, ACROSS[0], -10.0), (travel.seconds, ACROSS[-1], 60.0)):
        where, turn = travel.at(time_s)
        assert np.allclose(where, place, atol=1e-6)
        assert to_angles(turn)[0] == pytest.approx(yaw, abs=1e-3)
    start = [np.linalg.norm(travel.at(t)[0] - ACROSS[0]) for t in (0.1, 3.0)]
    assert start[0] < 0.02 and start[1] > 1.0


def test_speed_and_turning_change_gently() -> None:
    turns = [from_angles(yaw, 0.0, 0.0) for yaw in (0.0, 120.0, 240.0)]
    travel = Travel(through(ACROSS, flat), turns, np.array([5.0, 4.0]))
    places, angles = zip(*(travel.at(t) for t in np.arange(0.0, travel.seconds, 0.05)), strict=True)
    speed = np.linalg.norm(np.diff(places, axis=0), axis=1) / 0.05
    assert np.abs(np.diff(speed)).max() < 0.4 and speed.max() < 2.0 * speed.mean()
    yaw = np.unwrap([to_angles(turn)[0] for turn in angles], period=360.0)
    assert np.abs(np.diff(yaw, 2)).max() < 0.5


def test_smoothing_leaves_the_ends_where_they_are() -> None:
    values = np.random.default_rng(1).random((200, 2))
    mean = smoothed(values, 0.2)
    assert np.allclose(mean[[0, -1]], values[[0, -1]])
    assert np.abs(np.diff(mean, axis=0)).max() < 0.1
