"""The camera on its path over the terrain: speed, height, turning, and the same at any time."""

import dataclasses
import math

import numpy as np
import pytest

from landscape.flyover.environment import NAMES, Environment, open_environment
from landscape.flyover.flight import STEEPEST, Flight, follow, nearest
from landscape.flyover.height_field import height_field
from landscape.flyover.scene_flight import SceneFlight
from landscape.flyover.settings import Flyover
from landscape.geometry.bezier import BezierPath

CIRCLE = 100 + 60 * np.array(
    [
        [(1, 0), (1, 0.5523), (0.5523, 1), (0, 1)],
        [(0, 1), (-0.5523, 1), (-1, 0.5523), (-1, 0)],
        [(-1, 0), (-1, -0.5523), (-0.5523, -1), (0, -1)],
        [(0, -1), (0.5523, -1), (1, -0.5523), (1, 0)],
    ]
)
ACROSS = np.array([[(20, 64), (50, 64), (80, 64), (110, 64)]], np.float64)
BACK = np.array([[(110, 20), (80, 20), (50, 20), (20, 20)]], np.float64)
NOTHING = np.zeros((0, 2))
PLAIN = Flyover(ease=0.0, smooth=0.0, ahead=False)
ROUGH = height_field(np.random.default_rng(3).integers(0, 26, (256, 256)).astype(np.float32))


def flat(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    return np.zeros(np.shape(x))


def flown(path: list[np.ndarray], targets=NOTHING, settings=PLAIN, ground=flat) -> Flight:
    return Flight(BezierPath(path), np.array(targets, np.float64), ground, settings)


def cameras(flight: Flight, times: np.ndarray) -> np.ndarray:
    """Return x, y, z, theta_x, theta_y, theta_z (n, 6) at times (n,)."""
    return np.array([dataclasses.astuple(flight.camera(float(t))) for t in times])


def test_the_camera_goes_at_the_speed_that_is_set() -> None:
    flight = flown([CIRCLE], settings=Flyover(speed=30.0))
    assert flight.duration == pytest.approx(60 * math.tau / 30, rel=1e-3)
    places = cameras(flight, np.arange(0, flight.duration, 0.1))[:, :2]
    steps = np.linalg.norm(np.diff(places, axis=0), axis=1)
    assert abs(steps / 3.0 - 1).max() < 0.01


def test_the_camera_is_two_units_above_the_ground_unless_smoothed() -> None:
    flight = flown([CIRCLE], ground=ROUGH.height)
    seen = cameras(flight, np.linspace(0, flight.duration, 700))
    np.testing.assert_allclose(seen[:, 2] - ROUGH.height(seen[:, 0], seen[:, 1]), 2.0)


def test_smoothing_takes_the_jolts_and_keeps_the_distance() -> None:
    jolts = []
    for smooth in (0.0, 6.0):
        flight = flown([CIRCLE], settings=Flyover(smooth=smooth), ground=ROUGH.height)
        seen = cameras(flight, np.arange(0, flight.duration, 1 / 60))
        jolts.append(np.abs(np.diff(seen[:, 2], 2)).max())
        assert (seen[:, 2] - ROUGH.height(seen[:, 0], seen[:, 1])).min() > 1.5
    assert jolts[1] < jolts[0] / 10


def test_the_camera_is_the_same_whatever_was_asked_before() -> None:
    times = np.linspace(0, 30, 50)
    targets = [(100, 100), (180, 60)]
    forward = cameras(flown([CIRCLE], targets), times)
    backward = cameras(flown([CIRCLE], targets), times[::-1])[::-1]
    np.testing.assert_array_equal(forward, backward)


def test_between_frames_the_camera_moves_evenly_however_short_they_are() -> None:
    flight = flown([CIRCLE], [(100, 100), (180, 60)], Flyover(), ROUGH.height)
    seen = cameras(flight, np.arange(2, 4, 1 / 2000))
    steps = np.abs(np.diff(seen, axis=0))
    assert steps[:, 5].max() <= math.radians(60) / 2000 * 1.001 and steps[:, 2].max() < 0.05


def test_the_camera_looks_at_the_nearest_point() -> None:
    flight = flown([ACROSS], [(65, 200), (65, -1000)])
    assert flight.camera(0).theta_z == pytest.approx(math.atan2(136, 45))
    end = flight.camera(flight.duration - 1e-6)
    assert end.theta_z == pytest.approx(math.atan2(136, -45), abs=0.02)
    assert end.theta_y == pytest.approx(math.atan2(2, math.hypot(136, 45)), abs=1e-3)


def test_another_point_that_becomes_the_nearest_is_turned_to_at_the_set_rate() -> None:
    flight = flown([ACROSS], [(0, 64), (130, 64)], dataclasses.replace(PLAIN, turn=90.0))
    seen = np.degrees(cameras(flight, np.linspace(0, flight.duration, 1000, endpoint=False))[:, 5])
    rate = np.abs(np.diff(seen)) / (flight.duration / 1000)
    assert seen[0] == pytest.approx(180) and seen[-1] % 360 == pytest.approx(0, abs=1e-6)
    assert rate.max() == pytest.approx(90, rel=1e-6)
    # It takes two seconds for half a turn.
    assert (rate > 45).mean() * flight.duration == pytest.approx(2, abs=0.05)


def test_the_camera_turns_the_short_way() -> None:
    # From 170 to 190 degrees, the latter written as -170.
    wanted = np.radians([170.0] + [-170.0] * 200)
    turned = np.degrees(follow(wanted, 0.01, math.radians(60), 0.0, (wanted[0], 0.0)))
    assert turned.min() == pytest.approx(170) and turned.max() == pytest.approx(190)


def test_with_ease_the_camera_starts_and_stops_gently_and_turns_no_farther() -> None:
    wanted = np.radians([0.0] + [90.0] * 600)
    turned = np.degrees(follow(wanted, 0.01, math.radians(60), 0.5, (0.0, 0.0)))
    speed = np.diff(turned) / 0.01
    assert np.abs(np.diff(speed)).max() < 60 / 0.5 * 0.01 * 1.5
    assert speed.max() == pytest.approx(60)
    assert turned[-1] == pytest.approx(90, abs=0.01) and turned.max() < 90.1


def test_without_points_the_camera_looks_along_the_path_and_down_the_slope() -> None:
    seen = flown([ACROSS]).camera(1.0)
    assert (seen.theta_x, seen.theta_y, seen.theta_z) == (0, pytest.approx(0), pytest.approx(0))
    bend = flown([CIRCLE]).camera(1.0)
    # At 20 units on a circle of radius 60 the chord of the next 12 units is half of 12 further.
    assert bend.theta_z % math.tau == pytest.approx(math.pi / 2 + (20 + 6) / 60, abs=0.01)
    downhill = flown([ACROSS], ground=lambda x, y: -0.5 * np.asarray(x)).camera(1.0)
    assert downhill.theta_y == pytest.approx(math.atan(0.5))
    end = flown([ACROSS]).camera(90 / 20 - 1e-6)
    assert end.theta_z == pytest.approx(0)


def test_over_a_point_the_camera_does_not_look_straight_down() -> None:
    flight = flown([ACROSS], [(65, 64)])
    seen = cameras(flight, np.linspace(0, flight.duration - 1e-6, 500))
    assert seen[:, 4].max() == pytest.approx(STEEPEST, abs=1e-3)


def test_a_closed_path_is_flown_again_without_a_jump() -> None:
    flight = flown([CIRCLE], [(100, 100), (180, 60)], Flyover(), ROUGH.height)
    seen = cameras(flight, flight.duration + np.array([-2e-3, -1e-3, 1e-3, 2e-3]))
    turned = np.abs([math.remainder(step, math.tau) for step in np.diff(seen[:, 5])])
    assert np.abs(np.diff(seen[:, :5], axis=0)).max() < 0.1
    assert turned.max() <= math.radians(60) * 2e-3 * 1.001
    np.testing.assert_allclose(seen[2], dataclasses.astuple(flight.camera(1e-3)), atol=1e-6)


def test_at_a_cut_the_camera_looks_at_its_point_at_once() -> None:
    flight = flown([ACROSS, BACK], [(0, 64), (130, 20)])
    after = flight.camera(90 / 20 + 1e-6)
    assert (after.x, after.y) == pytest.approx((110, 20), abs=1e-3)
    assert math.remainder(after.theta_z, math.tau) == pytest.approx(0, abs=1e-3)
    # After the last part the first begins again.
    assert flight.camera(flight.duration + 1).x == pytest.approx(40)


def test_the_nearest_of_many_points_is_found_for_many_places() -> None:
    rng = np.random.default_rng(5)
    places, targets = rng.random((9000, 2)), rng.random((7, 2))
    expected = [targets[np.hypot(*(targets - place).T).argmin()] for place in places[:200]]
    np.testing.assert_array_equal(nearest(places, targets)[:200], expected)
    assert len(nearest(places, targets)) == 9000


class Ramp:
    """A map that rises to the east."""

    size = 40.0

    def height(self, x: float, z: float) -> float:
        """Return the height of the ground; nothing may ask beyond the map."""
        assert 0 <= x <= self.size and 0 <= z <= self.size
        return 0.1 * x


def test_a_path_is_flown_over_a_scene_of_another_size() -> None:
    image = np.zeros((128, 128), np.float32)
    corner_to_corner = np.array([[(0, 0), (40, 40), (80, 80), (128, 128)]], np.float64)
    over = Environment("test", image, (corner_to_corner,), np.array([(128.0, 0.0)]))
    flight = SceneFlight(over, Ramp(), 0.3, Flyover(smooth=0.0, ahead=False))
    assert flight.duration == pytest.approx(128 * 2**0.5 / 20)
    start, middle = flight.pose(0.0), flight.pose(flight.duration / 2)
    # The point to look at is in the north-east; north is -z, and a yaw of 90 degrees is east.
    assert (start.x, start.y, start.z, start.yaw) == pytest.approx((0, 0.3, 0, 90))
    assert (middle.x, middle.y, middle.z) == pytest.approx((20, 2.3, 20), abs=0.01)
    assert middle.yaw == pytest.approx(45, abs=1)
    assert middle.pitch == pytest.approx(math.degrees(math.atan2(1.7, 20 * 2**0.5)), abs=0.2)
    assert flight.pose(flight.duration - 1e-9).x == pytest.approx(40)


def test_with_ahead_it_looks_at_points_before_it_and_back_at_none() -> None:
    ahead = dataclasses.replace(PLAIN, ahead=True, turn=1e4)
    flight = flown([ACROSS], [(80, 84), (20, 60)], ahead)
    seen = [flight.camera(t).theta_z for t in (0.5, 1.5, 2.4, 4.0)]
    # Nearer points behind it and beside it do not count; it looks aside by 35 degrees at most.
    assert seen[0] == pytest.approx(math.atan2(20, 50)) and seen[1] == pytest.approx(
        math.atan2(20, 30)
    )
    assert seen[2] == pytest.approx(math.radians(35)) and seen[3] == pytest.approx(0)


@pytest.mark.parametrize("name", NAMES)
def test_shipped_paths_look_where_they_go_and_keep_their_distance(name: str) -> None:
    environment, settings = open_environment(name), Flyover()
    field = environment.field(settings)
    flight = environment.flight(field, settings)

    # The ends of an open path are left out: there is no way to compare with.
    times = np.arange(0.5, flight.duration - 0.6, 0.25)
    seen, later = cameras(flight, times), cameras(flight, times + 0.1)
    way = later[:, :2] - seen[:, :2]
    steps = np.linalg.norm(way, axis=1)

    # Between these places the path is curved.
    assert steps.min() / 2.0 > 0.98 and steps.max() / 2.0 < 1.001
    way /= steps[:, None]
    off = np.arccos(
        np.clip(np.sum(way * np.stack([np.cos(seen[:, 5]), np.sin(seen[:, 5])], 1), 1), -1, 1)
    )
    assert np.degrees(off).max() < 60 and np.degrees(np.median(off)) < 30

    # No ground at its sides is as high as the eye.
    aside = np.stack([-way[:, 1], way[:, 0]], 1)
    for side in (-2.0, 2.0):
        at = seen[:, :2] + side * aside
        assert (field.height(*at.T) > np.maximum(seen[:, 2], 6.4 + 1.5)).mean() < 0.01
