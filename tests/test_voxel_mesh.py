"""The voxel island's faces against a brute-force count, and its materials. No OpenGL."""

import itertools
from dataclasses import replace

import numpy as np
import pytest

from framelens.gl.texture import mip_levels
from landscape.voxel import distant, faces
from landscape.voxel.blocks import AIR, BLOCKS, SOLID, TILES, block
from landscape.voxel.distant import distant_mesh, distant_meshes, halved
from landscape.voxel.faces import DIRECTIONS, EDGE, Faces, shown_in, visible_faces
from landscape.voxel.heights import Heights, heights
from landscape.voxel.materials import filled, top_materials
from landscape.voxel.mesh import (
    FIRM,
    OVERLAP,
    PLANTS,
    SETS,
    SHORE,
    WET,
    Look,
    region_mesh,
    region_meshes,
)
from landscape.voxel.relief import roughened
from landscape.voxel.tile_column import PLACES, ROWS, WIDEST, column, first_row
from landscape.voxel.tiles import SIDE
from landscape.voxel.world import World

MERGES = ("rectangles", "runs", "none")


def some_blocks(
    seed: int, full: float = 0.5, kinds: tuple[int, ...] = (1, 2, 3, 11, 29)
) -> np.ndarray:
    """Return random blocks [x, z, y] with an edge all around, plants among them."""
    rng = np.random.default_rng(seed)
    return np.where(rng.random((9, 8, 10)) < full, rng.choice(kinds, (9, 8, 10)), 0).astype(
        np.uint8
    )


def density(kind: int) -> int:
    """Return 2 for a block that hides what is behind it, 1 for leaves and 0 for air and plants."""
    return int(SOLID[kind]) * (1 if "leaves" in BLOCKS[kind].name else 2)


def brute_force(blocks: np.ndarray, axis: int, sign: int) -> dict[tuple[int, ...], int]:
    """Return the block of each exposed face, by its place within the edge."""
    found = {}
    for place in itertools.product(*(range(1, side - 1) for side in blocks.shape)):
        beyond = list(place)
        beyond[axis] += sign
        if density(blocks[place]) > density(blocks[tuple(beyond)]):
            foot = (*beyond[:2], beyond[2] - 1)
            grown = axis < 2 and blocks[place] == blocks[foot] == block("grass")
            shown = block("turf") if grown else int(blocks[place])
            found[tuple(each - 1 for each in place)] = shown
    return found


def unit_faces(faces: Faces) -> list[tuple[tuple[int, ...], int]]:
    """Return the place and the block of every unit face that merged faces cover."""
    found = []
    for low, long, wide, kind in zip(faces.low, faces.long, faces.wide, faces.block, strict=True):
        for i, k in itertools.product(range(long), range(wide)):
            place = low.copy()
            place[faces.direction.along] += i
            place[faces.direction.across] += k
            found.append((tuple(int(each) for each in place), int(kind)))
    return found


@pytest.mark.parametrize("merge", MERGES)
@pytest.mark.parametrize("full", (0.15, 0.5, 0.9))
def test_faces_cover_every_exposed_face_once_and_no_other(merge: str, full: float) -> None:
    for seed in range(4):
        blocks = some_blocks(seed, full, (1, 1, 1, 3, 29))
        for direction in DIRECTIONS:
            covered = unit_faces(visible_faces(blocks, direction, merge))
            expected = brute_force(blocks, direction.axis, direction.sign)
            assert len(covered) == len(expected)
            assert dict(covered) == expected


def test_merging_makes_fewer_faces() -> None:
    flat = np.zeros((22, 22, 6), np.uint8)
    flat[:, :, :3] = block("grass")
    up = DIRECTIONS[2]
    counts = [len(visible_faces(flat, up, merge)) for merge in MERGES]
    assert counts == [4, 40, 400]  # runs and rectangles are cut at 16 blocks


def test_the_side_of_grass_is_overgrown_where_there_is_grass_one_step_below() -> None:
    west = next(each for each in DIRECTIONS if each.name == "west")
    for below, shown in (("grass", "turf"), ("sand", "grass"), ("air", "grass")):
        step = np.zeros((4, 3, 4), np.uint8)
        step[1, 1, 1], step[2, 1, 2] = block(below), block("grass")
        faces = visible_faces(step, west, "none")
        at = faces.low[:, 2] == 1
        assert [BLOCKS[each].name for each in faces.block[at]] == [shown]


def test_a_corner_is_darkened_by_the_blocks_around_it() -> None:
    floor = np.zeros((5, 5, 5), np.uint8)
    floor[:, :, :2] = 1
    floor[3, :, 2] = 1  # a wall east of the middle
    up = next(each for each in DIRECTIONS if each.name == "up")
    faces = visible_faces(floor, up, "none")
    at = {tuple(low[:2]): shade.tolist() for low, shade in zip(faces.low, faces.shade, strict=True)}
    # Corners in the order (west, north), (east, north), (east, south), (west, south).
    assert at[1, 1] == [0, 2, 2, 0]
    assert at[0, 1] == [0, 0, 0, 0]


def test_shade_is_that_of_a_brute_force_count() -> None:
    blocks = some_blocks(7, 0.4)
    solid = SOLID[blocks]
    for direction in DIRECTIONS:
        faces = visible_faces(blocks, direction, "none")
        for low, shade in zip(faces.low, faces.shade, strict=True):
            place = low + 1
            place[direction.axis] += direction.sign
            for corner, (s, t) in enumerate(((-1, -1), (1, -1), (1, 1), (-1, 1))):
                side = place.copy()
                other = place.copy()
                behind = place.copy()
                side[direction.along] += s
                other[direction.across] += t
                behind[direction.along] += s
                behind[direction.across] += t
                a, b, c = (bool(solid[tuple(each)]) for each in (side, other, behind))
                assert shade[corner] == (3 if a and b else a + b + c)


@pytest.mark.parametrize("merge", MERGES[:2])
def test_merging_changes_the_shade_of_no_face(merge: str) -> None:
    for seed in range(6):
        blocks = some_blocks(seed, 0.25, (1,))
        for direction in DIRECTIONS:
            units = visible_faces(blocks, direction, "none")
            shade = {
                tuple(low.tolist()): each for low, each in zip(units.low, units.shade, strict=True)
            }
            faces = visible_faces(blocks, direction, merge)
            for low, long, wide, corners in zip(
                faces.low, faces.long, faces.wide, faces.shade, strict=True
            ):
                grid = np.array([corners[0], corners[1], corners[3], corners[2]]).reshape(2, 2)
                for i, k in itertools.product(range(long), range(wide)):
                    place = low.copy()
                    place[direction.along] += i
                    place[direction.across] += k
                    # What OpenGL interpolates between the corners of the whole quad.
                    across, along = (np.array([k, k + 1]) / wide, np.array([i, i + 1]) / long)
                    rows = grid[0] + np.outer(across, grid[1].astype(float) - grid[0])
                    ends = rows[:, :1] + (rows[:, 1:] - rows[:, :1]) * along
                    expected = [ends[0, 0], ends[0, 1], ends[1, 1], ends[1, 0]]
                    assert shade[tuple(place.tolist())].tolist() == pytest.approx(expected)


def test_blocks_are_joined_by_eight_into_the_uppermost_that_is_solid() -> None:
    rng = np.random.default_rng(2)
    blocks = np.where(rng.random((6, 7, 5)) < 0.3, rng.choice((1, 3, 29), (6, 7, 5)), 0)
    found = halved(blocks.astype(np.uint8))
    assert found.shape == (3, 4, 3)
    for x, z, y in itertools.product(*map(range, found.shape)):
        cell = blocks[2 * x : 2 * x + 2, 2 * z : 2 * z + 2, 2 * y : 2 * y + 2]
        solid = [layer[SOLID[layer]] for layer in np.moveaxis(cell, 2, 0)[::-1]]
        highest = next((layer for layer in solid if len(layer)), np.array([0]))
        assert found[x, z, y] in highest


@pytest.mark.parametrize("size", (4, 5))
def test_a_distant_region_has_walls_where_its_neighbours_are_lower(size: int) -> None:
    blocks = np.zeros((2 * size, 2 * size, 8), np.uint8)
    blocks[:, :, :3] = block("rock")
    blocks[size + 1, 1, 3:6] = block("oak log")
    place = World(blocks, np.full((2 * size,) * 2, 3, np.int16), size, 1, 0.08)
    inner, origin = place.with_edge(2)  # x from size, z from 0
    mesh = distant_mesh(inner, origin, plain_look(2 * size), "rectangles")
    low, high = (getattr(mesh.vertices["position"], end)(axis=0) for end in ("min", "max"))
    wide = size + size % 2
    assert low[[0, 2]] == pytest.approx([size, 0], abs=0.02)
    assert high == pytest.approx([size + wide, 6, wide], abs=0.02)

    # Two blocks of the neighbours close each cell, but for the uppermost, with one block of land.
    # Cells that reach into a neighbour have walls down to the bottom.
    open_to = dict.fromkeys(("west", "south"), 2 if size % 2 == 0 else 0)
    lowest = dict(
        zip(
            [each.name for each in DIRECTIONS],
            (
                mesh.vertices["position"][ends - count : ends, 1].min() if count else None
                for ends, count in zip(
                    np.cumsum(mesh.counts.sum(axis=1)), mesh.counts.sum(axis=1), strict=True
                )
            ),
            strict=False,
        )
    )
    for name, height in open_to.items():
        assert lowest[name] == pytest.approx(height, abs=0.03)
    assert mesh.counts[PLANTS].sum() == 0


def plain_look(side: int) -> Look:
    return Look(np.ones((6, 4)), np.zeros((side + 1, side + 1), np.float32))


@pytest.mark.parametrize("merge", MERGES)
def test_quads_are_counter_clockwise_from_outside_and_as_large_as_their_faces(merge: str) -> None:
    blocks = some_blocks(3, 0.5, (1, 3))
    look = replace(plain_look(9), firm=OVERLAP)
    mesh = region_mesh(blocks, (0, 0, 0), look, merge)
    quads = mesh.vertices["position"].reshape(-1, 4, 3).astype(np.float64)
    way = np.repeat(np.arange(len(mesh.counts)), mesh.counts.sum(axis=1) // 4)
    edges = quads[:, 1] - quads[:, 0], quads[:, 2] - quads[:, 1]
    normals = np.cross(*edges)
    # x, z, y of a direction to x, y, z.
    axes = np.array([{0: 0, 1: 2, 2: 1}[each.axis] for each in DIRECTIONS])
    signs = np.array([each.sign for each in DIRECTIONS])
    along = normals[np.arange(len(quads)), axes[way]] * signs[way]
    sides = [np.linalg.norm(edge, axis=1) - 2 * OVERLAP for edge in edges]
    assert (along > 0).all()
    assert along == pytest.approx((sides[0] + 2 * OVERLAP) * (sides[1] + 2 * OVERLAP), rel=1e-4)
    faces = sum(len(brute_force(blocks, each.axis, each.sign)) for each in DIRECTIONS)
    assert (sides[0] * sides[1]).sum() == pytest.approx(faces, rel=1e-4)


@pytest.mark.parametrize("merge", MERGES)
def test_faces_that_look_up_overlap_more_where_blocks_lie_all_along_a_side(merge: str) -> None:
    wide = 0
    for seed in range(4):
        blocks = some_blocks(seed, 0.7, (1, 3))
        quads = region_mesh(blocks, (0, 0, 0), plain_look(9), merge).vertices.reshape(-1, 4)
        position = quads["position"]
        up = np.cross(position[:, 1] - position[:, 0], position[:, 2] - position[:, 1])[:, 1] > 0
        for corners in position[up]:
            ends = corners.min(axis=0), corners.max(axis=0)
            (x0, y, z0), (x1, _, z1) = (np.rint(end).astype(int).tolist() for end in ends)
            layer = SOLID[blocks[:, :, y]]  # blocks have an edge: this is the one below y
            west_east = layer[[x0, x1 + 1], z0 + 1 : z1 + 1]
            north_south = layer[x0 + 1 : x1 + 1, [z0, z1 + 1]].T
            for axis, beside in ((0, west_east), (2, north_south)):
                for end, firm, sign in zip(ends, beside.all(axis=1), (-1, 1), strict=True):
                    out = sign * (end[axis] - np.rint(end[axis]))
                    assert out == pytest.approx(FIRM if firm else OVERLAP, abs=1e-5)
                    wide += firm
    assert wide > 50


def test_a_tile_stands_upright_on_sides_and_is_repeated_once_a_block() -> None:
    blocks = np.zeros((6, 6, 6), np.uint8)
    blocks[1:5, 1:5, 1:5] = block("grass")
    mesh = region_mesh(blocks, (0, 0, 0), plain_look(6))
    tile = TILES.index("grass_side")
    vertices = mesh.vertices[: 4 * (mesh.counts[:2].sum() // 4)]  # east and west
    height, (s, t) = vertices["position"][:, 1], vertices["coordinate"].T
    # Row 0 of a tile is its upper edge, so t falls as y rises. Where a quad overlaps its neighbour
    # it does not show the opposite edge of the tile, which would be a line of earth above grass.
    assert (s == np.rint(vertices["position"][:, 2])).all()
    assert (t * ROWS == first_row(np.array(tile)) + 4 - np.rint(height)).all()
    assert not (height == np.rint(height)).any()


def test_a_merged_face_reads_its_own_tile_alone_in_every_mip_level() -> None:
    pictures = [np.full((SIDE, SIDE, 4), 10 + 10 * tile, np.uint8) for tile in range(len(TILES))]
    levels = mip_levels(column(pictures))[: SIDE.bit_length()]
    assert levels[-1].shape[:2] == (ROWS, 1)
    for tile in (0, 1, len(TILES) - 1):
        begin = float(first_row(np.array(tile)))
        for level in levels:
            # The texels that linear filtering reads, for t from one end to the other.
            ends = (np.array([begin, begin + WIDEST]) / ROWS) * len(level) - 0.5
            first, last = int(np.floor(ends[0])), int(np.ceil(ends[1]))
            assert (level[first : last + 1] == 10 + 10 * tile).all(), (tile, len(level))


def test_no_face_is_wider_than_its_tile_is_repeated() -> None:
    blocks = np.zeros((32, 32, 6), np.uint8)
    blocks[:, :, :3] = block("grass")
    quads = region_mesh(blocks, (0, 0, 0), plain_look(32)).vertices.reshape(-1, 4)
    rows = quads["coordinate"][..., 1] * ROWS - first_row(np.array(TILES.index("grass_top")))
    # On level ground the tile goes on where faces overlap.
    assert (rows.min(), rows.max()) == pytest.approx((-FIRM, WIDEST + FIRM), abs=1e-3)
    assert PLACES == WIDEST + 1


def test_faces_are_sorted_by_whether_they_are_under_water_and_then_from_the_highest_band() -> None:
    blocks = some_blocks(8, 0.5, (1, 3, 29))
    look = Look(np.ones((6, 4)), np.zeros((10, 10), np.float32), shore=(3, 5), band=1.0)
    mesh = region_mesh(blocks, (0, 0, 0), look)
    part = np.repeat(np.tile(np.arange(SETS), len(mesh.counts)), mesh.counts.ravel() // 4)
    height = mesh.vertices["position"][:, 1].reshape(-1, 4)
    low, high = height.min(axis=1) + OVERLAP, height.max(axis=1) - OVERLAP
    wet, dry = high <= 3.001, low >= 4.999
    lower = np.ceil(high - 5.01)  # bands begin at 5, where the highest one is the first
    dried = SETS - np.maximum(lower, 1)
    assert (part == np.where(dry, dried, np.where(wet, WET, SHORE))).all()
    assert all((part == each).any() for each in (WET, SHORE, SETS - 1, SETS - 2))


def test_plants_are_crossed_quads_and_hide_nothing() -> None:
    blocks = np.zeros((5, 5, 5), np.uint8)
    blocks[:, :, :2] = block("grass")
    bare = region_mesh(blocks, (0, 0, 0), plain_look(5))
    blocks[2, 2, 2] = block("poppy")
    planted = region_mesh(blocks, (0, 0, 0), plain_look(5))
    assert (planted.counts[:PLANTS] == bare.counts[:PLANTS]).all()
    assert planted.counts[PLANTS].sum() == 2 * 4


def test_regions_meshed_one_by_one_make_the_mesh_of_the_whole_map() -> None:
    rng = np.random.default_rng(5)
    blocks = np.where(rng.random((12, 12, 8)) < 0.5, 1, 0).astype(np.uint8)
    blocks[:, :, 0] = 1
    ground = np.ones((12, 12), np.int16)

    def area(region_size: int) -> float:
        place = World(blocks, ground, region_size, 2, 0.08)
        found = 0.0
        for region in range(place.regions**2):
            inner, origin = place.with_edge(region)
            mesh = region_mesh(inner, origin, plain_look(12), "none")
            found += len(mesh.vertices) / 4
        return found

    assert area(12) == area(4) == area(3)


def test_no_face_is_made_at_the_border_of_the_map_or_under_it() -> None:
    blocks = np.zeros((4, 4, 6), np.uint8)
    blocks[:, :, :2] = 1
    place = World(blocks, np.full((4, 4), 2, np.int16), 4, 1, 0.08)
    inner, origin = place.with_edge(0)
    mesh = region_mesh(inner, origin, plain_look(4), "none")
    per_direction = mesh.counts[:PLANTS].sum(axis=1) // 4
    assert dict(zip([each.name for each in DIRECTIONS], per_direction, strict=True)) == {
        "east": 0,
        "west": 0,
        "up": 16,
        "down": 0,
        "south": 0,
        "north": 0,
    }


def test_the_ground_under_a_plant_in_a_pit_is_drawn() -> None:
    blocks = np.zeros((4, 4, 6), np.uint8)
    blocks[:, :, :3] = block("rock")
    for kind in ("fern", "oak leaves"):
        blocks[1, 2, 2] = block(kind)
        place = World(blocks, np.full((4, 4), 3, np.int16), 4, 1, 0.08)
        faces = visible_faces(place.with_edge(0)[0], DIRECTIONS[2], "none")
        assert len(faces) == 16 + (kind == "oak leaves")


def test_heights_slopes_and_normals_of_a_plane_are_those_of_the_plane() -> None:
    x, z = np.meshgrid(np.arange(20) + 0.5, np.arange(20) + 0.5, indexing="ij")
    plane = Heights((3 + 0.5 * x - 0.25 * z).astype(np.float32))
    assert plane.height(7.3, 4.9) == pytest.approx(3 + 0.5 * 7.3 - 0.25 * 4.9, abs=1e-5)
    assert plane.gradient(7.3, 4.9) == pytest.approx((0.5, -0.25), abs=1e-5)
    normal = np.array([-0.5, 1.0, 0.25])
    assert plane.normal(7.3, 4.9) == pytest.approx(normal / np.linalg.norm(normal), abs=1e-5)
    assert plane.position(2.0, 3.0) == pytest.approx([2.0, 3.25, 3.0], abs=1e-5)
    assert plane.steepness == pytest.approx(np.full((20, 20), np.hypot(0.5, 0.25)), abs=1e-5)


def test_a_height_image_is_sampled_with_its_columns_east_and_its_rows_south() -> None:
    image = np.zeros((64, 64), np.float32)
    image[10:20, 40:60] = 128.0
    found = heights(image, 64, 256).field
    assert found[50, 15] == pytest.approx(128.0) and found[15, 50] == 0.0


def test_columns_are_filled_from_the_rock_up_to_their_top() -> None:
    tops = np.array([[3, 7]], np.int16)
    kinds = np.array([[block("sand"), block("grass")]], np.uint8)
    found = filled(tops, kinds, 10, np.zeros_like(tops))
    names = [[BLOCKS[each].name for each in column] for column in found[0]]
    assert names[0] == ["sand"] * 3 + ["air"] * 7
    assert names[1] == ["rock"] * 3 + ["earth"] * 3 + ["grass"] + ["air"] * 3


def test_layers_of_rock_lie_level_or_lower_by_as_many_blocks_as_they_are_shifted() -> None:
    tops, kinds = np.array([[20, 26, 26]], np.int16), np.full((1, 3), block("rock"), np.uint8)
    found = filled(tops, kinds, 30, np.array([[0, 0, 5]]))[0]
    assert len(np.unique(found[0, :20])) == 4
    assert (found[1, :20] == found[0, :20]).all()
    assert (found[2, :21] == found[1, 5:26]).all()


def test_rough_land_is_as_high_as_the_image_says_and_steep_land_has_ledges() -> None:
    x = np.arange(120, dtype=np.float32)[:, None] + np.zeros(120, np.float32)
    gentle, steep = Heights(0.3 * x), Heights(1.6 * x)
    assert abs(roughened(gentle).field - gentle.field).max() < 1.5
    ledges = roughened(steep)
    assert abs(ledges.field - steep.field).max() < 6.0
    assert (ledges.steepness < 0.9).mean() > 0.1 and (steep.steepness < 0.9).mean() == 0.0


def test_the_ground_is_sorted_by_height_and_then_by_slope() -> None:
    n = 200
    x = np.arange(n, dtype=np.float32)[:, None] + np.zeros(n, np.float32)
    gentle = Heights(np.maximum(x * 0.3 - 10, 0))  # 0 to 50 above a sea at 10
    kinds = top_materials(gentle, 10, np.random.default_rng(0))
    seen = [BLOCKS[kinds[i, 100]].name for i in (10, 70, 120, 199)]
    assert seen == ["gravel", "sand", "grass", "snow"]
    steep = Heights(x * 2.5)
    assert BLOCKS[top_materials(steep, 10, np.random.default_rng(0))[40, 100]].name == "rock"


@pytest.mark.seldom(3, first=1)
def test_materials_are_in_the_same_places_on_a_larger_and_on_a_higher_land() -> None:
    """Of a hill with a beach, meadows, cliffs and snow, whatever its columns and levels."""
    at = np.linspace(-1.0, 1.0, 256)
    away = np.hypot(at[:, None], at[None, :])
    image = 256.0 * (0.85 * np.clip(1.5 - away / 0.2, 0, 1) + 0.2 * np.clip(1.3 - away, 0, 1))
    shares = []
    for columns, levels in ((500, 96), (200, 96), (1000, 96), (200, 38), (1000, 192)):
        sea = round(10 * levels / 96)
        land = heights(image, columns, levels)
        kinds = top_materials(land, sea, np.random.default_rng(1))
        number = np.bincount(kinds[land.field > sea], minlength=len(BLOCKS))
        shares.append(number / number.sum())
    assert (shares[0] > 0.05).sum() >= 3
    for other in shares[1:]:
        assert np.abs(other - shares[0]).max() < 0.05


def test_large_regions_are_looked_through_in_slabs_that_miss_nothing(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    rng = np.random.default_rng(4)
    blocks = rng.choice([AIR, block("rock"), block("fern")], (9, 7, 6)).astype(np.uint8)
    whole, cells = shown_in(blocks), halved(blocks)
    for module in (faces, distant):
        monkeypatch.setattr(module, "AT_ONCE", 7 * 6 * 3)
    slabs = shown_in(blocks)
    assert (slabs.solid == SOLID[blocks]).all()
    for one, other in zip(whole.places, slabs.places, strict=True):
        assert len(one) and one.tolist() == other.tolist()
    assert (halved(blocks) == cells).all()


@pytest.mark.parametrize(("size", "merge"), [(6, "rectangles"), (5, "runs"), (1, "none")])
def test_regions_meshed_together_are_the_same_as_meshed_one_by_one(size: int, merge: str) -> None:
    rng = np.random.default_rng(3)
    kinds = [AIR, block("rock"), block("grass"), block("fern")]
    blocks = rng.choice(kinds, (2 * size, 4 * size, 9))
    blocks[:, :, :4] = block("rock")
    blocks = np.pad(blocks.astype(np.uint8), EDGE, mode="edge")
    look = plain_look(4 * size)
    together = region_meshes(blocks, size, (0, 0, 0), look, merge)
    distant = distant_meshes(blocks, size, (0, 0, 0), look, merge)
    assert len(together) == len(distant) == 8
    for k, found in enumerate(zip(together, distant, strict=True)):
        x, z = size * (k // 4), size * (k % 4)
        own = blocks[x : x + size + 2 * EDGE, z : z + size + 2 * EDGE]
        alone = (
            region_mesh(own, (x, z, 0), look, merge),
            distant_mesh(own, (x, z, 0), look, merge),
        )
        for mesh, other in zip(found, alone, strict=True):
            assert (mesh.counts == other.counts).all() and (mesh.vertices == other.vertices).all()
