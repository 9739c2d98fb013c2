"""The relief of steep rock: where it is, and that the walker stands on what is drawn of it."""

import numpy as np
import pytest

from landscape.elements.best.terrain.ledges import FINER, LedgedField, relief
from landscape.elements.best.terrain.rock_faces import LEVELS, blocks, grain, with_grain
from landscape.geometry.height_field import HeightField, ground_mesh

SIDE, SIZE, WATER = 25, 6.0, 0.5
GREY, GREEN = (128, 124, 118), (70, 120, 40)
RATES = (4.0, 3.0, 0.9, 0.0, 3.9)


def pyramid() -> HeightField:
    """Return a pyramid of slope 1 in the sea, its top in the middle."""
    at = np.abs(np.linspace(-SIZE / 2, SIZE / 2, SIDE))
    heights = 3.2 - np.maximum(at[None, :], at[:, None])
    return HeightField(heights.astype(np.float32), SIZE, WATER, exact=True)


def painted(colour: tuple[int, int, int]) -> np.ndarray:
    """Return a large texture of one colour."""
    return np.full((64, 64, 3), colour, np.uint8)


@pytest.fixture(scope="module")
def ledged() -> LedgedField:
    """Return the pyramid with ledges on it."""
    field = pyramid()
    raised = HeightField(relief(field, painted(GREY), 1.0), SIZE, WATER, exact=True)
    return LedgedField(field.heights, SIZE, WATER, True, raised, 1.0)


def test_rock_rises_above_its_height_field_and_never_falls_below_it(ledged: LedgedField) -> None:
    assert ledged.relief is not None
    raised, cells = ledged.relief.heights, SIDE - 1
    assert raised.shape == (cells * FINER + 1,) * 2
    assert raised.min() == 0.0
    top = cells * FINER // 2
    assert raised[top - 8 : top + 9, top - 8 : top + 9].max() > 0.1, "the summit has none"
    at = np.linspace(0.0, SIZE, len(raised))
    wet = pyramid().terrain_height(at[None, :], at[:, None]) < WATER
    assert raised[wet].max() == 0.0, "the shore has moved"


def test_turf_and_gentle_ground_have_no_ledges() -> None:
    assert relief(pyramid(), painted(GREEN), 1.0).max() == 0.0
    field = pyramid()
    gentle = HeightField(0.2 * field.heights + 1.0, SIZE, WATER, exact=True)
    assert relief(gentle, painted(GREY), 1.0).max() == 0.0


def test_the_walker_stands_on_the_triangles_that_are_drawn(ledged: LedgedField) -> None:
    mesh = with_grain(ground_mesh(pyramid(), (24.0, 18.0, 5.4, 1.0)))
    colors = np.full((len(mesh.vertices), 4), 255, np.uint8)
    mesh = type(mesh)(mesh.vertices, mesh.normals, mesh.triangles, mesh.coordinates, colors)
    labels = np.full(len(mesh.triangles), 4)
    found = blocks(ledged, mesh, RATES, labels, np.array([0.5, 0.7, 0.5]))
    assert found
    for block in found:
        assert len(block.meshes) == len(LEVELS)
        fine = block.meshes[0]
        middles = fine.vertices[fine.triangles].mean(axis=1)
        for x, y, z in (fine.vertices.T, middles.T):
            assert np.abs(ledged.terrain_height(x, z) - y).max() < 1e-4
        counts = [len(each.triangles) for each in block.meshes]
        assert counts == sorted(counts, reverse=True)


def test_rules_that_ask_how_steep_ground_is_mean_the_broad_slope(ledged: LedgedField) -> None:
    x, z = np.random.default_rng(1).uniform(1.0, 5.0, (2, 200))
    assert np.array_equal(ledged.slope(x, z), pyramid().slope(x, z))
    assert np.array_equal(ledged.broad.heights, pyramid().heights)
    assert ledged.made_from != pyramid().made_from, "the cache would take one for the other"


def test_the_grain_fades_to_a_grey_that_changes_nothing() -> None:
    rock = np.random.default_rng(2).integers(60, 200, (64, 64, 3)).astype(np.uint8)
    levels = grain(rock)
    assert levels[0].std() > 20
    assert np.abs(levels[-1].astype(int) - 127).max() <= 1
