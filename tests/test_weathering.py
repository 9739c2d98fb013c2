"""What is painted into the large texture: ledges, a tideline, ragged edges of turf."""

import numpy as np

from landscape.elements.best.terrain.weathering import noise, upright, weathered
from landscape.geometry.height_field import HeightField

SIDE = 256
GREY = np.full((64, 64, 3), 128, np.uint8)
SAND = np.full((SIDE, SIDE, 3), 160, np.uint8)
BARE = np.zeros((SIDE, SIDE, 1), np.uint8)


def slope(rise: float, low: float = 0.0) -> HeightField:
    """Return land of 8 x 8 units that rises along x from ``low``, water at 0.6."""
    heights = np.tile(low + rise * np.linspace(0.0, 8.0, 33, dtype=np.float32), (33, 1))
    return HeightField(heights, 8.0, 0.6)


def test_level_turf_and_the_floor_of_the_sea_stay_as_they_are() -> None:
    turf = np.full((SIDE, SIDE, 1), 255, np.uint8)
    for field, alpha in ((slope(0.0, 1.0), turf), (slope(0.0, 0.0), BARE)):
        colours, left = weathered(SAND, alpha, field, GREY)
        assert (np.abs(colours.astype(int) - SAND) <= 1).all() and (left == alpha).all()


def test_the_bed_of_shallow_water_is_pale_sand_that_gets_darker_and_bluer_with_its_depth() -> None:
    grey = np.full((SIDE, SIDE, 3), 90, np.uint8)
    bed = weathered(grey, BARE, slope(0.05, 0.2), GREY)[0].astype(float).mean(axis=0)
    above = 0.2 + 0.05 * (np.arange(SIDE) + 0.5) / SIDE * 8.0 - 0.6
    shallow, deep = (bed[np.abs(above - at) < 0.02].mean(axis=0) for at in (-0.06, -0.37))
    assert shallow.min() > 150 and shallow[0] > shallow[2], "sand"
    assert deep[0] < 100 and deep[2] > deep[0], "the colour of the floor below"


def test_ledges_follow_lines_of_equal_height() -> None:
    colours, _ = weathered(SAND, BARE, slope(0.8, 1.0), GREY)
    tone = colours[..., 0].astype(float)
    across, along = np.abs(np.diff(tone, axis=1)).mean(), np.abs(np.diff(tone, axis=0)).mean()
    assert across > 2.0 * along and tone.min() < 130 and tone.std() > 8


def test_sand_on_steep_ground_turns_to_rock_without_streaks() -> None:
    sandy = np.full((SIDE, SIDE, 3), (210, 194, 157), np.uint8)
    sandy[:, ::2] -= 40  # what is a texel wide seen from above is a streak on a cliff
    flat, steep = (weathered(sandy, BARE, slope(rise, 1.0), GREY)[0] for rise in (0.0, 0.9))
    fade = [float((each[..., 0] / each[..., 2]).mean()) for each in (flat, steep)]
    assert fade[0] > 1.25 and fade[1] < 1.2 and steep.mean() < 0.9 * flat.mean()
    streaks = [np.abs(np.diff(each[..., 0].astype(float))).mean() for each in (flat, steep)]
    assert streaks[0] > 35 and streaks[1] < 20


def test_the_pattern_of_rock_stands_upright_on_both_axes() -> None:
    rows = np.tile((np.arange(64) // 8 % 2 * 255).astype(np.uint8)[:, None, None], (1, 64, 3))
    at = np.linspace(0.0, 3.0, 50)
    zero = np.zeros(50)
    one = np.ones(50)
    for rises in ((one, zero), (zero, one)):
        level = upright(rows, at, at, zero, *rises)
        assert np.ptp(level) == 0.0, "layers are level"
        assert np.ptp(upright(rows, zero, zero, at, *rises)) > 0.5, "and change with the height"


def test_weed_lies_on_a_flat_beach_a_little_above_the_water_and_nowhere_else() -> None:
    colours, _ = weathered(SAND, BARE, slope(0.03, 0.6), GREY)
    above = (np.arange(SIDE) + 0.5) / SIDE * 8.0 * 0.03
    dark = (colours[..., 0] < 0.8 * SAND[0, 0, 0]).mean(axis=0)
    assert 0.04 < dark[np.abs(above - 0.06) < 0.01].mean() < 0.2, "a line, no brown beach"
    assert dark[above > 0.14].max() == 0.0
    turf = np.full((SIDE, SIDE, 1), 255, np.uint8)
    assert weathered(SAND, turf, slope(0.03, 0.6), GREY)[0].min() > 150


def test_the_edge_of_turf_is_ragged() -> None:
    fade = np.tile(np.linspace(0, 255, SIDE).astype(np.uint8)[None, :, None], (SIDE, 1, 1))
    _, turf = weathered(SAND, fade, slope(0.0, 1.0), GREY)
    spread = turf[..., 0].astype(float).std(axis=0)
    assert spread[SIDE // 2] > 40 and spread[0] < 1 and spread[-1] < 1


def test_the_smallest_textures_are_weathered_without_noise() -> None:
    assert (noise(1, 1, 4) == 0).all() and noise(1, 2, 4).std() > 0.9
    colours, left = weathered(SAND[:1, :1], BARE[:1, :1], slope(0.0, 1.0), GREY)
    assert (np.abs(colours.astype(int) - SAND[0, 0]) < 8).all() and (left == 0).all()
