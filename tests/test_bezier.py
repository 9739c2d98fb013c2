"""Paths of cubic Bezier curves: their points, lengths and speed."""

import numpy as np
import pytest

from landscape.geometry.bezier import BezierPath, evaluate, through


def line(start: np.ndarray, end: np.ndarray) -> np.ndarray:
    return np.stack([start, (2 * start + end) / 3, (start + 2 * end) / 3, end])


# A bend whose speed in t varies by a factor of nine, and one that stands still at both ends, as a
# straight line that was made a curve in a drawing program.
BENDS = np.array(
    [
        [(0, 0), (300, 0), (310, 10), (310, 60)],
        [(310, 60), (310, 60), (90, 140), (90, 140)],
    ],
    np.float64,
)
ELSEWHERE = line(np.array([500.0, 500]), np.array([530.0, 540]))[None]
# A circle of radius 100 about (200, 200), by the well-known constant.
C = 4 / 3 * (2**0.5 - 1)
QUARTERS = [[(1, 0), (1, C), (C, 1), (0, 1)], [(0, 1), (-C, 1), (-1, C), (-1, 0)]]
CIRCLE = 200 + 100 * np.concatenate([QUARTERS, -np.array(QUARTERS)])


def test_a_cubic_starts_at_its_first_control_point_and_ends_at_its_last() -> None:
    points = evaluate(BENDS[0], np.array([0.0, 0.5, 1.0]))
    # At one half the weights are 1/8, 3/8, 3/8, 1/8.
    middle = BENDS[0].T @ [0.125, 0.375, 0.375, 0.125]
    np.testing.assert_allclose(points, [(0, 0), middle, (310, 60)])


@pytest.mark.parametrize("curves", [BENDS[:1], BENDS[1:], CIRCLE])
def test_the_speed_along_a_path_is_constant_within_one_percent(curves: np.ndarray) -> None:
    path = BezierPath([curves])
    distances = np.linspace(0, path.length, 2000)
    steps = np.linalg.norm(np.diff(path.at(distances), axis=0), axis=1)
    assert steps.max() / steps.min() < 1.01


def test_equal_steps_of_the_parameter_are_no_constant_speed() -> None:
    by_t = np.linalg.norm(np.diff(evaluate(BENDS[0], np.linspace(0, 1, 1000)), axis=0), axis=1)
    assert by_t.max() / by_t.min() > 5


@pytest.mark.seldom(13, first=6)
def test_every_place_lies_on_the_curves() -> None:
    path = BezierPath([BENDS])
    places = path.at(np.linspace(0, path.length, 300))
    fine = np.concatenate([evaluate(curve, np.linspace(0, 1, 20_000)) for curve in BENDS])
    off = np.abs(places[:, None] - fine[None]).sum(axis=2).min(axis=1)
    assert off.max() < 0.03


def test_a_circle_has_its_circumference_as_length_and_is_closed() -> None:
    path = BezierPath([CIRCLE])
    assert path.closed == (True,)
    assert path.length == pytest.approx(200 * np.pi, rel=1e-3)
    np.testing.assert_allclose(path.at(0.0), path.at(path.length), atol=1e-9)
    assert BezierPath([BENDS]).closed == (False,)


def test_subpaths_follow_one_another_with_a_cut_between_them() -> None:
    path = BezierPath([BENDS, ELSEWHERE])
    assert path.starts[-1] == path.length == pytest.approx(path.starts[1] + 50)
    before, after = path.starts[1] - 1e-3, path.starts[1]
    np.testing.assert_allclose(
        path.at(np.array([before, after])), [(90, 140), (500, 500)], atol=0.01
    )
    assert path.part(np.array([0.0, before, after, path.length])).tolist() == [0, 0, 1, 1]


def test_no_place_is_between_two_subpaths() -> None:
    path = BezierPath([BENDS, ELSEWHERE])
    x = path.at(path.starts[1] + np.linspace(-0.1, 0.1, 2001))[:, 0]
    assert not np.any((x > 91) & (x < 499))


def test_beyond_the_ends_a_place_is_the_end() -> None:
    path = BezierPath([BENDS])
    np.testing.assert_allclose(path.at(np.array([-5.0, path.length + 5])), [(0, 0), (90, 140)])


def test_a_path_without_length_is_a_place() -> None:
    path = BezierPath([np.full((1, 4, 2), 7.0)])
    assert path.length == 0
    np.testing.assert_array_equal(path.at(0.0), (7, 7))


@pytest.mark.parametrize("closed", [False, True])
def test_a_path_through_points_is_smooth(closed: bool) -> None:
    points = np.array([(0.0, 0), (30, 10), (50, 60), (10, 40)])
    curves = through(points, closed)
    assert len(curves) == (4 if closed else 3) and BezierPath([curves]).closed == (closed,)
    np.testing.assert_allclose(curves[:, 0], points[: len(curves)])
    np.testing.assert_allclose(curves[:-1, 3], curves[1:, 0])
    np.testing.assert_allclose(curves[:-1, 3] - curves[:-1, 2], curves[1:, 1] - curves[1:, 0])
    # At (30, 10) the tangent is parallel to the line from (0, 0) to (50, 60).
    np.testing.assert_allclose((curves[1, 1] - curves[1, 0]) * 6, (50, 60))
