"""Ripples at each pixel: their slopes, what they make of the opacity, and the sea's own colour."""

import numpy as np
import pytest
from seaside import BACKGROUND, LEVEL, beach, drawn, grid_at
from stage import WHITE_LIGHT, Stage, close, pixel, project, small

from landscape.elements.best.sea import ripples, waves
from landscape.elements.best.sea.ripple_slopes import gusts, slopes
from landscape.elements.best.sea.ripples import LONG, LONGEST, PATCHES, fading, sights
from landscape.elements.best.sea.sea import Sea, reflected
from landscape.elements.best.sea.shallows import COLOURS, lit_colour
from landscape.files.assets import Assets
from landscape.frame import Pose

DOWN = Pose(20.0, 5.6, 21.5, 0.0, -89.9)


def test_ripples_vary_what_the_water_mirrors_at_each_pixel(stage: Stage) -> None:
    base = {"water.color": (0.0, 0.0, 0.4, 0.5), "water.animated": False}
    spreads = []
    for strength in (0.0, 1.0):
        picture = drawn(stage, Assets(), {**base, "water.ripples": strength})[0]
        spreads.append(picture[-30:, :, 0].astype(float).std())
    assert spreads[1] > 2 * spreads[0]


def test_the_slopes_repeat_without_a_seam_and_no_length_of_wave_stands_out() -> None:
    tile = slopes(1, 256)
    assert np.isclose(np.sqrt(np.mean(np.square(tile))), 1.0)
    step = np.abs(np.diff(tile, axis=1)).mean()
    assert np.abs(tile[:, 0] - tile[:, -1]).mean() < 1.5 * step
    energy = (np.abs(np.fft.fft2(tile, axes=(0, 1))) ** 2).sum(axis=2)
    number = np.hypot(*np.meshgrid(*[np.fft.fftfreq(256) * 256] * 2))
    octaves = [energy[(number >= low) & (number < 2 * low)].sum() for low in (5, 10, 20, 40)]
    assert max(octaves) < 3 * min(octaves)
    along, across = np.square(tile).mean(axis=(0, 1))
    assert 0.4 < along / across < 2.5, "no direction stands out either"


def test_no_part_of_the_long_layer_is_a_swirl_of_its_own() -> None:
    def unevenness(tile: np.ndarray) -> float:
        parts = tile[..., 0].reshape(8, 32, 8, 32)
        return float(parts.mean(axis=(1, 3)).std() + parts.std(axis=(1, 3)).std())

    chosen = {"longest": LONGEST[LONG], "patches": PATCHES[LONG]}
    assert unevenness(slopes(1, 256, **chosen)) < 0.6 * unevenness(slopes(1, 256))


def test_gusts_leave_slicks_on_the_sea_and_move_with_time() -> None:
    x, z = np.meshgrid(*[np.linspace(0, 40, 80, dtype=np.float32)] * 2)
    rough = gusts(x, z, 0.0)
    assert 0 <= rough.min() < 0.15 and 0.85 < rough.max() <= 1
    assert np.abs(gusts(x, z, 16.0) - rough).max() > 0.2


def test_the_fine_layer_fades_in_its_mip_levels() -> None:
    picture = np.random.default_rng(1).integers(60, 200, (64, 64, 3)).astype(np.uint8)
    picture[..., 2] = 255
    levels = fading(picture)
    assert [level.shape[0] for level in levels] == [64, 32, 16, 8, 4, 2, 1]
    assert levels[0][..., :2].std() > 10 and np.ptp(levels[-2][..., :2]) <= 1
    assert all((level[..., 2] == 255).all() for level in levels)


def dot3(colours: np.ndarray, texel: np.ndarray) -> np.ndarray:
    """Return what GL_DOT3_RGB makes of colours (n, 4) and a texel (3,), by the specification."""
    return np.clip(4 * ((colours[:, :3] - 0.5) @ (texel - 0.5)), 0, 1)


@pytest.mark.parametrize("slope", [-1.0, 0.0, 1.0])
def test_a_ripple_changes_the_opacity_as_its_slope_towards_the_eye_does(slope: float) -> None:
    grid = grid_at()
    level = np.full(grid.x.shape, 0.5, np.float32)
    change = np.full(grid.x.shape, 0.02, np.float32)
    one, two = sights(grid, level, change)
    for column in (0, grid.x.shape[1] // 2):
        here = np.ravel_multi_index((3, column), grid.x.shape)
        texel = np.array([*(0.5 + 0.5 * slope * np.array([grid.east, grid.south])[:, column]), 1])
        wanted_ = 0.5 + 0.02 * slope
        far = dot3(one[here : here + 1], texel) ** 2 * one[here, 3]
        level_texel = np.array([0.5, 0.5, 1.0])
        near = dot3(two[here : here + 1], texel) * dot3(two[here : here + 1], level_texel)
        assert far == pytest.approx(wanted_, abs=2e-3), "one layer, multiplied with itself"
        assert near == pytest.approx(wanted_, abs=2e-3), "two layers, one of them level"
    blended = sights(grid, level, change, blended=True)[0][:1]
    assert dot3(blended, np.array([0.5, 0.5, 1.0])) * blended[0, 3] == pytest.approx(0.5, abs=1e-3)


def test_rippled_water_has_the_opacity_and_colour_of_its_depth(
    stage: Stage, plain: Assets, monkeypatch: pytest.MonkeyPatch
) -> None:
    """From above, where neither the angle of view nor a slope matters much."""
    monkeypatch.setattr(waves, "STEEP", 0.0 * waves.STEEP)
    monkeypatch.setattr(ripples, "STEEP", 0.0)
    base = {"water.color": (0.0, 0.0, 0.4, 0.5), "water.ripples": 1.0, "water.shallow": True}
    for mirrored in (False, True):
        settings = small({**WHITE_LIGHT, **base, "reflection.rippled": mirrored})
        sea = Sea(settings, plain, beach(0.2))
        with stage.frame(settings, DOWN) as frame:
            if mirrored:
                with reflected(frame, settings, sea):
                    pass
            sea.draw(frame)
            deep = pixel(stage.read(), project(DOWN, (20.0, LEVEL, 23.5)))

        sea.release()
        blue = lit_colour(settings)[2] * COLOURS[-1][2]
        wanted_ = 0.5 * np.array([0, 0, blue * 255]) + 0.5 * BACKGROUND
        assert close(deep, wanted_, 6), mirrored
