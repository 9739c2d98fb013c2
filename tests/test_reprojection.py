"""A picture moved to where its things are seen now: where the vertices of the grid go."""

import math

import numpy as np
import pytest
from stage import Stage

from landscape.elements.settings import Settings
from landscape.frame import Pose
from landscape.scene.scene import Moment
from landscape.walk.reprojection import (
    COLUMNS,
    GRID,
    QUADS,
    ROWS,
    Seen,
    ahead,
    axes,
    distances,
    reprojected,
)

SIZE = (320, 180)
FOV = 60.0
TALL = math.tan(math.radians(FOV / 2))
WIDE = TALL * SIZE[0] / SIZE[1]
HERE = Pose(3.0, 1.0, -2.0, 30.0, -5.0)


def wall(pose: Pose, far: float) -> Seen:
    """Return what an eye sees of a wall at right angles to its line of sight."""
    return Seen(pose, FOV, SIZE, np.full((ROWS, COLUMNS), far))


def inner(vertices: np.ndarray) -> np.ndarray:
    return vertices[1:-1, 1:-1]


def test_the_axes_are_those_of_the_compass() -> None:
    assert np.allclose(axes(Pose(0, 0, 0)), np.eye(3))
    right, up, back = axes(Pose(0, 0, 0, yaw=90.0))
    assert np.allclose(right, (0, 0, 1)) and np.allclose(up, (0, 1, 0))
    assert np.allclose(back, (-1, 0, 0))
    for pose in (HERE, Pose(0, 0, 0, 200.0, 40.0, 25.0)):
        assert np.allclose(-axes(pose)[2], pose.forward)
        assert np.allclose(axes(pose) @ axes(pose).T, np.eye(3))


def test_the_axes_are_those_of_the_camera(stage: Stage) -> None:
    pose = Pose(1.0, 2.0, 3.0, 200.0, 40.0, 25.0)
    with stage.frame(Settings(), pose) as frame:
        turn = np.stack([frame.right, frame.up, frame.back])
    assert np.allclose(axes(pose), turn, atol=1e-6)


def test_from_the_same_place_all_is_where_it_was() -> None:
    depths = np.random.default_rng(1).uniform(0.1, 50, (ROWS, COLUMNS))
    vertices = reprojected(Seen(HERE, FOV, SIZE, depths), HERE)
    assert np.allclose(vertices[..., :2], 2 * GRID - 1, atol=1e-5) and (vertices[..., 2] == 0).all()


def test_a_wall_grows_as_one_comes_nearer() -> None:
    forward = np.array(HERE.forward)
    nearer = Pose(*(np.array([3.0, 1.0, -2.0]) + 0.5 * forward).tolist(), 30.0, -5.0)
    vertices = reprojected(wall(HERE, 2.0), nearer)
    assert np.allclose(inner(vertices)[..., :2], inner(2 * GRID - 1) * 2.0 / 1.5, atol=1e-5)


def test_what_is_near_moves_farther_than_what_is_far() -> None:
    start, aside = Pose(0, 0, 0), Pose(0.1, 0, 0)
    for far in (0.5, 5.0):
        moved = inner(reprojected(wall(start, far), aside) - reprojected(wall(start, far), start))
        assert np.allclose(moved[..., 0], -0.1 / (far * WIDE), atol=1e-6)
        assert np.allclose(moved[..., 1], 0.0, atol=1e-6)


def test_turning_moves_all_alike_whatever_its_depth() -> None:
    turned = Pose(3.0, 1.0, -2.0, 33.0, -5.0)
    near, far = (reprojected(wall(HERE, d), turned) for d in (0.3, 30.0))
    assert np.allclose(inner(near), inner(far), atol=1e-5)
    # In the middle of the picture to the left, as one turns to the right.
    middle = inner(near)[ROWS // 2, COLUMNS // 2] - inner(2 * GRID - 1)[ROWS // 2, COLUMNS // 2, 0]
    assert middle[0] == pytest.approx(-math.tan(math.radians(3.0)) / WIDE, rel=0.05)


@pytest.mark.parametrize("pose", [HERE, Pose(3.1, 1.0, -2.2, 50.0, -20.0), Pose(9, 9, 9, 200.0)])
def test_the_picture_covers_the_window(pose: Pose) -> None:
    vertices = reprojected(wall(HERE, 1.0), pose)
    assert (vertices[:, 0, 0] <= -1).all() and (vertices[:, -1, 0] >= 1).all()
    assert (vertices[0, :, 1] <= -1).all() and (vertices[-1, :, 1] >= 1).all()
    assert np.isfinite(vertices).all()


def test_each_cell_is_one_quad_of_four_neighbours() -> None:
    corners = GRID.reshape(-1, 2)[QUADS.reshape(-1, 4)]
    assert len(corners) == (ROWS + 1) * (COLUMNS + 1)
    sides = corners.max(axis=1) - corners.min(axis=1)
    assert sides.prod(axis=1).sum() == pytest.approx(1.0)


def test_depths_become_distances() -> None:
    near, far = 0.02, 400.0
    # The third row of glFrustum's matrix, by columns.
    projection = np.zeros(16)
    projection[10], projection[14] = -(far + near) / (far - near), -2 * far * near / (far - near)
    wanted = np.array([near, 0.1, 3.0, far])
    depths = (-projection[10] + projection[14] / wanted) / 2 + 0.5
    assert np.allclose(distances(depths, projection), wanted)


def moment(pose: Pose, kt: float) -> Moment:
    return Moment(pose, SIZE, kt)


def test_a_moment_ahead_goes_on_as_the_last_two_did() -> None:
    then = moment(Pose(1.0, 0.1, 2.0, 359.0, 3.0), 10.0)
    now = moment(Pose(1.1, 0.2, 1.8, 1.0, 2.0), 11.0)
    later = ahead(then, now, 1.5)
    pose = later.pose
    assert (pose.x, pose.y, pose.z) == pytest.approx((1.25, 0.35, 1.5))
    assert (pose.yaw, pose.pitch, later.kt) == pytest.approx((4.0, 0.5, 12.5))
    assert ahead(now, now, 1.5) == now


def test_who_was_put_elsewhere_does_not_go_on_so() -> None:
    now = moment(Pose(1.1, 0.2, 1.8, 1.0), 11.0)
    for then in (Pose(50.0, 0.2, 1.8, 1.0), Pose(1.1, 0.2, 1.8, 181.0)):
        assert ahead(moment(then, 10.0), now, 1.5) == now
