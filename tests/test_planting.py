"""Where sprites stand: on land, drawn by lot, the same lot for the same seed."""

from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from landscape.elements.ground import Ground
from landscape.elements.sprites.planting import (
    DEER,
    PLANT,
    Sprites,
    plant_everything,
    scatter,
    species_by_place,
    woodland,
)
from landscape.geometry.height_field import HeightField
from landscape.keys import with_settings
from landscape.settings import Settings

ALL = {"trees", "deer", "plants"}


def hill(level: float = 1.0) -> HeightField:
    """A round hill of 4 units in a sea of the given level."""
    at = np.linspace(-1.0, 1.0, 61)
    heights = 4.0 * np.exp(-3 * (at[None, :] ** 2 + at[:, None] ** 2))
    return HeightField(heights.astype(np.float32), 40.0, level)


def green_in_the_west(x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """A ground of grass where x is under 20, of sand elsewhere."""
    grass, sand = np.array([0.2, 0.4, 0.1]), np.array([0.7, 0.6, 0.5])
    return np.where((x < 20.0)[:, None], grass, sand)


def grow(kinds: set[str] = ALL, seed: int = 5, field: HeightField | None = None, **changes: Any):
    """Plant a hill; the castle and the rabbit stand where the settings put them."""
    field = field or hill()
    keys = {key.replace("__", "."): value for key, value in changes.items()}
    settings = with_settings(Settings(), {"water.level": field.water_level, **keys})
    ground = cast(Ground, SimpleNamespace(field=field, colour=green_in_the_west))
    return settings, plant_everything(settings, ground, seed, kinds)


@pytest.mark.parametrize("grouped", [False, True])
def test_every_sprite_stands_on_land_at_the_grounds_height(grouped: bool) -> None:
    _, sprites = grow(trees__grouped=grouped)
    x, y, z = sprites.positions.T
    assert (hill().terrain_height(x, z) > 1.0).all()
    assert np.allclose(y, hill().terrain_height(x, z))
    assert x.min() >= 0 and x.max() <= 40 and z.min() >= 0 and z.max() <= 40


def test_there_are_as_many_as_asked_for() -> None:
    settings, sprites = grow()
    of_kind = np.digitize(sprites.cells, [DEER, PLANT])
    wanted = [settings.trees.count, settings.deer.count, settings.plants.count]
    assert np.bincount(of_kind).tolist() == wanted


def test_sizes_are_uniform_between_their_limits() -> None:
    settings, sprites = grow({"trees"}, trees__count=20_000)
    low, high = settings.trees.size_min, settings.trees.size_max
    assert sprites.sizes.min() >= low and sprites.sizes.max() <= high
    assert np.allclose(sprites.sizes.mean(axis=0), (low + high) / 2, atol=0.01 * high)
    # Width and height are drawn apart from each other.
    assert abs(np.corrcoef(sprites.sizes.T)[0, 1]) < 0.05


def test_half_of_them_are_mirrored() -> None:
    _, sprites = grow({"trees"}, trees__count=20_000)
    assert sprites.flipped.mean() == pytest.approx(0.5, abs=0.02)


def test_places_are_spread_evenly_over_flat_land() -> None:
    flat = HeightField(np.full((4, 4), 3.0, np.float32), 40.0, 1.0)
    _, sprites = grow({"trees"}, field=flat, trees__count=40_000, castle__x=-900, rabbit__x=-900)
    x, z = sprites.positions[:, 0], sprites.positions[:, 2]
    counts = np.histogram2d(x, z, bins=4, range=[[0, 40], [0, 40]])[0]
    assert (np.abs(counts - 2500) < 5 * 50).all()  # five standard deviations


def test_the_same_seed_gives_the_same_places_and_another_seed_others() -> None:
    first, again, other = grow(seed=5)[1], grow(seed=5)[1], grow(seed=6)[1]
    for name in ("positions", "sizes", "cells", "flipped", "tints"):
        assert (getattr(first, name) == getattr(again, name)).all()
    assert (first.positions != other.positions).any()


@pytest.mark.parametrize("kind", sorted(ALL))
def test_showing_one_kind_alone_moves_none_of_its_sprites(kind: str) -> None:
    every, alone = grow()[1], grow({kind})[1]
    there = {tuple(row) for row in every.positions.tolist()}
    assert len(alone.positions) and {tuple(row) for row in alone.positions.tolist()} <= there


def test_nothing_grows_in_the_castle_or_the_rabbit() -> None:
    settings, sprites = grow(trees__count=20_000, castle__x=20, castle__z=20, rabbit__x=23)
    x, z = sprites.positions[:, 0], sprites.positions[:, 2]
    assert np.hypot(x - 20, z - 20).min() > 1.1
    rabbit = settings.rabbit
    assert np.hypot(x - rabbit.x, z - rabbit.z).min() > rabbit.scale


def test_an_island_under_water_stays_bare_and_does_not_hang() -> None:
    _, sprites = grow(field=hill(level=10.0))
    assert len(sprites.positions) == 0


def test_none_asked_for_gives_none() -> None:
    _, sprites = grow(trees__count=0, deer__count=0, plants__count=0)
    assert len(sprites.positions) == 0


def test_the_chance_of_a_place_is_the_share_of_its_sprites() -> None:
    flat = HeightField(np.full((4, 4), 3.0, np.float32), 40.0, 1.0)
    places = scatter(
        flat, 20_000, np.random.default_rng(1), lambda x, z: np.where(x < 20, 0.9, 0.3)
    )
    assert len(places) == 20_000
    assert (places[:, 0] < 20).mean() == pytest.approx(0.75, abs=0.02)


def test_only_so_many_species_as_asked_for() -> None:
    for species in (1, 2, 4):
        _, sprites = grow({"trees"}, trees__species=species)
        assert set(np.unique(sprites.cells)) == set(range(species))


def test_in_woods_trees_stand_closer_than_by_chance() -> None:
    def crowding(grouped: bool) -> float:
        _, sprites = grow({"trees"}, trees__grouped=grouped, trees__count=1500)
        xz = sprites.positions[:, [0, 2]]
        bins = np.histogram2d(xz[:, 0], xz[:, 1], bins=20, range=[[0, 40], [0, 40]])[0]
        return float(bins.var() / bins.mean())

    assert crowding(True) > crowding(False)


def test_a_wood_is_as_thick_as_its_function_says_and_never_quite_empty() -> None:
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


def test_sprites_are_joined_in_order() -> None:
    one = Sprites(*(np.full((1, 2), k) for k in range(5)))
    two = Sprites(*(np.full((2, 2), 10 + k) for k in range(5)))
    assert (one + two).cells[:, 0].tolist() == [2, 12, 12]


def test_grouped_plants_keep_to_green_ground_and_scattered_ones_do_not() -> None:
    _, grouped = grow({"plants"}, trees__grouped=True)
    _, scattered = grow({"plants"})
    assert len(grouped.positions) > 500 and (grouped.positions[:, 0] < 20.0).all()
    assert 0.3 < (scattered.positions[:, 0] < 20.0).mean() < 0.7
