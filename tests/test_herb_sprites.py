"""The herbs of `best`: each kind where it belongs, in cells of its own, near and far."""

from collections.abc import Iterator
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest
from landscape.elements.sprites.sprite_rules import crossing
from PIL import Image
from stage import Stage, close, pixel, project, small, write_plain
from test_planting import grow, hill
from test_transparent_elements import PLANT_GREEN, RED, put

from landscape.elements.ground import Ground
from landscape.elements.sprites.atlas import (
    CELL,
    CELLS,
    COLUMNS,
    FLOWERING,
    HERB,
    HERB_ROWS,
    HERBS,
    TOP_OF_CELL,
    TOPS_CELLS,
    atlas,
    cell_coordinates,
    top_coordinates,
)
from landscape.elements.sprites.planting import (
    COURT,
    PLANT,
    Sprites,
    drifts_of,
    herbs_by_place,
    woodland,
)
from landscape.elements.transparent_elements import TransparentElements
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.keys import with_settings
from landscape.settings import preset

FERN, OXEYE, WILLOWHERB, MARRAM, HEATHER = range(HERB, HERB + len(HERBS))
COLOURS = [(40 + 40 * k, 255 - 45 * k, 20 + 30 * k, 255) for k in range(len(HERBS))]
NORTH = Pose(20.0, 3.5, 20.0, 0.0, 0.0)


def grown(**changes: Any) -> Sprites:
    """Plants alone on the hill, green in the west, its slopes half as steep as elsewhere."""
    given = {"trees__grouped": True, "plants__count": 4000, "castle__x": 26.0, "castle__z": 20.0}
    return grow({"plants"}, **{**given, "plants__species": 5, **changes})[1]


# ---- where they grow --------------------------------------------------------------------------


def test_one_species_is_the_fern_of_2006_and_more_are_so_many_herbs() -> None:
    assert set(grown(plants__species=1).cells) == {PLANT}
    for species in (2, 3, 5):
        assert set(grown(plants__species=species).cells) == set(range(HERB, HERB + species))


def test_ferns_stand_in_woods_and_flowers_in_the_open_both_on_green_ground() -> None:
    sprites, woods = grown(), woodland(5)
    of_kind = {cell: sprites.positions[sprites.cells == cell] for cell in range(FERN, HEATHER + 1)}
    shade = {cell: woods(at[:, 0], at[:, 2]).mean() for cell, at in of_kind.items()}
    assert shade[FERN] > shade[WILLOWHERB] > shade[OXEYE] + 0.1
    for cell in (FERN, OXEYE, WILLOWHERB):
        assert (of_kind[cell][:, 0] < 20.0).all()


def test_no_fern_stands_where_no_tree_may_near_the_castle() -> None:
    sprites = grown(castle__x=16.0)
    at = sprites.positions[sprites.cells == FERN]
    assert len(at) and np.hypot(at[:, 0] - 16.0, at[:, 2] - 20.0).min() > COURT


def test_marram_grows_low_and_heather_high_or_on_slopes() -> None:
    sprites, field = grown(), hill()
    marram, heather = (sprites.positions[sprites.cells == cell] for cell in (MARRAM, HEATHER))
    assert marram[:, 1].max() < 1.75 and (marram[:, 1] > 1.03).all()
    # On green ground by the water only; on sand, here in the east, all over.
    green = marram[marram[:, 0] < 19.9]
    assert len(green) and green[:, 1].max() < 1.22 < np.median(marram[:, 1])
    slope = field.slope(heather[:, 0], heather[:, 2])
    assert ((slope > 0.30) | (heather[:, 1] > 3.2)).all() and (heather[:, 1] > 1.5).all()


def test_flowers_come_in_drifts_that_run_in_no_direction() -> None:
    at = np.linspace(0, 40, 200)
    x, z = (a.ravel() for a in np.meshgrid(at, at))
    for number in (101, 102, 104):
        drift = drifts_of(5, number)(x, z).reshape(200, 200)
        assert drift.min() == 0.0 and drift.max() <= 1.0
        assert 0.3 < (drift == 0).mean() < 0.7  # bare between
        steps = np.abs(np.diff(drift, axis=0)).mean(), np.abs(np.diff(drift, axis=1)).mean()
        assert max(steps) < 1.5 * min(steps)


def test_an_herb_is_drawn_by_its_chance_and_as_high_as_its_kind_is() -> None:
    plants = with_settings(preset("best"), {"plants.size_min": 0.1, "plants.size_max": 0.2}).plants
    chances = np.tile([0.0, 0.3, 0.6, 0.0, 0.0], (20_000, 1))
    cells, sizes = herbs_by_place(chances, plants, np.random.default_rng(1))
    assert set(cells) == {OXEYE, WILLOWHERB}
    assert (cells == WILLOWHERB).mean() == pytest.approx(2 / 3, abs=0.02)
    assert sizes[:, 1].min() >= 0.1 and sizes[:, 1].max() <= 0.2
    low, high = sizes[cells == OXEYE, 1], sizes[cells == WILLOWHERB, 1]
    assert low.max() < high.min()


def test_white_flowers_stay_white() -> None:
    sprites = grown()
    flowers, ferns = sprites.tints[sprites.cells == OXEYE], sprites.tints[sprites.cells == FERN]
    assert np.ptp(flowers[:, :3], axis=1).max() < 0.1 * 255 < np.ptp(ferns[:, :3], axis=1).max()


# ---- their cells ------------------------------------------------------------------------------


def test_with_herbs_the_atlas_is_as_high_as_wide() -> None:
    cells = [np.full((8, 8, 4), k, np.uint8) for k in range(HERB + len(HERBS))]
    sheet = atlas(cells)
    assert sheet.shape == (32, 32, 4)
    s = np.array([0.5])
    for k in range(HERB, len(cells)):
        u, v = cell_coordinates(np.array([k]), np.array([False]), s, s, HERB_ROWS)[0, 0]
        assert sheet[int(v * 32), int(u * 32), 0] == k


def test_views_from_above_have_cells_that_no_sprite_takes() -> None:
    taken = {*range(len(CELLS)), *range(HERB, HERB + len(HERBS))}
    assert taken.isdisjoint(TOPS_CELLS)
    plants = np.array([PLANT, *range(HERB, HERB + len(HERBS))])
    middles = top_coordinates(plants, HERB_ROWS).mean(axis=1)
    places = (middles * (2 * COLUMNS, 2 * HERB_ROWS)).astype(int)  # quarters of cells
    assert len(np.unique(places, axis=0)) == len(plants)
    cells = places[:, 0] // 2 + COLUMNS * (places[:, 1] // 2)
    assert (cells == np.array(TOPS_CELLS)[TOP_OF_CELL[plants] // 4]).all()


@pytest.fixture(scope="module")
def sprites(the_stage: Stage, tmp_path_factory) -> Iterator[TransparentElements]:
    """The element with an atlas of herbs, each of one colour."""
    the_stage.enter()
    folder = tmp_path_factory.mktemp("herbs")
    colours = {name: (9, 9, 9, 255) for name in CELLS} | {CELLS[0]: RED, CELLS[PLANT]: PLANT_GREEN}
    colours |= dict(zip(HERBS, COLOURS, strict=True))
    write_plain(folder)
    for name, colour in colours.items():
        Image.new("RGBA", (CELL // 2, CELL // 2), colour).save(folder / name)
    settings = small({"transparent.radius": 50.0, "plants.species": 5})
    ground = Ground(settings, Assets(folder), np.array([0, 1, 0], np.float32))
    element = TransparentElements(settings, Assets(folder), ground, 1, {"trees", "plants"})
    yield element
    the_stage.enter()
    element.release()
    ground.release()


def seen(stage: Stage, element: TransparentElements, pose: Pose, **changes: Any) -> np.ndarray:
    """Return the sprites' picture under some settings; the state must stay."""
    keys = {key.replace("__", "."): value for key, value in changes.items()}
    element._settings = small(
        {"transparent.radius": 50.0, "plants.sway": 0.0, "plants.species": 5, **keys}
    )
    with stage.frame(element._settings, pose) as frame:
        element.draw(frame)
        return stage.read()


@pytest.mark.parametrize("cell", [0, PLANT, *range(HERB, HERB + len(HERBS))])
def test_each_kind_shows_its_own_picture_near_and_far(
    stage: Stage, sprites: TransparentElements, cell: int
) -> None:
    put(sprites, [(20.0, 3.0, 17.0)], [cell], (1.0, 1.0))
    wanted = {0: RED, PLANT: PLANT_GREEN}.get(cell) or COLOURS[cell - HERB]
    for within in (0.0, 1.0):  # crossed, and a single billboard
        for trimmed in (False, True):
            picture = seen(
                stage, sprites, NORTH, plants__crossed_within=within, transparent__trimmed=trimmed
            )
            here = pixel(picture, project(NORTH, (20.1, 3.5, 17.0)))
            assert close(here, wanted[:3], 12)


@pytest.mark.parametrize("cell", range(HERB, HERB + len(HERBS)))
def test_from_above_each_herb_shows_its_own_colour(
    stage: Stage, sprites: TransparentElements, cell: int
) -> None:
    above = Pose(20.0, 6.0, 16.0, 0.0, -90.0)
    put(sprites, [(20.0, 3.0, 16.0)], [cell], (1.0, 1.0))
    picture = seen(stage, sprites, above, plants__rosette=True, plants__fade_edge_on=True)
    rise = 0.65 if cell in FLOWERING else 0.3
    here = pixel(picture, project(above, (20.17, 3.0 + rise, 16.1)))
    assert close(here, COLOURS[cell - HERB][:3], 12)


# ---- near, far, in shadow ---------------------------------------------------------------------


def test_single_and_crossed_plants_change_over_without_a_gap_or_a_jump() -> None:
    single, crossed = crossing(small({"plants.crossed_within": 5.0}), np.linspace(0.0, 8.0, 801))
    assert (np.maximum(single, crossed) == 1.0).all()
    assert single[0] == 0.0 and crossed[-1] == 0.0
    assert np.abs(np.diff([single, crossed])).max() < 0.04
    never = small({"plants.crossed_within": 0.0})
    assert (crossing(never, np.arange(9.0))[1] == 1.0).all()


def test_plants_beyond_their_own_radius_are_not_drawn_and_trees_are(
    stage: Stage, sprites: TransparentElements
) -> None:
    put(sprites, [(20.0, 3.0, 17.0), (20.0, 3.0, 12.0), (21.0, 3.0, 12.0)], [FERN, FERN, 0])
    counts = []
    for radius in (0.0, 5.0):
        seen(stage, sprites, NORTH, plants__radius=radius)
        with stage.frame(sprites._settings, NORTH) as frame:
            counts.append(len(sprites.prepare(frame)[3]) // 6)
    assert counts == [9, 5]


def test_plants_are_darker_where_the_ground_on_their_sunny_side_is_and_trees_as_they_were(
    sprites: TransparentElements,
) -> None:
    sprites._settings = small({"sun.azimuth": 90.0, "sun.elevation": 10.0})
    put(sprites, [(19.9, 3.0, 17.0), (20.1, 3.0, 12.0), (30.0, 3.0, 12.0)], [FERN, OXEYE, 0])
    before = sprites.sprites.tints.copy()

    def light(x: np.ndarray, z: np.ndarray) -> np.ndarray:
        return np.where(x < 20.0, 1.0, 0.25)

    sprites._shade(cast(Ground, SimpleNamespace(light=light)))
    # The first stands west of the shadow's edge, and what it is asked for lies east of it.
    assert np.allclose(sprites.sprites.tints[:2, :3], 0.5 * before[:2, :3])
    assert (sprites.sprites.tints[2] == before[2]).all()
    assert (sprites.sprites.tints[:, 3] == before[:, 3]).all()
