"""The wet band along the shore: where it lies, how dark it is, and what it leaves alone."""

import numpy as np
from seaside import LEVEL, beach

from landscape.elements.best.terrain.wet import (
    DARKER,
    DEEPEST,
    RAGGED,
    RUN_UP,
    SPLASH,
    dampened,
    noise,
    wet_texels,
    wetness,
)

SIDE = 512


def test_the_ground_is_wet_below_the_waves_reach_and_dry_above() -> None:
    above = np.array([-0.1, 0.0, 0.9 * RUN_UP, 1.1 * RUN_UP])
    wet = wetness(above, np.zeros(4), np.zeros(4))
    assert (wet[:2] == 1).all() and 0 < wet[2] < 0.5 and wet[3] == 0
    steep = wetness(np.full(2, 1.1 * RUN_UP), np.array([0.0, 1.0]), np.zeros(2))
    assert steep[0] == 0 < steep[1], "waves splash higher on rock"


def test_the_band_follows_the_shore_with_a_ragged_edge() -> None:
    field = beach(0.1)
    texels, wet = wet_texels(field, SIDE)
    rows, columns = np.divmod(texels, SIDE)
    above = field.terrain_height((columns + 0.5) * 40 / SIDE, (rows + 0.5) * 40 / SIDE) - LEVEL
    assert above.max() <= (RUN_UP + 0.1 * SPLASH) * (1 + RAGGED)
    assert above.min() >= -DEEPEST - 0.1
    assert (np.diff(texels) > 0).all() and wet.dtype == np.uint8
    assert (wet[(above < 0) & (above > -DEEPEST + 0.1)] == 255).all()
    highest = [rows[columns == column].min() for column in range(SIDE)]
    assert max(highest) > min(highest), "its edge is not a straight line"


def test_only_wet_texels_are_darker_and_their_alpha_stays() -> None:
    painted = np.full((4, 4, 4), 200, np.uint8)
    out = dampened(painted, np.array([5, 6], np.int32), np.array([255, 128], np.uint8))
    assert (painted == 200).all()
    changed = (out != painted).any(axis=2)
    assert changed.sum() == 2 and (out[..., 3] == 200).all()
    assert np.allclose(out[1, 1, :3], 200 * DARKER, atol=1)
    assert (out[1, 1, :3] < out[1, 2, :3]).all()


def test_the_noise_is_the_same_each_time_and_smooth() -> None:
    first = noise(1024, 40.0)
    assert (first == noise(1024, 40.0)).all() and np.abs(first).max() < 1.5
    assert np.abs(np.diff(first, axis=0)).mean() < 0.5 * first.std()
