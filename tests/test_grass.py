"""Grass: the report's blades and wind, the same blades whichever way one walks, cells that lose
no blade, and a blade where projection puts it."""

import math
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest
from flat_land import flat, grass_settings
from sprite_stage import looking
from stage import Stage, close, pixel, project, small, taken

from framelens.base.errors import InputError
from framelens.gl.seam import recording
from landscape.elements import grass as grass_module
from landscape.elements.best.meadow.meadow import Meadow
from landscape.elements.grass import (
    COORDINATES,
    STRIP_TRIANGLES,
    Blades,
    Grass,
    bent,
    blade_corners,
    blade_vertices,
    blade_wind,
    check_loop,
    send_one_by_one,
)
from landscape.elements.grass_cells import CELL, cells_around, shared_out, visible_cells
from landscape.elements.ground import Ground
from landscape.elements.settings import Settings, preset
from landscape.elements.transparent_elements import visible
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.geometry.height_field import HeightField, greenness
from landscape.geometry.wind import sway

ORIGIN = np.zeros((1, 3))
NORTH = Pose(20.0, 3.1, 20.0)


def test_a_blade_at_angle_0_is_the_reports_strip() -> None:
    blade = blade_vertices(ORIGIN, blade_corners(np.zeros(1)))[0]
    expected = [
        (-0.003, 0, 0),
        (0.003, 0, 0),
        (-0.0015, 0.015, 0),
        (0.0015, 0.015, 0),
        (0, 0.02, 0.004),
    ]
    assert np.allclose(blade, expected, atol=1e-8)


def test_a_blade_at_60_degrees_stands_where_sine_and_cosine_say() -> None:
    blade = blade_vertices(np.array([[1.0, 2.0, 3.0]]), blade_corners(np.array([math.pi / 3])))[0]
    c, s = 0.5, math.sqrt(0.75)
    expected = [
        (1 - 0.003 * c, 2, 3 - 0.003 * s),
        (1 + 0.003 * c, 2, 3 + 0.003 * s),
        (1 - 0.0015 * c, 2.015, 3 - 0.0015 * s),
        (1 + 0.0015 * c, 2.015, 3 + 0.0015 * s),
        (1 + 0.004 * s, 2.02, 3 + 0.004 * c),
    ]
    assert np.allclose(blade, expected, atol=1e-6)


def test_the_scale_stretches_x_and_z_by_its_first_and_y_by_its_second_number() -> None:
    corners = blade_corners(np.array([0.7]))
    once, scaled = (blade_vertices(ORIGIN, corners, scale)[0] for scale in ((1, 1), (2, 3)))
    assert np.allclose(scaled, once * (2, 3, 2))


def test_the_strip_is_three_triangles_of_one_winding() -> None:
    # As a GL_TRIANGLE_STRIP: 0 1 2, then 2 1 3, then 2 3 4.
    assert STRIP_TRIANGLES.tolist() == [0, 1, 2, 2, 1, 3, 2, 3, 4]
    blade = blade_vertices(ORIGIN, blade_corners(np.zeros(1)))[0]
    a, b, c = (blade[STRIP_TRIANGLES.reshape(-1, 3)[:, k]] for k in range(3))
    assert (np.cross(b - a, c - a)[:, 2] > 0).all()


def test_the_texture_coordinates_are_the_reports() -> None:
    expected = [(0, 1), (1, 1), (0.2, 0.3), (0.8, 0.3), (0.5, 0)]
    assert np.allclose(COORDINATES, expected)


def test_the_wind_is_a_fifth_of_the_plants_sway() -> None:
    places = np.array([(0.0, 1.0, 0.0), (3.0, 1.0, 2.0)])
    assert blade_wind(0.0, places, 1.0)[0] == pytest.approx([0.01, 0.006])
    assert np.allclose(blade_wind(13.0, places, 1.0), sway(13.0, places) / 5)
    assert np.allclose(blade_wind(13.0, places, 1.5), sway(13.0, places) * 0.3)


def test_the_wind_moves_tips_fully_shoulders_half_and_feet_not_at_all() -> None:
    places = (np.random.default_rng(1).random((200, 3)) * 40).astype(np.float32)
    blades = Blades(places, blade_vertices(places, blade_corners(np.linspace(0, 6, 200))))
    still = blades.vertices.copy()
    moved = bent(blades, 17.0, 1.5) - still
    wind = blade_wind(17.0, places, 1.5)
    assert np.allclose(moved[:, :2], 0.0) and np.allclose(moved[..., 1], 0.0)
    assert np.allclose(moved[:, 2, ::2], wind / 2, atol=1e-5)
    assert np.allclose(moved[:, 3, ::2], wind / 2, atol=1e-5)
    assert np.allclose(moved[:, 4, ::2], wind, atol=1e-5)
    assert (blades.vertices == still).all(), "bending leaves the still blades as they are"


@pytest.fixture
def sow(stage: Stage, plain: Assets):
    """A function that returns the grass of a flat island, released after the test."""
    made = []

    def grown(ground: Ground | None = None, seed: int = 7, **changes: Any) -> Grass:
        made.append(Grass(grass_settings(**changes), plain, ground or flat(), seed))
        return made[-1]

    yield grown
    stage.enter()
    for grass in made:
        grass.release()


def everything(grass: Grass, across: int = 80) -> Blades:
    """Return all blades of an island of ``across`` x ``across`` cells."""
    cells = [grass.cell(number) for number in range(across**2)]
    return Blades(*(np.concatenate(arrays) for arrays in zip(*cells, strict=True)))


@pytest.mark.seldom(3, first=2)
def test_as_many_blades_grow_as_asked_for(sow) -> None:
    small_land = flat(size=10.0)
    assert len(everything(sow(small_land), 20).positions) == 50_000
    assert len(everything(sow(small_land, count=0), 20).positions) == 0


@pytest.mark.seldom(13, first=10)
def test_blades_are_spread_evenly_over_flat_land(sow) -> None:
    places = everything(sow(count=200_000)).positions
    counts = np.histogram2d(places[:, 0], places[:, 2], bins=20, range=[[0, 40], [0, 40]])[0]
    assert np.abs(counts - 500).max() < 6 * math.sqrt(500)


def test_a_cells_blades_stand_in_the_cell_and_on_the_ground(sow) -> None:
    grass = sow()
    for cell in (0, 79, 3210, 6399):
        row, column = divmod(cell, 80)
        x, y, z = grass.cell(cell).positions.T
        assert (np.floor(x / CELL) == column).all() and (np.floor(z / CELL) == row).all()
        assert np.allclose(y, 3.0)


def test_the_same_grass_grows_in_whatever_order_the_cells_are_visited(sow) -> None:
    cells = [812, 3, 4000, 3999]
    there, back = sow(), sow()
    forth = [there.cell(number) for number in cells]
    again = [back.cell(number) for number in cells[::-1]][::-1]
    for one, two in zip(forth, again, strict=True):
        assert (one.positions == two.positions).all() and (one.vertices == two.vertices).all()


def test_another_seed_grows_other_grass(sow) -> None:
    one, two = (sow(seed=seed).cell(3210).positions for seed in (7, 8))
    assert one.shape != two.shape or (one != two).any()


@pytest.mark.seldom(3, first=2)
def test_no_blade_stands_in_the_water_and_a_drowned_island_bears_none(sow) -> None:
    at = np.linspace(0, 6, 40, dtype=np.float32)
    slope = HeightField(np.repeat(at[None, :], 40, axis=0), 10.0, 3.0)
    places = everything(sow(cast(Ground, SimpleNamespace(field=slope))), 20).positions
    assert len(places) == 50_000 and (places[:, 1] > 3.0).all()
    assert len(everything(sow(flat(0.1, 10.0)), 20).positions) == 0


def test_no_blade_stands_in_the_castle(stage: Stage, plain: Assets) -> None:
    settings = small({"grass.count": 5_000, "castle.x": 5.0, "castle.z": 5.0})
    grass = Grass(settings, plain, flat(size=10.0), 7)
    places = everything(grass, 20).positions
    grass.release()
    assert np.hypot(places[:, 0] - 5, places[:, 2] - 5).min() == pytest.approx(0.75, abs=0.1)


def test_greenness_is_0_for_rock_and_1_for_a_meadow() -> None:
    colours = [(0.5, 0.5, 0.5), (0.82, 0.76, 0.62), (0.2, 0.5, 0.1), (0.358, 0.4, 0.358)]
    assert greenness(np.array(colours)) == pytest.approx([0.0, 0.0, 1.0, 0.5])


def test_all_cells_within_the_radius_are_examined_and_none_off_the_map() -> None:
    rng = np.random.default_rng(5)
    for x, z in [(20.0, 20.0), (0.1, 39.9), (-3.0, 12.0), (33.3, 7.7)]:
        cells = {tuple(cell) for cell in cells_around(x, z, 4.0, 80).tolist()}
        points = rng.random((4000, 2)) * 40
        near = points[np.hypot(points[:, 0] - x, points[:, 1] - z) < 4.0]
        assert {tuple(p) for p in np.floor(near / CELL).astype(int).tolist()} <= cells
        assert all(0 <= c < 80 and 0 <= r < 80 for c, r in cells)
    assert len(cells_around(500.0, 500.0, 4.0, 80)) == 0


@pytest.mark.parametrize("yaw", [0.0, 45.0, 200.0])
@pytest.mark.parametrize("pitch", [0.0, -35.0, 20.0, -89.0])
def test_no_cell_that_shows_a_blade_on_the_screen_is_left_out(yaw: float, pitch: float) -> None:
    pose = Pose(20.2, 3.1, 19.9, yaw, pitch)
    frame = looking(pose)
    points = np.random.default_rng(6).random((20_000, 2)) * 9 + 15.5
    points = np.insert(points, 1, 3.0 + 0.02, axis=1)
    away = points - frame.eye
    depth = away @ np.array(pose.forward)
    half = math.tan(math.radians(30)) * depth
    on_screen = (
        (depth > 0.02)
        & (np.abs(away @ frame.right) <= half * 160 / 120)
        & (np.abs(away @ frame.up) <= half)
        & (np.hypot(away[:, 0], away[:, 2]) < 4.0)
    )
    assert on_screen.any() or pitch > 0
    cells = np.unique(np.floor(points[on_screen][:, ::2] / CELL).astype(int), axis=0)
    centres = np.insert((cells + 0.5) * CELL, 1, 3.0, axis=1)
    assert visible_cells(frame, centres, 4.0).all()


def test_cells_behind_or_beyond_the_radius_are_left_out() -> None:
    pose = Pose(20.0, 3.1, 20.0, 0.0, 0.0)
    frame = looking(pose)
    centres = np.array([(20.0, 3.0, 23.0), (20.0, 3.0, 14.0), (20.0, 3.0, 17.0), (24.0, 3, 19.5)])
    assert visible_cells(frame, centres, 4.0).tolist() == [False, False, True, False]


@pytest.mark.seldom(14, first=13)
def test_cells_select_every_visible_blade_that_testing_each_blade_finds(sow) -> None:
    grass = sow()
    places = everything(grass).positions
    for pose in (NORTH, Pose(12.3, 3.1, 25.1, 77.0, -20.0), Pose(1.0, 3.1, 1.0, 200.0, 10.0)):
        frame = looking(pose)
        one_by_one = places[visible(frame, places, 4.0)]
        away, half = one_by_one - frame.eye, math.tan(math.radians(30)) * 160 / 120
        in_window = np.abs(away @ frame.right) <= -frame.depth(one_by_one) * half
        plain = {place.tobytes() for place in one_by_one[in_window]}
        by_cell = {place.tobytes() for place in grass.select(frame).positions}
        assert plain <= by_cell and len(by_cell) < 0.1 * len(places)
        assert plain or pose.x == 1.0


def test_every_blade_of_a_visible_cell_is_sent(sow) -> None:
    grass = sow()
    places = grass.select(looking(NORTH)).positions
    column, row = np.floor(places[:, ::2] / CELL).astype(int).T
    numbers, counts = np.unique(row * 80 + column, return_counts=True)
    assert len(numbers) > 10
    assert [len(grass.cell(number).positions) for number in numbers] == counts.tolist()


def test_cells_long_out_of_view_are_dropped_and_regrow_identically(
    sow, monkeypatch: pytest.MonkeyPatch
) -> None:
    grown = []
    places_in = grass_module.places_in
    monkeypatch.setattr(grass_module, "places_in", lambda *a: grown.append(a[0]) or places_in(*a))
    monkeypatch.setattr(grass_module, "LEAST", 0)
    grass = sow()
    first = grass.select(looking(NORTH))
    seen = set(grown)
    again = grass.select(looking(NORTH))
    assert len(grown) == len(seen), "what stays in view is kept"
    for x in (8.0, 32.0, 8.0, 32.0, 14.0, 26.0):
        grass.select(looking(Pose(x, 3.1, 35.0)))
    grown.clear()
    after = grass.select(looking(NORTH))
    assert set(grown) == seen
    for one, two in ((first, again), (first, after)):
        assert (one.vertices == two.vertices).all()


@pytest.fixture
def field_of_grass(stage: Stage, plain: Assets):
    """Grass on the plain island (height 3), its ground, and its settings; released at the end."""
    settings = small()
    ground = Ground(settings, plain, np.array([0, 1, 0], np.float32))
    grass = Grass(settings, plain, ground, 7)
    yield settings, grass
    stage.enter()
    grass.release()
    ground.release()


@pytest.mark.parametrize("kt", [0.0, 40.0])
def test_a_blade_is_drawn_where_projection_and_wind_put_it(
    stage: Stage, field_of_grass: tuple[Settings, Grass], monkeypatch, kt: float
) -> None:
    settings, grass = field_of_grass
    place = (20.0, 3.0, 19.94)
    position = np.array([place], np.float32)
    blade = Blades(position, blade_vertices(position, blade_corners(np.zeros(1))))
    monkeypatch.setattr(grass, "_blades", lambda cells: blade)
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


def test_while_the_eye_stands_still_the_selection_is_kept_and_the_wind_blows(
    stage: Stage, field_of_grass: tuple[Settings, Grass], monkeypatch
) -> None:
    settings, grass = field_of_grass
    selected = []
    select = grass._blades
    monkeypatch.setattr(grass, "_blades", lambda group: selected.append(group) or select(group))
    pictures = []
    for pose, kt in ((NORTH, 0.0), (NORTH, 9.0), (Pose(20.0, 3.1, 20.001), 9.0)):
        with stage.frame(settings, pose, kt) as frame:
            grass.draw(frame)
            pictures.append(stage.read())
    assert len(selected) == 2
    assert (pictures[0] != pictures[1]).any()


def test_r18_the_loop_over_blades_and_one_call_draw_the_same_picture(stage: Stage, sow) -> None:
    large: dict[str, Any] = {"count": 40_000, "scale": (3.0, 3.0)}
    grass = sow(**large)
    pictures, calls = [], []
    for method in ("cells", "loop"):
        settings = grass_settings(method=method, **large)
        assert taken(grass, settings)
        with stage.frame(settings, NORTH, kt=9.0) as frame, recording() as recorder:
            grass.draw(frame)
            pictures.append(stage.read())
        calls.append([call.name for call in recorder.calls])
    # A matrix per blade rounds otherwise than the sums in numpy: some pixels on edges differ.
    off = np.abs(pictures[0] - pictures[1]).max(axis=2) > 0
    assert off.mean() < 0.005
    assert (np.abs(pictures[0] - np.array([102, 153, 178])) > 20).any(axis=2).sum() > 500
    assert calls[0].count("glDrawElements") == 1 and not calls[0].count("glBegin")
    assert calls[1].count("glBegin") == len(grass.select(frame).positions)


def test_blades_drawn_in_groups_make_the_same_picture_with_few_of_them_in_memory(
    stage: Stage, sow, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(grass_module, "LEAST", 0)
    settings = grass_settings()
    grass = sow()
    pictures = []
    most = []
    send = Grass._send
    monkeypatch.setattr(
        Grass, "_send", lambda self, at, blades: most.append(len(at)) or send(self, at, blades)
    )
    for at_once in (1_000_000, 100):
        monkeypatch.setattr(grass_module, "AT_ONCE", at_once)
        monkeypatch.setattr(grass_module, "MOST_KEPT", 3 * at_once)
        assert taken(grass, settings)
        with stage.frame(settings, NORTH) as frame:
            grass.draw(frame)
            pictures.append(stage.read())

    assert (pictures[0] == pictures[1]).all() and len(np.unique(pictures[0])) > 5
    assert most[0] > 300 and max(most[1:]) <= 100 and sum(most[1:]) == most[0]
    assert sum(len(blades.positions) for blades in grass._grown.values()) <= 300


def test_a_loop_over_more_blades_than_one_would_wait_for_is_refused() -> None:
    check_loop(1_000_000)
    with pytest.raises(InputError, match=r"setting grass\.method: expected at most 1000000 blades"):
        check_loop(1_000_001)


def test_a_cell_of_a_tiny_map_has_no_more_blades_than_fit_into_memory() -> None:
    assert shared_out(40_000_000, np.ones(4), 1).tolist() == [200_000] * 4


def test_one_blade_takes_sixteen_calls(stage: Stage) -> None:
    places, scale = np.arange(9.0).reshape(3, 3), (2.0, 3.0)
    blades = blade_vertices(places, blade_corners(np.zeros(3)), scale)
    with stage.frame(small(), Pose(0.0, 0.0, 5.0)), recording() as recorder:
        send_one_by_one(places, blades, scale)
    names = [call.name for call in recorder.calls]
    assert len(names) == 3 * 16
    first = [call for call in recorder.calls if call.name in ("glTranslatef", "glScalef")][:4]
    assert [call.args for call in first] == [(0, 1, 2), (2, 3, 2), (3, 4, 5), (2, 3, 2)]
    corner = next(call.args for call in recorder.calls if call.name == "glVertex3f")
    assert corner == pytest.approx((-0.003, 0.0, 0.0), abs=1e-6)
    assert names.count("glVertex3f") == names.count("glTexCoord2f") == 15
    assert names.count("glBegin") == names.count("glEnd") == 3


def test_settings_read_each_frame_can_be_applied_and_built_in_ones_cannot(
    stage: Stage, field_of_grass: tuple[Settings, Grass]
) -> None:
    settings, grass = field_of_grass

    def shown() -> np.ndarray:
        with stage.frame(settings, NORTH) as frame:
            grass.draw(frame)
            return stage.read()

    wide = shown()
    for change in (
        {"grass.count": 3001},
        {"grass.scale": (2.0, 1.0)},
        {"castle.z": 20.0},
        {"ground.resolution": 41},
        {"water.level": 0.7},
        {"grass.facing": 0.6},
        {"grass.fade": True},
        {"grass.tinted": True},
    ):
        assert not taken(grass, small({"grass.radius": 1.0, **change})), change
        assert (shown() == wide).all(), "refused settings change nothing"
    assert taken(grass, small({"grass.radius": 1.0, "fog.density": 0.5, "castle.yaw": 3.0}))
    assert (shown() != wide).any()
    assert taken(grass, settings)
    assert (shown() == wide).all()


def test_the_plain_grass_is_used_in_2006_and_not_in_best() -> None:
    assert not Meadow.serves(preset("2006")) and Meadow.serves(preset("best"))
    for key, value in (
        ("tinted", True),
        ("fade", True),
        ("facing", 0.6),
        ("tufts", 7),
        ("variety", 1.0),
        ("arch", 4.0),
    ):
        assert Meadow.serves(small({f"grass.{key}": value})), key
    assert not Meadow.serves(small({"grass.method": "loop", "grass.count": 9}))
