"""Where the sprites of 2006 stand: on land, at random, at the same places for the same seed."""

import numpy as np
import pytest
from hill import ALL, grow, hill

from landscape.elements.planting import DEER, DEER_POSTS, PLANT, Sprites, scatter
from landscape.geometry.height_field import HeightField


def test_every_sprite_stands_on_land_at_the_grounds_height() -> None:
    _, sprites = grow()
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
    first = grow(seed=5)[1]
    again = grow(seed=5)[1]
    other = grow(seed=6)[1]
    for name in ("positions", "sizes", "cells", "flipped"):
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


def test_sprites_are_spread_in_proportion_to_the_density() -> None:
    flat = HeightField(np.full((4, 4), 3.0, np.float32), 40.0, 1.0)
    places = scatter(
        flat, 20_000, np.random.default_rng(1), lambda x, z: np.where(x < 20, 0.9, 0.3)
    )
    assert len(places) == 20_000
    assert (places[:, 0] < 20).mean() == pytest.approx(0.75, abs=0.02)


def test_no_more_species_grow_than_asked_for() -> None:
    for species in (1, 2, 4):
        _, sprites = grow({"trees"}, trees__species=species)
        assert set(np.unique(sprites.cells)) == set(range(species))


def test_the_first_deer_stand_at_their_fixed_places_if_these_are_on_land() -> None:
    _, sprites = grow({"deer"}, deer__count=3)
    posts = np.array([post for post in DEER_POSTS if hill().terrain_height(*post) > 1.0])
    assert 1 < len(posts) < len(DEER_POSTS)
    assert np.allclose(sprites.positions[: len(posts[:3]), ::2], posts[:3])


def test_some_sprites_are_picked_by_mask_or_number() -> None:
    sprites = Sprites(np.arange(9.0).reshape(3, 3), np.ones((3, 2)), np.arange(3), np.ones(3, bool))
    assert sprites.only(np.array([True, False, True])).cells.tolist() == [0, 2]
    assert sprites.only(np.array([2, 0])).positions[:, 0].tolist() == [6.0, 0.0]
