"""The soft light on the statue's vertices: what blocks it, and where it comes from."""

import numpy as np

from landscape.hall.statue_light import brightness, directions, soft_light

UP = np.array([[0.0, 1.0, 0.0]])


def plate(height: float, half: float) -> tuple[np.ndarray, np.ndarray]:
    """Return points and normals (n, 3) of a level square that faces up."""
    x, z = np.meshgrid(np.linspace(-half, half, 40), np.linspace(-half, half, 40))
    points = np.stack([x.ravel(), np.full(x.size, height), z.ravel()], axis=1)
    return points, np.repeat(UP, len(points), axis=0)


def test_directions_are_unit_vectors_that_cancel_each_other() -> None:
    ways = directions()
    np.testing.assert_allclose(np.linalg.norm(ways, axis=1), 1.0)
    assert np.abs(ways.mean(axis=0)).max() < 0.02


def test_a_free_plate_has_nearly_all_light_and_one_that_faces_the_plinth_has_none() -> None:
    points, up = plate(0.0, 0.4)
    free = soft_light(points, up, -5.0)
    assert free.min() > 0.8 and free.max() <= 1.0, "cells of the plate itself block flat rays"
    below = soft_light(points, -up, -0.05)
    assert below.max() == 0.0


def test_what_stands_over_a_place_takes_its_light() -> None:
    low, up = plate(0.0, 0.4)
    roof, _ = plate(0.3, 0.4)
    both = soft_light(np.concatenate([low, roof]), np.concatenate([up, up]), -5.0)
    middle = np.abs(low[:, [0, 2]]).max(axis=1) < 0.1
    assert both[: len(low)][middle].max() < 0.5 and both[len(low) :].min() > 0.8


def test_more_light_comes_from_the_windows_in_the_east_than_from_the_west_or_the_floor() -> None:
    east, west, floor = brightness(np.array([(1.0, 0.0, 0.0), (-1.0, 0.0, 0.0), (0.0, -1.0, 0.0)]))
    assert east > 2 * west > 2 * floor
