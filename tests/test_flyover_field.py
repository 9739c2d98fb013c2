"""The fly-over's terrain: height images, mirror images, and levels of detail."""

from pathlib import Path

import numpy as np
import pytest

from framelens.base.errors import InputError
from landscape.flyover.bounds import bounds
from landscape.flyover.height_field import height_field, mirrored
from landscape.flyover.settings import Flyover, Settings, check
from landscape.settings.declare import with_settings


def image(side: int, seed: int = 3) -> np.ndarray:
    return np.random.default_rng(seed).integers(0, 256, (side, side)).astype(np.float32)


def test_vertices_are_the_pixels_mirrored_at_each_border_without_end() -> None:
    assert mirrored(np.arange(-5, 14), 4).tolist() == [
        *(3, 4, 3, 2, 1),
        *(0, 1, 2, 3, 4, 3, 2, 1),
        *(0, 1, 2, 3, 4, 3),
    ]


def test_black_is_high_or_by_a_setting_white() -> None:
    pixels = np.array([[0, 255], [51, 102]], np.uint8)
    low = height_field(pixels, Flyover(relief=10.0))
    assert low.height([0, 1, 0, 1], [0, 0, 1, 1]).tolist() == [10, 0, 8, 6]
    high = height_field(pixels, Flyover(relief=10.0, black_high=False))
    assert high.height([0, 1, 0, 1], [0, 0, 1, 1]).tolist() == [0, 10, 2, 4]


def test_heights_are_linear_between_pixels_and_continuous_at_the_borders() -> None:
    pixels = image(16)
    field = height_field(pixels, Flyover(relief=255.0, black_high=False, unit=2.0))
    assert field.size == 32.0
    assert field.height(2 * 3.25, 2 * 7.0) == pytest.approx(
        0.75 * pixels[7, 3] + 0.25 * pixels[7, 4], rel=1e-6
    )
    across = np.random.default_rng(1).uniform(-100, 100, (2, 500))
    assert np.allclose(field.height(*across), field.height(-across[0], across[1]))
    assert np.allclose(field.height(*across), field.height(across[0], 64 - across[1]))
    borders = np.array([-32.0, 0.0, 32.0, 64.0])
    before, after = field.height(borders - 1e-7, 5.0), field.height(borders + 1e-7, 5.0)
    assert np.allclose(before, after, atol=1e-4)


def test_the_gradient_is_the_slope_of_the_heights() -> None:
    field = height_field(image(16), Flyover(relief=40.0, unit=0.5))
    x, y = np.random.default_rng(2).uniform(-20, 20, (2, 200))
    d = 1e-4
    along_x = (field.height(x + d, y) - field.height(x - d, y)) / (2 * d)
    along_y = (field.height(x, y + d) - field.height(x, y - d)) / (2 * d)
    expected = np.stack([along_x, along_y], axis=1)
    # A point nearer than d to a vertex's line has another slope on the other side.
    close = np.isclose(field.gradient(x, y), expected, rtol=1e-3, atol=1e-3).all(axis=1)
    assert close.mean() > 0.99


def test_each_level_has_half_the_vertices_and_averages_of_the_one_below() -> None:
    field = height_field(image(8), Flyover(relief=255.0))
    assert [level.shape for level in field.levels] == [(9, 9), (5, 5), (3, 3), (2, 2), (2, 2)]
    fine, coarse = field.levels[:2]
    weights = np.array([1, 2, 1]) / 4
    for row, column in ((0, 0), (1, 2), (3, 4), (4, 4)):
        near = [mirrored(2 * at + np.arange(-1, 2), 8) for at in (row, column)]
        assert coarse[row, column] == pytest.approx(
            weights @ fine[np.ix_(*near)] @ weights, rel=1e-6
        )
    assert np.ptp(field.levels[-1]) == 0.0


@pytest.mark.parametrize(
    ("shape", "nearest"),
    (
        ((100, 100), "64x64 or 128x128, not 100x100"),
        ((64, 100), "64x64 or 128x128, not 100x64"),
        ((1, 1), "2x2, not 1x1"),
        ((0, 0), "2x2, not 0x0"),
        ((8192, 8192), "4096x4096, not 8192x8192"),
    ),
)
def test_other_sizes_are_refused_by_one_line(shape: tuple[int, int], nearest: str) -> None:
    with pytest.raises(InputError) as caught:
        height_field(np.zeros(shape, np.uint8), name="hills.png")
    assert str(caught.value) == (
        f"hills.png: expected an image whose sides are powers of two, such as {nearest}; "
        "flyover.resolution samples any other again"
    )


@pytest.mark.parametrize("shape", [(16, 64), (64, 16), (32, 64)])
def test_an_image_with_unequal_sides_is_mirrored_at_each_of_its_borders(
    shape: tuple[int, int],
) -> None:
    pixels = np.random.default_rng(1).integers(0, 256, shape).astype(np.uint8)
    field = height_field(pixels, Flyover(relief=255.0))
    rows, columns = np.mgrid[-130:130, -130:130]
    near = (
        np.minimum(mirrored(at, side), side - 1)
        for at, side in zip((rows, columns), shape, strict=True)
    )
    assert np.array_equal(field.height(columns, rows), 255.0 - pixels[tuple(near)])


def test_a_height_image_of_any_size_is_sampled_again() -> None:
    x = np.tile(np.linspace(0, 1, 300), (150, 1))
    slope = (255 * (1 - x)).astype(np.uint8)
    for resolution in (64, 512):
        settings = Flyover(relief=255.0, resolution=resolution)
        field = height_field(slope, settings)
        assert field.side == resolution and field.size == pytest.approx(300.0)
        along = np.linspace(20, 280, 50)
        assert field.height(along, 40.0) == pytest.approx(255 * along / 300, abs=3.0)
    with pytest.raises(InputError, match="sides are powers of two"):
        height_field(slope)


@pytest.mark.parametrize("resolution", [1, 100, 4095])
def test_a_resolution_that_is_no_power_of_two_is_refused(resolution: int) -> None:
    with pytest.raises(InputError, match=r"^setting flyover.resolution: expected 0 or a power"):
        check(with_settings(Settings(), {"flyover.resolution": resolution}))


def test_an_image_of_colours_or_of_numbers_that_are_not_finite_is_refused() -> None:
    with pytest.raises(InputError, match=r"^height image: expected one number for each pixel"):
        height_field(np.zeros((4, 4, 3), np.uint8))
    with pytest.raises(InputError, match=r"^height image: expected finite heights$"):
        height_field(np.full((4, 4), np.nan))


def test_damaged_caches_of_levels_and_boxes_are_made_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("LANDSCAPE_CACHE", str(tmp_path))
    first = height_field(image(32))
    boxes = bounds(first, 8)
    files = sorted(tmp_path.glob("*.arrays"))
    assert len(files) == 2
    for path in files:
        data = bytearray(path.read_bytes())
        data[-20] ^= 255
        path.write_bytes(data)
    again = height_field(image(32))
    assert np.array_equal(first.values, again.values)
    assert np.array_equal(boxes.values, bounds(again, 8).values)
