"""The map: its own viewport, and the walker's point where the report puts it."""

from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from stage import Stage, close, small, taken

from framelens.gl.seam import gl
from landscape.elements.map import Map, map_picture, place_on_map
from landscape.files.assets import Assets
from landscape.files.images import read_heights, read_image
from landscape.frame import Pose
from landscape.geometry.height_field import HeightField, height_field

BACKGROUND = np.array([0.4, 0.6, 0.7]) * 255
GREEN = np.array([0, 255, 0])
ALPHA = 0.75
FLAT = HeightField(np.ones((4, 4), np.float32), 40.0, 0.6)


def test_a_place_is_minus_1_plus_x_over_20_and_1_minus_z_over_20() -> None:
    assert place_on_map(0.0, 0.0, 40.0) == (-1.0, 1.0)
    assert place_on_map(40.0, 40.0, 40.0) == (1.0, -1.0)
    assert place_on_map(25.0, 10.0, 40.0) == (0.25, 0.5)
    assert place_on_map(25.0, 10.0, 100.0) == (-0.5, 0.8)


def drawn(
    stage: Stage, assets: Assets, pose: Pose, fog: bool = False, alpha: float = ALPHA
) -> np.ndarray:
    settings = small({"overlay.map_alpha": alpha})
    map_ = Map(settings, assets, FLAT)
    with stage.frame(settings, pose, fog=fog) as frame:
        map_.draw(frame)
        picture = stage.read()
    map_.release()
    return picture


@pytest.mark.parametrize("fog", [False, True])
def test_the_map_fills_the_upper_left_quarter_of_each_side(
    stage: Stage, plain: Assets, fog: bool
) -> None:
    picture = drawn(stage, plain, Pose(3.0, 1.0, 3.0), fog)
    wanted = ALPHA * GREEN + (1 - ALPHA) * BACKGROUND
    corner = picture[:30, :40]
    point = (corner == 255).all(axis=2)
    assert close(corner[~point], wanted)
    outside = picture.copy()
    outside[:30, :40] = BACKGROUND
    assert close(outside, BACKGROUND)


@pytest.mark.parametrize("size", [(160, 20), (40, 120)])
def test_in_a_long_window_the_map_keeps_its_shape(
    stage: Stage, plain: Assets, size: tuple[int, int]
) -> None:
    settings = small({"overlay.map_alpha": 1.0})
    map_ = Map(settings, plain, FLAT)
    with stage.frame(settings, Pose(39.9, 1.0, 39.9), size=size) as frame:
        map_.draw(frame)
        green = close_to_green(stage.read())
    map_.release()
    rows, columns = np.nonzero(green)
    side = min(size) // 2
    wanted = (side, min(size) // 4) if size[0] > size[1] else (min(size) // 4, side)
    assert (np.ptp(columns) + 1, np.ptp(rows) + 1) == wanted
    assert (columns.min(), rows.min()) == (0, stage.size[1] - size[1])


def close_to_green(picture: np.ndarray) -> np.ndarray:
    return np.abs(picture.astype(int) - GREEN).max(axis=2) < 3


@pytest.mark.parametrize(("x", "z"), [(20.0, 20.0), (10.0, 30.0), (34.0, 6.0)])
def test_the_point_at_the_walkers_position_is_five_pixels_wide(
    stage: Stage, plain: Assets, x: float, z: float
) -> None:
    picture = drawn(stage, plain, Pose(x, 1.0, z, 77.0, 10.0))
    white = (picture == 255).all(axis=2)
    rows, columns = np.nonzero(white)
    assert white.sum() == 25
    # The viewport is 40 x 30 pixels at the upper left; north is up.
    assert columns.mean() + 0.5 == pytest.approx(x / 40 * 40, abs=0.6)
    assert rows.mean() + 0.5 == pytest.approx(z / 40 * 30, abs=0.6)


def test_the_picture_is_the_right_way_up(stage: Stage, plain_folder) -> None:
    image = np.full((8, 8, 4), 255, np.uint8)
    image[:4, :4] = (200, 0, 0, 255)  # the north-west is red
    Image.fromarray(image).save(plain_folder / "map.png")
    picture = drawn(stage, Assets(plain_folder), Pose(39.0, 1.0, 39.0), alpha=1.0)
    assert close(picture[5, 5], (200, 0, 0))
    assert close(picture[25, 5], 255) and close(picture[5, 35], 255)


def test_the_map_lies_over_everything_whatever_the_depth(stage: Stage, plain: Assets) -> None:
    settings = small({"overlay.map_alpha": 1.0})
    map_ = Map(settings, plain, FLAT)
    with stage.frame(settings, Pose(3.0, 1.0, 3.0)) as frame:
        gl.glClearDepth(0.0)
        gl.glClear(gl.GL_DEPTH_BUFFER_BIT)
        gl.glClearDepth(1.0)
        map_.draw(frame)
        picture = stage.read()
    map_.release()
    assert close(picture[20, 20], GREEN)


def test_the_map_accepts_a_new_island_size_and_refuses_a_new_opacity(
    stage: Stage, plain: Assets
) -> None:
    map_ = Map(small(), plain, FLAT)
    assert not taken(map_, small({"overlay.map_alpha": 0.5, "ground.size": 80.0}))
    pictures = []
    for size in (40.0, 80.0):
        settings = small({"ground.size": size})
        assert taken(map_, settings)
        with stage.frame(settings, Pose(20.0, 1.0, 20.0)) as frame:
            map_.draw(frame)
            pictures.append((stage.read() == 255).all(axis=2))
    map_.release()
    rows, columns = zip(*(np.nonzero(point) for point in pictures), strict=True)
    assert [r.mean() + 0.5 for r in rows] == pytest.approx([15.0, 7.5], abs=0.6)
    assert [c.mean() + 0.5 for c in columns] == pytest.approx([20.0, 10.0], abs=0.6)


def sloping_west(tmp_path: Path) -> Path:
    """Write a height image whose west is deep sea and whose east is high land."""
    path = tmp_path / "west.png"
    Image.fromarray(np.tile(np.arange(256, dtype=np.uint8), (64, 1))).save(path)
    return path


def picture_of(path: str, assets: Assets) -> np.ndarray:
    settings = small({"ground.height_image": path})
    heights = read_heights(assets.path(path))
    field = height_field(heights, settings.ground, settings.water.level)
    return map_picture(settings, assets, field)


def test_the_map_of_other_heights_is_drawn_from_them(tmp_path: Path) -> None:
    shipped_map = read_image(Assets().path("map.png"))
    for ours in ("height.png", "height16.png"):
        assert np.array_equal(picture_of(ours, Assets()), shipped_map)
    other = picture_of(str(sloping_west(tmp_path)), Assets()).astype(int)
    blue = other[..., 2] > other[..., 0] + 20
    coast = 256 * 0.6 / 6.0  # the red value at the water's level
    columns = (np.arange(256) + 0.5) / 256 * 256
    assert blue[:, columns < coast - 6].all()
    assert not blue[:, columns > coast + 6].any()


def test_a_map_in_the_user_s_folder_is_kept(tmp_path: Path) -> None:
    heights = sloping_west(tmp_path)
    Image.new("RGB", (8, 8), (1, 2, 3)).save(tmp_path / "map.png")
    assert (picture_of(str(heights), Assets(tmp_path))[..., :3] == (1, 2, 3)).all()
