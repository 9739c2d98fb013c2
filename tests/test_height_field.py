"""The height field: resampling, height queries, normals, smooth patches, low-stretch UVs."""

import numpy as np
import pytest
from PIL import Image

from landscape.elements.settings import Ground as GroundSettings
from landscape.elements.settings import Settings
from landscape.files.assets import Assets
from landscape.files.images import read_heights
from landscape.geometry.height_colours import colour_by_height
from landscape.geometry.height_field import HeightField, ground_mesh, height_field, lookup
from landscape.geometry.low_stretch import low_stretch_coordinates, low_stretch_uv
from landscape.geometry.mesh import Mesh
from landscape.geometry.splines import smoothed, spline_weights
from landscape.settings.declare import with_settings
from landscape.walk.walker import eye_height


def plane(a: float, b: float, n: int = 9, level: float = -100.0) -> HeightField:
    """Return the height field a x + b z + 1 over 40 x 40 units."""
    at = np.linspace(0.0, 40.0, n)
    heights = a * at[None, :] + b * at[:, None] + 1.0
    return HeightField(heights.astype(np.float32), 40.0, level)


def test_the_normal_of_a_plane_is_at_right_angles_to_it_everywhere() -> None:
    # Section 2.1.2: Ground::get_normal.
    x, z = np.array([3.3, 20.0, 31.7]), np.array([8.1, 20.0, 2.9])
    normals = plane(0.3, -0.4).normal(x, z)
    assert normals == pytest.approx(np.array([[-0.3, 1.0, 0.4]] * 3) / np.sqrt(1.25), abs=1e-6)
    assert plane(0.3, -0.4).normal(5.0, 5.0).shape == (3,)
    assert plane(0.0, 0.0).normal(5.0, 5.0).tolist() == [0.0, 1.0, 0.0]


def test_vertex_k_of_n_samples_the_image_at_k_over_n() -> None:
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


def test_outside_the_map_the_height_of_the_border_continues() -> None:
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


def test_all_triangles_are_counter_clockwise_seen_from_above() -> None:
    heights = np.random.default_rng(2).random((7, 7)).astype(np.float32)
    mesh = ground_mesh(HeightField(heights, 40.0, 0.0), (1.0,))
    a, b, c = (mesh.vertices[mesh.triangles[:, k]] for k in range(3))
    up = np.cross(b - a, c - a)[:, 1]
    assert (up > 0).all()
    assert up.sum() / 2 == pytest.approx(40.0 * 40.0, rel=1e-5)


def test_vertices_stand_at_k_over_n_minus_1_and_indices_are_in_range() -> None:
    mesh = ground_mesh(plane(0.1, 0.2, n=5), (1.0, 160.0))
    assert mesh.vertices[7].tolist() == pytest.approx([20.0, 0.1 * 20 + 0.2 * 10 + 1, 10.0])
    assert mesh.triangles.shape == (2 * 4 * 4, 3)
    assert mesh.triangles.dtype == np.uint32
    assert set(np.unique(mesh.triangles)) == set(range(25))
    assert mesh.coordinates[0][7].tolist() == pytest.approx([0.5, 0.25])
    assert mesh.coordinates[1][7].tolist() == pytest.approx([80.0, 40.0])


def test_an_island_without_a_texture_has_sand_low_down_and_green_above() -> None:
    colours = colour_by_height(plane(0.1, 0.0, level=1.0), np.array([0, 1, 0]), 64).astype(int)
    red, green, blue = colours[32, 0]
    assert red > green > blue  # sand
    red, green, blue = colours[32, 9]
    assert green > red > blue  # grass


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


# Standing on the triangles that are drawn (R15)


@pytest.mark.seldom(13)
@pytest.mark.parametrize("smooth", ["none", "b_spline"])
def test_the_eye_is_always_equally_high_above_the_drawn_surface(
    shipped: Assets, smooth: str
) -> None:
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


# Bicubic patches (R14)


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
def test_the_patches_meet_with_the_same_slope(kind: str) -> None:
    parts = 50
    curve = spline_weights(6, parts, kind) @ np.array([0, 3, -2, 5, 5, 1.0])
    slope = np.diff(curve) * parts
    knots = np.arange(1, 5) * parts
    assert np.abs(slope[knots] - slope[knots - 1]).max() < 1.0  # bilinear: up to 12
    assert np.abs(slope).max() > 3


def test_the_setting_makes_a_finer_ground_from_the_same_data() -> None:
    image = np.random.default_rng(1).random((32, 32)) * 255
    plain = height_field(image, GroundSettings(resolution=10), 0.0)
    fine = height_field(
        image, GroundSettings(resolution=10, smooth="catmull_rom", subdivide=4), 0.0
    )
    assert plain.heights.shape == (10, 10) and fine.heights.shape == (37, 37)
    assert np.allclose(fine.heights[::4, ::4], plain.heights, atol=1e-5)


# Low-stretch texture coordinates


def test_on_level_ground_low_stretch_uvs_are_x_and_z() -> None:
    laid = low_stretch_coordinates(np.full((9, 9), 3.0, np.float32), 0.5)
    x, z = np.meshgrid(np.arange(9) * 0.5, np.arange(9) * 0.5)
    assert np.allclose(laid - laid[0, 0], np.stack([x, z], axis=2), atol=1e-5)


def test_on_a_steep_bank_a_texture_is_no_longer_stretched() -> None:
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
    bare, laid = (ground_mesh(field, (1.0, 8.0), uv) for uv in (None, low_stretch_uv(field)))
    assert np.array_equal(laid.coordinates[0], bare.coordinates[0])
    assert np.allclose(bare.coordinates[1], 8 * bare.coordinates[0])
    rows = laid.coordinates[1].reshape(6, 6, 2)[:, 0, 1]
    assert rows[-1] - rows[0] > 1.2 * 8.0
