"""The refined sprites: each fix of section 11.2, and selections kept for several frames.

Each of these tests fails when its fix is taken out.
"""

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from gl_state import snapshot
from sprite_stage import (
    BACKGROUND,
    BLUE,
    CONIFER,
    NORTH,
    PLANT_GREEN,
    RED,
    TREE,
    covered,
    element,
    looking,
    pictures,
    put,
    seen,
)
from stage import Stage, close, pixel, project

from landscape.elements.best.sprites.refined_planting import slopes_under
from landscape.elements.best.sprites.refined_quads import edge_on, half_places, turned
from landscape.elements.best.sprites.refined_sprites import RefinedSprites
from landscape.elements.best.sprites.rules import clearness, farthest, radii
from landscape.elements.best.sprites.slope_billboards import leaning, slope_axes
from landscape.elements.planting import PLANT, THICK
from landscape.elements.settings import Settings
from landscape.elements.transparent_elements import TransparentElements, crossed_quads
from landscape.frame import Pose
from landscape.geometry.height_field import HeightField
from landscape.geometry.obstacles import RADIUS
from landscape.settings.declare import with_settings


@pytest.fixture(scope="module")
def sprites(the_stage: Stage, tmp_path_factory) -> Iterator[RefinedSprites]:
    """The element, its cells of one colour each."""
    assets = pictures(tmp_path_factory.mktemp("refined"))
    with element(the_stage, RefinedSprites, assets) as made:
        yield made


def calm(stage: Stage, sprites: Any, pose: Pose = NORTH, **changes: Any) -> np.ndarray:
    """Return the sprites' picture under some settings, on a day without wind."""
    return seen(stage, sprites, pose, **{"plants__sway": 0.0, **changes})


@pytest.mark.parametrize("fixed", [False, True])
def test_r3_the_near_half_of_a_quad_is_drawn_over_a_billboard_that_crosses_it(
    stage: Stage, sprites: RefinedSprites, fixed: bool
) -> None:
    # The plant's quad along z goes through the tree, which stands a little nearer than its middle.
    pose = Pose(19.0, 3.5, 20.0, 14.0, 0.0)
    put(sprites, [(20.0, 3.0, 16.0), (20.0, 3.0, 16.12)], [PLANT, TREE], (1.0, 1.0))
    picture = calm(stage, sprites, pose, transparent__split=fixed)
    near = pixel(picture, project(pose, (20.0, 3.4, 16.4)))
    far = pixel(picture, project(pose, (20.0, 3.4, 15.75)))
    assert close(near, PLANT_GREEN[:3] if fixed else RED[:3], 12)
    assert close(far, RED[:3], 12)


def test_r3_halves_stand_where_their_feet_are() -> None:
    crossed = crossed_quads(np.array([[5.0, 1.0, 7.0]]), np.array([[0.8, 1.0]]), np.zeros((1, 2)))
    expected = [(4.8, 1, 7), (5.2, 1, 7), (5, 1, 6.8), (5, 1, 7.2)]
    assert np.allclose(half_places(crossed)[0], expected)


@pytest.mark.parametrize("fixed", [False, True])
def test_r4_from_above_an_upright_billboard_is_foreshortened(
    stage: Stage, sprites: RefinedSprites, fixed: bool
) -> None:
    pose = Pose(20.0, 6.0, 17.0, 0.0, -60.0)
    put(sprites, [(20.0, 3.0, 15.5)], [1])
    rows = np.flatnonzero(
        covered(calm(stage, sprites, pose, transparent__upright=fixed)).any(axis=1)
    )
    foot, top = (project(pose, (20.0, y, 15.5))[1] for y in (3.0, 4.0))
    lying_down = project(pose, (20.0, 3.0 + math.cos(math.pi / 3), 15.5 - math.sin(math.pi / 3)))[1]
    assert rows[-1] == pytest.approx(foot, abs=2)
    assert rows[0] == pytest.approx(top if fixed else lying_down, abs=2)


def test_r5_one_axis_lies_in_the_slope_and_the_other_is_at_right_angles_to_it() -> None:
    slopes = np.array([(0.0, 0.0), (0.5, 0.0), (0.3, -0.4), (30.0, 0.0)])
    across, up = slope_axes(np.array([1.0, 0.0, 0.0]), leaning(slopes))
    assert np.allclose(np.linalg.norm(across, axis=1), 1) and np.allclose((across * up).sum(1), 0)
    assert np.allclose(across[1], np.array([1, 0.5, 0]) / math.hypot(1, 0.5))
    assert np.allclose(up[2], np.array([-0.3, 1, 0.4]) / math.sqrt(1.25))
    assert up[0].tolist() == [0, 1, 0]
    assert up[3, 1] > math.cos(math.radians(36))  # never flat on its side


def test_r5_the_slope_is_that_between_the_ends_of_the_foot() -> None:
    along = np.linspace(0, 40, 401)
    hill = HeightField(np.tile(along * 0.25, (401, 1)).astype(np.float32), 40.0, 0.0)
    slopes = slopes_under(hill, np.array([[20.0, 5.0, 20.0]]), np.array([0.2]))
    assert slopes == pytest.approx(np.array([[0.25, 0.0]]), abs=1e-4)


def test_r6_all_three_quads_are_drawn_where_they_stand(
    stage: Stage, sprites: RefinedSprites
) -> None:
    place = np.array([19.951, 3.0, 17.0])  # its own turn leaves none edge-on
    put(sprites, [place], [PLANT], (1.0, 0.3))
    pose = Pose(20.0, 5.0, 18.5, 0.0, -53.0)  # looks at the plant
    picture = covered(calm(stage, sprites, pose, plants__quads=3))
    for turn in turned(place[None], 3)[0]:
        for end in (-0.45, 0.45):
            foot = place + (end * math.cos(turn), 0.1, end * math.sin(turn))
            column, row = project(pose, tuple(foot))
            assert picture[int(row), int(column)]


def test_r6_a_quad_shows_face_on_and_not_edge_on() -> None:
    east = np.array([[1.0, -0.2, 0.0]])
    assert edge_on(east, np.array([[math.pi / 2, 0.0]])).tolist() == [[1.0, 0.0]]
    for view in np.linspace(0, math.pi, 60):
        away = np.array([[math.cos(view), 0.0, math.sin(view)]])
        for quads in (2, 3):
            shown = edge_on(away, np.arange(quads)[None] * math.pi / quads)
            assert shown.max() == 1.0 and (quads == 2 or (shown > 0.6).sum() >= 2)


@pytest.mark.parametrize("fixed", [False, True])
def test_r6_no_line_is_seen_along_a_quad(
    stage: Stage, sprites: RefinedSprites, fixed: bool
) -> None:
    # From a little beside the quad along z: it is a thin strip, taller than the other's top.
    pose = Pose(20.0, 3.2, 18.0, 0.0, 0.0)
    put(sprites, [(20.02, 3.0, 17.0)], [PLANT], (1.0, 0.4))
    picture = covered(calm(stage, sprites, pose, plants__fade_edge_on=fixed))
    top = project(pose, (20.02, 3.4, 17.0))[1]
    assert picture[: int(top) - 2].any() != fixed
    assert picture[int(top) + 4 :].any()


@pytest.mark.parametrize("fixed", [False, True])
def test_r6_from_above_a_plant_is_a_disc_and_not_a_cross(
    stage: Stage, sprites: RefinedSprites, fixed: bool
) -> None:
    above = Pose(20.0, 6.0, 16.0, 0.0, -90.0)
    put(sprites, [(20.0, 3.0, 16.0)], [PLANT], (1.0, 0.6))
    picture = covered(calm(stage, sprites, above, plants__rosette=fixed, plants__fade_edge_on=True))
    between = [
        project(above, (20 + 0.2 * dx, 3.2, 16 + 0.2 * dz)) for dx in (-1, 1) for dz in (-1, 1)
    ]
    assert all(picture[int(row), int(column)] == fixed for column, row in between)


@pytest.mark.parametrize("fixed", [False, True])
def test_from_above_a_tree_is_a_crown_and_not_a_line(
    stage: Stage, sprites: RefinedSprites, fixed: bool
) -> None:
    above = Pose(20.0, 7.0, 16.0, 0.0, -90.0)
    put(sprites, [(20.0, 3.0, 16.0)], [1])
    changes = {"trees__crown": fixed, "transparent__upright": True}
    picture = covered(calm(stage, sprites, above, **changes))
    for dx, dz in ((0.25, 0.1), (-0.1, -0.25), (0.2, -0.2)):
        column, row = project(above, (20.0 + dx, 3.62, 16.0 + dz))
        assert picture[int(row), int(column)] == fixed


def crowns_share(stage: Stage, sprites: RefinedSprites, pose: Pose) -> float:
    """Return the fraction of the picture that the pictures from above change."""
    tops = {"trees__crown": True, "plants__rosette": True}
    without = calm(stage, sprites, pose, transparent__upright=True)
    difference = calm(stage, sprites, pose, transparent__upright=True, **tops) - without
    return float((np.abs(difference).max(axis=2) > 0).mean())


@pytest.mark.seldom(5, first=4)
def test_no_crown_hangs_over_a_walker_and_all_show_from_above(
    stage: Stage, sprites: RefinedSprites
) -> None:
    rng = np.random.default_rng(6)
    for _ in range(12):
        x, z = rng.uniform(19.0, 21.0, (2, 30))
        put(sprites, np.stack([x, 0 * x + 3.0, z], 1), np.arange(30) % 2, (0.45, 0.5))
        eye, yaw = rng.uniform(19.2, 20.8, 2), rng.uniform(0, 360)
        for pitch in (0.0, 25.0, -25.0):
            assert crowns_share(stage, sprites, Pose(eye[0], 3.1, eye[1], yaw, pitch)) == 0.0
        assert crowns_share(stage, sprites, Pose(20.0, 6.0, 21.5, 0.0, -60.0)) > 0.02


def test_no_rosette_shows_to_an_eye_lower_than_its_leaves(
    stage: Stage, sprites: RefinedSprites
) -> None:
    put(sprites, [(20.0, 3.0, 19.75)], [PLANT], (0.6, 0.6))
    assert crowns_share(stage, sprites, Pose(20.0, 3.15, 20.0, 0.0, 0.0)) == 0.0
    assert crowns_share(stage, sprites, Pose(20.0, 3.90, 20.0, 0.0, -60.0)) > 0.02


@pytest.mark.parametrize("fade", [0.0, 0.5])
def test_sprites_fade_towards_the_radius(
    stage: Stage, sprites: RefinedSprites, fade: float
) -> None:
    place = (20.0, 3.0, 17.0)
    put(sprites, [place], [1])
    changes = {"transparent__radius": 4.0, "transparent__fade": fade}
    got = pixel(calm(stage, sprites, **changes), project(NORTH, (20.0, 3.5, 17.0)))
    opacity = 0.5 if fade else 1.0  # 3 units away, a quarter of the radius before the end
    assert close(got, opacity * np.array(BLUE[:3]) + (1 - opacity) * BACKGROUND, 3)


def test_faded_sprites_stop_where_the_fog_hides_all() -> None:
    keys = {"transparent.radius": 50.0, "transparent.fade": 0.1, "fog.density": 0.5}
    far = farthest(with_settings(Settings(), keys))
    assert math.exp(-((0.5 * far) ** 2)) == pytest.approx(1 / 512)
    assert farthest(with_settings(Settings(), {**keys, "transparent.fade": 0.0})) == 50.0


def test_sprites_lower_than_min_pixels_are_not_drawn() -> None:
    frame = looking(NORTH)
    cells, heights = np.array([0, PLANT, 0]), np.array([0.5, 0.05, 0.01], np.float32)
    keys = {"transparent.radius": 8.0, "plants.radius": 4.0}
    far = radii(with_settings(Settings(), keys), cells, heights, frame)
    assert far.tolist() == [8.0, 4.0, 8.0]
    least = with_settings(Settings(), {**keys, "transparent.min_pixels": 2.0})
    far = radii(least, cells, heights, frame)
    assert far[0] == 8.0
    # At this distance the others are just two pixels high.
    pixels = heights[1:] / far[1:] * frame.size[1] / (2 * math.tan(math.radians(frame.fov / 2)))
    assert pixels == pytest.approx([2.0, 2.0])


def test_a_sprite_fades_before_the_eye_passes_through_it() -> None:
    keys = {"transparent.clear_near": True, "transparent.fade": 0.0}
    radius = np.full(4, 8.0)
    widths = np.ones(4)
    away = np.array([0.2, 0.35, 0.5, 5.0])
    plants, trees = np.full(4, PLANT), np.zeros(4, int)
    clear = clearness(with_settings(Settings(), keys), plants, radius, widths, away)
    assert clear == pytest.approx([0.0, 0.5, 1.0, 1.0])
    # A walker cannot get nearer to a trunk than where it is still opaque.
    near = np.array([0.05, 0.085, THICK[0] + RADIUS / 0.65, 0.2])
    clear = clearness(with_settings(Settings(), keys), trees, radius, widths, near)
    assert clear == pytest.approx([0.0, 0.5, 1.0, 1.0])
    settings = with_settings(Settings(), {**keys, "transparent.clear_near": False})
    assert (clearness(settings, plants, radius, widths, away) == 1.0).all()


def test_switching_everything_on_and_off_again_changes_nothing(
    stage: Stage, sprites: RefinedSprites
) -> None:
    rng = np.random.default_rng(1)
    places = np.stack([rng.uniform(18, 22, 30), np.full(30, 3.0), rng.uniform(14, 19, 30)], axis=1)
    put(sprites, places, rng.integers(0, 7, 30), (0.6, 0.6))
    before, state = calm(stage, sprites), snapshot()
    every = {
        "transparent__split": True,
        "transparent__fade": 0.2,
        "transparent__rooted": True,
        "transparent__trimmed": True,
        "trees__crown": True,
        "deer__follow_slope": True,
        "plants__quads": 3,
        "plants__fade_edge_on": True,
        "plants__rosette": True,
        "plants__crossed_within": 3.0,
    }
    assert (calm(stage, sprites, **every) != before).any()
    assert (calm(stage, sprites) == before).all()
    assert snapshot() == state


@pytest.mark.parametrize("fixed", [False, True])
def test_r5_a_deer_stands_on_the_slope_with_both_ends(
    stage: Stage, sprites: RefinedSprites, fixed: bool
) -> None:
    put(sprites, [(20.0, 3.0, 17.0)], [4], slope=(0.5, 0.0))
    picture = covered(calm(stage, sprites, deer__follow_slope=fixed))
    column, row = project(NORTH, (20.4, 3.2, 17.0))  # on the slope, under the body's right end
    assert picture[int(row) + 4, int(column)] != fixed  # inside the hill
    assert picture[int(row) - 4, int(column)]


@pytest.mark.parametrize("rooted", [False, True])
def test_feet_of_trees_sink_where_the_ground_slopes(
    stage: Stage, sprites: RefinedSprites, rooted: bool
) -> None:
    put(sprites, [(20.0, 3.0, 17.0)], [CONIFER], slope=(0.6, 0.8))
    picture = covered(calm(stage, sprites, transparent__rooted=rooted))
    bottom = np.flatnonzero(picture.any(axis=1))[-1]
    foot = 3.0 - (0.07 if rooted else 0.0)
    assert bottom == pytest.approx(project(NORTH, (20.0, foot, 17.0))[1] - 1, abs=1)


def test_the_tint_multiplies_the_picture(stage: Stage, sprites: RefinedSprites) -> None:
    put(sprites, [(20.0, 3.0, 17.0)], [CONIFER], tint=(128, 128, 128, 255))
    got = pixel(calm(stage, sprites), project(NORTH, (20.0, 3.4, 17.0)))
    assert close(got, np.array(BLUE[:3]) * 128 / 255, 2)


def triangles_drawn(stage: Stage, sprites: RefinedSprites, **changes: Any) -> np.ndarray:
    """Return the triangles (n, 3, 3) a frame from NORTH sends."""
    calm(stage, sprites, **changes)
    vertices, *_, indices = sprites.prepare(looking(NORTH))
    return vertices[indices].reshape(-1, 3, 3)


def test_far_plants_are_single_quads(stage: Stage, sprites: RefinedSprites) -> None:
    put(sprites, [(20.0, 3.0, 17.0), (20.0, 3.0, 12.0)], [PLANT, PLANT])
    counts = [
        len(triangles_drawn(stage, sprites, plants__crossed_within=within)) // 2
        for within in (0.0, 5.0)
    ]
    assert counts == [8, 5]


@pytest.mark.seldom(3, first=1)
@pytest.mark.parametrize("flipped", [False, True])
def test_a_trimmed_quad_shows_the_same_picture_in_less_area(
    stage: Stage, tmp_path, flipped: bool
) -> None:
    tree = np.zeros((480, 512, 4), np.uint8)  # the size of a cell under its gutter
    tree[:, :, 2] = 250
    tree[68:268, 60:420, 3] = tree[268:, 200:260, 3] = 255
    assets = pictures(tmp_path, {"tree_conifer.png": tree})
    shown, areas = [], []
    with element(stage, RefinedSprites, assets) as sprites:
        put(sprites, [(20.0, 3.0, 17.0)], [CONIFER], flipped=flipped)
        for trimmed in (False, True):
            shown.append(calm(stage, sprites, transparent__trimmed=trimmed))
            a, b, c = triangles_drawn(stage, sprites, transparent__trimmed=trimmed).swapaxes(0, 1)
            areas.append(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2)

    whole, trimmed = shown

    # Along its outline the filter mixes a little more of the transparent surround in.
    off = np.abs(whole - trimmed).max(axis=2)
    assert (off > 8).sum() < 0.1 * covered(whole).sum() and off.max() < 64
    assert covered(whole).sum() > 400
    assert areas[0] == pytest.approx(1.0, abs=0.01) and areas[1] < 0.5

    # Mirrored, the trunk stands right of the middle by as much as it stood left.
    columns = np.flatnonzero(covered(trimmed)[int(project(NORTH, (20.0, 3.1, 17.0))[1])])
    aside = (0.5 - 230 / 512) * (1 if flipped else -1)
    middle = project(NORTH, (20.0 + aside, 3.1, 17.0))[0]
    assert (columns[0] + columns[-1] + 1) / 2 == pytest.approx(middle, abs=2)


def test_with_all_switches_off_the_picture_is_that_of_the_plain_sprites(
    stage: Stage, sprites: RefinedSprites, tmp_path
) -> None:
    rng = np.random.default_rng(5)
    places = np.stack([rng.uniform(17, 23, 60), np.full(60, 3.0), rng.uniform(12, 19, 60)], axis=1)
    cells = rng.integers(0, 7, 60)
    with element(stage, TransparentElements, pictures(tmp_path)) as plain:
        for each in (plain, sprites):
            put(each, places, cells, (0.6, 0.6))
        for changes in ({}, {"transparent__sorted": False}, {"transparent__textured": False}):
            for kt in (0.0, 31.0):
                one, other = (seen(stage, each, kt=kt, **changes) for each in (plain, sprites))
                assert (one == other).all() and covered(one).mean() > 0.1
