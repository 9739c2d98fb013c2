"""Clipping: lines that cannot be seen are dropped, and those that pass the near plane are cut.

The view volume is bounded by planes. A line is off the screen if both of its ends are on the outer
side of one of them: each vertex gets a code with one bit for each plane, as Cohen and Sutherland
do, and a line is dropped if the codes of its ends have a bit in common. The projection divides by
x, the distance along the line of sight (section 2.1 warns of zero), so a line with one end nearer
than the near plane is cut there. At the screen's edges nothing is cut: see :mod:`.bresenham`.
"""

from dataclasses import dataclass, fields

import numpy as np

from landscape.flyover.camera import Frustum, Points, project
from landscape.flyover.edges import Edges

NEAR, FAR, LEFT, RIGHT, TOP, BOTTOM, *WALLS = (1 << bit for bit in range(8))
NO_WALLS = np.zeros((0, 3))
# Chosen: a rounded end may be up to a pixel away from where it was, and so may the line's pixels.
MARGIN = 2.0


@dataclass(frozen=True)
class Lines:
    """Lines on the screen's plane, (n,) each: their ends, as vertices and as pixels.

    ``a`` and ``b`` are the vertices at their ends. ``x0``, ``y0``, ``x1``, ``y1`` are int64 pixels,
    which may be off the screen. ``depth0`` and ``depth1`` are the distances of the ends along the
    line of sight, in units, cut at the near plane.
    """

    a: np.ndarray
    b: np.ndarray
    x0: np.ndarray
    y0: np.ndarray
    x1: np.ndarray
    y1: np.ndarray
    depth0: np.ndarray
    depth1: np.ndarray

    def __getitem__(self, which: np.ndarray) -> "Lines":
        """Return some of the lines."""
        return Lines(*(getattr(self, each.name)[which] for each in fields(self)))


def planes(volume: Frustum, size: tuple[int, int]) -> np.ndarray:
    """Return the six planes of the view volume, (6, 4), in the camera's frame of reference.

    A point (x, y, z) is outside the one of bit i where ``row i @ (x, y, z, 1) < 0``. The sides are
    MARGIN pixels outside the screen's.
    """
    width, height = size
    beside = MARGIN * (volume.right - volume.left) / width
    above = MARGIN * (volume.top - volume.bottom) / height
    near = volume.near
    return np.array(
        [
            (1, 0, 0, -near),
            (-1, 0, 0, volume.far),
            (beside - volume.left, near, 0, 0),
            (beside + volume.right, -near, 0, 0),
            (above + volume.top, 0, -near, 0),
            (above - volume.bottom, 0, near, 0),
        ]
    )


def codes(
    points: Points, volume: Frustum, size: tuple[int, int], walls: np.ndarray = NO_WALLS
) -> np.ndarray:
    """Return the code, uint8, of each point in the camera's frame: the planes that it is outside.

    Points have any shape. ``walls`` (n, 3) are up to two more planes, through the eye: a point p is
    outside the one where ``row @ p < 0``.
    """
    x, y, z = points
    across, up = y * volume.near, z * volume.near
    _near, _far, left, right, top, bottom = planes(volume, size)[:, 0]
    outside = (
        (x < volume.near, NEAR),
        (x > volume.far, FAR),
        (x * left < -across, LEFT),
        (x * right < across, RIGHT),
        (x * top < up, TOP),
        (x * bottom < -up, BOTTOM),
    )
    code = np.zeros(np.shape(x), np.uint8)
    for beyond, bit in outside:
        code |= beyond.view(np.uint8) * np.uint8(bit)
    for wall, bit in zip(walls, WALLS, strict=False):
        beyond = x * wall[0] + y * wall[1] + z * wall[2] < 0
        code |= beyond.view(np.uint8) * np.uint8(bit)
    return code


def projected(points: Points, edges: Edges, volume: Frustum, size: tuple[int, int]) -> Lines:
    """Return edges between points (m,) in the camera's frame as lines.

    Edges must reach beyond the near plane; those that begin nearer are cut there. Those that fade
    are shorter by the part that is missing.
    """
    x, y, z = points
    a, b = edges.a, edges.b
    in_front = np.maximum(x, volume.near)
    column, row = project(in_front, y, z, volume, size)
    ends = [[column[a], row[a], in_front[a]], [column[b], row[b], in_front[b]]]
    for (column, row, _depth), from_, to in ((ends[0], a, b), (ends[1], b, a)):
        at = np.flatnonzero(x[from_] < volume.near)
        inside, outside = to[at], from_[at]
        part = (volume.near - x[inside]) / (x[outside] - x[inside])
        cut_y = y[inside] + part * (y[outside] - y[inside])
        cut_z = z[inside] + part * (z[outside] - z[inside])
        near = np.full(len(at), volume.near)
        column[at], row[at] = project(near, cut_y, cut_z, volume, size)

    if edges.fading is not None:
        shorten(ends[0], ends[1], edges.fading)
        shorten(ends[1], ends[0], -edges.fading)
    (x0, y0, depth0), (x1, y1, depth1) = ends
    return Lines(a, b, x0, y0, x1, y1, depth0, depth1)


def joined(parts: list[Lines]) -> Lines:
    """Return all lines of some parts; their vertices ``a`` and ``b`` are those of each part."""
    names = [field.name for field in fields(Lines)]
    return Lines(*(np.concatenate([getattr(part, name) for part in parts]) for name in names))


def shorten(stays: list[np.ndarray], goes: list[np.ndarray], missing: np.ndarray) -> None:
    """Move lines' ends towards their other ends, where ``missing`` (n,), a part of them, is > 0.

    Ends are columns, rows and depths, (n,) each.
    """
    at = np.flatnonzero(missing > 0)
    part = missing[at]
    for end, other in zip(goes[:2], stays[:2], strict=True):
        end[at] += np.rint((other[at] - end[at]) * part).astype(np.int64)
    # It is the inverse depth that changes evenly on the screen.
    goes[2][at] = 1 / ((1 - part) / goes[2][at] + part / stays[2][at])
