"""The sea's grid around the eye: it covers the water that the window shows, and keeps still."""

import numpy as np
import pytest
from seaside import LEVEL, POSE, frame_at, grid_at
from stage import SIZE

from landscape.elements.best.sea.eye_grid import eye_grid
from landscape.frame import Pose


@pytest.mark.parametrize(
    "pose",
    [
        POSE,
        Pose(20, 0.7, 20, 77, 3),
        Pose(20, 9, 20, 200, -50),
        Pose(20, 5, 20, 0, -89),
        Pose(3, 1, 9, 340, -28),
    ],
)
def test_the_grid_covers_every_point_of_the_window_that_shows_water(pose: Pose) -> None:
    grid = grid_at(pose)
    # Rays through the window's border, from the definition of the perspective.
    yaw, pitch = np.radians(pose.yaw), np.radians(pose.pitch)
    right = np.array([np.cos(yaw), 0, np.sin(yaw)])
    ahead = np.array(pose.forward)
    up = np.array([-np.sin(pitch) * np.sin(yaw), np.cos(pitch), np.sin(pitch) * np.cos(yaw)])
    half = np.tan(np.radians(30))
    heading = np.unwrap(np.arctan2(grid.east, -grid.south))
    for a in np.linspace(-1, 1, 9):
        for b in np.linspace(-1, 1, 9):
            ray = ahead + a * half * SIZE[0] / SIZE[1] * right + b * half * up
            if ray[1] >= -1e-3:
                continue
            ring = (pose.y - LEVEL) / -ray[1] * np.hypot(ray[0], ray[2])
            assert grid.ring.min() <= max(ring, 0.02)
            assert ring <= grid.ring.max() or ring > 59
            turns = (np.arctan2(ray[0], -ray[2]) - heading[0]) % (2 * np.pi)
            assert ring < 0.02 or turns <= heading[-1] - heading[0] + 1e-5


def test_there_is_no_grid_where_only_sky_is_seen() -> None:
    assert eye_grid(frame_at(Pose(20, 1, 20, 0, 45)), LEVEL, 60.0) is None


def test_the_lines_stay_where_they_are_when_the_viewer_turns() -> None:
    first, second = grid_at(Pose(20, 1, 20, 10, -5)), grid_at(Pose(20, 1, 20, 14.3, -5))
    directions = np.stack([first.east, first.south], axis=1)
    turned = np.stack([second.east, second.south], axis=1)
    shared = [np.abs(turned - d).max(axis=1).min() < 1e-5 for d in directions[20:-5]]
    assert all(shared)


def test_a_wide_view_has_no_more_lines_than_the_limit() -> None:
    grid = eye_grid(frame_at(Pose(20, 30, 20, 0, -80), fov=150.0), LEVEL, 60.0)
    assert grid is not None and max(grid.x.shape) <= 160
    assert grid.triangles.max() == grid.x.size - 1


def test_rows_run_from_far_to_near_and_stay_inside_the_water() -> None:
    grid = grid_at()
    assert (np.diff(grid.ring) <= 0).all()
    grid.keep_within(15.0, 30.0)
    assert grid.x.min() >= 15 and grid.x.max() <= 30 and grid.z.min() >= 15 and grid.z.max() <= 30


def test_lines_crowd_towards_the_horizon_where_one_step_reaches_far() -> None:
    grid = eye_grid(frame_at(Pose(20, LEVEL + 0.1, 20, 0, -5)), LEVEL, 400.0)
    assert grid is not None
    ring = grid.ring
    assert ring[0] > 3 * ring[4] and (ring[:4] / ring[1:5]).max() < 12
