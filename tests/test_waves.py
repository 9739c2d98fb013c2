"""The sea's waves: slopes that fit the heights, unit normals, and where the mirror is looked up."""

import math

import numpy as np
import pytest
from seaside import LEVEL, POSE, grid_at

from landscape.elements.best.sea import waves
from landscape.frame import Pose


def test_slopes_are_the_derivatives_of_the_height(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(waves, "LIFTING", len(waves.WAVES))
    step = 1e-3
    x, z = np.meshgrid(np.linspace(3, 4, 40), np.linspace(8, 9, 40))
    cell = np.zeros(40)

    def height(dx: float, dz: float) -> np.ndarray:
        return waves.waves((x + dx).astype(np.float32), (z + dz).astype(np.float32), cell, 1.7)[0]

    _, slope_x, slope_z = waves.waves(x.astype(np.float32), z.astype(np.float32), cell, 1.7)
    by_x = (height(step, 0) - height(-step, 0)) / (2 * step)
    by_z = (height(0, step) - height(0, -step)) / (2 * step)
    assert np.abs(by_x - slope_x).max() < 0.01 and np.abs(by_z - slope_z).max() < 0.01
    assert slope_x.std() > 0.01 and slope_z.std() > 0.01


@pytest.mark.parametrize("t", [0.0, 1.7, 900.0])
def test_all_waves_computed_at_once_equal_their_sum(t: float) -> None:
    grid = grid_at()
    fast = waves.waves(grid.x, grid.z, grid.cell, t)
    plain = waves.waves_one_by_one(grid.x.astype(float), grid.z.astype(float), grid.cell, t)
    for got, wanted in zip(fast, plain, strict=True):
        assert got.dtype == np.float32
        assert np.abs(got - wanted).max() < 0.002 * np.abs(wanted).max()


def test_normals_stand_at_right_angles_to_the_slopes() -> None:
    slope_x, slope_z = np.array([[0.3, -0.1]], np.float32), np.array([[0.2, 0.0]], np.float32)
    normals = waves.surface_normals(slope_x, slope_z)
    assert np.allclose(np.linalg.norm(normals, axis=1), 1.0)
    assert normals[0] @ (1, 0.3, 0) == pytest.approx(0, abs=1e-6)
    assert normals[0] @ (0, 0.2, 1) == pytest.approx(0, abs=1e-6)


def test_far_water_is_calmer_and_a_wave_is_about_a_hundredth_of_a_unit_high() -> None:
    grid = grid_at(Pose(20, 1.1, 30, 0, -12))
    lift, slope_x, slope_z = waves.waves(grid.x, grid.z, grid.cell, 0.4)
    steep = np.hypot(slope_x, slope_z)
    assert steep[grid.ring > 30].max() < 0.2 * steep[grid.ring < 2].max()
    assert 0.004 < np.abs(lift).max() < 0.03


def test_flat_water_looks_up_its_own_place_and_a_tilt_moves_it_by_twice_the_angle() -> None:
    grid = grid_at(Pose(20, 1.6, 30, 0, -20))
    flat, y = np.zeros(grid.x.shape, np.float32), np.full(grid.x.shape, LEVEL, np.float32)
    own = np.stack([grid.x.ravel(), y.ravel(), grid.z.ravel()], axis=1)
    assert np.allclose(waves.mirror_places(grid, y, flat, flat), own, atol=1e-5)
    # All facets lean to the viewer, who looks north: height grows with -z in the middle column.
    lean = waves.mirror_places(grid, y, flat, flat - 0.01).reshape(*grid.x.shape, 3)
    column = int(np.argmin(np.abs(grid.east)))
    near = grid.ring < 5
    away = np.hypot(grid.ring, grid.height)[near]
    sunk = lean[near, column, 1] - LEVEL
    assert np.allclose(sunk / away, -2 * waves.MIRRORED * 0.01, rtol=0.01)
    # Facets that lean to the west: the image moves west, as far as the height of the eye allows.
    lean = waves.mirror_places(grid, y, flat + 0.01, flat).reshape(*grid.x.shape, 3)
    aside = (lean[..., 0] - grid.x)[near, column]
    assert np.allclose(aside, -2 * waves.MIRRORED * 0.01 * grid.height, rtol=0.02)


def test_a_facet_that_leans_towards_the_viewer_reflects_less() -> None:
    grid = grid_at(POSE)
    flat = np.zeros(grid.x.shape, np.float32)
    away = np.hypot(grid.ring, grid.height)
    level = waves.facing(grid, flat, flat)[:, 3]
    assert np.allclose(level[grid.ring < 0.3], (grid.height / away)[grid.ring < 0.3], atol=1e-3)
    assert level[0] > waves.ROUGH / 2, "of the far sea one sees facets that lean towards the eye"
    leaning = waves.facing(grid, 0.05 * np.broadcast_to(grid.east, flat.shape), 0.05 * grid.south)
    assert (leaning >= waves.facing(grid, flat, flat)).all()


def test_the_water_is_more_opaque_from_above_than_at_a_grazing_angle() -> None:
    cosine = np.array([1.0, math.sqrt(0.5), 0.3, 0.0])
    alpha = waves.opacity(cosine, 0.8)
    assert alpha[0] == pytest.approx(0.8)
    assert alpha[1] == pytest.approx(
        0.8 * (1 - waves.CLEARED * (1 - math.sqrt(0.5)) ** waves.FRESNEL_POWER)
    )
    assert alpha[3] == pytest.approx(0.8 * (1 - waves.CLEARED))
    assert (np.diff(alpha) < 0).all()


def test_rows_of_the_sea_that_are_very_far_apart_have_no_waves_and_overflow_nothing() -> None:
    # From an eye 10^8 units high; pytest turns a warning of overflow into an error.
    slopes = waves.damped_slopes(np.array([0.01, 1e9, 1e30], np.float32))
    assert np.isfinite(slopes).all() and slopes[..., 0].any() and not slopes[..., 1:].any()


def test_no_wave_moves_the_mirror_image_by_as_much_as_a_fold() -> None:
    grid = grid_at(Pose(20, 0.71, 30, 0, -8))
    moved = waves.unfolded(grid)
    assert moved.shape == (len(waves.WAVES), len(grid.ring)) and (moved <= 1).all()
    assert (moved > 0.9).any() and (moved < 0.1).any()
    # One wave alone, straight ahead: the image may be compressed, but its order stays.
    depression = np.linspace(0.03, 0.5, 4000)
    ring = grid.height / np.tan(depression)
    for number, steep, wave in zip(waves.NUMBERS, waves.STEEP, moved, strict=True):
        slope = np.interp(ring, grid.ring[::-1], wave[::-1]) * steep
        shift = 2 * waves.MIRRORED * slope * np.cos(number * ring)
        assert (np.diff(depression + shift) > 0).mean() > 0.97


def test_the_factors_of_the_movement_weigh_the_slopes_of_each_wave() -> None:
    grid = grid_at()
    ones = np.ones((len(waves.WAVES), len(grid.ring)), np.float32)
    _, slope_x, slope_z, same_x, same_z = waves.waves(grid.x, grid.z, grid.cell, 0.3, ones)
    assert np.allclose(slope_x, same_x) and np.allclose(slope_z, same_z)
    none = waves.waves(grid.x, grid.z, grid.cell, 0.3, 0 * ones)
    assert (none[3] == 0).all() and (none[1] == slope_x).all()
