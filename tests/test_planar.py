"""The planar shadow matrix: on the plane, on the light's ray, and nothing where no shadow falls."""

import numpy as np
import pytest

from landscape.geometry.planar import shadow_matrix, shadows_of

RNG = np.random.default_rng(7)
PLANES = [
    np.array([0.0, 1.0, 0.0, 0.0]),
    np.array([0.0, 0.0, 1.0, -0.4]),
    np.array([0.6, 0.8, 0.0, -1.5]),
    np.array([2.0, -1.0, 0.5, 3.0]),
]


def in_front(plane: np.ndarray, least: float, most: float) -> np.ndarray:
    """Return 50 points (50, 3) between two values of p . v."""
    points = RNG.uniform(-3, 3, (50, 3))
    wanted = RNG.uniform(least, most, 50)
    normal = plane[:3]
    return np.asarray(
        points + ((wanted - points @ normal - plane[3]) / (normal @ normal))[:, None] * normal
    )


@pytest.mark.parametrize("plane", PLANES, ids=["floor", "wall", "slanted", "not unit"])
@pytest.mark.parametrize("w", [0.0, 1.0], ids=["directional", "point"])
def test_a_shadow_lies_on_the_plane_and_on_the_ray_from_the_light_through_the_point(
    plane: np.ndarray, w: float
) -> None:
    light = np.append(in_front(plane, 4.0, 5.0)[0], 1.0) if w else np.append(plane[:3], 0.0)
    light[:3] += (0.0, 0.0, 0.0) if w else (0.1, 0.2, -0.1)
    points = in_front(plane, 0.1, 3.0)
    shadows = shadows_of(points, plane, light)
    assert not np.isnan(shadows).any()
    assert np.abs(shadows @ plane[:3] + plane[3]).max() < 1e-9
    ray = points - light[:3] if w else np.broadcast_to(-light[:3], points.shape)
    assert np.abs(np.cross(ray, shadows - points)).max() < 1e-8
    assert (np.einsum("ij,ij->i", ray, shadows - points) > 0).all(), "beyond it, from the light"


@pytest.mark.parametrize("plane", PLANES, ids=["floor", "wall", "slanted", "not unit"])
def test_the_light_itself_and_what_is_beyond_it_cast_no_shadow(plane: np.ndarray) -> None:
    light = np.append(in_front(plane, 2.0, 2.1)[0], 1.0)
    assert np.abs(shadow_matrix(plane, light) @ light).max() < 1e-12
    assert np.isnan(shadows_of(in_front(plane, 2.5, 9.0), plane, light)).all()
    assert not np.isnan(shadows_of(in_front(plane, 0.1, 1.9), plane, light)).any()


def test_a_light_at_infinity_behind_the_plane_casts_no_shadow() -> None:
    floor, below = PLANES[0], np.array([0.3, -0.5, 0.1, 0.0])
    assert np.isnan(shadows_of(RNG.uniform(0.1, 2, (9, 3)), floor, below)).all()
    assert not np.isnan(shadows_of(RNG.uniform(0.1, 2, (9, 3)), floor, -below)).any()


def test_the_sun_s_shadow_on_the_floor_is_the_height_times_the_cotangent_away() -> None:
    sun = np.array([1.0, 1.0, 0.0, 0.0])
    assert shadows_of(np.array([[2.0, 0.7, 3.0]]), PLANES[0], sun)[0] == pytest.approx(
        [1.3, 0.0, 3.0]
    )
