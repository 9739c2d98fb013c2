"""The tiles of the blocks: their order, that they repeat without a seam or a grid, bad files."""

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from framelens.base.errors import InputError
from framelens.gl.texture import mip_levels
from landscape.files.assets import Assets
from landscape.studio.asset_measures import seams
from landscape.voxel.blocks import BLOCKS, HOLED, PLANT_TILES, TILES
from landscape.voxel.tiles import FILE, PLANTS_FILE, RIPPLES_FILE, SIDE, plants, ripples, tiles

SIDES = ("grass_side", "turf_side", "snow_side")
# Those with a frame around each block.
FRAMED = ("log_top", "lamp")


@pytest.fixture(scope="module")
def shown() -> dict[str, np.ndarray]:
    return tiles(Assets())


def pictures() -> dict[str, np.ndarray]:
    """Return the picture of each plant by name."""
    parts = np.split(plants(Assets()), len(PLANT_TILES), axis=1)
    return dict(zip(PLANT_TILES, parts, strict=True))


def mean(tile: np.ndarray) -> np.ndarray:
    return np.asarray(tile.reshape(-1, tile.shape[-1]).mean(axis=0))


def test_each_tile_is_where_its_name_says(shown: dict[str, np.ndarray]) -> None:
    assert tuple(shown) == TILES
    for name, tile in shown.items():
        assert tile.shape == (SIDE, SIDE, 4 if name in HOLED else 3), name
    means = {name: mean(tile)[:3] for name, tile in shown.items()}
    assert means["grass_top"].argmax() == 1
    assert max(means, key=lambda name: means[name].sum()) == "snow"
    assert means["slate"].argmax() == 2
    for warm in ("earth", "sand", "planks", "brick", "lamp", "log_top"):
        red, _, blue = means[warm]
        assert red > blue + 20, warm


@pytest.mark.parametrize("name", ["leaves", "needles", "hide"])
def test_tiles_that_blocks_tint_are_nearly_grey(shown: dict[str, np.ndarray], name: str) -> None:
    assert np.ptp(mean(shown[name])[:3]) < 12


def test_sides_are_grass_or_snow_above_and_earth_below(shown: dict[str, np.ndarray]) -> None:
    for side, top in (("grass_side", "grass_top"), ("snow_side", "snow")):
        above, below = mean(shown[side][:3]), mean(shown[side][-8:])
        assert np.abs(above - mean(shown[top])).max() < 45
        assert np.abs(below - mean(shown["earth"])).max() < 12


@pytest.mark.parametrize("name", TILES)
def test_a_tile_has_no_seam(shown: dict[str, np.ndarray], name: str) -> None:
    columns, rows = seams(shown[name])
    assert columns.ok and (rows.ok or name in SIDES)


@pytest.mark.parametrize("name", [name for name in TILES if name not in (*SIDES, *FRAMED)])
def test_a_repeated_tile_shows_no_grid(shown: dict[str, np.ndarray], name: str) -> None:
    spectrum = np.abs(np.fft.fft2(shown[name][..., :3].mean(axis=2))) / SIDE**2
    k = np.fft.fftfreq(SIDE) * SIDE
    once = np.hypot(*np.meshgrid(k, k)) < 1.5  # one light and one dark spot per tile
    once[0, 0] = False
    assert 2 * spectrum[once].max() < 2.0, "amplitude in levels"


def test_plants_stand_on_the_lower_edge_within_their_picture() -> None:
    for name, picture in pictures().items():
        assert picture.shape == (SIDE, SIDE, 4)
        solid = picture[..., 3] > 127
        assert solid[-1].any(), name
        assert not solid[0].any() and not solid[:, [0, -1]].any(), name
        assert 0.1 < solid.mean() < 0.6, name


def test_flowers_have_the_colour_of_their_name() -> None:
    found = pictures()

    def share(name: str, low: tuple[int, int, int], high: tuple[int, int, int]) -> float:
        picture = found[name].astype(int)
        inside = (picture[..., :3] >= low) & (picture[..., :3] <= high)
        return float((inside.all(axis=2) & (picture[..., 3] > 127)).mean())

    assert share("poppy", (160, 0, 0), (255, 130, 90)) > 0.03
    assert share("buttercup", (220, 160, 0), (255, 255, 150)) > 0.03
    assert share("cornflower", (0, 0, 150), (180, 200, 255)) > 0.03
    assert share("heather", (150, 60, 130), (255, 200, 240)) > 0.03


def test_blocks_use_only_tiles_of_the_strips_and_all_of_them() -> None:
    used = {tile for block in BLOCKS[1:] for tile in (block.top, block.side, block.bottom) if tile}
    assert used == {*TILES, *PLANT_TILES}


def test_ripples_are_unit_normals_that_point_up() -> None:
    coded = ripples(Assets())
    normal = coded / 127.5 - 1.0
    assert np.abs(np.linalg.norm(normal, axis=2) - 1.0).max() < 0.02
    assert normal[..., 2].min() > 0.5
    assert np.abs(normal[..., :2].mean(axis=(0, 1))).max() < 0.01


def test_ripples_are_no_single_wave() -> None:
    normal = ripples(Assets()) / 127.5 - 1.0
    power = np.abs(np.fft.fft2(normal[..., 0])) ** 2
    power[0, 0] = 0.0
    assert power.max() < 0.15 * power.sum()


@pytest.mark.parametrize(
    ("file", "read", "asked"),
    [
        (FILE, tiles, f"32x{32 * len(TILES)}"),
        (PLANTS_FILE, plants, f"{32 * len(PLANT_TILES)}x32"),
        (RIPPLES_FILE, ripples, "128x128"),
    ],
)
def test_a_strip_of_another_size_is_named(tmp_path: Path, file: str, read, asked: str) -> None:
    Image.new("RGBA", (64, 128)).save(tmp_path / file)
    with pytest.raises(InputError) as raised:
        read(Assets(tmp_path))
    assert str(raised.value) == f"{tmp_path / file}: expected {asked} pixels, found 64x128"


@pytest.mark.parametrize("name", HOLED)
def test_leaves_have_holes_that_are_closed_from_afar(
    shown: dict[str, np.ndarray], name: str
) -> None:
    alpha = shown[name][..., 3]
    assert set(np.unique(alpha)) == {0, 255}
    assert 0.1 < (alpha == 0).mean() < 0.35
    assert min(level[..., 3].min() for level in mip_levels(shown[name])[3:]) > 127
