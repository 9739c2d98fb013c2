"""The relief of steep rock: where it is, and that the walker stands on what is drawn of it."""

from dataclasses import replace

import numpy as np
import pytest

from landscape.elements.best.terrain.ledges import FINER, LedgedField, relief
from landscape.elements.best.terrain.materials import ROCK, SAND, TURF
from landscape.elements.best.terrain.rock_faces import (
    LEVELS,
    PLANES,
    Block,
    blocks,
    grain,
    in_planes,
    lit_rock,
    lowest,
    with_grain,
)
from landscape.geometry.height_field import HeightField, ground_mesh
from landscape.geometry.mesh import Mesh

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


def rock(ledged: LedgedField, label: int = ROCK) -> list[Block]:
    """Return regions and blocks of the pyramid's rock, whose triangles all have one label."""
    mesh = with_grain(ground_mesh(pyramid(), (24.0, 18.0, 5.4, 1.0)))
    colors = np.full((len(mesh.vertices), 4), 255, np.uint8)
    mesh = replace(mesh, colors=colors)
    labels = np.full(len(mesh.triangles), label)
    return blocks(ledged, mesh, RATES, labels)


def test_the_walker_stands_on_the_triangles_that_are_drawn(ledged: LedgedField) -> None:
    found = [block for block in rock(ledged) if block.region >= 0]
    assert found
    for block in found:
        assert len(block.meshes) == len(LEVELS)
        fine = block.meshes[0]
        middles = fine.vertices[fine.triangles].mean(axis=1)
        for x, y, z in (fine.vertices.T, middles.T):
            assert np.abs(ledged.terrain_height(x, z) - y).max() < 1e-4
        counts = [len(each.triangles) for each in block.meshes]
        assert counts == sorted(counts, reverse=True)


def test_a_region_has_the_cells_of_its_blocks(ledged: LedgedField) -> None:
    found = rock(ledged)
    regions = [block for block in found if block.region < 0]
    assert found[: len(regions)] == regions, "blocks name them by their numbers"
    for k, region in enumerate(regions):
        own = [block for block in found if block.region == k]
        cells = [len(block.meshes[0].triangles) // (2 * FINER * FINER) for block in own]
        assert sum(cells) == len(region.meshes[-1].triangles) // 2
        assert {block.mixture for block in own} == {region.mixture}
        assert np.array_equal(region.low, np.min([block.low for block in own], axis=0))
        assert np.array_equal(region.high, np.max([block.high for block in own], axis=0))


def test_rock_that_stands_out_is_looked_up_as_rock_alone(ledged: LedgedField) -> None:
    assert ledged.relief is not None
    heights = ledged.relief.heights
    cells = SIDE - 1
    for r, c in ((10, 12), (13, 4)):
        own = heights[r * FINER : (r + 1) * FINER + 1, c * FINER : (c + 1) * FINER + 1]
        assert lowest(heights, cells)[r, c] == own.min()
    assert {block.mixture for block in rock(ledged, TURF | ROCK)} == {ROCK, TURF | SAND | ROCK}
    assert {block.mixture for block in rock(ledged)} == {ROCK}


def test_the_light_on_the_relief_is_in_the_large_colours(ledged: LedgedField) -> None:
    sun = np.array([0.5, 0.7, 0.5])
    colours = np.full((128, 128, 4), 120, np.uint8)
    lit = lit_rock(colours, ledged, sun)
    assert np.array_equal(lit[..., 3], colours[..., 3])
    assert (lit[:4] == 120).all(), "there is no rock in the sea"
    assert lit[..., :3].min() < 90 and lit[..., :3].max() > 130


def stretches(mesh: Mesh, layer: int, rate: float) -> np.ndarray:
    """Return how many times longer than it should be a texture's unit is on each triangle, most."""
    points, looked_up = mesh.vertices[mesh.triangles], mesh.coordinates[layer][mesh.triangles]
    sides = (points[:, 1:] - points[:, :1]).astype(float)
    along = sides[:, 0] / np.linalg.norm(sides[:, 0], axis=1, keepdims=True)
    aside = sides[:, 1] - (sides[:, 1] * along).sum(axis=1, keepdims=True) * along
    aside /= np.linalg.norm(aside, axis=1, keepdims=True)
    flat = np.stack([(sides * each[:, None]).sum(axis=2) for each in (along, aside)], axis=2)
    steps = (looked_up[:, 1:] - looked_up[:, :1]).astype(float) / rate
    least = np.linalg.svd(np.linalg.solve(flat, steps), compute_uv=False)[:, -1]
    return np.asarray(1.0 / least)


@pytest.mark.seldom(3, first=1)
def test_rock_that_stands_is_looked_up_from_in_front(ledged: LedgedField) -> None:
    meshes = [block.meshes[0] for block in rock(ledged) if block.region >= 0]
    stretched = np.concatenate([stretches(mesh, 2, RATES[2]) for mesh in meshes])
    assert np.median(stretched) < 1.15 and np.quantile(stretched, 0.98) < 2.0
    flat = [replace(mesh, coordinates=(mesh.vertices[:, ::2],)) for mesh in meshes]
    from_above = np.concatenate([stretches(mesh, 0, 1.0) for mesh in flat])
    assert np.quantile(from_above, 0.98) > 2.0, "as it was on a height field"
    assert np.allclose(PLANES @ PLANES.transpose(0, 2, 1), np.eye(3), atol=1e-6)


def test_level_cells_and_the_large_texture_keep_their_coordinates() -> None:
    mesh = ground_mesh(HeightField(np.ones((4, 4), np.float32), 3.0, 0.5, exact=True), (5.0, 1.0))
    mesh = replace(mesh, colors=np.full((16, 4), 255, np.uint8))
    same = in_planes(mesh, (5.0, 0.0))
    for one, other in zip(same.coordinates, mesh.coordinates, strict=True):
        assert np.array_equal(one[same.triangles], other[mesh.triangles])
    upright = replace(mesh, normals=np.tile(np.float32([1.0, 0.0, 0.0]), (16, 1)))
    turned = in_planes(upright, (5.0, 0.0))
    assert not np.array_equal(
        turned.coordinates[0][turned.triangles], mesh.coordinates[0][mesh.triangles]
    )
    assert np.array_equal(
        turned.coordinates[1][turned.triangles], mesh.coordinates[1][mesh.triangles]
    )


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
