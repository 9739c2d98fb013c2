"""The ground: heights and normals in closed form, two texture units, the clip plane."""

import numpy as np
import pytest
from PIL import Image
from stage import Stage, close, pixel, project, small

from landscape.elements.ground import Ground, clipped
from landscape.files.assets import Assets
from landscape.files.images import read_heights
from landscape.frame import Pose
from landscape.geometry.height_field import (
    HeightField,
    colour_by_height,
    ground_mesh,
    height_field,
    lookup,
    low_stretch_coordinates,
)
from landscape.settings import Ground as GroundSettings

SUN = np.array([0.0, 1.0, 0.0], np.float32)
DOWN = Pose(20.0, 9.0, 20.0, 0.0, -90.0)


def plane(a: float, b: float, n: int = 9, level: float = -100.0) -> HeightField:
    """Return the height field a x + b z + 1 over 40 x 40 units."""
    at = np.linspace(0.0, 40.0, n)
    heights = a * at[None, :] + b * at[:, None] + 1.0
    return HeightField(heights.astype(np.float32), 40.0, level)


def test_vertex_k_of_n_takes_the_image_at_k_over_n() -> None:
    row, column = np.mgrid[0:8, 0:8]
    image = (3 * column + 20 * row).astype(np.float32)
    field = height_field(image, GroundSettings(resolution=4, scale_y=6.4), 0.0)
    for r in range(4):
        for k in range(4):
            # At k/4 of 8 texels stands texel 2 k.
            assert field.heights[r, k] == pytest.approx((6 * k + 40 * r) / 256 * 6.4)


def test_between_texels_the_lookup_is_linear() -> None:
    image = np.array([[0.0, 100.0], [200.0, 60.0]])
    assert lookup(image, np.array(0.25), np.array(0.0)) == pytest.approx(50.0)
    assert lookup(image, np.array(0.25), np.array(0.25)) == pytest.approx((0 + 100 + 200 + 60) / 4)
    assert lookup(image, np.array(7.0), np.array(-1.0)) == pytest.approx(100.0)


def test_only_the_red_channel_is_height(tmp_path) -> None:
    pixels = np.dstack([np.full((4, 4), 77), np.full((4, 4), 200), np.full((4, 4), 9)])
    Image.fromarray(pixels.astype(np.uint8)).save(tmp_path / "h.png")
    assert (read_heights(tmp_path / "h.png") == 77).all()


def test_a_16_bit_image_keeps_its_bits(tmp_path) -> None:
    Image.fromarray(np.array([[0, 257, 300], [65535, 128, 514]], np.uint16)).save(
        tmp_path / "h.png"
    )
    heights = read_heights(tmp_path / "h.png")
    assert heights[0].tolist() == pytest.approx([0.0, 1.0, 300 / 257])
    assert heights[1].tolist() == pytest.approx([255.0, 128 / 257, 2.0])


def test_heights_between_vertices_are_bilinear() -> None:
    heights = np.array([[0, 1, 0], [2, 5, 0], [0, 0, 0]], np.float32)
    field = HeightField(heights, 40.0, -1.0)
    assert field.terrain_height(20.0, 20.0) == pytest.approx(5.0)
    assert field.terrain_height(10.0, 0.0) == pytest.approx(0.5)
    # A quarter of the first cell along x, half of it along z.
    near, far = 0.75 * 0 + 0.25 * 1, 0.75 * 2 + 0.25 * 5
    assert field.terrain_height(5.0, 10.0) == pytest.approx((near + far) / 2)


def test_outside_the_map_the_border_goes_on() -> None:
    field = plane(0.1, 0.05)
    assert field.terrain_height(-3.0, 20.0) == pytest.approx(field.terrain_height(0.0, 20.0))
    assert field.terrain_height(50.0, 41.0) == pytest.approx(0.1 * 40 + 0.05 * 40 + 1, rel=1e-6)


def test_nobody_stands_below_the_water() -> None:
    field = plane(0.1, 0.0, level=3.0)
    assert field.height(5.0, 7.0) == pytest.approx(3.0)
    assert field.terrain_height(5.0, 7.0) == pytest.approx(1.5)
    assert field.height(30.0, 7.0) == pytest.approx(4.0)


def test_the_slope_of_a_plane_is_its_gradient() -> None:
    field = plane(0.3, -0.4, n=21)
    x, z = np.array([7.3, 20.0, 31.1]), np.array([9.9, 20.0, 5.5])
    assert field.slope(x, z) == pytest.approx(0.5, rel=1e-4)


def test_normals_of_a_plane_are_its_normal() -> None:
    mesh = ground_mesh(plane(0.3, -0.4), (1.0,))
    wanted = np.array([-0.3, 1.0, 0.4]) / np.sqrt(1 + 0.3**2 + 0.4**2)
    assert np.allclose(mesh.normals, wanted, atol=1e-5)


def test_normals_of_rough_ground_have_length_one_and_point_up() -> None:
    heights = np.random.default_rng(1).random((12, 12)).astype(np.float32) * 9
    mesh = ground_mesh(HeightField(heights, 40.0, 0.0), (1.0,))
    assert np.allclose(np.linalg.norm(mesh.normals, axis=1), 1.0, atol=1e-5)
    assert (mesh.normals[:, 1] > 0).all()


def test_all_triangles_turn_counter_clockwise_seen_from_above() -> None:
    heights = np.random.default_rng(2).random((7, 7)).astype(np.float32)
    mesh = ground_mesh(HeightField(heights, 40.0, 0.0), (1.0,))
    a, b, c = (mesh.vertices[mesh.triangles[:, k]] for k in range(3))
    up = np.cross(b - a, c - a)[:, 1]
    assert (up > 0).all()
    assert up.sum() / 2 == pytest.approx(40.0 * 40.0, rel=1e-5)


def test_vertices_stand_at_k_over_n_minus_1_and_indices_stay_inside() -> None:
    mesh = ground_mesh(plane(0.1, 0.2, n=5), (1.0, 160.0))
    assert mesh.vertices[7].tolist() == pytest.approx([20.0, 0.1 * 20 + 0.2 * 10 + 1, 10.0])
    assert mesh.triangles.shape == (2 * 4 * 4, 3)
    assert mesh.triangles.dtype == np.uint32
    assert set(np.unique(mesh.triangles)) == set(range(25))
    assert mesh.coordinates[0][7].tolist() == pytest.approx([0.5, 0.25])
    assert mesh.coordinates[1][7].tolist() == pytest.approx([80.0, 40.0])


def test_an_island_without_a_texture_is_sand_low_and_green_above() -> None:
    colours = colour_by_height(plane(0.1, 0.0, level=1.0), np.array([0, 1, 0]), 64).astype(int)
    red, green, blue = colours[32, 0]
    assert red > green > blue  # sand
    red, green, blue = colours[32, 9]
    assert green > red > blue  # grass


LARGE, DETAIL = np.array([100, 150, 200]), np.array([96, 96, 96])


@pytest.mark.parametrize(
    ("units", "wanted"),
    [
        ("both", LARGE * DETAIL * 2 / 255),
        ("large", LARGE),
        ("detail", DETAIL),
        ("none", (255, 255, 255)),
    ],
)
def test_two_texture_units_give_large_times_detail_times_two(
    stage: Stage, plain: Assets, units: str, wanted
) -> None:
    settings = small({"ground.units": units})
    ground = Ground(settings, plain, SUN)
    with stage.frame(settings, DOWN) as frame:
        ground.draw(frame)
        picture = stage.read()
    ground.release()
    assert close(picture[20:100:20, 20:140:20], wanted)


def test_a_third_unit_multiplies_by_twice_the_detail_once_more(stage: Stage, plain: Assets) -> None:
    settings = small({"ground.mid_repeat": 13.0})
    ground = Ground(settings, plain, SUN)
    with stage.frame(settings, DOWN) as frame:
        ground.draw(frame)
        picture = stage.read()
    ground.release()
    assert close(picture[60, 80], LARGE * (DETAIL * 2 / 255) ** 2, 2)


def test_the_ground_is_drawn_where_its_heights_say(stage: Stage, plain_folder) -> None:
    ramp = np.repeat(np.arange(256, dtype=np.uint8)[None, :], 256, axis=0)
    Image.fromarray(ramp).save(plain_folder / "height.png")
    settings = small({"ground.resolution": 100})
    ground = Ground(settings, Assets(plain_folder), SUN)
    pose = Pose(20.0, 8.0, 60.0, 0.0, 0.0)
    with stage.frame(settings, pose) as frame:
        ground.draw(frame)
        picture = stage.read()
    ground.release()
    for x in (8.0, 20.0, 31.0):
        # The edge towards us stands at z = 40, at the height of its image column.
        height = x / 40 * 99 / 100 * 6
        column, row = project(pose, (x, height, 40.0))
        assert close(picture[int(row - 1.5), int(column)], LARGE * DETAIL * 2 / 255)
        assert close(picture[int(row + 1.5), int(column)], np.array([0.4, 0.6, 0.7]) * 255)


def test_the_clip_plane_removes_everything_below_the_water(stage: Stage, plain_folder) -> None:
    ramp = np.repeat(np.arange(256, dtype=np.uint8)[None, :], 256, axis=0)
    Image.fromarray(ramp).save(plain_folder / "height.png")
    settings = small({"ground.resolution": 100})
    ground = Ground(settings, Assets(plain_folder), SUN)
    level = 3.0
    pose = Pose(20.0, 30.0, 20.0, 0.0, -90.0)
    pictures = {}
    for enabled in (True, False):
        with stage.frame(settings, pose) as frame:
            with clipped(level, enabled):
                ground.draw(frame)
            pictures[enabled] = stage.read()
    ground.release()
    shore = level / 6 * 100 / 99 * 40
    column, row = project(pose, (shore, level, 20.0))
    sky, land = np.array([0.4, 0.6, 0.7]) * 255, LARGE * DETAIL * 2 / 255
    line = pictures[True][int(row)]
    assert close(line[int(column - 2)], sky) and close(line[int(column + 2)], land)
    assert close(pictures[False][int(row), int(column - 2)], land)


def test_the_plane_goes_away_when_the_block_ends_even_by_an_exception(stage: Stage) -> None:
    with stage.frame(small(), DOWN):  # the frame itself looks at what is enabled
        with pytest.raises(RuntimeError):
            with clipped(1.0):
                raise RuntimeError


def test_the_colour_asked_for_is_the_colour_drawn(stage: Stage, plain_folder) -> None:
    colours = np.zeros((64, 64, 3), np.uint8)
    colours[..., 0] = np.arange(64) * 4
    colours[..., 2] = 255 - np.arange(64)[:, None] * 4
    Image.fromarray(colours).save(plain_folder / "ground_large.png")
    settings = small({"ground.units": "large"})
    ground = Ground(settings, Assets(plain_folder), SUN)
    pose = Pose(20.0, 40.0, 20.0, 0.0, -90.0)
    with stage.frame(settings, pose) as frame:
        ground.draw(frame)
        picture = stage.read()
    asked = [(10.0, 12.0), (20.0, 30.0), (29.0, 7.0)]
    for x, z in asked:
        drawn = pixel(picture, project(pose, (x, 3.0, z)))
        assert close(drawn, ground.colour(np.array([x]), np.array([z]))[0] * 255, 4)
    ground.release()


def test_a_textile_on_level_ground_stays_as_it_was_cut() -> None:
    laid = low_stretch_coordinates(np.full((9, 9), 3.0, np.float32), 0.5)
    x, z = np.meshgrid(np.arange(9) * 0.5, np.arange(9) * 0.5)
    assert np.allclose(laid - laid[0, 0], np.stack([x, z], axis=2), atol=1e-5)


def test_on_a_steep_bank_a_texture_is_no_longer_drawn_out() -> None:
    # Level, a bank of 60 degrees, level again; seen from above each cell is one unit long.
    profile = np.concatenate([np.zeros(12), 1.732 * np.arange(1, 9), np.full(12, 1.732 * 8)])
    heights = np.repeat(profile[None].astype(np.float32), 32, axis=0)
    laid = low_stretch_coordinates(heights, 1.0)
    along = np.hypot(*(laid[:, 1:] - laid[:, :-1]).transpose(2, 0, 1))
    on_ground = np.hypot(1.0, np.diff(heights, axis=1))
    assert 1 / on_ground.max() == pytest.approx(0.5, abs=1e-3)  # what x and z alone would give
    assert (along / on_ground).min() > 0.8 and (along / on_ground).max() < 1.25


def test_only_details_follow_the_slopes_and_only_when_asked() -> None:
    heights = np.add.outer(np.arange(6.0), np.zeros(6)).astype(np.float32)
    field = HeightField(heights, 5.0, -1.0)
    bare, laid = (ground_mesh(field, (1.0, 8.0), follow) for follow in (False, True))
    assert np.array_equal(laid.coordinates[0], bare.coordinates[0])
    assert np.allclose(bare.coordinates[1], 8 * bare.coordinates[0])
    rows = laid.coordinates[1].reshape(6, 6, 2)[:, 0, 1]
    assert rows[-1] - rows[0] > 1.2 * 8.0
