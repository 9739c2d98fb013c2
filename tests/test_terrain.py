"""The ground of the preset best: tiles, a coarser mirror image, three materials, shadows."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from PIL import Image
from stage import Stage, close, kind_in, small, taken

from framelens.gl.seam import lists_now, recording
from landscape.elements.best.terrain import terrain
from landscape.elements.best.terrain.materials import (
    ROCK,
    SAND,
    TURF,
    mixtures,
    rock_share,
    textured,
    turf_range,
)
from landscape.elements.best.terrain.terrain import Terrain, shaded
from landscape.elements.best.terrain.tiles import boxes, cut, every_second
from landscape.elements.ground import Ground, clipped
from landscape.elements.sun import direction
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.geometry.culling import boxes_in_view
from landscape.geometry.height_field import HeightField, ground_mesh
from landscape.island.slots import GROUND
from landscape.settings.declare import with_settings

SUN = np.array([0.0, 1.0, 0.0], np.float32)


def rough() -> HeightField:
    heights = np.random.default_rng(3).random((14, 14)).astype(np.float32) * 4 + 1
    return HeightField(heights, 40.0, 0.6)


def test_the_settings_choose_the_class_of_the_ground() -> None:
    assert kind_in(GROUND, small({"ground.smooth": "catmull_rom"})) is Ground
    for key, value in (
        ("materials", True),
        ("tiles", 2),
        ("low_stretch", True),
        ("shadows", True),
    ):
        assert kind_in(GROUND, small({f"ground.{key}": value})) is Terrain


# Tiles


def test_the_tiles_hold_every_triangle_once() -> None:
    mesh = ground_mesh(rough(), (1.0, 5.0))
    tiles = cut(mesh, 4)
    assert len(tiles) == 16

    parts = [set(map(tuple, tile.triangles.tolist())) for tile in tiles]
    assert sum(map(len, parts)) == len(mesh.triangles)
    assert set.union(*parts) == set(map(tuple, mesh.triangles.tolist()))


def test_a_box_in_front_is_in_view_and_one_behind_or_aside_is_not(stage: Stage) -> None:
    with stage.frame(small(), Pose(20.0, 3.0, 20.0, 0.0, 0.0)) as frame:
        pass
    low = np.array([(19, 2, 10), (19, 2, 25), (60, 2, 10), (-100, -9, -100), (19, 30, 10)], float)
    halves = np.array([(1, 1, 1), (1, 1, 1), (1, 1, 1), (100, 10, 100), (1, 1, 1)], float)
    assert boxes_in_view(frame, low + halves, halves).tolist() == [True, False, False, True, False]


def test_a_tiles_box_holds_it_and_is_mirrored_at_the_water() -> None:
    mesh = ground_mesh(rough(), (1.0,))
    tiles = cut(mesh, 3)
    (middles, halves), (mirrored, same) = boxes(tiles), boxes(tiles, 0.6)
    for tile, middle, half in zip(tiles, middles, halves, strict=True):
        assert (np.abs(mesh.vertices[tile.triangles] - middle) <= half + 1e-5).all()
    assert np.array_equal(halves, same)
    assert np.allclose(mirrored[:, 1], 1.2 - middles[:, 1])
    assert np.array_equal(mirrored[:, ::2], middles[:, ::2])


@pytest.mark.parametrize("side", [8, 9])
def test_keeping_every_second_row_and_column_leaves_a_quarter_of_the_triangles(side: int) -> None:
    heights = np.random.default_rng(3).random((side, side)).astype(np.float32)
    mesh = ground_mesh(HeightField(heights, 40.0, 0.6), (1.0, 5.0))
    coarse = every_second(mesh)
    cells = (side - 1 + 1) // 2
    assert len(coarse.triangles) == 2 * cells**2
    fine, kept = (
        {row.tobytes() for row in np.hstack([m.vertices, m.normals, *m.coordinates])}
        for m in (mesh, coarse)
    )
    assert kept < fine
    assert coarse.vertices[:, [0, 2]].min() == 0.0 and coarse.vertices[:, [0, 2]].max() == 40.0
    a, b, c = (coarse.vertices[coarse.triangles[:, k]][:, [0, 2]] for k in range(3))
    area = np.cross(np.insert(b - a, 2, 0, axis=1), np.insert(c - a, 2, 0, axis=1))[:, 2] / 2
    assert np.abs(area).sum() == pytest.approx(1600.0) and (area < 0).all()


POSES = [
    Pose(20.0, 6.0, 30.0, 20.0, -15.0),
    Pose(5.0, 1.0, 35.0, 300.0, 0.0),
    Pose(20.0, 9.0, 20.0, 0.0, -88.0),
]


def test_the_mirrored_ground_alone_is_coarser(stage: Stage, shipped: Assets) -> None:
    pictures, sent = [], []
    for coarse in (1.0, 4.0):
        settings = small({"ground.tiles": 4, "reflection.lod_scale": coarse})
        others = dict(lists_now())  # of elements that tests before this one did not release
        with recording():
            ground = Terrain(settings, shipped, np.array([0.5, 0.7, 0.5]))
        for mirrored in (False, True):
            with stage.frame(settings, POSES[0]) as frame:
                ground.draw(replace(frame, mirrored=mirrored))
                pictures.append(stage.read())
        counts = [
            call.args[1]
            for number, listing in lists_now().items()
            for call in listing.calls()
            if listing is not others.get(number) and call.name == "glDrawElements"
        ]
        sent.append(sum(counts))
        ground.release()

    straight, mirrored_, straight_, coarser = pictures
    assert (straight == straight_).all()
    assert (mirrored_ != coarser).any()
    assert np.abs(mirrored_.astype(int) - coarser).mean() < 6
    assert sent[0] * 1.2 < sent[1] < sent[0] * 1.3


def test_the_mirrored_ground_beside_the_eye_is_fine(stage: Stage, shipped: Assets) -> None:
    settings = small({"ground.tiles": 8, "reflection.lod_scale": 4.0})
    ground = Terrain(settings, shipped, np.array([0.5, 0.7, 0.5]))
    try:
        with stage.frame(settings, Pose(20.0, 1.0, 22.5, 0.0, 0.0)) as frame:
            with recording() as recorder:
                ground.draw(replace(frame, mirrored=True))
    finally:
        ground.release()
    meshes = [[c for c in call.listed if c.name == "glDrawElements"] for call in recorder.calls]
    counts = [call.args[1] for mesh in meshes for call in mesh]
    fine = [count > 2 * np.median(counts) for count in counts]
    assert fine[0] and 1 <= sum(fine) <= 4 < len(fine)  # the nearest come first


@pytest.mark.parametrize("pose", POSES)
@pytest.mark.parametrize("materials", [False, True])
@pytest.mark.sweep(3)
def test_no_pixel_changes_when_tiles_out_of_view_are_skipped(
    stage: Stage, shipped: Assets, pose: Pose, materials: bool
) -> None:
    pictures, calls = [], []
    for tiles in (1, 6):
        settings = small({"ground.tiles": tiles, "ground.materials": materials})
        ground = kind_in(GROUND, settings)(settings, shipped, np.array([0.5, 0.7, 0.5]))
        with stage.frame(settings, pose) as frame:
            with clipped(settings.water.level):
                ground.draw(frame)
            pictures.append(stage.read())
        if tiles > 1:
            assert isinstance(ground, Terrain)
            calls.append(len(ground.tiles_in_view(frame)))
        ground.release()
    assert (pictures[0] == pictures[1]).all()
    assert 0 < calls[-1] < 36


# Materials


MATERIALS: dict[str, Any] = {
    "ground_sand.png": (60, 60, 60),
    "ground_rock.png": (160, 160, 160),
    "ground_detail.png": (127, 127, 127),
}


def material_picture(stage: Stage, folder: Any, large: tuple[int, int, int], steep: bool) -> Any:
    for name, colour in {**MATERIALS, "ground_large.png": large}.items():
        Image.fromarray(np.full((4, 4, 3), colour, np.uint8)).save(folder / name)
    if steep:
        ramp = np.repeat(np.arange(256, dtype=np.uint8)[None, :], 256, axis=0)
        Image.fromarray(ramp).save(folder / "height.png")
    settings = small({"ground.materials": True, "ground.scale_y": 60.0 if steep else 6.0})
    ground = Terrain(settings, Assets(folder), SUN)
    with stage.frame(settings, Pose(20.0, 80.0, 20.0, 0.0, -90.0)) as frame:
        ground.draw(frame)
        picture = stage.read()
    ground.release()
    return picture[60, 80]


@pytest.mark.parametrize(
    ("large", "steep", "detail"),
    [
        ((90, 120, 50), False, 127),  # green and level: turf
        ((130, 110, 90), False, 60),  # not green, not grey: sand
        ((130, 110, 90), True, 160),  # steep: rock
        ((110, 110, 108), False, 160),  # grey: rock
    ],
)
@pytest.mark.sweep(2)
def test_each_kind_of_ground_has_its_own_detail(
    stage: Stage, plain_folder, large: tuple[int, int, int], steep: bool, detail: int
) -> None:
    got = material_picture(stage, plain_folder, large, steep)
    assert close(got, np.array(large) * detail * 2 / 255, 3)


def test_rock_shows_where_it_is_steep_or_grey_and_hardly_under_green() -> None:
    steep = np.array([(0.6, 0.8, 0.0)] * 2)
    colours = np.array([(0.5, 0.4, 0.3), (0.2, 0.5, 0.1)])
    assert rock_share(steep, colours) == pytest.approx([1.0, 0.3])
    assert rock_share(np.array([(0.0, 1.0, 0.0)]), colours[:1]) == pytest.approx([0.0])


def test_detail_baked_into_the_colours_keeps_their_mean() -> None:
    detail = (np.random.default_rng(1).random((64, 64, 3)) * 200 + 27.5).astype(np.uint8)
    colours = np.full((256, 256, 3), 100, np.uint8)
    green = textured(colours, detail, 8.0, np.full((256, 256, 1), 255, np.uint8))
    bare = textured(colours, detail, 8.0, np.zeros((256, 256, 1), np.uint8))
    assert abs(green.mean() - 100) < 2 and abs(bare.mean() - 100) < 2
    assert green.std() > 2.5 * bare.std() > 0


def test_a_triangle_has_the_materials_that_filtering_may_mix_into_it() -> None:
    turf = np.full((64, 64), 255, np.uint8)
    turf[:, 32:] = 0
    least, most = turf_range(turf, 8)
    assert (most[:, :4] == 255).all() and (least[:, 4:] == 0).all()
    # The cells beside the edge have texels of both sides.
    assert (least[:, :3] == 255).all() and (least[:, 3] == 0).all()
    assert (most[:, 5:] == 0).all() and (most[:, 4] == 255).all()


def test_what_is_only_turf_or_covered_by_rock_looks_up_nothing_else() -> None:
    turf = np.array([[255, 0, 0, 255], [255, 255, 0, 255]], np.uint8)
    rock = np.zeros((8, 3), np.uint8)
    rock[0, 1] = 100  # one corner of the first triangle
    rock[6:] = 255
    found = mixtures(turf, rock).tolist()
    assert found == [TURF | ROCK, TURF, *2 * [TURF | SAND], *2 * [SAND], *2 * [ROCK]]


def test_materials_that_are_not_there_are_not_missed(
    stage: Stage, shipped: Assets, monkeypatch: pytest.MonkeyPatch
) -> None:
    settings, pictures = small({"ground.materials": True, "ground.tiles": 4}), []
    for kinds in (mixtures, lambda turf, rock: np.full(len(rock), TURF | SAND | ROCK)):
        monkeypatch.setattr(terrain, "mixtures", kinds)
        ground = Terrain(settings, shipped, SUN)
        with stage.frame(settings, POSES[0]) as frame:
            ground.draw(frame)
            pictures.append(stage.read().astype(int))
        ground.release()
    apart = np.abs(pictures[0] - pictures[1])
    assert apart.max() < 32 and (apart > 4).mean() < 0.02


# Shadows


@pytest.mark.parametrize("materials", [False, True])
def test_the_ground_shows_the_light_map_and_keeps_its_own_colour(
    stage: Stage, plain: Assets, materials: bool
) -> None:
    settings = small({"ground.materials": materials, "ground.shadows": True})
    ground = Terrain(settings, plain, direction(settings.sun))
    x = z = np.array([20.0])
    colour = ground.colour(x, z)
    pictures = []
    for light in (None, np.full((*ground.large.shape[:2], 3), 127, np.uint8)):
        if light is not None:
            ground.shade(light)
        with stage.frame(settings, Pose(20.0, 5.0, 20.0, 0.0, -80.0)) as frame:
            ground.draw(frame)
            pictures.append(stage.read()[60, 80])
    ground.release()
    assert np.allclose(pictures[1], pictures[0] * 0.5, atol=2.0) and pictures[0].min() > 20
    assert np.array_equal(ground.colour(x, z), colour)
    assert np.allclose(ground.light(x, z), 127 / 255)


def test_a_shaded_texture_is_colour_times_light_within_one_level() -> None:
    rng = np.random.default_rng(6)
    painted = rng.integers(0, 256, (40, 40, 4)).astype(np.uint8)
    light = rng.integers(0, 256, (40, 40, 3)).astype(np.uint8)
    got = shaded(painted, light)
    assert np.abs(got[..., :3] - painted[..., :3] * (light / 255.0)).max() <= 1.0
    assert np.array_equal(got[..., 3], painted[..., 3])
    assert np.array_equal(shaded(painted, np.full_like(light, 255)), painted)


def test_the_terrain_accepts_settings_read_each_frame_and_refuses_the_rest(
    stage: Stage, plain: Assets
) -> None:
    settings = small({"ground.tiles": 4, "ground.clip": False})
    ground = Terrain(settings, plain, SUN)
    with stage.frame(settings, Pose(20.0, 9.0, 20.0, 0.0, -88.0)) as frame:
        every = len(ground.tiles_in_view(frame))
        assert taken(ground, with_settings(settings, {"camera.cull": True, "ground.clip": True}))
        with recording() as recorder:
            ground.draw(frame)

    assert any("CULL_FACE" in str(call.shown) for call in recorder.calls) and every > 0
    for changes in (
        {"ground.tiles": 5},
        {"ground.materials": True},
        {"ground.shadows": True},
        {"ground.scale_y": 3.0},
        {"water.level": 1.0},
        {"reflection.lod_scale": 8.0},
    ):
        assert not taken(ground, with_settings(settings, changes))

    assert taken(ground, with_settings(settings, {"reflection.lod_scale": 0.5 + 0.5}))
    ground.release()
