"""Filled mode of the fly-over: which ground each pixel shows, its light, and its switches."""

import math
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from framelens.base.errors import InputError
from landscape.flyover import blending, close_up, filled, frame, ground, march, sunlight
from landscape.flyover.camera import Camera, Frustum, camera_transform
from landscape.flyover.height_field import HeightField, height_field
from landscape.flyover.noise import noise
from landscape.flyover.reflection import reflection
from landscape.flyover.settings import Flyover, Settings
from landscape.settings.declare import with_settings

SIZE = (160, 120)
VOLUME = Frustum(-4 / 3, 4 / 3, 1, -1, 1.5, 4096)
SMALL = {"flyover.mode": "filled", "filled.texels": 128}


def hills(relief: float = 24.0) -> HeightField:
    image = noise(64, 4, 1.9)
    image = (image - image.min()) / np.ptp(image) * 255
    return height_field(image, Flyover(relief=relief))


@pytest.fixture
def red(tmp_path: Path) -> str:
    """Return the name of an image that makes all of the ground red, as the sky never is."""
    Image.new("RGB", (20, 20), (230, 20, 20)).save(tmp_path / "red.png")
    return str(tmp_path / "red.png")


def is_red(picture: np.ndarray) -> np.ndarray:
    return np.asarray(picture[..., 0] > 1.3 * picture[..., 2])


def look(field: HeightField, camera: Camera, **changes: object) -> np.ndarray:
    """Return a filled picture as int, (h, w, 3)."""
    keys = {key.replace("__", "."): value for key, value in changes.items()}
    settings = with_settings(Settings(), SMALL | {"flyover.relief": 24.0} | keys)
    return frame.draw(field, camera, settings, SIZE).picture.astype(int)


@pytest.mark.seldom(14, first=8)
def test_a_frame_is_opaque_and_has_the_sky_above_and_the_ground_below(red: str) -> None:
    settings = with_settings(Settings(), SMALL | {"filled.image": red, "filled.sea": 0})
    drawn = frame.draw(hills(), Camera(20, 20, 40), settings, SIZE)
    assert drawn.rgba.shape == (120, 160, 4) and (drawn.rgba[..., 3] == 255).all()
    ground = is_red(drawn.picture.astype(int))
    assert not ground[:40].any() and ground[80:].all()


@pytest.mark.sweep(8)
@pytest.mark.parametrize(
    "angles", ((0, 0), (0.25, 0), (-0.3, 0), (0, 0.5), (0.4, -0.3), (0.7, 0.0))
)
def test_each_pixel_shows_the_ground_that_its_ray_meets(
    angles: tuple[float, float], red: str
) -> None:
    """Compare with rays that are followed one small step at a time."""
    pitch, roll = angles
    field = hills()
    camera = Camera(20, 30, 24, roll, pitch, 0.8)
    changes = {"filled__sea": 0, "filled__fog": False, "filled__edges": False}
    ground = is_red(look(field, camera, filled__image=red, flyover__far=150.0, **changes))
    rays = view_directions(camera)
    for row, column in np.random.default_rng(2).integers((0, 0), (120, 160), (150, 2)):
        along = rays[row, column][:, None] * np.arange(1.5, 150, 0.05)
        above = along[2] + camera.z - field.height(along[0] + camera.x, along[1] + camera.y)
        # A pixel is 0.011 wide at distance 1: what is as narrow as two of them may be missed.
        steep = above / np.arange(1.5, 150, 0.05)
        if np.abs(steep).min() > 0.012 or (steep < -0.022).any():
            assert ground[row, column] == (above < 0).any(), (row, column)


def view_directions(camera: Camera) -> np.ndarray:
    """Return the ray of each pixel's centre, (h, w, 3), in the world, 1 along the line of sight."""
    column, row = np.meshgrid(np.arange(160) - 0.5, np.arange(120) - 0.5)
    y, z = (column / 80 - 1) * 4 / 3 / 1.5, (1 - row / 60) / 1.5
    # The camera transform is a rotation: its transpose turns back.
    axes = np.array(camera_transform(*np.eye(3), camera))
    return np.stack([np.ones_like(y), y, z], axis=2) @ axes


def test_filling_columns_at_once_gives_what_a_loop_from_front_to_back_gives() -> None:
    tops = np.random.default_rng(5).uniform(-20, 80, (40, 25)).astype(np.float32)
    found = march.filled_by(tops, 60)
    for column in range(25):
        expected, free = np.full(60, 40), 60
        for step in range(40):
            top = max(math.ceil(tops[step, column]), 0)
            expected[top:free] = step
            free = min(free, top)
        assert (found[:, column] == expected).all()


def test_the_terrain_goes_on_as_mirror_images_without_a_seam() -> None:
    field, height = hills(), 30.0
    changes = {"filled__shadows": False, "filled__occlusion": False}
    at = look(field, Camera(-40, 30, height, 0, 0.3, 0.4), **changes)
    further = look(field, Camera(-40 + 128, 30 - 256, height, 0, 0.3, 0.4), **changes)
    assert np.abs(at - further).mean() < 0.3
    path = march.steps(1.5, 200.0, 0.02, 4.0, len(field.levels), 1.0)
    out = np.empty((len(path.distances), 2), np.float32)
    across = np.array([[-1.0, 1.0], [0.3, 0.3]], np.float32)
    march.walk(field, path, (0.0, 10.0, 0.0), across, -100.0, True, True, out)
    assert np.allclose(out[:, 0], out[:, 1], atol=1e-4)


def test_without_mirror_images_the_terrain_ends_at_its_borders(red: str) -> None:
    camera = Camera(20, 32, 60, 0, 0.5, 0)
    changes = {"filled__sea": 0, "filled__fog": False, "filled__image": red}
    on, off = (
        is_red(look(hills(), camera, flyover__mirror=mirror, **changes)).mean(axis=1)
        for mirror in (True, False)
    )
    assert on[110] == 1 and on[40] == 1
    assert off[118] > 0.6 and off[40] == 0


def test_far_ground_fades_into_the_colour_of_the_horizon(red: str) -> None:
    changes = {"filled__clouds": False, "filled__image": red, "filled__sea": 0}
    hazy, clear = (
        look(hills(), Camera(20, 20, 40), flyover__visible=v, **changes)[:, 80]
        for v in (200.0, 4000.0)
    )
    horizon = look(hills(), Camera(20, 20, 1e3), flyover__visible=200.0, **changes)[57, 80]
    differences = np.abs(hazy[66:] - horizon).sum(axis=1)
    assert differences[0] < 60 < 0.3 * differences[-1] and (np.diff(differences) >= -25).all()
    assert np.abs(clear[66:] - horizon).sum(axis=1).min() > 100


def test_steep_pitches_are_drawn_as_the_steepest_that_keeps_clear_of_the_nadir() -> None:
    most = filled.steepest(VOLUME, 0.0)
    assert math.radians(35) < most < math.atan(1.5)
    steep, limit = (look(hills(), Camera(20, 20, 60, 0, p, 0)) for p in (1.5, most))
    assert (steep == limit).all()


@pytest.mark.seldom(10)
def test_an_eye_below_the_water_is_lifted_above_it() -> None:
    deep, high, dry = (
        look(hills(), Camera(20, 20, z, 0, 0.1, 2.0), filled__sea=0.4) for z in (2, 8, 30)
    )
    assert (deep == high).all() and (deep != dry).any()
    heights = [filled.afloat(z, 9.6) for z in np.linspace(0, 20, 400)]
    assert min(heights) == 9.6 + filled.AFLOAT and heights[-1] == 20
    assert np.diff(heights).min() >= 0 and np.diff(heights).max() < 0.051


@pytest.mark.seldom(14, first=12)
def test_ground_before_the_near_plane_is_drawn_where_it_is(tmp_path: Path) -> None:
    # A slope that rises before the eye, which is less than the near plane from it.
    field = height_field(
        np.tile(4 * np.arange(64), (64, 1)), Flyover(relief=128.0, black_high=False)
    )
    stripes = np.zeros((1, 512, 3), np.uint8)
    stripes[:, ::2] = 255
    Image.fromarray(stripes).save(tmp_path / "stripes.png")
    changes = {"filled__image": str(tmp_path / "stripes.png"), "filled__texels": 1024}
    at = Camera(20, 20, float(field.height(20, 20)) + 1)
    column = look(field, at, filled__sea=0, flyover__relief=128.0, **changes)[40:, 80].sum(axis=1)
    assert np.ptp(column) > 150


def test_walls_are_of_layers_of_rock_and_not_of_bars() -> None:
    image = np.zeros((64, 64))
    image[:, 32:] = 255
    field = height_field(image, Flyover(relief=40.0, black_high=False))
    changes = {"filled__sea": 0, "filled__fog": False, "filled__texels": 256}
    wall = look(field, Camera(16, 20, 20, 0, 0, 0), **changes)[40:80, 40:120].sum(axis=2)
    down, across = (np.abs(np.diff(wall, axis=axis)).mean() for axis in (0, 1))
    assert down > 6 and down > 1.5 * across


def plain_with_a_tower(size: int = 64) -> np.ndarray:
    heights = np.zeros((size, size), np.float32)
    heights[30:34, 30:34] = 10
    return heights


def test_the_shadow_of_a_tower_is_as_long_as_the_sun_says() -> None:
    sun = np.array([-1, 0, 0.5]) / math.hypot(1, 0.5)
    lit = sunlight.sun_light(plain_with_a_tower(), sun)
    # The sun is in the direction of -x, and the tower is 10 high: its shadow ends 20 beyond it.
    row = lit[32]
    assert (row[36:52] < 0.3).all() and (row[56:] > 0.6).all() and (row[:28] > 0.4).all()
    assert (lit[20] > 0.4).all() and (lit[50] > 0.4).all()


def test_hollows_see_less_of_the_sky_and_plains_all_of_it() -> None:
    pit = 10 - plain_with_a_tower()
    seen = sunlight.sky_seen(pit)
    assert seen[32, 32] < 0.3 and seen[5, 5] > 0.99 and sunlight.sky_seen(pit * 0).min() == 1


@pytest.mark.parametrize(
    "switch", ("shadows", "occlusion", "fog", "clouds", "reflection", "smooth", "levels", "edges")
)
@pytest.mark.sweep(8)
def test_each_switch_changes_the_picture(switch: str) -> None:
    camera = Camera(20, 20, 20, 0, 0.1, 2.0)
    both = {"filled__sea": 0.4, "filled__texels": 512}
    on, off = (look(hills(), camera, **{f"filled__{switch}": v}, **both) for v in (True, False))
    assert (on != off).any(axis=2).mean() > (0.003 if switch == "edges" else 0.02)


def test_blocks_have_flat_tops_and_a_surface_has_not() -> None:
    field = hills()
    u = np.linspace(0.3, 0.5, 400, dtype=np.float32)
    rough, even = (march.looked_up(field.levels[0], u, u, smooth) for smooth in (False, True))
    assert len(np.unique(rough)) < 20 and len(np.unique(even)) > 300


def test_an_image_may_be_laid_over_the_ground(tmp_path: Path) -> None:
    halves = np.zeros((8, 8, 3), np.uint8)
    halves[:, :4, 0] = halves[:, 4:, 2] = 255
    Image.fromarray(halves).save(tmp_path / "halves.png")
    changes = {"filled__image": str(tmp_path / "halves.png"), "filled__sea": 0}
    # Looking along +y from the middle of the field's border, +x is on the left.
    picture = look(hills(), Camera(32, -5, 40, 0, 0.6, math.pi / 2), **changes)[80:]
    assert is_red(picture[:, 90:]).all() and not is_red(picture[:, :70]).any()
    with pytest.raises(InputError, match=r"none\.png: no such image file"):
        look(hills(), Camera(20, 20, 40), filled__image=str(tmp_path / "none.png"))


def test_smaller_copies_of_the_ground_average_the_larger_ones() -> None:
    random = np.random.default_rng(1)
    colour, (wet, cliff) = random.random((16, 16, 3)), random.random((2, 16, 16))
    made = ground.pyramid(colour, wet, cliff, 32.0)
    assert made.offsets.tolist() == [0, 256, 320, 336, 340] and made.bits == 4
    last = made.texels[-1:].view(np.uint8)
    assert np.abs(last[:3] - colour.mean((0, 1)) * 255).max() <= 1
    assert abs(last[3] - ground.WET - wet.mean() * 127) <= 1
    dry = ground.pyramid(colour, wet * 0, cliff, 32.0)
    assert abs(dry.texels[-1:].view(np.uint8)[3] - cliff.mean() * 127) <= 1


def test_a_field_is_resampled_without_a_shift() -> None:
    at = np.arange(32) / 32 * 2 * np.pi
    field = np.sin(at)[:, None] + np.cos(2 * at)
    for size in (16, 32, 128):
        centres = (np.arange(size) + 0.5) / size * 2 * np.pi
        if size < 32:
            centres -= np.pi / 32  # of the means of pairs
        expected = np.sin(centres)[:, None] + np.cos(2 * centres)
        assert np.abs(ground.resampled(field, size) - expected).max() < 0.06


@pytest.mark.seldom(14, first=8)
def test_an_unseen_picture_of_the_ground_comes_from_the_cache(tmp_path, monkeypatch) -> None:
    from landscape.flyover import look as looks

    monkeypatch.setenv("LANDSCAPE_CACHE", str(tmp_path))
    settings = with_settings(Settings(), SMALL)
    first = looks.look(hills(), settings)
    monkeypatch.setattr(looks, "bake", None)
    again = looks.look(hills(), settings)
    assert again is not first and (again.ground.texels == first.ground.texels).all()


@pytest.mark.sweep(2)
@pytest.mark.parametrize("size", ((1, 1), (1, 40), (40, 1), (33, 17)))
def test_pictures_of_any_size_and_from_anywhere_can_be_drawn(size: tuple[int, int]) -> None:
    settings = with_settings(Settings(), SMALL | {"flyover.visible": 30.0})
    for camera in (
        Camera(20, 20, 40),
        Camera(1e7, -1e7, 30, 0.5, 0.3, 1),
        Camera(20, 20, -50, 3.1, -1.5, 0),
    ):
        drawn = frame.draw(hills(), camera, settings, size)
        assert drawn.rgba.shape == (size[1], size[0], 4)
        assert drawn.counts["pixels"] == size[0] * size[1]


def test_water_mirrors_the_land_behind_it_as_an_eye_below_the_water_sees_it() -> None:
    # Each column: a beach, water, a wall, water again, and a higher wall; the last has no land.
    distances = np.arange(1, 181, dtype=np.float32)
    land = np.zeros((180, 16), np.float32)
    land[:10, :8], land[60:80, :8], land[140:, :8] = 1.0, 12.0, 40.0
    eye = 3.0
    found = reflection(land - eye, distances, eye, 0.7, 0.002)
    assert found is not None and found.lift == 2 * eye
    tops = {wall: (land[wall, 0] + eye) / distances[wall] for wall in (60, 140)}
    for water in (20, 100):
        for up in np.linspace(eye / (water + 1), 0.6, 30):
            if min(abs(up - top) for top in tops.values()) > 0.01:
                wall = min((w for w, top in tops.items() if w > water and up < top), default=180)
                for column, there in ((0, wall), (12, 180)):
                    ray = (np.array([each]) for each in (water, column, up))
                    assert min(found.seen(*ray)[0], 180) == there, (water, up, column)
    assert reflection(land + 1, distances, eye, 0.7, 0.002) is None


def test_close_to_the_eye_texels_and_their_parts_of_rock_are_blended_but_not_with_water() -> None:
    colour = np.zeros((8, 8, 3))
    wet = np.zeros((8, 8))
    cliff = np.zeros((8, 8))
    colour[:, 2], cliff[:, 2], wet[:, 6] = 1.0, 1.0, 1.0
    picture = ground.pyramid(colour, wet, cliff, 8.0)
    x, y = np.array([1.5, 1.75, 2.0, 2.5, 5.9, 6.1], np.float32), np.full(6, 3.5, np.float32)
    own = picture.texels[:64].reshape(8, 8)[3, x.astype(int)]
    found = close_up.between(picture, x, y, own).view(np.uint8).reshape(-1, 4)
    assert np.abs(found[:4, 0] - np.array([0, 64, 128, 255])).max() <= 2
    assert np.abs(found[:4, 3] - np.array([0, 32, 64, 127])).max() <= 2
    assert (found[4:, 3] == [0, 255]).all()


def test_packed_colours_are_blended_byte_by_byte() -> None:
    random = np.random.default_rng(8)
    corners = random.integers(0, 1 << 32, (4, 500), np.uint32)
    u, v = random.integers(0, 256, (2, 500), np.uint32)
    bytes_ = corners.view(np.uint8).reshape(4, 500, 4).astype(float)
    x, y = u[:, None] / 256, v[:, None] / 256
    upper, lower = (bytes_[k] * (1 - x) + bytes_[k + 1] * x for k in (0, 2))
    between = blending.between_four(tuple(corners.copy()), u.copy(), v.copy())
    found = between.view(np.uint8).reshape(500, 4)
    assert np.abs(found - (upper * (1 - y) + lower * y)).max() < 2.5
    mixed = blending.blend(corners[0], corners[1], u).view(np.uint8).reshape(500, 4)
    assert np.abs(mixed[:, :3] - (bytes_[0] * (1 - x) + bytes_[1] * x)[:, :3]).max() <= 1
    assert not mixed[:, 3].any()


def test_a_wall_behind_water_is_mirrored_in_it(red: str) -> None:
    pixels = np.zeros((64, 64))
    pixels[:, 32:] = 255
    field = height_field(pixels, Flyover(relief=24.0, black_high=False))
    changes = {"filled__sea": 0.4, "filled__image": red, "filled__fog": False}
    at = Camera(5, 20, 12)
    with_land = look(field, at, **changes)
    without = look(field, at, filled__reflection=False, **changes)
    shore = np.flatnonzero(is_red(without[:, 80]))[-1]
    water = with_land[shore + 4 : shore + 14, 60:100]
    assert is_red(water).mean() > 0.6 and not is_red(with_land[115:]).any()
