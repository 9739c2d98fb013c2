"""The castle: closed walls facing outward, a gate in three layers, sixteen flames."""

import math
from dataclasses import replace

import numpy as np
import pytest
from castles import BRICK, DOOR, FLAT, GATE, PLACED, at, drawn
from PIL import Image
from stage import (
    PLAIN,
    WHITE_LIGHT,
    Stage,
    close,
    kind_in,
    pixel,
    project,
    small,
    taken,
    write_plain,
)

from framelens.gl.seam import gl
from landscape.elements.best.castle.gate import CastleInOnePass
from landscape.elements.best.castle.ornate_castle import OrnateCastle
from landscape.elements.castle import Castle
from landscape.elements.castle_fire import FLAME_Z, TORCHES, flame_across, flame_frame
from landscape.elements.castle_gate import light_shift
from landscape.elements.settings import preset
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.geometry.height_field import HeightField
from landscape.geometry.masonry import (
    FOOT,
    MERLON,
    TOWER_RADIUS,
    TOWER_TOP,
    WALL,
    box_quads,
    quads_mesh,
    tower_mesh,
    wall_boxes,
    walls_mesh,
)
from landscape.geometry.mesh import Mesh
from landscape.island.slots import CASTLE
from landscape.settings.declare import with_settings

LIGHT = np.array(PLAIN["castle_light.png"]) / 255


def test_the_flame_runs_through_sixteen_frames_of_two_kt_each() -> None:
    assert [flame_frame(kt) for kt in (0, 1, 2, 7, 8, 30, 31.9)] == [
        *((0, 0), (0, 0), (1, 0), (3, 0), (0, 1)),
        *((3, 3), (3, 3)),
    ]
    assert len({flame_frame(kt) for kt in range(32)}) == 16
    assert all(flame_frame(kt) == flame_frame(kt + 32) for kt in range(32))


def test_the_light_moves_as_the_report_says() -> None:
    assert light_shift(0.0) == pytest.approx((0.0, 0.01))
    assert light_shift(5.0) == pytest.approx(
        (0.01 * math.sin(5 / 10.8) ** 2, 0.01 * math.cos(5 / 7.2) ** 2)
    )
    shifts = np.array([light_shift(kt) for kt in np.linspace(0, 500, 999)])
    assert shifts.min() >= 0 and shifts.max() <= 0.01


def turned_outward(mesh: Mesh) -> np.ndarray:
    """Return for each triangle whether its winding agrees with its vertices' normals."""
    a, b, c = (mesh.vertices[mesh.triangles[:, k]] for k in range(3))
    face = np.cross(b - a, c - a)
    return (face * mesh.normals[mesh.triangles].sum(axis=1)).sum(axis=1) > 0


@pytest.mark.parametrize("mesh", [walls_mesh(4.0), tower_mesh(4.0)], ids=["walls", "tower"])
def test_meshes_have_unit_normals_valid_indices_and_one_winding(mesh: Mesh) -> None:
    assert np.allclose(np.linalg.norm(mesh.normals, axis=1), 1.0, atol=1e-5)
    assert mesh.triangles.max() == len(mesh.vertices) - 1
    solid = (
        np.linalg.norm(
            np.cross(
                *(
                    mesh.vertices[mesh.triangles[:, k]] - mesh.vertices[mesh.triangles[:, 0]]
                    for k in (1, 2)
                )
            ),
            axis=1,
        )
        > 1e-9
    )
    assert turned_outward(mesh)[solid].all()
    for array in (mesh.vertices, mesh.normals, *mesh.coordinates):
        assert array.dtype == np.float32 and array.flags.c_contiguous


def test_a_boxs_faces_point_away_from_its_centre_and_its_bottom_is_open() -> None:
    quads = box_quads(1.0, 2.0, 3.0, 2.0, 4.0, 6.0)
    normals = np.cross(quads[:, 1] - quads[:, 0], quads[:, 2] - quads[:, 0])
    outward = quads.mean(axis=1) - (1.5, 3.0, 4.5)
    assert ((normals * outward).sum(axis=1) > 0).all()
    assert len(quads) == 5 and not (quads[:, :, 1] == 2.0).all(axis=1).any()


def test_the_walls_span_the_unit_square_and_one_unit_of_height() -> None:
    vertices = walls_mesh(4.0).vertices
    assert vertices[:, ::2].min() == 0.0 and vertices[:, ::2].max() == 1.0
    assert vertices[:, 1].min() == pytest.approx(-FOOT)
    tops = np.unique(np.round(vertices[:, 1], 3))
    assert tops.tolist() == pytest.approx([-FOOT, 1.0, 1.07], abs=1e-3)


def test_merlons_stand_between_the_towers_on_all_four_walls() -> None:
    boxes = np.array(wall_boxes())
    assert len(boxes) == 20
    assert (boxes[:, 1] == 1.0).all() and (boxes[:, 3:] > boxes[:, :3]).all()
    assert boxes[:, [0, 2]].min() == 0.0 and boxes[:, [3, 5]].max() == 1.0
    middle = (boxes[:, [0, 2]] + boxes[:, [3, 5]]) / 2
    for corner in ((0, 0), (0, 1), (1, 0), (1, 1)):
        assert np.hypot(*(middle - corner).T).min() > TOWER_RADIUS


def test_bricks_have_the_same_size_on_every_wall() -> None:
    quads = np.concatenate([box_quads(0, 0, 0, 2, 1, 3)])
    mesh = quads_mesh(quads, 4.0)
    for k in range(4):  # the upright faces
        corners, uv = mesh.vertices[4 * k : 4 * k + 4], mesh.coordinates[0][4 * k : 4 * k + 4]
        assert np.linalg.norm(uv[1] - uv[0]) == pytest.approx(
            4 * np.linalg.norm(corners[1] - corners[0])
        )
        assert abs(uv[2, 1] - uv[1, 1]) == pytest.approx(4.0)


def test_a_tower_is_round_and_reaches_from_foot_to_top() -> None:
    vertices = tower_mesh(4.0).vertices
    assert vertices[:, 1].min() == pytest.approx(-FOOT)
    assert vertices[:, 1].max() == pytest.approx(TOWER_TOP)
    foot = vertices[np.isclose(vertices[:, 1], -FOOT)]
    assert np.allclose(np.hypot(foot[:, 0], foot[:, 2]), TOWER_RADIUS, atol=1e-6)


def test_the_gate_is_the_door_times_the_light(stage: Stage, plain: Assets) -> None:
    picture = drawn(stage, plain)
    for x, y in ((0.5, 0.5), (0.2, 0.8), (0.8, 0.1)):
        assert close(pixel(picture, project(GATE, at(x, y, 0.0))), DOOR * LIGHT)


def test_bricks_show_through_the_doors_transparent_surround_and_are_lit(
    stage: Stage, plain_folder
) -> None:
    assets = Assets(write_plain(plain_folder, {"castle_door.png": (90, 60, 30, 0)}))
    picture = drawn(stage, assets)
    assert close(pixel(picture, project(GATE, at(0.5, 0.5, 0))), BRICK * LIGHT)


def test_a_half_transparent_door_is_blended_before_it_is_lit(stage: Stage, plain_folder) -> None:
    assets = Assets(write_plain(plain_folder, {"castle_door.png": (90, 60, 30, 102)}))
    picture = drawn(stage, assets)
    wanted = (0.4 * DOOR + 0.6 * BRICK) * LIGHT
    assert close(pixel(picture, project(GATE, at(0.5, 0.5, 0))), wanted, 2)


@pytest.mark.parametrize("distance", [1.0, 4.0, 15.0])
def test_the_layers_do_not_z_fight_at_any_distance(
    stage: Stage, plain: Assets, distance: float
) -> None:
    pose = Pose(20.7, 2.6, 19.5 - distance, 180.0 + math.degrees(math.atan2(0.7, distance)), -2.0)
    picture = drawn(stage, plain, pose)
    corners = [project(pose, at(x, y, 0.0)) for x in (0.3, 0.7) for y in (0.4, 0.9)]
    columns, rows = np.array(corners).T
    top, bottom = max(int(rows.min()) + 1, 0), min(int(rows.max()) - 1, 119)
    left, right = max(int(columns.min()) + 1, 0), min(int(columns.max()) - 1, 159)
    part = picture[top:bottom, left:right]
    assert part.size and close(part, DOOR * LIGHT, 2)


def test_only_the_gate_has_layers(stage: Stage, plain: Assets) -> None:
    south = Pose(20.0, 2.4, 22.5, 0.0, 0.0)
    picture = drawn(stage, plain, south)
    assert close(pixel(picture, project(south, at(0.5, 0.5, 1.0))), BRICK)


def test_a_tower_stands_at_every_corner(stage: Stage, plain: Assets) -> None:
    above = Pose(20.0, 6.0, 20.0, 0.0, -90.0)
    picture = drawn(stage, plain, above)
    for x in (0.0, 1.0):
        for z in (0.0, 1.0):
            outside = at(x + (x - 0.5) * 0.1, TOWER_TOP - 0.06, z + (z - 0.5) * 0.1)
            assert close(pixel(picture, project(above, outside)), BRICK)
    background = np.array([0.4, 0.6, 0.7]) * 255
    assert close(pixel(picture, project(above, at(0.5, 0.0, 0.5))), background)
    assert close(pixel(picture, project(above, at(-0.35, 0.0, 0.5))), background)


@pytest.mark.parametrize("kt", [0.0, 7.0, 21.0])
def test_both_torches_show_the_current_frame_of_the_flame(
    stage: Stage, plain_folder, kt: float
) -> None:
    sheet = np.zeros((256, 256, 4), np.uint8)
    colours = np.array([(15 * k, 255 - 15 * k, 40 + 10 * k, 255) for k in range(16)])
    for k in range(16):
        row, column = divmod(k, 4)
        sheet[64 * row : 64 * row + 64, 64 * column : 64 * column + 64] = colours[k]
    Image.fromarray(sheet).save(plain_folder / "fire.png")
    pose = Pose(20.0, 2.3, 18.6, 180.0, 0.0)
    picture = drawn(stage, Assets(plain_folder), pose, kt)
    number = int(kt * 0.5) % 16
    assert TORCHES == (0.27, 0.75)
    for x in TORCHES:
        assert close(pixel(picture, project(pose, at(x, 0.27, FLAME_Z))), colours[number, :3], 2)
        beside = pixel(picture, project(pose, at(x + 0.05, 0.27, FLAME_Z)))
        assert close(beside, DOOR * LIGHT, 2)


def test_the_gate_turns_with_the_yaw(stage: Stage, plain: Assets) -> None:
    settings = small({**WHITE_LIGHT, "castle.x": 20.0, "castle.z": 20.0, "castle.yaw": 90.0})
    castle = Castle(settings, plain, FLAT)
    west = Pose(17.8, 2.5, 20.0, 90.0, 0.0)  # turning about y by 90 takes north to west
    with stage.frame(settings, west) as frame:
        castle.draw(frame)
        got = stage.read()[60, 80]
    castle.release()
    assert close(got, DOOR * LIGHT)


SETTINGS = small({**WHITE_LIGHT, **PLACED})


def test_the_castle_stands_on_the_lowest_of_its_corners(stage: Stage, plain: Assets) -> None:
    at_ = np.linspace(0, 40, 41)
    slope = HeightField(np.tile(at_ * 0.1, (41, 1)).astype(np.float32), 40.0, 0.0)
    castle = Castle(SETTINGS, plain, slope)
    castle.release()
    assert castle.base == pytest.approx((20.0, 1.94, 20.0))


# R2


def test_r2_a_flame_turns_to_the_eye_and_stays_upright() -> None:
    assert flame_across((0.3, -5.0), 0.3, True) == pytest.approx((1.0, 0.0))
    assert flame_across((5.0, FLAME_Z), 0.3, True) == pytest.approx((0.0, 1.0))
    assert flame_across((5.0, FLAME_Z), 0.3, False) == (1.0, 0.0)
    for eye in ((3.0, -2.0), (-1.0, -0.5)):
        x, z = flame_across(eye, 0.75, True)
        assert math.hypot(x, z) == pytest.approx(1.0)
        assert x * (0.75 - eye[0]) + z * (FLAME_Z - eye[1]) == pytest.approx(0.0)


@pytest.mark.parametrize("fixed", [False, True])
def test_r2_from_the_side_a_flame_is_as_wide_as_from_the_front(
    stage: Stage, plain_folder, fixed: bool
) -> None:
    Image.new("RGBA", (64, 64), (255, 0, 255, 255)).save(plain_folder / "fire.png")
    side = Pose(20.0, 2.26, 19.5 + FLAME_Z, 90.0, 0.0)
    picture = drawn(stage, Assets(plain_folder), side, castle__flame_faces=fixed)
    flame = (np.abs(picture - (255, 0, 255)).max(axis=2) < 9)[60]
    near = 19.5 + TORCHES[1] - 20.0
    wide = 0.06 / near * 60 / math.tan(math.radians(30))
    assert flame.sum() == (pytest.approx(wide, abs=2) if fixed else 0)


# The castle as a part of the island


@pytest.mark.seldom(13, first=4)
@pytest.mark.parametrize("changes", [{}, {"multitexture": True}, {"ornate": True}])
@pytest.mark.parametrize("rippled", [False, True])
def test_mirrored_or_not_no_texture_stays_bound(
    stage: Stage, plain: Assets, changes: dict[str, bool], rippled: bool
) -> None:
    keys = {f"castle.{key}": value for key, value in changes.items()}
    settings = small({**WHITE_LIGHT, **PLACED, **keys, "reflection.rippled": rippled})
    castle = kind_in(CASTLE, settings)(settings, plain, FLAT)
    for is_mirrored in (False, True):
        with stage.frame(settings, GATE) as frame:
            castle.draw(replace(frame, mirrored=is_mirrored))
            assert int(gl.glGetIntegerv(gl.GL_TEXTURE_BINDING_2D)) == 0
    castle.release()


def test_the_settings_choose_the_class_of_the_castle() -> None:
    for changes, chosen in (
        ({}, Castle),
        ({"castle.flame_faces": True}, Castle),
        ({"castle.multitexture": True}, CastleInOnePass),
        ({"castle.ornate": True, "castle.multitexture": True}, OrnateCastle),
    ):
        assert kind_in(CASTLE, small(changes)) is chosen


def test_flames_turn_alike_whether_the_setting_is_built_in_or_applied_later(
    stage: Stage, plain_folder
) -> None:
    Image.new("RGBA", (64, 64), (255, 0, 255, 255)).save(plain_folder / "fire.png")
    assets = Assets(plain_folder)
    side = Pose(20.0, 2.26, 19.5 + FLAME_Z, 90.0, 0.0)
    wanted = drawn(stage, assets, side, castle__flame_faces=True)
    castle = Castle(SETTINGS, assets, FLAT)
    settings = with_settings(SETTINGS, {"castle.flame_faces": True})
    assert taken(castle, settings)
    with stage.frame(settings, side) as frame:
        castle.draw(frame)
        picture = stage.read()
    castle.release()
    assert (picture == wanted).all() and (picture != drawn(stage, assets, side)).any()


@pytest.mark.seldom(14, first=4)
@pytest.mark.parametrize("changes", [{}, {"multitexture": True}, {"ornate": True}])
def test_what_is_compiled_is_not_changed_by_settings(
    stage: Stage, plain: Assets, changes: dict[str, bool]
) -> None:
    settings = small({**PLACED, **{f"castle.{key}": value for key, value in changes.items()}})
    castle = kind_in(CASTLE, settings)(settings, plain, FLAT)
    for key, value in (
        ("x", 21.0),
        ("yaw", 5.0),
        ("brick_repeat", 2.0),
        ("ornate", not changes.get("ornate")),
    ):
        assert not taken(castle, with_settings(settings, {f"castle.{key}": value}))
    lit_once = bool(changes.get("ornate"))
    assert taken(castle, with_settings(settings, {"sun.azimuth": 200.0})) != lit_once
    castle.release()


@pytest.mark.seldom(13, first=4)
@pytest.mark.parametrize("changes", [{}, {"multitexture": True}, {"ornate": True}])
def test_the_obstacles_are_the_walls_and_towers(
    stage: Stage, plain: Assets, changes: dict[str, bool]
) -> None:
    keys = {f"castle.{key}": value for key, value in changes.items()}
    settings = small({**PLACED, "castle.yaw": -160.0, **keys})
    castle = kind_in(CASTLE, settings)(settings, plain, FLAT)
    found = castle.obstacles()
    castle.release()
    assert len(found) == 8
    tops = sorted({round(each.top, 6) for each in found})
    assert tops == pytest.approx([2.0 + 1.0 + MERLON, 2.0 + TOWER_TOP])
    # The middle of the yard is free, and half a unit farther out along the turned x axis is a wall.
    middle = settings.castle.x, settings.castle.z
    yaw = math.radians(settings.castle.yaw)
    wall = middle[0] + 0.49 * math.cos(yaw), middle[1] - 0.49 * math.sin(yaw)
    assert min(each.gap(*middle)[0] for each in found) == pytest.approx(0.5 - WALL)
    assert min(each.gap(*wall)[0] for each in found) < 0.0


def test_the_report_s_towers_have_few_sides_and_a_flat_top_and_its_walls_no_merlons() -> None:
    # Section 6: four rectangular walls, four cylinders with few details.
    tower = tower_mesh(4.0, 8, battlements=False)
    rim = tower.vertices[np.abs(tower.vertices[:, 1] - TOWER_TOP) < 1e-6]
    around = rim[np.hypot(rim[:, 0], rim[:, 2]) > 0.5 * TOWER_RADIUS]
    angles = np.round(np.degrees(np.arctan2(around[:, 2], around[:, 0]))) % 360
    assert len(np.unique(angles)) == 8
    assert np.hypot(around[:, 0], around[:, 2]).max() == pytest.approx(TOWER_RADIUS)
    assert tower.vertices[:, 1].max() == pytest.approx(TOWER_TOP)
    upright = np.abs(tower.normals[:, 1]) < 0.5
    turns = np.round(np.degrees(np.arctan2(tower.normals[:, 2], tower.normals[:, 0]))[upright])
    assert len(np.unique(turns)) == 8, "each side is flat"
    walls = walls_mesh(4.0, battlements=False)
    assert walls.vertices[:, 1].max() == 1.0 and len(walls.vertices) == 4 * 5 * 4
    assert walls_mesh(4.0).vertices[:, 1].max() > 1.0
    assert preset("2006").castle.sides == 8 and not preset("2006").castle.battlements
