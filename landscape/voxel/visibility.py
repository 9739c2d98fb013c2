"""Which regions can be seen: their boxes against the view frustum (TP2, part 2).

The document asks in two directions. In projected space a region's eight corners are transformed to
clip coordinates, and it is hidden if all of them lie beyond the same side of the cube -w..w. In
world space the box around the frustum's eight corners is compared with the region's: if the two do
not meet, the region is hidden. Each finds some that the other misses: a region beyond an edge of
the frustum is beyond no single side of it, but may be beside its box.
The six planes of the frustum in world space ask what the corners ask in projected space, with the
same answers (a test compares them) and less work, so that they are the default.
Switch: ``voxel.visibility``.
"""

from collections.abc import Callable

import numpy as np

# Which end of a box along x, y and z each of its eight corners takes.
CORNERS = np.array([[i >> 2 & 1, i >> 1 & 1, i & 1] for i in range(8)], np.float64)


# A point is in front of each of these when it is inside the clip cube -w..w.
SIDES = np.array(
    [
        (sign * (k == 0), sign * (k == 1), sign * (k == 2), 1.0)
        for k in range(3)
        for sign in (1.0, -1.0)
    ]
)


def frustum_planes(matrix: np.ndarray) -> np.ndarray:
    """Return the six planes (6, 4) of a projection times modelview matrix, looking inwards.

    ``matrix`` (4, 4) transforms column vectors. A point p is inside where plane . (p, 1) >= 0
    (Gribb and Hartmann 2001).
    """
    return np.asarray(SIDES @ matrix)


def visible_in_world(low: np.ndarray, high: np.ndarray, matrix: np.ndarray) -> np.ndarray:
    """Return which boxes from ``low`` to ``high`` (n, 3) are not behind one plane of a frustum."""
    planes = frustum_planes(matrix)
    normals, offsets = planes[:, :3], planes[:, 3:]
    # Of each box only the corner that is farthest along the plane's normal counts.
    within = np.maximum(normals, 0) @ high.T + np.minimum(normals, 0) @ low.T + offsets
    return np.asarray(within.min(axis=0) >= 0)


def visible_projected(low: np.ndarray, high: np.ndarray, matrix: np.ndarray) -> np.ndarray:
    """Return the same by the corners of the boxes in clip space."""
    corners = low[:, None] + CORNERS * (high - low)[:, None]  # (n, 8, 3)
    x, y, z, w = np.moveaxis(corners @ matrix[:, :3].T + matrix[:, 3], -1, 0)
    outside = np.stack([x < -w, x > w, y < -w, y > w, z < -w, z > w])
    return ~np.asarray(outside.all(axis=2).any(axis=0))


def frustum_box(matrix: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the least and the greatest corner (3,) of the box around a frustum."""
    corners = np.c_[2.0 * CORNERS - 1.0, np.ones(8)] @ np.linalg.inv(matrix).T
    places = corners[:, :3] / corners[:, 3:]
    return places.min(axis=0), places.max(axis=0)


def meets_frustum_box(low: np.ndarray, high: np.ndarray, matrix: np.ndarray) -> np.ndarray:
    """Return which boxes from ``low`` to ``high`` (n, 3) meet the box around a frustum."""
    least, greatest = frustum_box(matrix)
    return np.asarray(((low <= greatest) & (high >= least)).all(axis=1))


def visible_both_ways(low: np.ndarray, high: np.ndarray, matrix: np.ndarray) -> np.ndarray:
    """Return which boxes neither of the document's two directions finds to be hidden."""
    return visible_projected(low, high, matrix) & meets_frustum_box(low, high, matrix)


Test = Callable[[np.ndarray, np.ndarray, np.ndarray], np.ndarray]
TESTS: dict[str, Test] = {
    "planes": visible_in_world,
    "projected": visible_projected,
    "boxes": meets_frustum_box,
    "two-way": visible_both_ways,
}
"""What ``voxel.visibility`` chooses from."""


def distances(low: np.ndarray, high: np.ndarray, eye: np.ndarray) -> np.ndarray:
    """Return how far the eye (3,) is from boxes (n, 3), 0 within."""
    at = eye[:, None]
    gap = np.maximum(np.maximum(low.T - at, at - high.T), 0.0)
    return np.asarray(np.sqrt((gap * gap).sum(axis=0)))


def facing(low: np.ndarray, high: np.ndarray, eye: np.ndarray) -> np.ndarray:
    """Return in which directions the eye may see faces of boxes, (n, 6) in order of DIRECTIONS.

    A face that looks east can only be seen from east of it, so not from west of the whole box.
    """
    found = np.empty((len(low), 3, 2), bool)
    np.greater(eye, low, out=found[:, :, 0])  # east, up, south
    np.less(eye, high, out=found[:, :, 1])  # west, down, north
    return found.reshape(-1, 6)
