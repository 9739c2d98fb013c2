"""Where the sea is sheltered: an open sea, a cove, and the edge of the map."""

import numpy as np
import pytest

from landscape.elements.best.sea.shelter import CALMEST, DIRECTIONS, FETCH, openness, wave_heights

SIDE, SIZE = 128, 40.0


def island() -> np.ndarray:
    """Return depths (SIDE, SIDE) of a square island with a narrow cove in its south side."""
    depths = np.full((SIDE, SIDE), 1.0)
    depths[40:90, 40:90] = -1.0
    depths[80:90, 63:67] = 1.0
    return depths


def test_waves_are_calm_in_a_cove_and_as_high_as_ever_at_sea() -> None:
    heights = wave_heights(island(), SIZE)
    assert heights.dtype == np.float32
    assert heights[82, 65] == pytest.approx(CALMEST)  # in the cove
    assert heights[10, 64] == 1.0  # at sea
    assert heights[[0, -1], :].min() == heights[:, [0, -1]].min() == 1.0  # beyond the map
    off_the_coast = heights[65, 91:120]
    assert CALMEST < off_the_coast[0] < 1.0 == off_the_coast[-1]
    assert (np.diff(off_the_coast) >= -1e-6).all()  # the further out, the higher


def test_openness_is_the_mean_way_to_the_land_in_all_directions() -> None:
    land = np.zeros((64, 64), bool)
    land[:, 40:] = True  # a straight coast in the east
    spacing = FETCH / 12  # a line has 12 steps
    away = openness(land, spacing)
    assert away[32, 10] == 1.0 and (away[:, 40:] == 0.0).all()

    # Beside the coast, lines to the east end at once, and those to the west never.
    angles = 2 * np.pi * np.arange(DIRECTIONS) / DIRECTIONS
    steps = np.arange(1, 13)[:, None]
    afloat = np.round(steps * np.cos(angles)) < 1
    expected = (1 + np.cumprod(afloat, axis=0)[:-1].sum(axis=0)) / 12
    assert away[32, 39] == pytest.approx(expected.mean(), abs=1e-6)
