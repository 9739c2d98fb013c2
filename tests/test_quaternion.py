"""Quaternions: products and angles against matrices, and SLERP's arc, speed and special cases."""

from typing import ClassVar

import numpy as np
import pytest

from landscape.geometry.quaternion import (
    about,
    exponential,
    from_angles,
    from_axes,
    logarithm,
    looking,
    product,
    slerp,
    squad,
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


@pytest.mark.seldom(3, first=1)
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


class Counted(float):
    """A number that counts what is done with numbers of its kind."""

    done: ClassVar[dict[str, int]] = {"*": 0, "+": 0}

    def __mul__(self, other: object) -> "Counted":
        Counted.done["*"] += 1
        return Counted(float(self) * float(other))  # type: ignore[arg-type]

    def __add__(self, other: object) -> "Counted":
        Counted.done["+"] += 1
        return Counted(float(self) + float(other))  # type: ignore[arg-type]

    def __sub__(self, other: object) -> "Counted":
        Counted.done["+"] += 1
        return Counted(float(self) - float(other))  # type: ignore[arg-type]


def test_a_product_takes_fewer_operations_of_quaternions_than_of_matrices() -> None:
    """As the module's docstring, the lesson's page and docs/effects.md say."""

    def operations(p: list[list[float]], q: list[list[float]]) -> dict[str, int]:
        Counted.done.update({"*": 0, "+": 0})
        np.dot(np.array(p, object), np.array(q, object))
        return dict(Counted.done)

    three = [[Counted(1.0)] * 3] * 3
    assert operations(three, three) == {"*": 27, "+": 18}
    assert operations(three, [[Counted(1.0)]] * 3) == {"*": 9, "+": 6}
    Counted.done.update({"*": 0, "+": 0})
    (a, b, c, d), (e, f, g, h) = [Counted(1.0)] * 4, [Counted(1.0)] * 4
    found = (a * e - b * f - c * g - d * h, a * f + b * e + c * h - d * g)
    found += (a * g - b * h + c * e + d * f, a * h + b * g - c * f + d * e)
    assert Counted.done == {"*": 16, "+": 12}
    np.testing.assert_allclose(product(np.ones(4), np.ones(4)), [float(each) for each in found])


def test_i_j_and_k_multiply_as_the_rules_say() -> None:
    one, i, j, k = np.eye(4)
    for p, q, r in ((i, j, k), (j, k, i), (k, i, j)):
        np.testing.assert_array_equal(product(p, q), r)
        np.testing.assert_array_equal(product(q, p), -r)
        np.testing.assert_array_equal(product(p, p), -one)


def test_exponential_and_logarithm_undo_each_other() -> None:
    rng = np.random.default_rng(5)
    for _ in range(20):
        q = unit(rng)
        np.testing.assert_allclose(exponential(logarithm(q)), q, atol=1e-12)
    np.testing.assert_array_equal(logarithm(np.array([1.0, 0, 0, 0])), 0)
    np.testing.assert_array_equal(exponential(np.zeros(3)), [1, 0, 0, 0])


def test_squad_passes_its_middle_keys_and_is_slerp_where_the_turn_is_even() -> None:
    rng = np.random.default_rng(6)
    keys = [unit(rng) for _ in range(4)]
    for t, key in ((0.0, keys[1]), (1.0, keys[2])):
        assert abs(squad(keys, t) @ key) == pytest.approx(1.0)
    even = [about((0.0, 1.0, 0.0), 0.4 * n) for n in range(4)]
    for t in (0.2, 0.5, 0.9):
        np.testing.assert_allclose(squad(even, t), about((0.0, 1.0, 0.0), 0.4 * (1 + t)))
