"""The shore's colours: no land shows the colours of the sea floor."""

from pathlib import Path

import numpy as np
import pytest
from stage import Stage

from landscape.elements.best.terrain.shore import moved_shore
from landscape.elements.best.terrain.terrain import Terrain
from landscape.elements.ground import Ground
from landscape.elements.settings import Settings, preset
from landscape.elements.sun import direction
from landscape.files.assets import Assets
from landscape.geometry.height_field import height_field
from landscape.settings.declare import with_settings

LAND, SEA = (200, 60, 20), (20, 90, 200)
LEVEL = 0.6
SIDE = 512


def island(shape: str) -> np.ndarray:
    """Return a height image (256, 256): steep coasts on all sides, or a round hill."""
    at = (np.arange(256) + 0.5) / 256 * 40.0
    x, z = np.meshgrid(at, at)
    if shape == "plateau":
        y = np.where(np.maximum(abs(x - 20.0), abs(z - 22.0)) < 11.3, 2.0, 0.1)
    else:
        y = np.clip(2.5 - 0.25 * np.hypot(x - 24.0, z - 18.0), 0.1, None)
    return np.asarray(y / Settings().ground.scale_y * 256.0)


@pytest.mark.parametrize("smooth", ["none", "catmull_rom"])
@pytest.mark.parametrize("shape", ["plateau", "hill"])
@pytest.mark.sweep(2)
def test_what_is_drawn_above_the_water_has_the_colours_of_land(shape: str, smooth: str) -> None:
    ground = with_settings(Settings(), {"ground.resolution": 60, "ground.smooth": smooth}).ground
    image = island(shape)
    painted = image / 256.0 * ground.scale_y
    field = height_field(image, ground, LEVEL)
    texel = np.minimum((np.arange(SIDE) + 0.5) / SIDE * 256, 255).astype(int)
    wet = (painted < LEVEL)[texel][:, texel]
    large = np.where(wet[..., None], np.uint8(SEA), np.uint8(LAND))
    texels, colours = moved_shore(large, painted, field, ground.resolution)
    drawn = large.copy()
    drawn.reshape(-1, 3)[texels] = colours

    at = (np.arange(SIDE) + 0.5) / SIDE * field.size
    height = field.terrain_height(*np.meshgrid(at, at))
    bluish = [(c[height > LEVEL + 0.05, 2] > c[height > LEVEL + 0.05, 0]) for c in (large, drawn)]
    assert bluish[0].sum() > 300, "the colours need not be moved"
    assert bluish[1].sum() < 0.3 * bluish[0].sum(), "more than the soft edge"
    far = (height < LEVEL - 0.25) | ~wet & (height > LEVEL + 0.25)
    assert (drawn[far] == large[far]).all()
    assert len(np.unique(texels)) == len(texels)


@pytest.mark.seldom(3)
def test_the_shipped_island_has_no_belt_of_sea_floor_on_its_cliffs(stage: Stage) -> None:
    settings = with_settings(preset("best"), {"ground.texture_size": 512, "ground.tiles": 1})
    ground = Terrain(settings, Assets(), direction(settings.sun))
    at = (np.arange(800) + 0.5) / 20
    x, z = (a.ravel() for a in np.meshgrid(at, at))
    height = ground.terrain_height(x, z) - settings.water.level
    shore = (height > 0.03) & (height < 0.3)
    teal = [
        (colour[:, 1:].min(axis=1) > 1.1 * colour[:, 0]).mean()
        for colour in (f(x[shore], z[shore]) for f in (ground.colour, ground.drawn_colour))
    ]
    ground.release()
    assert teal[0] > 0.004, "as painted"
    assert teal[1] < 0.1 * teal[0], f"as drawn: {teal}"


def test_the_ground_of_2006_is_drawn_as_painted(stage: Stage, plain: Assets) -> None:
    ground = Ground(Settings(), plain, direction(Settings().sun))
    x = z = np.array([12.0, 20.0])
    assert (ground.drawn_colour(x, z) == ground.colour(x, z)).all()
    ground.release()


@pytest.mark.seldom(10, first=4)
def test_the_colours_in_the_cache_are_those_of_the_heights_between_the_vertices(
    stage: Stage, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    small = {"ground.texture_size": 512, "ground.tiles": 1, "ground.resolution": 50}

    def colours(exact: bool, cache: str) -> np.ndarray:
        monkeypatch.setenv("LANDSCAPE_CACHE", cache)
        settings = with_settings(preset("best"), {**small, "ground.exact_height": exact})
        ground = Terrain(settings, Assets(), direction(settings.sun))
        drawn = ground._drawn.copy()
        ground.release()
        return drawn

    bilinear, exact = (colours(exact, str(tmp_path)) for exact in (False, True))
    assert (bilinear != exact).any()
    assert (exact == colours(True, "")).all()
