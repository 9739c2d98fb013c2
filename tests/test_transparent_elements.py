"""Sprites: one sort for all, quads that face the camera, plants that sway, colours in order."""

import math
from collections.abc import Iterator

import numpy as np
import pytest
from landscape.elements.sprites.sprite_quads import (
    HALVES,
    QUAD,
    Quads,
    billboards,
    crossed_quads,
    sway,
    upright_axes,
)
from landscape.elements.sprites.sprite_rules import visible_order
from PIL import Image
from stage import Stage, close, pixel, project, small, write_plain

from landscape.elements.ground import Ground
from landscape.elements.sprites.atlas import CELL, CELLS, GUTTER, atlas, cell_coordinates
from landscape.elements.sprites.planting import PLANT, Sprites
from landscape.elements.transparent_elements import TransparentElements
from landscape.files.assets import Assets
from landscape.frame import Frame, Pose

BACKGROUND = np.array([0.4, 0.6, 0.7]) * 255
RED, BLUE, PLANT_GREEN = (250, 0, 0, 255), (0, 0, 250, 255), (20, 230, 30, 255)


def looking(pose: Pose) -> Frame:
    """Return a frame whose modelview is written from the definition of the camera."""
    yaw, pitch = math.radians(pose.yaw), math.radians(pose.pitch)
    right = np.array([math.cos(yaw), 0.0, math.sin(yaw)])
    ahead = np.array(pose.forward)
    up = np.cross(right, ahead)
    assert up[1] == pytest.approx(math.cos(pitch))
    matrix = np.eye(4)
    matrix[:3, :3] = right, up, -ahead
    matrix[:3, 3] = -matrix[:3, :3] @ (pose.x, pose.y, pose.z)
    return Frame(pose, (160, 120), 0.0, matrix.T.ravel(), 60.0)


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


def test_what_is_seen_comes_from_far_to_near() -> None:
    frame = looking(Pose(10.0, 1.0, 10.0, 90.0, 0.0))
    places = np.array([(12.0, 0, 10.0), (15.0, 0, 11.0), (9.0, 0, 10.0), (13.0, 0, 9.0)])
    assert visible_order(frame, places, 100.0).tolist() == [1, 3, 0]
    assert visible_order(frame, places, 100.0, sort=False).tolist() == [0, 1, 3]


def test_the_order_is_by_depth_along_the_view_and_not_by_distance() -> None:
    frame = looking(Pose(0.0, 0.0, 0.0, 0.0, 0.0))
    places = np.array([(3.0, 0.0, -2.0), (0.0, 0.0, -2.5)])
    assert visible_order(frame, places, 100.0).tolist() == [1, 0]


def test_random_places_are_sorted_and_none_in_view_is_lost() -> None:
    frame = looking(Pose(20.0, 2.0, 20.0, 33.0, -12.0))
    places = np.random.default_rng(3).random((5000, 3)) * (40.0, 3.0, 40.0)
    order = visible_order(frame, places, 9.0)
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


def test_upright_billboards_keep_the_cameras_direction_and_stand() -> None:
    right, up = upright_axes(looking(Pose(0, 0, 0, 40.0, -60.0)).right)
    assert right == pytest.approx([math.cos(math.radians(40)), 0, math.sin(math.radians(40))])
    assert up.tolist() == [0, 1, 0]


def test_crossed_quads_stand_along_x_and_z_and_only_their_top_middles_sway() -> None:
    place, size = np.array([[5.0, 1.0, 7.0]]), np.array([[0.4, 0.6]])
    still = crossed_quads(place, size, np.zeros((1, 2)))[0]
    assert np.allclose(still[:6, 0], [4.8, 5.0, 5.2, 4.8, 5.0, 5.2])
    assert np.allclose(still[6:, 2], [6.8, 7.0, 7.2, 6.8, 7.0, 7.2])
    assert np.allclose(still[:6, 2], 7.0) and np.allclose(still[6:, 0], 5.0)
    assert np.allclose(still[:, 1], np.tile([1, 1, 1, 1.6, 1.6, 1.6], 2))
    moved = crossed_quads(place, size, np.array([[0.05, -0.03]]))[0] - still
    wanted = np.zeros((12, 3))
    wanted[[4, 10]] = (0.05, 0.0, -0.03)
    assert np.allclose(moved, wanted)


def test_the_four_triangles_of_a_plants_quad_cover_it_once() -> None:
    corners = crossed_quads(np.zeros((1, 3)), np.array([[2.0, 1.0]]), np.zeros((1, 2)))[0]
    triangles = corners[np.concatenate([HALVES, HALVES + 6]).reshape(-1, 3)]
    areas = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]) / 2
    assert len(triangles) == 8
    assert areas[:4, 2].tolist() == [0.5] * 4
    assert np.abs(areas[4:, 0]).tolist() == [0.5] * 4


def test_indices_name_each_quads_own_vertices_from_far_to_near() -> None:
    tree = Quads.of(
        np.zeros((2, 4, 3)), np.zeros((2, 4, 2)), np.zeros((2, 4)), QUAD, np.array([-1.0, -3.0])
    )
    plant = Quads.of(
        np.zeros((1, 6, 3)), np.zeros((1, 6, 2)), np.zeros((1, 4)), HALVES, np.array([-2.0])
    )
    both = Quads.join([tree, plant])
    first, second = QUAD[0].tolist(), (QUAD[0] + 4).tolist()
    halves = (HALVES.ravel() + 8).tolist()
    assert both.indices(sort=False).tolist() == first + second + halves
    assert both.indices(sort=True).tolist() == second + halves + first
    assert both.indices(sort=True).dtype == np.uint32
    assert len(both.vertices) == 14 == both.indices(sort=False).max() + 1
    nothing = Quads.of(
        np.zeros((0, 4, 3)), np.zeros((0, 4, 2)), np.zeros((0, 4)), QUAD, np.zeros(0)
    )
    assert nothing.indices(sort=True).shape == (0,)


def test_texture_coordinates_stay_inside_their_cell_and_under_the_gutter() -> None:
    s, t = np.array([0.0, 1.0]), np.array([0.0, 1.0])
    uv = cell_coordinates(np.array([0, 5]), np.array([False, False]), s, t)
    half_u, half_v = 0.5 / CELL / 4, 0.5 / CELL / 2
    gutter = GUTTER / CELL / 2
    assert uv[0, 0] == pytest.approx([half_u, gutter])
    assert uv[0, 1] == pytest.approx([0.25 - half_u, 0.5 - half_v])
    assert uv[1, 0] == pytest.approx([0.25 + half_u, 0.5 + gutter])


def test_a_mirrored_sprite_runs_backwards_in_s_alone() -> None:
    s, t = np.array([0.0, 0.3, 1.0]), np.array([0.2, 0.5, 0.9])
    there, back = cell_coordinates(np.array([2, 2]), np.array([False, True]), s, t)
    assert np.allclose(there[:, 0] + back[:, 0], 2 * (2.5 / 4))
    assert np.allclose(there[:, 1], back[:, 1])


def test_the_atlas_lays_its_cells_out_in_rows_of_four() -> None:
    cells = [np.full((8, 8, 4), k + 1, np.uint8) for k in range(7)]
    sheet = atlas(cells)
    assert sheet.shape == (16, 32, 4)
    assert [int(sheet[3, 8 * k + 3, 0]) for k in range(4)] == [1, 2, 3, 4]
    assert [int(sheet[11, 8 * k + 3, 0]) for k in range(4)] == [5, 6, 7, 0]


@pytest.fixture(scope="module")
def sprites(the_stage: Stage, tmp_path_factory) -> Iterator[TransparentElements]:
    """The element, its cells of one colour each: broadleaf red, conifer blue, plant green."""
    the_stage.enter()
    folder = tmp_path_factory.mktemp("sprites")
    colours = {name: (9, 9, 9, 255) for name in CELLS}
    colours |= {CELLS[0]: RED, CELLS[1]: BLUE, CELLS[PLANT]: PLANT_GREEN}
    write_plain(folder)
    for name, colour in colours.items():
        Image.new("RGBA", (CELL, CELL), colour).save(folder / name)
    settings = small({"transparent.radius": 50.0})
    assets = Assets(folder)
    ground = Ground(settings, assets, np.array([0, 1, 0], np.float32))
    element = TransparentElements(settings, assets, ground, 1, {"trees", "deer", "plants"})
    yield element
    the_stage.enter()
    element.release()
    ground.release()


def put(element: TransparentElements, places, cells, size=(1.0, 1.0), alpha=None) -> None:
    """Let the element have these sprites and no others."""
    n = len(places)
    tints = np.full((n, 4), 255.0)
    if alpha is not None:
        tints[:, 3] = alpha
    sizes = np.tile(np.array(size, float), (n, 1))
    element.stand(
        Sprites(np.array(places, float), sizes, np.array(cells), np.zeros(n, bool), tints)
    )


SETTINGS = small({"transparent.radius": 50.0})
NORTH = Pose(20.0, 3.5, 20.0, 0.0, 0.0)


def seen(stage: Stage, element: TransparentElements, pose: Pose = NORTH, kt: float = 0.0):
    with stage.frame(SETTINGS, pose, kt) as frame:
        element.draw(frame)
        return stage.read()


@pytest.mark.parametrize("pose", [NORTH, Pose(20.0, 3.5, 20.0, 0.0, -20.0)])
def test_a_tree_covers_exactly_its_width_and_height(stage: Stage, sprites, pose: Pose) -> None:
    place = (20.0, 3.0, 16.0)
    put(sprites, [place], [1])
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
    if nearer_first:
        put(sprites, [near, far], [0, 1], alpha=[128, 255])
    else:
        put(sprites, [far, near], [1, 0], alpha=[255, 128])
    got = pixel(seen(stage, sprites), project(NORTH, (20.0, 3.4, 15.0)))
    part = 128 / 255
    assert close(got, part * np.array(RED[:3]) + (1 - part) * np.array(BLUE[:3]), 2)


def test_a_plant_between_two_trees_is_sorted_with_them(stage: Stage, sprites) -> None:
    places = [(20.0, 3.0, 17.0), (20.0, 3.0, 16.0), (20.0, 3.0, 15.0)]
    put(sprites, places, [0, PLANT, 1], alpha=[128, 255, 255])
    got = pixel(seen(stage, sprites), project(NORTH, (20.0, 3.3, 16.0)))
    part = 128 / 255
    assert close(got, part * np.array(RED[:3]) + (1 - part) * np.array(PLANT_GREEN[:3]), 3)


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
    put(sprites, [(20.0, 3.0, 17.0)], [1])
    assert (seen(stage, sprites, kt=0) == seen(stage, sprites, kt=31.0)).all()


def test_the_tint_multiplies_the_picture(stage: Stage, sprites) -> None:
    put(sprites, [(20.0, 3.0, 17.0)], [1])
    sprites.sprites.tints[:, :3] = 128
    got = pixel(seen(stage, sprites), project(NORTH, (20.0, 3.4, 17.0)))
    assert close(got, np.array(BLUE[:3]) * 128 / 255, 2)


def test_nothing_in_view_draws_nothing(stage: Stage, sprites) -> None:
    put(sprites, [(20.0, 3.0, 30.0)], [1])
    assert close(seen(stage, sprites), BACKGROUND)
