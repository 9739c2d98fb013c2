"""Which regions can be seen: their boxes against the view frustum, in two ways (TP2, part 2).

In world space a box is hidden if it lies wholly behind one plane of the frustum. In projected space
its eight corners are transformed to clip coordinates, and it is hidden if all of them lie beyond
the same side of the cube -w..w. Both ask the same question, and a test shows that they agree. The
second also works for any other projection, such as that of the shadow map.
"""

import numpy as np

# Which end of a box along x, y and z each of its eight corners takes.
CORNERS = np.array([[i >> 2 & 1, i >> 1 & 1, i & 1] for i in range(8)], np.float64)


# A point is in front of each of these when it is inside the clip cube -w..w.
SIDES = np.array([(sign * (k == 0), sign * (k == 1), sign * (k == 2), 1.0)
                  for k in range(3) for sign in (1.0, -1.0)])  # fmt: skip


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
