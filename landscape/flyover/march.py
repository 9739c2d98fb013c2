"""Which ground each pixel shows: all columns of the screen are walked front to back at once.

A column of a picture taken level is a vertical plane. Along it the ground's height is looked up at
growing distances; a step is seen where it is projected higher than all steps before it, and fills
the column from there down to what is filled already. In arrays of (steps, columns): one running
minimum of the projected rows says what is seen, and one running minimum down the rows of the
screen says which step fills each pixel. No loop runs over steps, columns or pixels.
"""

from dataclasses import dataclass

import numpy as np

from landscape.flyover.height_field import HeightField

NOTHING = -1e9  # the height of what is not there
FINEST = 0.125  # the shortest step, pixels of the height image, chosen
BLOCK = 128  # columns walked together: their arrays fit into the processor's cache, chosen


@dataclass(frozen=True)
class Steps:
    """Distances (s,) at which the ground is looked up, and from which level of its heights.

    ``runs`` are (first step, last step + 1, level); ``blend`` (s,) is how much of the next coarser
    level is mixed in.
    """

    distances: np.ndarray
    runs: tuple[tuple[int, int, int], ...]
    blend: np.ndarray


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
    runs = tuple((a, b, int(level[a])) for a, b in zip(edges[:-1], edges[1:], strict=True))
    return Steps(distances, runs, blend)


def looked_up(level: np.ndarray, u: np.ndarray, v: np.ndarray, bilinear: bool) -> np.ndarray:
    """Return heights of a level at u, v in 0..1 along its columns and rows."""
    n = np.float32(len(level) - 1)
    x, y = u * n, v * n
    width, flat = len(level), level.ravel()
    if not bilinear:
        near = (y + np.float32(0.5)).astype(np.int64) * width
        return flat.take(near + (x + np.float32(0.5)).astype(np.int64), mode="clip")
    column, row = x.astype(np.int64), y.astype(np.int64)
    np.minimum(column, width - 2, out=column)
    np.minimum(row, width - 2, out=row)
    x -= column
    y -= row
    row *= width
    row += column
    top, below = flat.take(row, mode="clip"), flat.take(row + width, mode="clip")
    right = flat.take(row + 1, mode="clip")
    right -= top
    right *= x
    top += right
    right = flat.take(row + (width + 1), mode="clip")
    right -= below
    right *= x
    below += right
    below -= top
    below *= y
    top += below
    return top


def mirrored(x: np.ndarray) -> np.ndarray:
    """Return coordinates in sides of the field, folded into 0..1: there and back again."""
    x = x - 2 * np.floor(x * np.float32(0.5))
    x -= 1
    np.abs(x, out=x)
    np.subtract(1, x, out=x)
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
    side = field.size
    start = [np.float32(each / side % 2) if mirror else np.float32(each / side) for each in eye[:2]]
    for first, last, level in path.runs:
        away = path.distances[first:last, None] * np.float32(1 / side)
        u, v = (at + away * along for at, along in zip(start, directions, strict=True))
        outside = None if mirror else (np.abs(u - 0.5) > 0.5) | (np.abs(v - 0.5) > 0.5)
        u, v = mirrored(u), mirrored(v)
        found = looked_up(field.levels[level], u, v, bilinear)
        blend = path.blend[first:last]
        some = int(np.argmax(blend > 0)) if blend.any() else last - first
        if some < last - first:
            coarse = looked_up(field.levels[level + 1], u[some:], v[some:], bilinear)
            found[some:] += (coarse - found[some:]) * blend[some:, None]
        np.maximum(found, np.float32(sea), out=found)
        if outside is not None:
            found[outside] = NOTHING
        np.subtract(found, np.float32(eye[2]), out=out[first:last])


def filled_by(tops: np.ndarray, height: int) -> np.ndarray:
    """Return which step fills each pixel, int16 (height, columns); the number of steps for none.

    ``tops`` (steps, columns) are rows on the screen, as floats.
    """
    count, columns = tops.shape
    rows = np.ceil(np.clip(tops, 0, height)).astype(np.int16)
    highest = np.minimum.accumulate(rows, axis=0)
    seen = np.empty(highest.shape, bool)
    np.less(highest[0], height, out=seen[0])
    np.less(highest[1:], highest[:-1], out=seen[1:])
    where = np.flatnonzero(seen)
    step = where // columns
    target = highest.ravel()[where].astype(np.int64) * columns + (where - step * columns)
    filled = np.full((height + 1) * columns, count, np.int16)
    filled[target] = step
    return np.minimum.accumulate(filled.reshape(height + 1, columns)[:height], axis=0)
