"""Which ground each pixel shows: all columns of the screen are walked front to back at once.

A column of a picture taken level is a vertical plane. Along it the ground's height is looked up at
growing distances; a step is seen where it is projected higher than all steps before it, and fills
the column from there down to what is filled already. In arrays of (steps, columns): one running
minimum of the projected rows says what is seen, and one running minimum down the rows of the
screen says which step fills each pixel. No loop runs over steps, columns or pixels.
"""

from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise

import numpy as np

from landscape.flyover.height_field import HeightField

NOTHING = -1e9  # the height of what is not there
FINEST = 0.125  # the shortest step, pixels of the height image, chosen
TOGETHER = 24  # steps walked together: their arrays fit into the processor's cache, chosen


@dataclass(frozen=True)
class Steps:
    """Distances (s,) at which the ground is looked up, and from which level of its heights.

    ``runs`` are (first step, last step + 1, level); ``blend`` (s,) is how much of the next coarser
    level is mixed in.
    """

    distances: np.ndarray
    runs: tuple[tuple[int, int, int], ...]
    blend: np.ndarray


@lru_cache(maxsize=4)
def steps(
    near: float, far: float, growth: float, longest: float, levels: int, unit: float
) -> Steps:
    """Return steps from ``near`` to ``far`` that grow by ``growth`` of the distance each.

    Close by they are not shorter than FINEST; in the middle they are not longer than ``longest``
    units until ``growth / 2`` is longer still.
    """
    at, found = near, [near]
    while at < far or len(found) < 2:
        at += max(min(growth * at, longest), 0.5 * growth * at, FINEST * unit)
        found.append(at)
    distances = np.array(found, np.float32)
    wanted = np.log2(np.gradient(distances) / unit) - 1
    wanted = np.clip(wanted, 0, levels - 1) if levels > 1 else np.zeros(len(distances))
    level = np.minimum(wanted.astype(int), max(levels - 2, 0))
    blend = np.clip((wanted - level - 0.5) * 2, 0, 1).astype(np.float32)
    edges = [0, *(np.flatnonzero(np.diff(level)) + 1).tolist(), len(level)]
    runs = tuple(
        (first, min(first + TOGETHER, end), int(level[begin]))
        for begin, end in pairwise(edges)
        for first in range(begin, end, TOGETHER)
    )
    return Steps(distances, runs, blend)


def looked_up(level: np.ndarray, u: np.ndarray, v: np.ndarray, bilinear: bool) -> np.ndarray:
    """Return heights of a level at u, v in 0..1 along its columns and rows."""
    width, flat = len(level), level.ravel()
    x, y = u * np.float32(width - 1), v * np.float32(width - 1)
    if not bilinear:
        near = (y + np.float32(0.5)).astype(np.int32) * width
        return flat.take(near + (x + np.float32(0.5)).astype(np.int32), mode="clip")
    left, top = np.floor(x), np.floor(y)
    x -= left
    y -= top
    at = top.astype(np.int32)
    at *= width
    at += left.astype(np.int32)

    # On the last row or column the next vertex is another one, or none, and has no weight.
    upper = flat.take(at, mode="clip")
    at += 1
    right = flat.take(at, mode="clip")
    right -= upper
    right *= x
    upper += right
    at += width
    right = flat.take(at, mode="clip")
    at -= 1
    lower = flat.take(at, mode="clip")
    right -= lower
    right *= x
    lower += right
    lower -= upper
    lower *= y
    upper += lower
    return upper


def folded(x: np.ndarray) -> np.ndarray:
    """Return coordinates, in periods of two sides of the field, folded into 0..1 of a side.

    They go there and back again. ``x`` is overwritten.
    """
    x -= np.rint(x)
    np.abs(x, out=x)
    x += x
    return x


def walk(
    field: HeightField,
    path: Steps,
    eye: tuple[float, float, float],
    directions: np.ndarray,
    sea: float,
    bilinear: bool,
    mirror: bool,
    out: np.ndarray,
) -> None:
    """Write heights above the eye into ``out`` (steps, columns).

    ``directions`` (2, columns) are x and y per unit of distance. Without ``mirror`` there is
    nothing outside the field.
    """
    period = 2 * field.size
    start = [np.float32(each / period % 1 if mirror else each / period) for each in eye[:2]]
    for first, last, level in path.runs:
        away = path.distances[first:last, None] * np.float32(1 / period)
        u, v = (away * along for along in directions)
        u += start[0]
        v += start[1]
        outside = None if mirror else (np.abs(u - 0.25) > 0.25) | (np.abs(v - 0.25) > 0.25)
        u, v = folded(u), folded(v)
        found = looked_up(field.levels[level], u, v, bilinear)
        blend = path.blend[first:last]
        some = int(np.argmax(blend > 0)) if blend.any() else last - first
        if some < last - first:
            coarse = looked_up(field.levels[level + 1], u[some:], v[some:], bilinear)
            coarse -= found[some:]
            coarse *= blend[some:, None]
            found[some:] += coarse

        np.maximum(found, np.float32(sea), out=found)
        if outside is not None:
            found[outside] = NOTHING
        np.subtract(found, np.float32(eye[2]), out=out[first:last])


def filled_by(tops: np.ndarray, height: int) -> np.ndarray:
    """Return which step fills each pixel, int16 (height, columns); the number of steps for none.

    ``tops`` (steps, columns) are rows on the screen, as floats. They are overwritten.
    """
    count, columns = tops.shape
    np.maximum(tops, 0, out=tops)
    np.minimum(tops, height, out=tops)
    highest = np.ceil(tops, out=tops).astype(np.int16)

    # In place and row by row: several times as fast as minimum.accumulate along columns.
    for before, after in pairwise(highest):
        np.minimum(before, after, out=after)
    seen = np.empty(highest.shape, bool)
    np.less(highest[0], height, out=seen[0])
    np.less(highest[1:], highest[:-1], out=seen[1:])
    where = np.flatnonzero(seen)
    step = where // columns
    target = highest.ravel().take(where).astype(np.int64)
    target -= step
    target *= columns
    target += where
    filled = np.full((height, columns), count, np.int16)
    filled.ravel()[target] = step
    for above, below in pairwise(filled):
        np.minimum(above, below, out=below)
    return filled
