"""View frustum culling: spheres and boxes against the frustum's planes. No OpenGL."""

import math
from collections.abc import Sequence

import numpy as np

from landscape.frame import Frame

# What to draw is chosen with a margin, and the choice is kept for several frames.
REUSE_DISTANCE = 0.06  # chosen: units the eye may move until a new choice is made
REUSE_ANGLE = math.radians(4.0)  # chosen: radians it may turn until then


def is_near(
    then: Frame, now: Frame, distance: float = REUSE_DISTANCE, angle: float = REUSE_ANGLE
) -> bool:
    """Return whether the eye has moved less than ``distance`` units since ``then``, or not at all.

    It must also have turned less than ``angle`` radians about any axis, with the same window, and
    sizes in pixels must count the same.
    """
    if (then.size, then.fov, then.pixels) != (now.size, now.fov, now.pixels):
        return False
    if then.pose == now.pose:
        return True
    # The trace of the rotation from one view to the other is 1 + 2 cos(angle).
    trace = float(then.axes @ now.axes)
    return math.dist(then.eye, now.eye) < distance and trace > 1.0 + 2.0 * math.cos(angle)


def in_view(frame: Frame, positions: np.ndarray, reach: np.ndarray) -> np.ndarray:
    """Return whether spheres at positions (n, 3) of radius ``reach`` (n,) meet the frustum, (n,).

    Its four sides go through the eye; near and far planes are left out.
    """
    sides = frame.frustum_planes.astype(positions.dtype).T
    within = sides @ (positions - frame.eye.astype(positions.dtype)).T
    lengths = np.sqrt((sides * sides).sum(axis=1))
    return np.asarray((within > -reach * lengths[:, None]).all(axis=0))


def ball_in_view(frame: Frame, middle: Sequence[float], reach: float) -> bool:
    """Return what in_view returns, for one sphere and without arrays: in a tenth of the time."""
    pose = frame.pose
    x = middle[0] - pose.x
    y = middle[1] - frame.eye_y
    z = middle[2] - pose.z
    return all(
        a * x + b * y + c * z > -reach * math.sqrt(a * a + b * b + c * c)
        for a, b, c in frame.frustum_rows
    )


def boxes_in_view(frame: Frame, middles: np.ndarray, halves: np.ndarray) -> np.ndarray:
    """Return a mask (n,) of the boxes, centres and half sides (n, 3), that the camera may see.

    A box is out of view when all its corners are outside the same plane of the frustum, that is,
    when the corner farthest along the plane's normal is.
    """
    sides = frame.frustum_planes.T
    within = sides @ (middles - frame.eye).T + np.abs(sides) @ halves.T
    return np.asarray((within >= 0.0).all(axis=0))
