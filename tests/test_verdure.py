"""Turf in the colour of the sward, details that keep their grain, and the shadows of clouds."""

from dataclasses import replace

import numpy as np

from framelens.gl.texture import mip_levels
from landscape.elements.best.terrain.cloud_shade import cloud_cover, cloud_light, clouds_shade
from landscape.elements.best.terrain.verdure import grained, verdant
from landscape.elements.settings import preset
from landscape.geometry.height_field import HeightField

GRASS, SAND = (95, 110, 75), (210, 194, 157)
HIGH = HeightField(np.full((9, 9), 2.0, np.float32), 40.0, 0.6)


def grown(colour: tuple[int, int, int], turf: int, strength: float) -> np.ndarray:
    """Return a colour (3,) as it is where there is so much turf, 0..255."""
    painted = np.full((4, 4, 3), colour, np.uint8)
    found = verdant(painted, np.full((4, 4, 1), turf, np.uint8), strength)
    return np.asarray(found[2, 2].astype(float))


def test_turf_turns_greener_and_bare_ground_stays() -> None:
    red, green, blue = grown(GRASS, 255, 1.0)
    assert green / red > 1.17 and green / blue > 1.6 and green > 110
    assert tuple(grown(SAND, 0, 1.0)) == SAND


def test_the_strength_of_verdure_is_how_far_the_colour_changes() -> None:
    half, full = (grown(GRASS, 255, s) - GRASS for s in (0.5, 1.0))
    assert np.abs(full).max() > 3 and np.abs(half - full / 2).max() <= 1


def test_details_keep_contrast_that_averaging_would_take() -> None:
    noise = np.random.default_rng(1).integers(0, 256, (64, 64, 3)).astype(np.uint8)
    plain, kept = mip_levels(noise), grained(noise)
    assert [level.shape for level in kept] == [level.shape for level in plain]
    assert np.abs(kept[0].astype(int) - noise).max() <= 1
    for level in (1, 2, 3):
        assert kept[level].std() > 1.3 * plain[level].std()
        assert abs(kept[level].mean() - plain[level].mean()) < 2.0


def test_a_detail_of_one_colour_stays_so() -> None:
    assert all((level == 90).all() for level in grained(np.full((8, 8, 3), 90, np.uint8)))


def test_clouds_shade_part_of_the_land_with_soft_edges() -> None:
    cover = cloud_cover(HIGH, 512)
    assert cover.min() == 0.0 and cover.max() == 1.0 and 0.15 < cover.mean() < 0.5
    assert np.abs(np.diff(cover, axis=0)).max() < 0.4


def test_the_map_of_the_clouds_is_the_same_at_every_resolution() -> None:
    fine = cloud_cover(HIGH, 512).reshape(128, 4, 128, 4).mean(axis=(1, 3))
    assert np.abs(fine - cloud_cover(HIGH, 128)).mean() < 0.02


def test_no_cloud_shades_the_beach() -> None:
    beach = replace(HIGH, heights=np.full((9, 9), 0.65, np.float32))
    assert cloud_cover(beach, 64).max() == 0.0


def test_under_clouds_the_light_lies_between_sun_and_shade() -> None:
    best = preset("best")
    z, x = np.mgrid[0:40:0.5, 0:40:0.5].reshape(2, -1)
    light = cloud_light(best, HIGH, x, z)
    darkest = 1.0 - best.ground.clouds * (1.0 - np.array(best.sun.shade))
    assert light.max() == 1.0 and np.allclose(light.min(axis=0), darkest, atol=0.02)


def test_clouds_shade_by_day_alone_and_only_where_shadows_are_baked() -> None:
    best = preset("best")
    assert clouds_shade(best) and not clouds_shade(preset("2006"))
    assert not clouds_shade(replace(best, sun=replace(best.sun, relit=True)))
    assert not clouds_shade(replace(best, ground=replace(best.ground, shadows=False)))
