"""Land in the tones of a photograph: olive grass, grey rock, darker."""

import numpy as np
from hill import refine

from landscape.elements.best.terrain.tone import STONES_DRAINED, bare_toned, toned, turf_toned
from landscape.elements.settings import preset
from landscape.elements.sprite_names import HERB

GRASS, STRAW = np.array([0.46, 0.545, 0.27]), np.array([0.635, 0.645, 0.40])
ROCK = np.array([0.60, 0.53, 0.40])
LUMINANCE = np.array([0.30, 0.59, 0.11])


def test_grass_becomes_darker_and_less_green_but_stays_green() -> None:
    red, green, _ = turf_toned(GRASS, 1.0)
    assert 1.0 < green / red < GRASS[1] / GRASS[0] - 0.05
    assert turf_toned(GRASS, 1.0) @ LUMINANCE < 0.9 * (GRASS @ LUMINANCE)


def test_pale_grass_is_darkened_most() -> None:
    left = [turf_toned(each, 1.0) @ LUMINANCE / (each @ LUMINANCE) for each in (GRASS, STRAW)]
    assert left[1] < left[0] - 0.03


def test_rock_is_drained_of_colour_and_stones_more() -> None:
    rock, stone = bare_toned(ROCK, 1.0), bare_toned(ROCK, 1.0, STONES_DRAINED)
    spread = [np.ptp(each) / each.max() for each in (ROCK, rock, stone)]
    assert spread[0] > spread[1] + 0.05 > spread[2] + 0.1
    assert np.isclose(rock @ LUMINANCE, stone @ LUMINANCE)


def test_the_strength_of_the_tone_is_how_far_colours_change() -> None:
    for change, colour in ((turf_toned, STRAW), (bare_toned, ROCK)):
        half, full = (change(colour, strength) - colour for strength in (0.5, 1.0))
        assert np.allclose(half, full / 2) and np.abs(full).max() > 0.03
        assert np.array_equal(change(colour, 0.0), colour)


def test_the_ground_is_toned_as_turf_where_there_is_turf() -> None:
    painted = np.broadcast_to((255 * GRASS).astype(np.uint8), (1, 2, 3)).copy()
    turf = np.array([[[255], [0]]], np.uint8)
    grass, bare = toned(painted, turf, 1.0)[0].astype(float) / 255.0
    exact = painted[0, 0] / 255.0
    assert np.allclose(grass, turf_toned(exact, 1.0), atol=0.003)
    assert np.allclose(bare, bare_toned(exact, 1.0), atol=0.003)


def test_best_is_toned_and_2006_is_not() -> None:
    assert preset("best").ground.tone == 1.0 and preset("2006").ground.tone == 0.0


def test_deer_and_herbs_are_duller_on_toned_land_and_stand_where_they_did() -> None:
    for kind, changes in (("deer", {"deer__count": 40}), ("plants", {"plants__species": 5})):
        plain, toned_ones = (refine({kind}, ground__tone=tone, **changes) for tone in (0.0, 1.0))
        assert np.array_equal(plain.positions, toned_ones.positions)
        assert (toned_ones.tints[:, :3].mean(axis=1) < 0.95 * plain.tints[:, :3].mean(axis=1)).all()
    heather = plain.cells == HERB + 4
    left = toned_ones.tints[:, :3] / plain.tints[:, :3]
    assert heather.any() and left[heather].max() < left[plain.cells == HERB].min()
