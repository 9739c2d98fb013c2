"""The faces of blocks that can be seen, found with numpy: no loop goes over blocks.

A face is exposed where the block is denser than its neighbour: where one is solid and the other
air, or the other is of leaves, which have holes. Its corners are darker where other blocks stand
around them (ambient occlusion). Equal faces side by side are merged: into runs along a row, and
equal runs of following rows into rectangles.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from landscape.voxel.blocks import DENSITY, block, looked_up


class Direction(NamedTuple):
    """A direction a face looks in, with the axes 0 x, 1 z, 2 y of the block array.

    ``along`` is the axis across which runs go, which is texture s; ``across`` is texture t. Seen
    from outside, a face's corners go around counter-clockwise in the order (0, 0), (1, 0), (1, 1),
    (0, 1) of along and across if not ``swapped``, and the other way round if it is.
    """

    name: str
    axis: int
    sign: int
    along: int
    across: int
    swapped: bool


# x east, z south, y up.
DIRECTIONS = (
    Direction("east", 0, 1, 1, 2, True),
    Direction("west", 0, -1, 1, 2, False),
    Direction("up", 2, 1, 0, 1, True),
    Direction("down", 2, -1, 0, 1, False),
    Direction("south", 1, 1, 0, 2, False),
    Direction("north", 1, -1, 0, 2, True),
)
EDGE = 1  # blocks around a region that must be known: neighbours of its outermost blocks
GRASS, TURF = block("grass"), block("turf")
AT_ONCE = 1 << 22  # blocks, chosen: as many are looked through at once
LONGEST = 16  # blocks, chosen: longer quads would interpolate the tint over too much land


@dataclass(frozen=True)
class Faces:
    """Rectangles of faces that look in one direction, all arrays of (m,) or (m, 4).

    ``low`` (m, 3) is the corner block [x, z, y] in the region; ``long`` and ``wide`` are the sides
    in blocks along and across. ``shade`` holds how many blocks darken each corner, 0..3, in the
    order (0, 0), (1, 0), (1, 1), (0, 1) of along and across. ``thick`` is how many blocks lie
    between them and those that look the other way. ``firm`` (m, 4) says whether there are blocks
    all along the sides at the low and the high end along, and at both ends across.
    """

    direction: Direction
    low: np.ndarray
    long: np.ndarray
    wide: np.ndarray
    block: np.ndarray
    shade: np.ndarray
    thick: int = 1
    firm: np.ndarray | None = None

    def __len__(self) -> int:
        return len(self.block)


def exposed(density: np.ndarray, direction: Direction) -> np.ndarray:
    """Return which blocks show a face in a direction, bool, without the edge of ``density``."""
    inner = tuple(slice(EDGE, -EDGE) for _ in range(3))
    beyond = list(inner)
    start = EDGE + direction.sign
    beyond[direction.axis] = slice(start, density.shape[direction.axis] - EDGE + direction.sign)
    return np.asarray(density[inner] > density[tuple(beyond)])


def shown_kinds(blocks: np.ndarray, at: np.ndarray, direction: Direction) -> np.ndarray:
    """Return the blocks (m,) that faces are drawn as; ``at`` (m,) are their flat indices.

    Where grass goes down a step of one block its side is overgrown. Sides of earth would draw
    contour lines on every gentle hill.
    """
    steps, flat = np.array(blocks.strides), blocks.ravel()
    found = flat[at]
    if direction.axis != 2:
        foot = at + direction.sign * steps[direction.axis] - steps[2]
        found[(found == GRASS) & (flat[foot] == GRASS)] = TURF
    return np.asarray(found)


def corner_shade(solid: np.ndarray, at: np.ndarray, direction: Direction) -> np.ndarray:
    """Return how many blocks darken each corner of faces, uint8 (m, 4).

    ``at`` holds the flat indices in ``solid`` of the empty cells in front of the faces. A corner
    between two side blocks is as dark as it gets, whatever stands behind them.
    """
    steps = np.array(solid.strides) // solid.itemsize
    flat = solid.ravel().view(np.uint8)
    s, t = steps[direction.along], steps[direction.across]
    left, right, below, above = (flat[at + step] for step in (-s, s, -t, t))
    found = np.empty((len(at), 4), np.uint8)
    corners = (
        (left, below, -s - t),
        (right, below, s - t),
        (right, above, s + t),
        (left, above, t - s),
    )
    for k, (side, other, step) in enumerate(corners):
        found[:, k] = side + other + (flat[at + step] | (side & other))
    return found


def firm_sides(solid: np.ndarray, faces: Faces) -> np.ndarray:
    """Return whether there are blocks all along each side of faces, bool (m, 4).

    They are in the order of ``Faces.firm``. A face goes on there, or ends at a wall.
    """
    direction, flat = faces.direction, solid.ravel()
    steps = np.array(solid.strides) // solid.itemsize
    first = (faces.low + EDGE) @ steps
    found = np.ones((len(faces), 4), bool)
    sides = (direction.along, faces.long), (direction.across, faces.wide)
    for pair, ((axis, size), (other, length)) in enumerate((sides, sides[::-1])):
        step = steps[other]
        for end, start in enumerate((first - steps[axis], first + steps[axis] * size)):
            firm = found[:, 2 * pair + end]
            for k in range(int(length.max(initial=0))):
                rows = np.flatnonzero(firm & (length > k))
                firm[rows] = flat[start[rows] + k * step]
    return found


def with_firm_sides(faces: Faces, solid: np.ndarray) -> Faces:
    """Return faces that know their firm sides, if they look up: others need not."""
    up = faces.direction.axis == 2 and faces.direction.sign > 0
    return replace(faces, firm=firm_sides(solid, faces)) if up else faces


class Shown(NamedTuple):
    """Which blocks are solid, with an edge all around, and which of them show a face.

    ``places`` are flat indices, in an array (m,) for each of DIRECTIONS.
    """

    solid: np.ndarray
    places: list[np.ndarray]


def shown_in(blocks: np.ndarray) -> Shown:
    """Return which of blocks [x, z, y], uint8 with an edge all around, show a face."""
    whole = looked_up(DENSITY, blocks)
    steps = whole.strides
    inner = tuple(slice(EDGE, -EDGE) for _ in range(3))
    found: list[list[np.ndarray]] = [[] for _ in DIRECTIONS]
    many = max(1, AT_ONCE // steps[0])
    for start in range(0, len(whole) - 2 * EDGE, many):
        density = whole[start : start + many + 2 * EDGE]
        within = np.zeros_like(density)
        within[inner] = density[inner]
        within, density = within.ravel(), density.ravel()
        for places, direction in zip(found, DIRECTIONS, strict=True):
            # Nothing at an edge is within, so a neighbour one step on never lies beyond the array.
            step, first = steps[direction.axis], start * steps[0]
            if direction.sign > 0:
                places.append(np.flatnonzero(within[:-step] > density[step:]) + first)
            else:
                places.append(np.flatnonzero(within[step:] > density[:-step]) + (first + step))

    return Shown(whole > 0, [np.concatenate(places) for places in found])


Parts = Sequence[tuple[np.ndarray, int]]


def visible_faces(
    blocks: np.ndarray,
    direction: Direction,
    merge: str = "rectangles",
    occlusion: bool = True,
    shown: Shown | None = None,
    region_size: int = 0,
    widest: int = LONGEST,
) -> Faces:
    """Return the faces that blocks [x, z, y], uint8 with an edge all around, show in a direction.

    ``merge`` is "rectangles", "runs" or "none". ``shown`` is what :func:`shown_in` returns, if that
    is known. If the blocks are those of several regions, side by side along x and z,
    ``region_size`` says how many columns they are wide; no face goes over from one to the next. No
    rectangle is more than ``widest`` blocks wide.
    """
    blocks = np.ascontiguousarray(blocks)
    shown = shown or shown_in(blocks)
    at = shown.places[DIRECTIONS.index(direction)]
    kinds = shown_kinds(blocks, at, direction)
    shade = np.zeros(len(at), np.uint8)
    if occlusion:
        step = blocks.strides[direction.axis]
        shade = packed(corner_shade(shown.solid, at + direction.sign * step, direction))
    low = np.stack(np.unravel_index(at, blocks.shape)) - EDGE
    along, across = low[direction.along], low[direction.across]
    long = wide = np.ones(len(at), np.intp)

    # A face is one number, of which the last 12 bits are its place along: sorted, faces follow each
    # other that may be joined, and the difference of two says whether they are alike.
    if merge != "none":
        parts: Parts = (
            (low[direction.axis], 12),
            (across, 12),
            (kinds, 8),
            (shade, 8),
            (along, 12),
        )
        key, long = joined(parts, EVEN_ALONG, region_size)  # along is x or z
        layer, across, kinds, shade, along = split(key, parts)
        low = rows(direction, layer, along, across)
        wide = np.ones(len(key), np.intp)

    if merge == "rectangles":
        parts = ((layer, 12), (along, 12), (long, 5), (kinds, 8), (shade, 8), (across, 12))
        key, wide = joined(parts, EVEN_ACROSS, 0 if direction.across == 2 else region_size, widest)
        layer, along, long, kinds, shade, across = split(key, parts)
        low = rows(direction, layer, along, across)

    corners = shade[:, None] >> np.array([6, 4, 2, 0], np.uint8) & 3
    found = Faces(direction, low.T, long, wide, kinds.astype(np.uint8), corners.astype(np.uint8))
    return with_firm_sides(found, shown.solid)


def packed(shade: np.ndarray) -> np.ndarray:
    """Return the shade of four corners, uint8 (m, 4), in one number each, uint8 (m,)."""
    one, two, three, four = shade.T
    return np.asarray(one << 6 | two << 4 | three << 2 | four)


def rows(
    direction: Direction, layer: np.ndarray, along: np.ndarray, across: np.ndarray
) -> np.ndarray:
    """Return places (3, m), x, z and y, from those along the axes of a direction."""
    found = np.empty((3, len(layer)), np.intp)
    found[direction.axis], found[direction.along], found[direction.across] = layer, along, across
    return found


def split(key: np.ndarray, parts: Parts) -> list[np.ndarray]:
    """Return what numbers (m,) are made of: the parts, each with its number of bits."""
    found = []
    for _, bits in reversed(parts):
        found.append(key & ((1 << bits) - 1))
        key = key >> bits
    return found[::-1]


def joined(
    parts: Parts, even: np.ndarray, size: int = 0, longest: int = LONGEST
) -> tuple[np.ndarray, np.ndarray]:
    """Join equal faces that follow each other in the last of the parts; the shade is before it.

    Return the number of each run's first face, and how many it joins. Only faces whose shade does
    not change from one to the next may be joined: ``even`` (256,) says of which this is so. At
    multiples of ``size`` runs end, and after ``longest`` faces.
    """
    key = np.zeros(len(parts[0][0]), np.int64)
    for values, bits in parts:
        key <<= bits
        key |= values
    key.sort()
    starts = np.ones(len(key), bool)
    shade = key[1:] >> parts[-1][1] & 255
    starts[1:] = (key[1:] != key[:-1] + 1) | ~even[shade]
    if size:
        starts |= (key & ((1 << parts[-1][1]) - 1)) % size == 0
    first = np.flatnonzero(starts)
    count = np.diff(first, append=len(key))

    # A run that is too long is cut into pieces.
    pieces = (count + (longest - 1)) // longest
    many = np.repeat(np.arange(len(first)), pieces)
    before = longest * (np.arange(len(many)) - (np.cumsum(pieces) - pieces)[many])
    return key[first[many] + before], np.minimum(count[many] - before, longest)


# By the packed shade: whether it is the same at both ends along, or across.
_CORNERS = np.arange(256)[:, None] >> np.array([6, 4, 2, 0]) & 3
EVEN_ALONG = (_CORNERS[:, [0, 3]] == _CORNERS[:, [1, 2]]).all(axis=1)
EVEN_ACROSS = (_CORNERS[:, [0, 1]] == _CORNERS[:, [3, 2]]).all(axis=1)
