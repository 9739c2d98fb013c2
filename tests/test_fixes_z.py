"""The fixes of the ground: smooth, stood on exactly, of three kinds, in tiles; charts."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from PIL import Image
from sprite_stage import looking
from stage import PLAIN, Stage, close, small

from landscape.elements.animal import by_axis, read_animal
from landscape.elements.ground import Ground, clipped, cut, every_second, rock_share, textured
from landscape.elements.rabbit import Rabbit
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.geometry.camera import boxes_in_view
from landscape.geometry.height_field import (
    HeightField,
    ground_mesh,
    height_field,
    smoothed,
    spline_weights,
)
from landscape.geometry.mesh import Mesh
from landscape.gl.calls import recording
from landscape.island import Island
from landscape.keys import with_settings
from landscape.settings import Ground as GroundSettings
from landscape.settings import Settings
from landscape.window.walker import eye_height

SUN = np.array([0.0, 1.0, 0.0], np.float32)
LARGE = np.array(PLAIN["ground_large.png"])


def rough(n: int = 14, exact: bool = True) -> HeightField:
    heights = np.random.default_rng(3).random((n, n)).astype(np.float32) * 4 + 1
    return HeightField(heights, 40.0, 0.6, exact)


def drawn_heights(mesh: Mesh, x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Return the y of the mesh's triangles over each x, z: found by barycentric coordinates."""
    a, b, c = (mesh.vertices[mesh.triangles[:, k]].astype(np.float64) for k in range(3))
    out = np.full(len(x), np.nan)
    for k, (px, pz) in enumerate(zip(x, z, strict=True)):
        det = (b - a)[:, 0] * (c - a)[:, 2] - (b - a)[:, 2] * (c - a)[:, 0]
        u = ((px - a[:, 0]) * (c - a)[:, 2] - (pz - a[:, 2]) * (c - a)[:, 0]) / det
        v = ((pz - a[:, 2]) * (b - a)[:, 0] - (px - a[:, 0]) * (b - a)[:, 2]) / det
        hit = np.flatnonzero((u >= -1e-9) & (v >= -1e-9) & (u + v <= 1 + 1e-9))[0]
        out[k] = a[hit, 1] + u[hit] * (b - a)[hit, 1] + v[hit] * (c - a)[hit, 1]
    return out


# R15


@pytest.mark.parametrize("smooth", ["none", "b_spline"])
def test_the_eye_is_always_as_high_above_the_surface_drawn(shipped: Assets, smooth: str) -> None:
    changes = {"ground.exact_height": True, "ground.smooth": smooth, "ground.subdivide": 2}
    settings = with_settings(Settings(), {**changes, "water.level": 0.0})
    image = np.random.default_rng(1).random((64, 64)) * 200 + 20
    field = height_field(image, settings.ground, settings.water.level)
    x, z = np.random.default_rng(2).random((2, 1000)) * 40
    surface = drawn_heights(ground_mesh(field, (1.0,)), x, z)
    eye = [eye_height(a, b, 0.0, field, settings) for a, b in zip(x, z, strict=True)]
    above = np.array(eye) - surface
    assert np.abs(above - (settings.walk.eye + settings.walk.bob)).max() < 1e-4


def test_without_the_fix_the_eye_is_off_by_more_than_a_hand() -> None:
    field = rough(exact=False)
    x, z = np.random.default_rng(2).random((2, 200)) * 40
    off = field.terrain_height(x, z) - drawn_heights(ground_mesh(field, (1.0,)), x, z)
    assert np.abs(off).max() > 0.1


def test_at_the_vertices_and_outside_both_ways_agree() -> None:
    at = np.linspace(0, 40, 14)
    x, z = np.meshgrid([-5, *at, 44], [-2, *at, 41])
    assert np.allclose(
        rough().terrain_height(x, z), rough(exact=False).terrain_height(x, z), atol=1e-5
    )


# R14


@pytest.mark.parametrize("kind", ["catmull_rom", "b_spline"])
def test_a_plane_stays_a_plane_under_either_spline(kind: str) -> None:
    column, row = np.meshgrid(np.arange(7.0), np.arange(7.0))
    fine = np.linspace(0, 6, 19)
    wanted = 2 * fine[None, :] - 3 * fine[:, None] + 1
    assert np.allclose(smoothed(2 * column - 3 * row + 1, 3, kind), wanted)


def test_catmull_rom_passes_through_the_knots_and_the_b_spline_near_them() -> None:
    heights = rough().heights.astype(float)
    assert np.allclose(smoothed(heights, 4, "catmull_rom")[::4, ::4], heights)
    near = smoothed(heights, 4, "b_spline")[4:-4:4, 4:-4:4]
    kernel = np.array([1, 4, 1]) / 6
    rows = sum(k * heights[i : 12 + i] for i, k in enumerate(kernel))
    wanted = sum(k * rows[:, i : 12 + i] for i, k in enumerate(kernel))
    assert np.allclose(near, wanted)


@pytest.mark.parametrize("kind", ["catmull_rom", "b_spline"])
def test_the_patches_meet_with_one_slope(kind: str) -> None:
    parts = 50
    curve = spline_weights(6, parts, kind) @ np.array([0, 3, -2, 5, 5, 1.0])
    slope = np.diff(curve) * parts
    knots = np.arange(1, 5) * parts
    assert np.abs(slope[knots] - slope[knots - 1]).max() < 1.0  # bilinear: up to 12
    assert np.abs(slope).max() > 3


def test_the_setting_makes_a_finer_ground_of_the_same_data() -> None:
    image = np.random.default_rng(1).random((32, 32)) * 255
    plain = height_field(image, GroundSettings(resolution=10), 0.0)
    fine = height_field(
        image, GroundSettings(resolution=10, smooth="catmull_rom", subdivide=4), 0.0
    )
    assert plain.heights.shape == (10, 10) and fine.heights.shape == (37, 37)
    assert np.allclose(fine.heights[::4, ::4], plain.heights, atol=1e-5)


# Tiles


def test_the_tiles_hold_every_triangle_once() -> None:
    mesh = ground_mesh(rough(), (1.0, 5.0))
    tiles = cut(mesh, 4)
    assert len(tiles) == 16

    def corners(m: Mesh) -> set[bytes]:
        return {m.vertices[t].tobytes() + m.coordinates[1][t].tobytes() for t in m.triangles}

    parts = [corners(tile.mesh) for tile in tiles]
    assert sum(map(len, parts)) == len(mesh.triangles)
    assert set.union(*parts) == corners(mesh)


@pytest.mark.parametrize("side", [8, 9])
def test_every_second_row_and_column_leaves_a_quarter_of_the_triangles(side: int) -> None:
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


def test_the_mirrored_ground_alone_is_coarser(stage: Stage, shipped: Assets) -> None:
    pictures, sent = [], []
    for coarse in (1.0, 4.0):
        settings = small({"ground.tiles": 4, "reflection.lod_scale": coarse})
        island = Island(settings, shipped, only=("ground", "reflection", "fog"))
        with recording() as recorder:
            # Recorded anew: what the display lists hold is known from their making.
            ground = Ground(settings, shipped, np.array([0.5, 0.7, 0.5]))
        for mirrored in (False, True):
            with stage.frame(settings, POSES[0]) as frame:
                island.ground.draw(replace(frame, mirrored=mirrored))
                pictures.append(stage.read())
        counts = [
            call.args[1]
            for calls in recorder.lists.values()
            for call in calls
            if call.name == "glDrawElements"
        ]
        sent.append(sum(counts))
        ground.release()
        island.release()
    straight, mirrored_, straight_, coarser = pictures
    assert (straight == straight_).all()
    assert (mirrored_ != coarser).any()
    assert np.abs(mirrored_.astype(int) - coarser).mean() < 6
    assert sent[0] * 1.2 < sent[1] < sent[0] * 1.3


def test_a_box_before_the_camera_is_seen_and_one_behind_or_aside_is_not() -> None:
    frame = looking(Pose(20.0, 3.0, 20.0, 0.0, 0.0))
    low = np.array([(19, 2, 10), (19, 2, 25), (60, 2, 10), (-100, -9, -100), (19, 30, 10)], float)
    halves = np.array([(1, 1, 1), (1, 1, 1), (1, 1, 1), (100, 10, 100), (1, 1, 1)], float)
    assert boxes_in_view(frame, low + halves, halves).tolist() == [True, False, False, True, False]


POSES = [
    Pose(20.0, 6.0, 30.0, 20.0, -15.0),
    Pose(5.0, 1.0, 35.0, 300.0, 0.0),
    Pose(20.0, 9.0, 20.0, 0.0, -88.0),
]


@pytest.mark.parametrize("pose", POSES)
@pytest.mark.parametrize("materials", [False, True])
def test_no_pixel_changes_when_tiles_out_of_view_are_skipped(
    stage: Stage, shipped: Assets, pose: Pose, materials: bool
) -> None:
    pictures, calls = [], []
    for tiles in (1, 6):
        settings = small({"ground.tiles": tiles, "ground.materials": materials})
        island = Island(settings, shipped, only=("ground", "reflection", "fog"))
        with stage.frame(settings, pose) as frame:
            with clipped(settings.water.level):
                island.ground.draw(frame)
            pictures.append(stage.read())
        calls.append(len(island.ground.tiles_in_view(frame)) if tiles > 1 else 0)
        island.release()
    assert (pictures[0] == pictures[1]).all()
    assert 0 < calls[1] < 36


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
    ground = Ground(settings, Assets(folder), SUN)
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


def test_the_detail_laid_into_the_colours_keeps_their_mean() -> None:
    detail = (np.random.default_rng(1).random((64, 64, 3)) * 200 + 27.5).astype(np.uint8)
    colours = np.full((256, 256, 3), 100, np.uint8)
    green = textured(colours, detail, 8.0, np.full((256, 256, 1), 255, np.uint8))
    bare = textured(colours, detail, 8.0, np.zeros((256, 256, 1), np.uint8))
    assert abs(green.mean() - 100) < 2 and abs(bare.mean() - 100) < 2
    assert green.std() > 2.5 * bare.std() > 0


# R19


def test_no_texture_is_larger_than_asked_for(stage: Stage, plain_folder) -> None:
    colours = np.zeros((64, 64, 3), np.uint8)
    Image.fromarray(colours).save(plain_folder / "ground_large.png")
    sizes = []
    for limit in (4096, 16):
        ground = Ground(small({"ground.texture_size": limit}), Assets(plain_folder), SUN)
        sizes.append(ground.large.shape)
        ground.release()
    assert sizes == [(64, 64, 3), (16, 16, 3)]


# R12


def test_every_face_is_mapped_along_the_axis_it_looks_at(shipped: Assets) -> None:
    vertices, normals, triangles = read_animal(shipped, "rabbit.ply", "key")
    mesh = by_axis(Mesh(vertices, normals, triangles), 4.0)
    assert len(mesh.triangles) == len(triangles)
    assert np.allclose(mesh.vertices[mesh.triangles], vertices[triangles])

    def stretch(coordinates: np.ndarray, corners: np.ndarray, points: np.ndarray) -> np.ndarray:
        """Texture area over area, of each face: 4 is a chart seen straight on."""
        s, p = coordinates[corners], points[corners].astype(np.float64)
        a, b = s[:, 1] - s[:, 0], s[:, 2] - s[:, 0]
        size = np.linalg.norm(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1)
        return np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / np.maximum(size, 1e-12)

    charts = stretch(mesh.coordinates[0], mesh.triangles, mesh.vertices)
    # No face is stretched; a few on edges, where the smooth normals differ, are compressed.
    assert charts.max() < 4.0 + 1e-3
    assert np.quantile(charts, 0.02) > 4.0 / math.sqrt(3) * 0.8


def test_the_setting_chooses_the_rabbits_mapping(stage: Stage, shipped: Assets) -> None:
    pictures = {}
    for mapping in ("cylindrical", "axis"):
        settings = small({"rabbit.mapping": mapping, "rabbit.x": 20.0, "rabbit.z": 20.0})
        rabbit = Rabbit(settings, shipped, HeightField(np.full((4, 4), 2.0, np.float32), 40.0, 0.6))
        with stage.frame(settings, Pose(20.0, 2.5, 20.2, 0.0, -60.0)):
            rabbit.draw()
            pictures[mapping] = stage.read()
        rabbit.release()
    changed = (np.abs(pictures["axis"] - pictures["cylindrical"]) > 4).any(axis=2)
    assert changed.sum() > 500


# 2006 is as it was


def test_all_the_cures_are_off_in_2006() -> None:
    ground = Settings().ground
    assert (ground.smooth, ground.exact_height, ground.materials, ground.tiles) == (
        *("none", False, False),
        1,
    )
    assert Settings().rabbit.mapping == "cylindrical"
