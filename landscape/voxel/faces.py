"""The faces of blocks that can be seen, found with numpy: no loop goes over blocks.

A face is exposed where the block is solid and its neighbour is not. Its corners are darker where
other blocks stand around them (ambient occlusion). Equal faces side by side are merged: into runs
along a row, and equal runs of following rows into rectangles.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from landscape.voxel.blocks import SOLID, block


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
LONGEST = 16  # blocks, chosen: longer quads would interpolate the tint over too much land


@dataclass(frozen=True)
class Faces:
    """Rectangles of faces that look in one direction, all arrays of (m,) or (m, 4).

    ``low`` (m, 3) is the corner block [x, z, y] in the region; ``long`` and ``wide`` are the sides
    in blocks along and across. ``shade`` holds how many blocks darken each corner, 0..3, in the
    order (0, 0), (1, 0), (1, 1), (0, 1) of along and across.
    """

    direction: Direction
    low: np.ndarray
    long: np.ndarray
    wide: np.ndarray
    block: np.ndarray
    shade: np.ndarray

    def __len__(self) -> int:
        return len(self.block)


def exposed(solid: np.ndarray, direction: Direction) -> np.ndarray:
    """Return which blocks show a face in a direction, bool, without the edge of ``solid``."""
    inner = tuple(slice(EDGE, -EDGE) for _ in range(3))
    beyond = list(inner)
    start = EDGE + direction.sign
    beyond[direction.axis] = slice(start, solid.shape[direction.axis] - EDGE + direction.sign)
    return np.asarray(solid[inner] & ~solid[tuple(beyond)])


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
    corners = ((left, below, -s - t), (right, below, s - t), (right, above, s + t),
               (left, above, t - s))  # fmt: skip
    for k, (side, other, step) in enumerate(corners):
        found[:, k] = side + other + (flat[at + step] | (side & other))
    return found


def visible_faces(
    blocks: np.ndarray, direction: Direction, merge: str = "rectangles", occlusion: bool = True
) -> Faces:
    """Return the faces that blocks [x, z, y], uint8 with an edge all around, show in a direction.

    ``merge`` is "rectangles", "runs" or "none".
    """
    solid = SOLID[blocks]
    shown = exposed(solid, direction)
    order = (direction.axis, direction.across, direction.along)
    place = np.nonzero(shown.transpose(order))  # rows along the last axis, one after the other
    low = np.empty((len(place[0]), 3), np.intp)
    for axis, values in zip(order, place, strict=True):
        low[:, axis] = values
    steps = np.array(blocks.strides)
    flat = (low + EDGE) @ steps
    kinds = shown_kinds(blocks, flat, direction)
    if occlusion:
        in_front = flat + direction.sign * steps[direction.axis]
        shade = corner_shade(solid, in_front, direction)
    else:
        shade = np.zeros((len(low), 4), np.uint8)
    ones = np.ones(len(low), np.intp)
    faces = Faces(direction, low, ones, ones, kinds, shade)
    if merge != "none":
        faces = merged(faces, direction.along, direction.across, (0, 1, 3, 2))
    if merge == "rectangles":
        faces = merged(faces, direction.across, direction.along, (0, 3, 1, 2))
    return faces


def merged(faces: Faces, axis: int, other: int, pairs: tuple[int, int, int, int]) -> Faces:
    """Join equal faces that follow each other along ``axis``, and are as wide along ``other``.

    Faces may only be joined where their shade does not change along the axis: where the corners
    ``pairs``, first and second, third and fourth, have the same shade.
    """
    grows = axis == faces.direction.along
    wide = faces.wide if grows else faces.long
    a, b, c, d = (faces.shade[:, k].astype(np.int64) for k in pairs)
    even = (a == b) & (c == d)
    # Everything that must be equal in one number, and then the place along the axis.
    same = faces.low[:, faces.direction.axis].astype(np.int64) << 12 | faces.low[:, other]
    same = ((same << 8 | faces.block) << 10 | wide) << 8 | a << 6 | b << 4 | c << 2 | d
    at = faces.low[:, axis]
    order = np.lexsort((at, same))
    same, at, even = same[order], at[order], even[order]
    starts = np.ones(len(order), bool)
    starts[1:] = (same[1:] != same[:-1]) | (at[1:] != at[:-1] + 1) | ~even[1:]
    starts |= _every(starts, LONGEST)
    first = np.flatnonzero(starts)
    count = np.diff(first, append=len(order))
    chosen = order[first]
    long, across = (count, faces.wide[chosen]) if grows else (faces.long[chosen], count)
    return Faces(
        faces.direction,
        faces.low[chosen],
        long,
        across,
        faces.block[chosen],
        faces.shade[chosen],
    )


def _every(starts: np.ndarray, longest: int) -> np.ndarray:
    """Return where a run that begins at ``starts`` must be cut, to be at most ``longest`` long."""
    at = np.arange(len(starts))
    begin = np.maximum.accumulate(np.where(starts, at, 0))
    return np.asarray((at - begin) % longest == 0)
