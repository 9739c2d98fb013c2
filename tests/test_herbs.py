"""The herbs of `best`: each kind in cells of its own, near, far, from above and in shadow."""

from collections.abc import Iterator
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest
from sprite_stage import (
    NORTH,
    PLANT_GREEN,
    RED,
    TREE,
    WIDE,
    element,
    looking,
    pictures,
    put,
    seen,
)
from stage import Stage, close, pixel, project, small, taken

from landscape.elements.atlas import CELLS, COLUMNS, cell_coordinates, laid_out
from landscape.elements.best.sprites.refined_atlas import (
    FLOWERING,
    HERB_ROWS,
    TOP_OF_CELL,
    TOPS_CELLS,
    top_coordinates,
    with_herbs,
)
from landscape.elements.best.sprites.refined_sprites import RefinedSprites
from landscape.elements.best.sprites.rules import crossing
from landscape.elements.ground import Ground
from landscape.elements.planting import PLANT
from landscape.elements.sprite_names import HERB, HERBS
from landscape.frame import Pose

FERN, OXEYE = HERB, HERB + 1
COLOURS = [(40 + 40 * k, 255 - 45 * k, 20 + 30 * k, 255) for k in range(len(HERBS))]


def test_with_herbs_the_atlas_is_square() -> None:
    cells = [np.full((8, 8, 4), k + 1, np.uint8) for k in range(len(CELLS) + len(HERBS))]
    sheet = laid_out(with_herbs(cells))
    assert sheet.shape == (32, 32, 4)
    s = np.array([0.5])
    for k in range(len(HERBS)):
        u, v = cell_coordinates(np.array([HERB + k]), np.array([False]), s, s, HERB_ROWS)[0, 0]
        assert sheet[int(v * 32), int(u * 32), 0] == len(CELLS) + k + 1
    assert with_herbs(cells[: len(CELLS)]) == cells[: len(CELLS)]


def test_pictures_from_above_have_cells_of_their_own() -> None:
    taken = {*range(len(CELLS)), *range(HERB, HERB + len(HERBS))}
    assert taken.isdisjoint(TOPS_CELLS)
    plants = np.array([PLANT, *range(HERB, HERB + len(HERBS))])
    middles = top_coordinates(plants, HERB_ROWS).mean(axis=1)
    places = (middles * (2 * COLUMNS, 2 * HERB_ROWS)).astype(int)  # quarters of cells
    assert len(np.unique(places, axis=0)) == len(plants)
    cells = places[:, 0] // 2 + COLUMNS * (places[:, 1] // 2)
    assert (cells == np.array(TOPS_CELLS)[TOP_OF_CELL[plants] // 4]).all()


@pytest.fixture(scope="module")
def sprites(the_stage: Stage, tmp_path_factory) -> Iterator[RefinedSprites]:
    """The element with an atlas of herbs, each of one colour."""
    assets = pictures(tmp_path_factory.mktemp("herbs"), dict(zip(HERBS, COLOURS, strict=True)))
    with element(the_stage, RefinedSprites, assets, {"plants.species": 5}) as made:
        yield made


def shown(stage: Stage, sprites: RefinedSprites, pose: Pose = NORTH, **changes: Any) -> np.ndarray:
    """Return the herbs' picture under some settings, on a day without wind."""
    return seen(stage, sprites, pose, **{"plants__sway": 0.0, "plants__species": 5, **changes})


@pytest.mark.parametrize("cell", [0, PLANT, *range(HERB, HERB + len(HERBS))])
@pytest.mark.sweep(3)
def test_each_kind_shows_its_own_picture_near_and_far(
    stage: Stage, sprites: RefinedSprites, cell: int
) -> None:
    put(sprites, [(20.0, 3.0, 17.0)], [cell], (1.0, 1.0))
    expected = {0: RED, PLANT: PLANT_GREEN}.get(cell) or COLOURS[cell - HERB]
    for within in (0.0, 1.0):  # crossed, and a single billboard
        for trimmed in (False, True):
            picture = shown(
                stage, sprites, NORTH, plants__crossed_within=within, transparent__trimmed=trimmed
            )
            here = pixel(picture, project(NORTH, (20.1, 3.5, 17.0)))
            assert close(here, expected[:3], 12)


@pytest.mark.seldom(3, first=2)
@pytest.mark.parametrize("cell", range(HERB, HERB + len(HERBS)))
def test_from_above_each_herb_shows_its_own_colour(
    stage: Stage, sprites: RefinedSprites, cell: int
) -> None:
    above = Pose(20.0, 6.0, 16.0, 0.0, -90.0)
    put(sprites, [(20.0, 3.0, 16.0)], [cell], (1.0, 1.0))
    picture = shown(stage, sprites, above, plants__rosette=True, plants__fade_edge_on=True)
    rise = 0.65 if cell in FLOWERING else 0.3
    here = pixel(picture, project(above, (20.17, 3.0 + rise, 16.1)))
    assert close(here, COLOURS[cell - HERB][:3], 12)


def test_plants_switch_between_single_and_crossed_without_a_gap_or_a_jump() -> None:
    single, crossed = crossing(small({"plants.crossed_within": 5.0}), np.linspace(0.0, 8.0, 801))
    assert (np.maximum(single, crossed) == 1.0).all()
    assert single[0] == 0.0 and crossed[-1] == 0.0
    assert np.abs(np.diff([single, crossed])).max() < 0.04
    never = small({"plants.crossed_within": 0.0})
    assert (crossing(never, np.arange(9.0))[1] == 1.0).all()


def test_plants_beyond_their_own_radius_are_not_drawn_and_trees_are(
    stage: Stage, sprites: RefinedSprites
) -> None:
    put(sprites, [(20.0, 3.0, 17.0), (20.0, 3.0, 12.0), (21.0, 3.0, 12.0)], [FERN, FERN, TREE])
    counts = []
    for radius in (0.0, 5.0):
        shown(stage, sprites, plants__radius=radius)
        counts.append(len(sprites.prepare(looking(NORTH))[3]) // 6)
    assert counts == [9, 5]


def test_plants_but_not_trees_are_darkened_by_shadow_on_their_sunny_side(
    sprites: RefinedSprites,
) -> None:
    sunrise = {"sun.azimuth": 90.0, "sun.elevation": 10.0}
    assert taken(sprites, small({**WIDE, "plants.species": 5, **sunrise}))
    put(sprites, [(19.9, 3.0, 17.0), (20.1, 3.0, 12.0), (30.0, 3.0, 12.0)], [FERN, OXEYE, TREE])

    def light(x: np.ndarray, z: np.ndarray) -> np.ndarray:
        return np.repeat(np.where(x < 20.0, 1.0, 0.25)[:, None], 3, axis=1)

    sprites.shade(cast(Ground, SimpleNamespace(light=light)))
    tints = sprites.sprites.tints
    # The first stands west of the shadow's edge, and its light is looked up east of it.
    assert np.allclose(tints[:2, :3], 0.5 * 255)
    assert (tints[2] == 255).all() and (tints[:, 3] == 255).all()
