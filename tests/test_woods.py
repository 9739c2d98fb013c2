"""Where the refined sprites stand: in woods and drifts, each herb in its own surroundings."""

from typing import Any

import numpy as np
import pytest
from hill import grow, hill, refine
from stage import Stage

from landscape.elements.best.sprites.herbs import herbs_by_place
from landscape.elements.best.sprites.refined_planting import TintedSprites, plant_refined
from landscape.elements.best.sprites.woods import SHRUB, drifts_of, species_by_place, woodland
from landscape.elements.ground import Ground
from landscape.elements.planting import COURT, PLANT
from landscape.elements.settings import preset
from landscape.elements.sprite_names import HERB, HERBS
from landscape.files.assets import Assets
from landscape.settings.declare import with_settings

FERN, OXEYE, WILLOWHERB, MARRAM, HEATHER = range(HERB, HERB + len(HERBS))


def test_without_woods_and_herbs_the_places_are_those_of_2006() -> None:
    plain, refined = grow()[1], refine()
    for name, values in vars(plain).items():
        assert (getattr(refined, name) == values).all(), name
    assert (refined.tints == 255).all()


def test_in_woods_every_sprite_stands_on_land_at_the_grounds_height() -> None:
    x, y, z = refine(trees__grouped=True).positions.T
    assert (hill().terrain_height(x, z) > 1.0).all()
    assert np.allclose(y, hill().terrain_height(x, z))


@pytest.mark.seldom(3, first=2)
def test_the_same_seed_gives_the_same_woods_and_another_seed_others() -> None:
    changes = {"trees__grouped": True, "plants__species": 3}
    first, again, other = (refine(seed=seed, **changes) for seed in (5, 5, 6))
    for name, values in vars(first).items():
        assert (getattr(again, name) == values).all(), name
    assert (
        first.positions.shape != other.positions.shape or (first.positions != other.positions).any()
    )


def test_in_woods_trees_stand_closer_than_at_random() -> None:
    def crowding(grouped: bool) -> float:
        xz = refine({"trees"}, trees__grouped=grouped, trees__count=1500).positions[:, [0, 2]]
        bins = np.histogram2d(xz[:, 0], xz[:, 1], bins=20, range=[[0, 40], [0, 40]])[0]
        return float(bins.var() / bins.mean())

    assert crowding(True) > crowding(False)


def test_a_wood_is_as_dense_as_its_function_says_and_never_quite_empty() -> None:
    at = np.linspace(0, 40, 50)
    density = woodland(3)(*np.meshgrid(at, at))
    assert density.min() >= 0.02 and density.max() <= 1.0
    assert density.std() > 0.1


def test_conifers_stand_higher_than_shrubs() -> None:
    rng = np.random.default_rng(2)
    places = np.stack([np.zeros(4000), rng.random(4000) * 3, np.zeros(4000)], axis=1)
    kind = species_by_place(places, 0.0, 4, rng)
    assert set(np.unique(kind)) == {0, 1, 2, 3}
    assert places[kind == 1, 1].mean() > places[kind == 3, 1].mean() + 0.5


def test_grouped_plants_keep_to_green_ground_and_scattered_ones_do_not() -> None:
    grouped, scattered = refine({"plants"}, trees__grouped=True), refine({"plants"})
    assert len(grouped.positions) > 500 and (grouped.positions[:, 0] < 20.0).all()
    assert 0.3 < (scattered.positions[:, 0] < 20.0).mean() < 0.7


def grown(**changes: Any) -> TintedSprites:
    """Plants alone on the hill, green in the west, its slopes half as steep as elsewhere."""
    given = {"trees__grouped": True, "plants__count": 4000, "castle__x": 26.0, "castle__z": 20.0}
    return refine({"plants"}, **{**given, "plants__species": 5, **changes})


@pytest.mark.seldom(10, first=4)
def test_one_species_is_the_fern_of_2006_and_more_are_as_many_herbs() -> None:
    assert set(grown(plants__species=1).cells) == {PLANT}
    for species in (2, 3, 5):
        assert set(grown(plants__species=species).cells) == set(range(HERB, HERB + species))


@pytest.mark.seldom(3, first=1)
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
    assert len(green) and green[:, 1].max() < 1.22 and np.median(marram[:, 1]) > 1.2
    slope = field.slope(heather[:, 0], heather[:, 2])
    assert ((slope > 0.30) | (heather[:, 1] > 3.2)).all() and (heather[:, 1] > 1.5).all()


def test_flowers_come_in_drifts_with_no_preferred_direction() -> None:
    at = np.linspace(0, 40, 200)
    x, z = (a.ravel() for a in np.meshgrid(at, at))
    for number in (101, 102, 104):
        drift = drifts_of(5, number)(x, z).reshape(200, 200)
        assert drift.min() == 0.0 and drift.max() <= 1.0
        assert 0.3 < (drift == 0).mean() < 0.7  # bare between
        steps = np.abs(np.diff(drift, axis=0)).mean(), np.abs(np.diff(drift, axis=1)).mean()
        assert max(steps) < 1.5 * min(steps)


def test_a_herb_is_chosen_by_its_probability_and_has_the_height_of_its_kind() -> None:
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


def test_woods_keep_off_the_beach_and_shrubs_stand_at_their_edges(
    shipped: Assets, stage: Stage
) -> None:
    settings = preset("best")
    ground = Ground(settings, shipped, np.array([0, 1, 0], np.float32))
    sprites = plant_refined(settings, ground, 2006, {"trees"})
    ground.release()
    x, y, z = sprites.positions.T
    assert (y > settings.water.level + 0.12).all()
    assert ground.field.slope(x, z).max() < 0.91
    thick = woodland(2006)(x, z)
    shrubs = sprites.cells == SHRUB
    assert thick[shrubs].mean() < thick[~shrubs].mean()
