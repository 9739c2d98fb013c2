"""Sprites: one sort for all, quads that face the camera, plants that sway, colours in order."""

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest
from sprite_stage import (
    BACKGROUND,
    BLUE,
    CONIFER,
    GLASS_TREE,
    NORTH,
    PLANT_GREEN,
    RED,
    TREE,
    WIDE,
    element,
    looking,
    pictures,
    put,
    seen,
)
from stage import Stage, close, pixel, project, small, taken

from landscape.elements.atlas import CELL, GUTTER, cell_coordinates, laid_out
from landscape.elements.best.sprites.refined_sprites import RefinedSprites
from landscape.elements.planting import PLANT
from landscape.elements.settings import preset
from landscape.elements.transparent_elements import (
    CROSS,
    TransparentElements,
    billboards,
    crossed_quads,
    far_to_near,
    visible,
)
from landscape.frame import Pose
from landscape.geometry.wind import sway


def test_the_sway_is_the_reports_at_a_place_and_time_computed_by_hand() -> None:
    places = np.array([(0.0, 5.0, 0.0), (2.0, 0.0, 3.0)])
    winds = sway(0.0, places)
    assert winds[0] == pytest.approx([0.05, 0.03])
    # cos(-2.4 - 2.232) = cos(4.632) = -0.080302 and cos(-2.88) = -0.965991
    assert winds[1] == pytest.approx([0.05 * -0.080302, 0.03 * -0.965991], rel=1e-4)
    # After 20 pi (in dx) and 19.2 pi (in dz) all is as before.
    assert sway(20 * math.pi, places)[:, 0] == pytest.approx(winds[:, 0])
    assert sway(19.2 * math.pi, places)[:, 1] == pytest.approx(winds[:, 1])
    assert sway(7.0, places, 2.0) == pytest.approx(2 * sway(7.0, places))


def test_what_is_in_front_of_the_camera_and_near_is_visible() -> None:
    frame = looking(Pose(10.0, 1.0, 10.0, 90.0, 0.0))
    places = np.array([(12.0, 0, 10.0), (15.0, 0, 11.0), (9.0, 0, 10.0), (13.0, 0, 9.0)])
    assert visible(frame, places, 100.0).tolist() == [0, 1, 3]
    assert visible(frame, places, 4.0).tolist() == [0, 3]
    assert visible(frame, places, np.array([1.0, 9.0, 9.0, 9.0])).tolist() == [1, 3]


def test_the_order_is_by_depth_along_the_view_and_not_by_distance() -> None:
    frame = looking(Pose(0.0, 0.0, 0.0, 0.0, 0.0))
    places = np.array([(3.0, 0.0, -2.0), (0.0, 0.0, -2.5)])
    assert far_to_near(np.arange(2), frame.depth(places)).tolist() == [1, 0]


def test_random_places_are_sorted_and_none_in_view_is_lost() -> None:
    frame = looking(Pose(20.0, 2.0, 20.0, 33.0, -12.0))
    places = np.random.default_rng(3).random((5000, 3)) * (40.0, 3.0, 40.0)
    found = visible(frame, places, 9.0)
    order = far_to_near(found, frame.depth(places[found]))
    ahead = (places - (20.0, 2.0, 20.0)) @ np.array(frame.pose.forward)
    near = np.hypot(places[:, 0] - 20.0, places[:, 2] - 20.0) < 9.0
    assert set(order) == set(np.flatnonzero((ahead > 0) & near))
    assert (np.diff(ahead[order]) <= 1e-9).all()


def test_a_billboard_stands_on_its_place_along_the_cameras_right_and_up() -> None:
    right, up = np.array([0.6, 0.0, 0.8]), np.array([0.0, 1.0, 0.0])
    corners = billboards(np.array([[1.0, 2.0, 3.0]]), np.array([[0.5, 2.0]]), right, up)[0]
    assert np.allclose(corners[0], (1 - 0.15, 2, 3 - 0.2))
    assert np.allclose(corners[1], (1 + 0.15, 2, 3 + 0.2))
    assert np.allclose(corners[2], (1 + 0.15, 4, 3 + 0.2))
    assert np.allclose(corners[3], (1 - 0.15, 4, 3 - 0.2))


@pytest.mark.parametrize("pose", [Pose(0, 0, 0, 0, 0), Pose(1, 2, 3, 130, -25), Pose(0, 9, 0, 77)])
def test_billboards_face_the_camera_and_turn_counter_clockwise(pose: Pose) -> None:
    frame = looking(pose)
    places = np.random.default_rng(4).random((50, 3)) * 10
    corners = billboards(places, np.full((50, 2), 0.5), frame.right, frame.up)
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 3] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    assert np.allclose(normals, -np.array(pose.forward), atol=1e-9)


def test_crossed_quads_stand_along_x_and_z_and_only_their_top_middles_sway() -> None:
    place, size = np.array([[5.0, 1.0, 7.0]]), np.array([[0.4, 0.6]])
    still = crossed_quads(place, size, np.zeros((1, 2)))[0]
    assert np.allclose(still[:6, 0], [4.8, 5.0, 5.2, 4.8, 5.0, 5.2])
    assert np.allclose(still[6:, 2], [6.8, 7.0, 7.2, 6.8, 7.0, 7.2])
    assert np.allclose(still[:6, 2], 7.0) and np.allclose(still[6:, 0], 5.0)
    assert np.allclose(still[:, 1], np.tile([1, 1, 1, 1.6, 1.6, 1.6], 2))
    moved = crossed_quads(place, size, np.array([[0.05, -0.03]]))[0] - still
    expected = np.zeros((12, 3))
    expected[[4, 10]] = (0.05, 0.0, -0.03)
    assert np.allclose(moved, expected)


def test_the_four_triangles_of_a_plants_quad_cover_it_once() -> None:
    corners = crossed_quads(np.zeros((1, 3)), np.array([[2.0, 1.0]]), np.zeros((1, 2)))[0]
    triangles = corners[CROSS.reshape(-1, 3)]
    areas = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]) / 2
    assert len(triangles) == 8
    assert areas[:4, 2].tolist() == [0.5] * 4
    assert np.abs(areas[4:, 0]).tolist() == [0.5] * 4


def test_texture_coordinates_stay_inside_their_cell_and_under_the_gutter() -> None:
    s, t = np.array([0.0, 1.0]), np.array([0.0, 1.0])
    uv = cell_coordinates(np.array([0, 5]), np.array([False, False]), s, t)
    half_u, half_v = 0.5 / CELL / 4, 0.5 / CELL / 2
    gutter = GUTTER / CELL / 2
    assert uv[0, 0] == pytest.approx([half_u, gutter])
    assert uv[0, 1] == pytest.approx([0.25 - half_u, 0.5 - half_v])
    assert uv[1, 0] == pytest.approx([0.25 + half_u, 0.5 + gutter])


def test_a_mirrored_sprite_runs_backwards_in_s_only() -> None:
    s, t = np.array([0.0, 0.3, 1.0]), np.array([0.2, 0.5, 0.9])
    there, back = cell_coordinates(np.array([2, 2]), np.array([False, True]), s, t)
    assert np.allclose(there[:, 0] + back[:, 0], 2 * (2.5 / 4))
    assert np.allclose(there[:, 1], back[:, 1])


def test_the_atlas_lays_its_cells_out_in_rows_of_four() -> None:
    cells = [np.full((8, 8, 4), k + 1, np.uint8) for k in range(7)]
    sheet = laid_out(cells)
    assert sheet.shape == (16, 32, 4)
    assert [int(sheet[3, 8 * k + 3, 0]) for k in range(4)] == [1, 2, 3, 4]
    assert [int(sheet[11, 8 * k + 3, 0]) for k in range(4)] == [5, 6, 7, 0]


@pytest.fixture(scope="module")
def sprites(the_stage: Stage, tmp_path_factory) -> Iterator[TransparentElements]:
    """The element, its cells of one colour each."""
    assets = pictures(tmp_path_factory.mktemp("sprites"))
    with element(the_stage, TransparentElements, assets) as made:
        yield made


def test_indices_name_each_sprites_own_vertices_from_far_to_near(sprites) -> None:
    put(sprites, [(20.0, 3.0, 17.0), (20.0, 3.0, 16.0), (20.0, 3.0, 15.0)], [TREE, PLANT, CONIFER])
    rows = {}
    for is_sorted in (False, True):
        assert taken(sprites, small({**WIDE, "transparent.sorted": is_sorted}))
        vertices, coordinates, indices = sprites.prepare(looking(NORTH))
        assert len(vertices) == len(coordinates) == 4 + 4 + 12 == indices.max() + 1
        assert indices.dtype == np.uint32
        rows[is_sorted] = indices.reshape(-1, 6)
    # A billboard is a row of six indices, a plant four. Near tree, far tree, plant, as they stand;
    near, far, *plant = rows[False].tolist()
    assert max(near) == 3 and {4, 7} <= set(far) <= set(range(4, 8)) and np.min(plant) == 8
    # sorted: far tree, plant, near tree.
    assert rows[True].tolist() == [far, *plant, near]


def test_none_in_view_gives_no_indices(sprites) -> None:
    put(sprites, [(20.0, 3.0, 30.0)], [PLANT])
    assert [len(array) for array in sprites.prepare(looking(NORTH))] == [0, 0, 0]


@pytest.mark.parametrize("pose", [NORTH, Pose(20.0, 3.5, 20.0, 0.0, -20.0)])
def test_a_tree_covers_exactly_its_width_and_height(stage: Stage, sprites, pose: Pose) -> None:
    place = (20.0, 3.0, 16.0)
    put(sprites, [place], [CONIFER])
    # At its border the filter mixes a little of the neighbouring cells in.
    blue = np.abs(seen(stage, sprites, pose) - BACKGROUND).max(axis=2) > 9
    frame = looking(pose)
    foot = np.array(place)
    left, bottom = project(pose, tuple(foot - 0.5 * frame.right))
    right, top = project(pose, tuple(foot + 0.5 * frame.right + frame.up))
    columns, rows = np.flatnonzero(blue.any(axis=0)), np.flatnonzero(blue.any(axis=1))
    assert columns[[0, -1]] == pytest.approx([left, right - 1], abs=1)
    assert rows[[0, -1]] == pytest.approx([top, bottom - 1], abs=1)
    # It faces us: a rectangle on the screen, wherever the camera turns.
    assert blue.sum() == len(columns) * len(rows)


@pytest.mark.parametrize("nearer_first", [False, True])
def test_a_near_tree_is_blended_over_a_far_one_whatever_their_numbers(
    stage: Stage, sprites, nearer_first: bool
) -> None:
    near, far = (20.0, 3.0, 17.0), (20.0, 3.0, 15.0)
    places, cells = [far, near], [CONIFER, GLASS_TREE]
    put(sprites, places[::-1] if nearer_first else places, cells[::-1] if nearer_first else cells)
    got = pixel(seen(stage, sprites), project(NORTH, (20.0, 3.4, 15.0)))
    alpha = 128 / 255
    assert close(got, alpha * np.array(RED[:3]) + (1 - alpha) * np.array(BLUE[:3]), 2)


def test_unsorted_a_near_tree_drawn_first_is_painted_over(stage: Stage, sprites) -> None:
    put(sprites, [(20.0, 3.0, 17.0), (20.0, 3.0, 15.0)], [TREE, CONIFER])
    at = project(NORTH, (20.0, 3.4, 15.0))
    assert close(pixel(seen(stage, sprites), at), RED[:3], 2)
    assert close(pixel(seen(stage, sprites, transparent__sorted=False), at), BLUE[:3], 2)


def test_a_plant_between_two_trees_is_sorted_with_them(stage: Stage, sprites) -> None:
    places = [(20.0, 3.0, 17.0), (20.0, 3.0, 16.0), (20.0, 3.0, 15.0)]
    put(sprites, places, [GLASS_TREE, PLANT, CONIFER])
    got = pixel(seen(stage, sprites), project(NORTH, (20.0, 3.3, 16.0)))
    alpha = 128 / 255
    assert close(got, alpha * np.array(RED[:3]) + (1 - alpha) * np.array(PLANT_GREEN[:3]), 3)


def test_a_plant_shows_its_quads_where_projection_puts_them(stage: Stage, sprites) -> None:
    pose = Pose(20.0, 3.5, 20.0, 20.0, 0.0)
    place = (21.3, 3.0, 16.3)
    put(sprites, [place], [PLANT], (0.8, 0.5))
    picture = seen(stage, sprites, pose)
    for dx, dz in ((0.35, 0.0), (-0.35, 0.0), (0.0, 0.3), (0.0, -0.3)):
        at = (place[0] + dx, place[1] + 0.1, place[2] + dz)
        assert close(pixel(picture, project(pose, at)), PLANT_GREEN[:3], 15)
    outside = (place[0] + 0.5, place[1] + 0.1, place[2])
    assert close(pixel(picture, project(pose, outside)), BACKGROUND, 2)


def test_plants_sway_and_trees_stand_still(stage: Stage, sprites) -> None:
    put(sprites, [(20.0, 3.0, 17.0)], [PLANT])
    assert (seen(stage, sprites, kt=0) != seen(stage, sprites, kt=31.0)).any()
    put(sprites, [(20.0, 3.0, 17.0)], [CONIFER])
    assert (seen(stage, sprites, kt=0) == seen(stage, sprites, kt=31.0)).all()


def test_without_texture_the_bare_quads_are_white(stage: Stage, sprites) -> None:
    put(sprites, [(20.0, 3.0, 17.0)], [CONIFER])
    picture = seen(stage, sprites, transparent__textured=False)
    assert close(pixel(picture, project(NORTH, (20.0, 3.4, 17.0))), (255, 255, 255))


def test_nothing_in_view_draws_nothing(stage: Stage, sprites) -> None:
    put(sprites, [(20.0, 3.0, 30.0)], [CONIFER])
    assert close(seen(stage, sprites), BACKGROUND)


def test_settings_read_each_frame_can_be_applied_and_built_in_ones_cannot(
    stage: Stage, sprites
) -> None:
    put(sprites, [(20.0, 3.0, 12.0)], [CONIFER])
    assert (seen(stage, sprites, transparent__radius=9.0) != BACKGROUND.astype(int)).any()
    there = seen(stage, sprites)
    for change in (
        {"trees.count": 61},
        {"plants.size_max": 0.2},
        {"ground.scale_y": 5.0},
        {"water.level": 0.7},
        {"castle.x": 20.0},
        {"rabbit.scale": 0.2},
        {"trees.species": 1},
        {"transparent.upright": True},
        {"ground.shadows": True},
    ):
        assert not taken(sprites, small({**WIDE, "transparent.radius": 1.0, **change})), change
        with stage.frame(small(WIDE), NORTH) as frame:
            sprites.draw(frame)
            assert (stage.read() == there).all(), "refused settings change nothing"

    near = seen(stage, sprites, transparent__radius=1.0, fog__density=0.5)
    assert close(near, BACKGROUND)


def test_the_mirrored_scene_is_drawn_from_the_same_arrays(stage: Stage, sprites) -> None:
    put(sprites, [(20.0, 3.0, 17.0)], [CONIFER])
    assert taken(sprites, small(WIDE))
    with stage.frame(small(WIDE), NORTH) as frame:
        prepared = sprites.prepare(frame)
        sprites.draw(replace(frame, mirrored=True), prepared)
        once = stage.read()
    assert (once == seen(stage, sprites)).all()


def test_the_plain_sprites_are_used_in_2006_and_not_in_best() -> None:
    assert not RefinedSprites.serves(preset("2006"))
    assert RefinedSprites.serves(preset("best"))
    for key in (
        "transparent.upright",
        "transparent.split",
        "transparent.clear_near",
        "trees.crown",
        "transparent.rooted",
        "transparent.trimmed",
        "trees.grouped",
        "deer.follow_slope",
        "plants.shaded",
        "plants.fade_edge_on",
        "plants.rosette",
        "ground.shadows",
    ):
        assert RefinedSprites.serves(small({key: True})), key

    for key in ("transparent.fade", "transparent.min_pixels", "plants.radius"):
        assert RefinedSprites.serves(small({key: 0.5})), key
    assert RefinedSprites.serves(small({"plants.species": 2}))
    assert RefinedSprites.serves(small({"plants.quads": 3}))
    assert RefinedSprites.serves(small({"plants.crossed_within": 7.0}))
    assert RefinedSprites.serves(small({"transparent.trilinear": False}))
    for key in ("transparent.sorted", "transparent.textured"):
        assert not RefinedSprites.serves(small({key: False})), key
