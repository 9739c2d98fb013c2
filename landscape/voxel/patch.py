"""A region's mesh after a block has changed: only what lies around it is meshed again.

To mesh a whole region takes longer than a frame may. But a block decides only about the faces of
the blocks that touch it, be it at a corner: whether they can be seen, and how dark their corners
are. So the 3 x 3 x 3 blocks around it are cut out of all quads, and the faces that they show now
are put in one by one. The test compares the result with the mesh of the whole region.
"""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from landscape.voxel.blocks import DENSITY
from landscape.voxel.faces import (
    DIRECTIONS,
    EDGE,
    Direction,
    Faces,
    corner_shade,
    exposed,
    shown_kinds,
    with_firm_sides,
)
from landscape.voxel.mesh import (
    PLANTS,
    SETS,
    Look,
    Part,
    RegionMesh,
    assembled,
    part_of,
    part_of_plants,
    plant_places,
    plant_quads,
)
from landscape.voxel.world import World

X_Z_Y = [0, 2, 1]
Corner = list[int]  # [x, z, y]


class Rectangle(NamedTuple):
    """Faces that look in one direction, of the blocks from ``low`` to ``high``."""

    low: Corner
    high: Corner


def touched(
    mesh: RegionMesh, key: np.ndarray, low: Corner, high: Corner
) -> tuple[np.ndarray, list[list[Rectangle]]]:
    """Return which quads (m,) cover blocks of the box from ``low`` to ``high``.

    Also, per direction, which blocks' faces those are. ``key`` (m,) is the index in TURNS of each
    quad times the number of sets, plus its set.
    """
    position = mesh.vertices["position"]
    one, other = position[0::4], position[2::4]  # corners that face each other

    def overlaps(axis: int, which: np.ndarray | slice) -> np.ndarray:
        a, b = one[which, X_Z_Y[axis]], other[which, X_Z_Y[axis]]
        return np.asarray(
            (np.minimum(a, b) < high[axis] + 0.5) & (np.maximum(a, b) > low[axis] - 0.5)
        )

    near = np.flatnonzero(overlaps(0, slice(None)))
    for axis in (1, 2):  # each axis leaves far fewer quads for the next
        near = near[overlaps(axis, near)]

    ends = one[near][:, X_Z_Y], other[near][:, X_Z_Y]
    least, most = np.minimum(*ends), np.maximum(*ends)
    found = np.zeros(len(key), bool)
    rectangles: list[list[Rectangle]] = [[] for _ in DIRECTIONS]
    for n, m in enumerate(near.tolist()):
        turn = int(key[m]) // SETS
        if turn == PLANTS:
            # It is not in the middle of its block, but its middle is in the block.
            begin = np.floor((least[n] + most[n]) / 2).astype(int).tolist()
            end = [at + 1 for at in begin]
        else:
            direction = DIRECTIONS[turn]
            begin, end = (np.rint(each[n]).astype(int).tolist() for each in (least, most))
            begin[direction.axis] -= direction.sign > 0
            end[direction.axis] = begin[direction.axis] + 1
        if all(begin[a] < high[a] and end[a] > low[a] for a in range(3)):
            found[m] = True
            if turn != PLANTS:
                rectangles[turn].append(Rectangle(begin, end))

    return found, rectangles


def remainders(
    whole: Rectangle, low: Corner, high: Corner, direction: Direction
) -> Iterator[Rectangle]:
    """Yield the up to four rectangles that are left of one when a box is cut out of it."""
    begin, end = list(whole.low), list(whole.high)
    for axis in (direction.across, direction.along):
        if begin[axis] < low[axis]:
            yield Rectangle(list(begin), [*end[:axis], low[axis], *end[axis + 1 :]])
            begin[axis] = low[axis]
        if end[axis] > high[axis]:
            yield Rectangle([*begin[:axis], high[axis], *begin[axis + 1 :]], list(end))
            end[axis] = high[axis]


def faces_again(
    world: World, low: Corner, high: Corner, rectangles: list[list[Rectangle]], occlusion: bool
) -> tuple[list[Faces], Corner]:
    """Return the faces, per direction, that are put in again, and the place they are counted from.

    They are those that the blocks from ``low`` to ``high`` show, and what is left of rectangles.
    """
    every = [each for some in rectangles for each in some]
    place = [min([low[a], *(each.low[a] for each in every)]) for a in range(3)]
    end = [max([high[a], *(each.high[a] for each in every)]) for a in range(3)]
    blocks = world.around(place, end)
    density = DENSITY[blocks]
    solid = density > 0
    steps = np.array(blocks.strides)
    around = tuple(slice(low[a] - place[a], high[a] - place[a] + 2 * EDGE) for a in range(3))
    found = []
    for some, direction in zip(rectangles, DIRECTIONS, strict=True):
        left = [part for each in some for part in remainders(each, low, high, direction)]
        shown = np.argwhere(exposed(density[around], direction)) + np.array(low)
        at = np.concatenate([shown, np.array([part.low for part in left], np.intp).reshape(-1, 3)])
        at -= np.array(place)
        sides = np.ones((len(at), 3), np.intp)
        for part, row in zip(left, sides[len(shown) :], strict=True):
            row[:] = np.array(part.high) - np.array(part.low)
        flat = (at + EDGE) @ steps
        shade = np.zeros((len(at), 4), np.uint8)
        if occlusion:  # along a rectangle it does not change, so its first block has all of it
            shade = corner_shade(solid, flat + direction.sign * steps[direction.axis], direction)
        kinds = shown_kinds(blocks, flat, direction)
        sizes = sides[:, direction.along], sides[:, direction.across]
        faces = Faces(direction, at, *sizes, kinds, shade)
        found.append(with_firm_sides(faces, solid))

    return found, place


def regions_around(world: World, low: Sequence[int], high: Sequence[int]) -> set[int]:
    """Return the regions whose meshes change with the blocks from ``low`` to ``high`` [x, z, y]."""
    last = world.side - 1
    xs, zs = ([max(low[a] - 1, 0), min(high[a], last)] for a in (0, 1))
    return {world.region_of(x, z) for x in xs for z in zs}


def patched(
    mesh: RegionMesh,
    world: World,
    region: int,
    low: Sequence[int],
    high: Sequence[int],
    look: Look,
    occlusion: bool = True,
    plants: bool = True,
) -> RegionMesh:
    """Return the mesh of a region after blocks from ``low`` to ``high`` [x, z, y] have changed.

    The box is a few blocks large, less than a region on each side.
    """
    first = *world.region_columns(region), 0
    size = world.region_size, world.region_size, world.blocks.shape[2]
    low = [max(at - 1, a) for at, a in zip(low, first, strict=True)]
    high = [min(at + 1, a + b) for at, a, b in zip(high, first, size, strict=True)]
    key = np.repeat(np.arange(mesh.counts.size, dtype=np.int16), mesh.counts.ravel() // 4)
    out, rectangles = touched(mesh, key, low, high)
    found, place = faces_again(world, low, high, rectangles, occlusion)
    origin = place[0], place[1], place[2]
    parts = [Part(mesh.vertices.reshape(-1, 4)[~out], key[~out])]
    parts += [part_of(faces, 0, origin, look) for faces in found if len(faces)]
    if plants:
        parts.append(_plants_again(world, low, high, look))
    return assembled(parts, 1)[0]


def _plants_again(world: World, low: Sequence[int], high: Sequence[int], look: Look) -> Part:
    """Return the plants from ``low`` to ``high`` [x, z, y]."""
    blocks = world.blocks[tuple(slice(*ends) for ends in zip(low, high, strict=True))]
    crossed = plant_quads(blocks, plant_places(blocks), (low[0], low[1], low[2]), look)
    return part_of_plants(crossed, 0, look)
