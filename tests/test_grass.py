"""Grass: the report's blades and wind, the same lot whichever way one walks, culling that loses
no blade, and a blade where projection puts it."""

import math
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest
from landscape.elements.sprites.sprite_quads import sway
from stage import Stage, close, pixel, project, small

from landscape.elements.grass import CELL, Grass, cells_around, greenness, visible_cells
from landscape.elements.ground import Ground
from landscape.elements.meadow.blades import (
    COORDINATES,
    DENSE,
    NEAR,
    STRIP_TRIANGLES,
    Patch,
    blade_tints,
    blade_vertices,
    blade_wind,
    drawn_at,
    nearness,
)
from landscape.files.assets import Assets
from landscape.frame import Frame, Pose
from landscape.geometry.height_field import HeightField
from landscape.settings import Settings

ORIGIN = np.zeros((1, 3))


def test_a_blade_at_angle_0_is_the_reports_strip() -> None:
    blade = blade_vertices(ORIGIN, np.zeros(1))[0]
    wanted = [
        (-0.003, 0, 0),
        (0.003, 0, 0),
        (-0.0015, 0.015, 0),
        (0.0015, 0.015, 0),
        (0, 0.02, 0.004),
    ]
    assert np.allclose(blade, wanted, atol=1e-8)


def test_a_blade_at_60_degrees_stands_where_sine_and_cosine_say() -> None:
    blade = blade_vertices(np.array([[1.0, 2.0, 3.0]]), np.array([math.pi / 3]))[0]
    c, s = 0.5, math.sqrt(0.75)
    wanted = [
        (1 - 0.003 * c, 2, 3 - 0.003 * s),
        (1 + 0.003 * c, 2, 3 + 0.003 * s),
        (1 - 0.0015 * c, 2.015, 3 - 0.0015 * s),
        (1 + 0.0015 * c, 2.015, 3 + 0.0015 * s),
        (1 + 0.004 * s, 2.02, 3 + 0.004 * c),
    ]
    assert np.allclose(blade, wanted, atol=1e-6)


def test_the_scale_stretches_x_and_z_by_its_first_and_y_by_its_second_number() -> None:
    angles = np.array([0.7])
    once, scaled = blade_vertices(ORIGIN, angles)[0], blade_vertices(ORIGIN, angles, (2, 3))[0]
    assert np.allclose(scaled, once * (2, 3, 2))


def test_the_strip_is_three_triangles_of_one_winding() -> None:
    # As a GL_TRIANGLE_STRIP: 0 1 2, then 2 1 3, then 2 3 4.
    assert STRIP_TRIANGLES.tolist() == [0, 1, 2, 2, 1, 3, 2, 3, 4]
    blade = blade_vertices(ORIGIN, np.zeros(1))[0]
    a, b, c = (blade[STRIP_TRIANGLES.reshape(-1, 3)[:, k]] for k in range(3))
    assert (np.cross(b - a, c - a)[:, 2] > 0).all()


def test_the_texture_coordinates_are_the_reports() -> None:
    wanted = [(0, 1), (1, 1), (0.2, 0.3), (0.8, 0.3), (0.5, 0)]
    assert np.allclose(COORDINATES, wanted)


def test_the_wind_is_a_fifth_of_the_plants() -> None:
    places = np.array([(0.0, 1.0, 0.0), (3.0, 1.0, 2.0)])
    assert blade_wind(0.0, places, 1.0)[0] == pytest.approx([0.01, 0.006])
    assert np.allclose(blade_wind(13.0, places, 1.0), sway(13.0, places) / 5)
    assert np.allclose(blade_wind(13.0, places, 1.5), sway(13.0, places) * 0.3)


def flat(height: float = 3.0) -> Ground:
    """A ground of one height and one green, without OpenGL."""
    field = HeightField(np.full((5, 5), height, np.float32), 40.0, 0.6)

    def colour(x: np.ndarray, z: np.ndarray) -> np.ndarray:
        green = np.where(np.asarray(x) < 20, 0.5, 0.2)  # green in the west, grey in the east
        return np.stack([np.full_like(green, 0.2), green, np.full_like(green, 0.2)], axis=1)

    def light(x: np.ndarray, z: np.ndarray) -> np.ndarray:
        return np.where(np.asarray(z) < 20, 1.0, 0.5)  # shadow in the south

    return cast(Ground, SimpleNamespace(field=field, colour=colour, light=light))


def sow(ground: Ground | None = None, seed: int = 7, **changes: Any) -> Grass:
    """Return the grass of a flat island without its texture."""
    grass = Grass.__new__(Grass)
    keys = {f"grass.{key}": value for key, value in changes.items()}
    grass._settings = small({"grass.count": 50_000, "castle.x": -900, **keys})
    grass._ground, grass._seed = ground or flat(), seed
    grass._across = int(np.ceil(40.0 / CELL))
    grass._patches, grass._grown, grass._ends = {}, 0, (np.full(3, 0.4), np.full(3, 0.4))
    grass._in_view, grass._chosen, grass._chosen_for = 0, None, None
    grass.counts = grass._share()
    grass._shared = grass.counts.copy()
    return grass


def all_blades(grass: Grass, cells: Any = None) -> list[Patch]:
    return [grass._patch(int(c)) for c in (range(len(grass.counts)) if cells is None else cells)]


def test_the_cells_bear_as_many_blades_as_asked_for() -> None:
    grass = sow()
    assert grass.counts.sum() == 50_000
    assert sum(len(patch.blades) for patch in all_blades(grass)) == 50_000


def test_blades_are_spread_evenly_over_flat_land() -> None:
    counts = sow(count=1_000_000).counts
    assert len(counts) == 6400
    assert np.abs(counts - 1e6 / 6400).max() < 6 * math.sqrt(1e6 / 6400)


def test_a_cells_blades_stand_in_the_cell_and_on_the_ground() -> None:
    grass = sow()
    for cell in (0, 79, 3210, 6399):
        row, column = divmod(cell, 80)
        x, y, z = grass._patch(cell).positions.T
        assert (np.floor(x / CELL) == column).all() and (np.floor(z / CELL) == row).all()
        assert np.allclose(y, 3.0)


def test_the_same_grass_grows_whichever_way_the_cells_are_visited() -> None:
    cells = [812, 3, 4000, 3999]
    there, back = sow(), sow()
    forth = all_blades(there, cells)
    again = all_blades(back, cells[::-1])[::-1]
    for one, two in zip(forth, again, strict=True):
        assert (one.blades == two.blades).all() and (one.tints == two.tints).all()


def test_another_seed_grows_other_grass() -> None:
    one, two = sow(seed=7)._patch(3210), sow(seed=8)._patch(3210)
    assert one.positions.shape != two.positions.shape or (one.positions != two.positions).any()


def test_no_blade_stands_in_the_water_and_a_drowned_island_bears_none() -> None:
    at = np.linspace(0, 6, 40, dtype=np.float32)
    slope = HeightField(np.repeat(at[None, :], 40, axis=0), 40.0, 3.0)
    ground = cast(Ground, SimpleNamespace(field=slope))
    grass = sow(ground)
    assert grass.counts.sum() == 50_000
    for patch in all_blades(grass, np.flatnonzero(grass.counts)[::50]):
        assert (patch.positions[:, 1] > 3.0).all()
    assert sow(flat(0.1)).counts.sum() == 0


def test_tinted_grass_keeps_to_green_ground_and_takes_its_colour() -> None:
    grass = sow(tinted=True, count=20_000)
    counts = grass.counts.reshape(80, 80)
    assert counts[:, 40:].sum() == 0 and counts[:, :40].sum() == 20_000
    tints = grass._patch(805).tints
    assert (tints[..., 1] > tints[..., 0]).all() and (tints[..., 3] == 255).all()


def test_greenness_is_0_for_rock_and_1_for_a_meadow() -> None:
    colours = [(0.5, 0.5, 0.5), (0.82, 0.76, 0.62), (0.2, 0.5, 0.1), (0.358, 0.4, 0.358)]
    assert greenness(np.array(colours)) == pytest.approx([0.0, 0.0, 1.0, 0.5])


def test_a_blade_is_darker_at_its_foot() -> None:
    tints = blade_tints(np.array([(0.2, 0.4, 0.1)]), np.random.default_rng(0))[0].astype(float)
    assert (tints[:2] < 0.9 * tints[4]).all()
    assert (tints[0] == tints[1]).all() and (tints[2] == tints[4]).all()
    assert tints[4, 1] / tints[4, 0] == pytest.approx(2.0, abs=0.05)


def test_all_cells_within_the_radius_are_looked_at_and_none_off_the_map() -> None:
    rng = np.random.default_rng(5)
    for x, z in [(20.0, 20.0), (0.1, 39.9), (-3.0, 12.0), (33.3, 7.7)]:
        cells = {tuple(cell) for cell in cells_around(x, z, 4.0, 80).tolist()}
        points = rng.random((4000, 2)) * 40
        near = points[np.hypot(points[:, 0] - x, points[:, 1] - z) < 4.0]
        assert {tuple(p) for p in np.floor(near / CELL).astype(int).tolist()} <= cells
        assert all(0 <= c < 80 and 0 <= r < 80 for c, r in cells)
    assert len(cells_around(500.0, 500.0, 4.0, 80)) == 0


def modelview(pose: Pose) -> np.ndarray:
    yaw = math.radians(pose.yaw)
    right, ahead = np.array([math.cos(yaw), 0.0, math.sin(yaw)]), np.array(pose.forward)
    matrix = np.eye(4)
    matrix[:3, :3] = right, np.cross(right, ahead), -ahead
    matrix[:3, 3] = -matrix[:3, :3] @ (pose.x, pose.y, pose.z)
    return matrix.T.ravel()


@pytest.mark.parametrize("yaw", [0.0, 45.0, 200.0])
@pytest.mark.parametrize("pitch", [0.0, -35.0, 20.0, -89.0])
def test_no_cell_that_shows_a_blade_on_the_screen_is_left_out(yaw: float, pitch: float) -> None:
    pose = Pose(20.2, 3.1, 19.9, yaw, pitch)
    frame = Frame(pose, (160, 120), 0.0, modelview(pose), 60.0)
    points = np.random.default_rng(6).random((20_000, 2)) * 9 + 15.5
    points = np.insert(points, 1, 3.0 + 0.02, axis=1)
    away = points - frame.eye
    depth = away @ np.array(pose.forward)
    reach = math.tan(math.radians(30)) * depth
    on_screen = (
        (depth > 0.02)
        & (np.abs(away @ frame.right) <= reach * 160 / 120)
        & (np.abs(away @ frame.up) <= reach)
        & (np.hypot(away[:, 0], away[:, 2]) < 4.0)
    )
    assert on_screen.any() or pitch > 0
    cells = np.unique(np.floor(points[on_screen][:, ::2] / CELL).astype(int), axis=0)
    centres = np.insert((cells + 0.5) * CELL, 1, 3.0, axis=1)
    assert visible_cells(frame, centres, 4.0).all()


def test_cells_behind_or_beyond_the_radius_are_left_out() -> None:
    pose = Pose(20.0, 3.1, 20.0, 0.0, 0.0)
    frame = Frame(pose, (160, 120), 0.0, modelview(pose), 60.0)
    centres = np.array([(20.0, 3.0, 23.0), (20.0, 3.0, 14.0), (20.0, 3.0, 17.0), (24.0, 3, 19.5)])
    assert visible_cells(frame, centres, 4.0).tolist() == [False, False, True, False]


def frame_at(pose: Pose, kt: float = 0.0) -> Frame:
    return Frame(pose, (160, 120), kt, modelview(pose), 60.0)


def test_the_wind_moves_tips_fully_shoulders_half_and_feet_not_at_all() -> None:
    grass = sow()
    frame = frame_at(Pose(20.0, 3.1, 20.0), kt=17.0)
    patch = grass.select(frame)
    moved = grass.bend(frame, patch) - patch.blades
    wind = blade_wind(17.0, patch.positions, 1.0)
    assert np.allclose(moved[:, :2], 0.0)
    assert np.allclose(moved[:, 2, ::2], wind / 2, atol=1e-5)
    assert np.allclose(moved[:, 3, ::2], wind / 2, atol=1e-5)
    assert np.allclose(moved[:, 4, ::2], wind, atol=1e-5)
    assert np.allclose(moved[..., 1], 0.0)


def test_bending_does_not_wear_the_still_blades_out() -> None:
    grass = sow()
    frame = frame_at(Pose(20.0, 3.1, 20.0), kt=17.0)
    first = grass.bend(frame, grass.select(frame))
    second = grass.bend(frame, grass.select(frame))
    assert (first == second).all()


def test_with_fade_far_cells_are_thinned_and_far_blades_shrink() -> None:
    grass = sow(fade=True, count=2_000_000)
    frame = frame_at(Pose(20.0, 3.1, 20.0))
    patch = grass.select(frame)
    blades, places = grass.bend(frame, patch), patch.positions
    away = np.hypot(places[:, 0] - 20, places[:, 2] - 20)
    reach, still = 4.0 * patch.reach, patch.blades[:, 4, 1] - 3.0
    part = (blades[:, 4, 1] - 3.0) / still
    # Whole up to three quarters of its reach, then down to nothing at its end.
    assert np.allclose(part, np.clip((reach - away) / (reach / 4), 0.0, 1.0), atol=1e-3)
    assert (part[away < 0.2] > 0.99).all() and part.min() < 0.2
    assert (away > 2.0).any() and still.min() > 0.005
    ahead = {cell: len(grass._patch(cell).blades) for cell in (34 * 80 + 40,)}
    for cell, whole in ahead.items():
        middle = np.array([(cell % 80 + 0.5) * CELL, (cell // 80 + 0.5) * CELL])
        drawn = (np.abs(places[:, ::2] - middle) < CELL / 2).all(axis=1).sum()
        assert 0 < drawn < whole


def test_without_fade_every_blade_of_a_visible_cell_is_sent() -> None:
    grass = sow()
    places = grass.select(frame_at(Pose(20.0, 3.1, 20.0))).positions
    column, row = np.floor(places[:, ::2] / CELL).astype(int).T
    numbers, counts = np.unique(row * 80 + column, return_counts=True)
    assert len(numbers) > 10
    assert (counts == grass.counts[numbers]).all()


@pytest.mark.parametrize("fade", [True, False])
def test_a_choice_that_is_kept_shows_what_a_new_one_would(fade: bool) -> None:
    grass, other = (sow(fade=fade, count=200_000) for _ in range(2))
    start = Pose(20.0, 3.1, 20.0, 10.0, -5.0)
    kept = grass.chosen(frame_at(start))
    for step in range(1, 6):
        pose = Pose(20.0 + 0.01 * step, 3.1, 20.0 - 0.01 * step, 10.0 + 0.5 * step, -5.0)
        frame = frame_at(pose, kt=3.0 * step)
        assert (grass.chosen(frame) is kept) == (fade and step <= 4)
        seen, anew = (
            {b.tobytes() for b in g.bend(frame, p) if np.ptp(b[:, 1]) > 0}
            for g, p in ((grass, grass.chosen(frame)), (other, other.select(frame)))
        )
        assert anew <= seen
        if fade:
            shown = grass.chosen(frame).positions
            away = np.hypot(shown[:, 0] - pose.x, shown[:, 2] - pose.z)
            flat = np.ptp(grass.bend(frame, grass.chosen(frame))[..., 1], axis=1) == 0
            assert flat[away > 4.0 * grass.chosen(frame).reach].all()
    far = frame_at(Pose(20.3, 3.1, 20.0, 10.0, -5.0))
    assert grass.chosen(far) is not kept


def test_other_settings_or_another_window_are_chosen_for_anew() -> None:
    grass, pose = sow(fade=True, count=200_000), Pose(20.0, 3.1, 20.0)
    kept = grass.chosen(frame_at(pose))
    assert grass.chosen(frame_at(pose)) is kept
    wide = Frame(pose, (320, 120), 0.0, modelview(pose), 60.0)
    assert grass.chosen(wide) is not kept
    kept = grass.chosen(wide)
    grass._settings = small({"grass.fade": True, "grass.radius": 3.0})
    assert grass.chosen(wide) is not kept


@pytest.fixture
def field_of_grass(stage: Stage, plain: Assets):
    """Grass with its texture on the plain island (height 3), released after the test."""
    settings = small()
    ground = Ground(settings, plain, np.array([0, 1, 0], np.float32))
    grass = Grass(settings, plain, ground, 7)
    yield settings, grass
    stage.enter()
    grass.release()
    ground.release()


def one_blade(place: tuple[float, float, float], angle: float) -> Patch:
    positions = np.array([place], np.float32)
    blades = blade_vertices(positions, np.array([angle]))
    tints = np.full((1, 5, 4), 255, np.uint8)
    return Patch(positions, blades, tints, np.ones(1, np.float32))


@pytest.mark.parametrize("kt", [0.0, 40.0])
def test_a_blade_is_drawn_where_projection_and_wind_put_it(
    stage: Stage, field_of_grass: tuple[Settings, Grass], monkeypatch, kt: float
) -> None:
    settings, grass = field_of_grass
    place = (20.0, 3.0, 19.94)
    monkeypatch.setattr(grass, "chosen", lambda frame: one_blade(place, 0.0))
    pose = Pose(20.0, 3.01, 20.0)
    with stage.frame(settings, pose, kt) as frame:
        grass.draw(frame)
        picture = stage.read()
    dx, dz = blade_wind(kt, np.array([place]), 1.0)[0]
    x, y, z = place
    green = (40, 220, 60)
    middle = (x + dx / 2, y + 0.0149, z + dz / 2)  # between the shoulders
    assert close(pixel(picture, project(pose, (x, y + 0.002, z))), green)
    assert close(pixel(picture, project(pose, middle)), green)
    below_tip = (x + 0.9 * dx, y + 0.019, z + 0.9 * dz + 0.0033)
    column, row = (int(v) for v in project(pose, below_tip))
    assert (np.abs(picture[row - 1 : row + 2, column - 1 : column + 2] - green) <= 1).all(-1).any()
    width = 0.006 / (0.06 * 2 * math.tan(math.radians(30))) * 120
    foot = int(project(pose, (x, y + 0.0005, z))[1])
    got = int((np.abs(picture[foot] - green) <= 1).all(axis=1).sum())
    assert got == pytest.approx(width, abs=1.5)
    above = project(pose, (x + dx, y + 0.0225, z + dz + 0.004))
    assert close(pixel(picture, above), np.array([0.4, 0.6, 0.7]) * 255)


def test_no_grass_in_view_draws_nothing(
    stage: Stage, field_of_grass: tuple[Settings, Grass]
) -> None:
    settings, grass = field_of_grass
    with stage.frame(settings, Pose(500.0, 3.0, 500.0)) as frame:
        grass.draw(frame)
        assert close(stage.read(), np.array([0.4, 0.6, 0.7]) * 255)


def test_cells_not_used_for_long_are_forgotten_and_grow_again_the_same(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    grass = sow(fade=True)
    first = all_blades(grass)
    counts = grass.counts.copy()
    monkeypatch.setattr("landscape.elements.grass.LEAST", 1000)
    grass._in_view = 0
    grass._forget()
    assert grass._grown == sum(len(p.positions) for p in grass._patches.values()) <= 1000
    assert max(grass._patches) == len(counts) - 1, "the last used stay"
    again = all_blades(grass)
    assert all(np.array_equal(a.blades, b.blades) for a, b in zip(first, again, strict=True))
    assert np.array_equal(grass.counts, counts)


def test_tinted_blades_in_the_shadow_are_darker() -> None:
    grass = sow(tinted=True)
    across = int(np.sqrt(len(grass.counts)))
    north, south = (
        grass._patch(row * across + across // 4) for row in (across // 4, 3 * across // 4)
    )
    assert south.tints[..., 1].mean() == pytest.approx(0.5 * north.tints[..., 1].mean(), rel=0.1)


def test_a_sparse_meadow_is_thinned_out_later_and_shows_less_all_the_same() -> None:
    assert nearness(DENSE) == nearness(10 * DENSE) == NEAR
    near = [nearness(density) for density in (DENSE / 64, DENSE / 8, DENSE)]
    assert near == sorted(near, reverse=True) and near[0] > 2 * NEAR
    # Of as many square units: blades drawn up to 2 units away, at 1 and at 8 times the density.
    few, many = (drawn_at(count, near_, 2.0) for count, near_ in ((1000, near[0]), (8000, near[1])))
    assert few < many < 3 * few
