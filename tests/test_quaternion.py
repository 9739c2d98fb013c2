"""Quaternions: products and angles against matrices, and SLERP's arc, speed and special cases."""

import numpy as np
import pytest

from landscape.geometry.quaternion import (
    about,
    from_angles,
    from_axes,
    looking,
    product,
    slerp,
    to_angles,
    turned,
)


def matrix(q: np.ndarray) -> np.ndarray:
    return np.stack([turned(q, axis) for axis in np.eye(3)], axis=1)


def unit(rng: np.random.Generator) -> np.ndarray:
    q = rng.normal(size=4)
    return q / np.linalg.norm(q)


def axis_rotation(axis: int, degrees: float) -> np.ndarray:
    """Return a rotation matrix as glRotatef's, about x, y or z."""
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    turn = np.eye(3)
    a, b = (axis + 1) % 3, (axis + 2) % 3
    turn[a, a] = turn[b, b] = c
    turn[a, b], turn[b, a] = -s, s
    return turn


def angle(p: np.ndarray, q: np.ndarray) -> float:
    """Return the angle in radians of the rotation from one orientation to another."""
    return float(np.arccos(np.clip((np.trace(matrix(p).T @ matrix(q)) - 1) / 2, -1, 1)))


def test_a_product_is_one_rotation_after_the_other() -> None:
    rng = np.random.default_rng(1)
    for _ in range(20):
        p, q = unit(rng), unit(rng)
        np.testing.assert_allclose(matrix(product(p, q)), matrix(p) @ matrix(q), atol=1e-12)
        np.testing.assert_allclose(matrix(-p), matrix(p), atol=1e-12)


def test_angles_turn_the_camera_as_the_frame_s_three_rotations_do() -> None:
    rng = np.random.default_rng(2)
    for yaw, pitch, roll in rng.uniform(-180, 180, (20, 3)):
        view = axis_rotation(2, -roll) @ axis_rotation(0, -pitch) @ axis_rotation(1, yaw)
        np.testing.assert_allclose(matrix(from_angles(yaw, pitch, roll)).T, view, atol=1e-12)


def test_angles_come_back_but_for_gimbal_lock_where_the_orientation_does() -> None:
    rng = np.random.default_rng(3)
    for yaw, pitch, roll in rng.uniform((-180, -89, -180), (180, 89, 180), (20, 3)):
        assert to_angles(from_angles(yaw, pitch, roll)) == pytest.approx((yaw, pitch, roll))
    for pitch in (-90.0, 90.0):
        q = from_angles(70.0, pitch, 20.0)
        again = to_angles(q)
        assert again[0] == 0.0 and angle(from_angles(*again), q) < 1e-6


def test_axes_give_their_own_rotation_in_all_four_cases() -> None:
    rng = np.random.default_rng(4)
    halves = [about(axis, np.pi) for axis in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
    for q in [*halves, about((0, 1, 0), 0.0), *(unit(rng) for _ in range(40))]:
        np.testing.assert_allclose(matrix(from_axes(*matrix(q).T)), matrix(q), atol=1e-12)


def test_a_camera_looks_at_its_target_with_its_top_up() -> None:
    eye, target = np.array([1.0, 2.0, 5.0]), np.array([0.0, 1.0, 0.0])
    q = looking(eye, target, np.array([0.0, 1.0, 0.0]))
    ahead = turned(q, np.array([0.0, 0.0, -1.0]))
    np.testing.assert_allclose(ahead, (target - eye) / np.linalg.norm(target - eye), atol=1e-12)
    assert turned(q, np.array([1.0, 0.0, 0.0]))[1] == pytest.approx(0.0, abs=1e-12)
    assert turned(q, np.array([0.0, 1.0, 0.0]))[1] > 0


@pytest.mark.parametrize("short", [True, False])
def test_slerp_turns_at_constant_speed_from_one_end_to_the_other(short: bool) -> None:
    rng = np.random.default_rng(5)
    for _ in range(10):
        p, q = unit(rng), unit(rng)
        path = [slerp(p, q, t, short) for t in np.linspace(0, 1, 65)]
        steps = [angle(a, b) for a, b in zip(path, path[1:], strict=False)]
        assert max(steps) - min(steps) < 1e-6
        assert angle(path[0], p) < 1e-6 and angle(path[-1], q) < 1e-6
        np.testing.assert_allclose(np.linalg.norm(path, axis=1), 1.0, atol=1e-12)


def test_slerp_takes_the_short_arc_unless_it_is_told_not_to() -> None:
    p, q = about((0, 1, 0), 0.2), -about((0, 1, 0), 0.8)
    assert angle(p, slerp(p, q, 0.5)) == pytest.approx(0.3)
    assert angle(p, slerp(p, q, 0.5, short=False)) == pytest.approx(np.pi - 0.3)


def test_slerp_between_nearly_equal_and_opposite_rotations_is_finite() -> None:
    p = about((0.6, 0.0, 0.8), 1.0)
    near = product(p, about((0, 0, 1), 1e-6))
    assert angle(p, slerp(p, near, 0.5)) < 1e-5 and slerp(p, p, 0.3) == pytest.approx(p)
    assert slerp(p, -p, 0.4) == pytest.approx(p)
    half = slerp(p, -p, 0.5, short=False)
    assert angle(p, half) == pytest.approx(np.pi) and slerp(p, -p, 1.0, False) == pytest.approx(-p)
