"""The axes of billboards that face the eye's place, stand upright (R4), or follow a slope (R5).

The lesson's billboards are spanned by the camera's right and up (section 5.1.1), so they lean back
when the camera looks down, and those close by turn with the camera when it turns on the spot
(section 11.2.1). No OpenGL here.
"""

import numpy as np

from landscape.frame import Frame

OVERHEAD = 1e-6  # units: nearer than this to the vertical through the eye
STEEPEST = 0.7  # chosen: rise over run; a deer leans no farther


def upright_axes(right: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return right and up of billboards that turn about the y axis only."""
    level = np.array([right[0], 0.0, right[2]])
    return level / max(float(np.linalg.norm(level)), 1e-9), np.array([0.0, 1.0, 0.0])


def place_axes(frame: Frame, points: np.ndarray, upright: bool) -> tuple[np.ndarray, np.ndarray]:
    """Return right and up, (n, 3) each, of billboards at ``points`` (n, 3) that face the eye.

    They are perpendicular to the line from the eye to them, so they stay as they are while the
    camera turns on the spot. ``upright`` ones turn about the y axis only, and their up is one for
    all, (3,).
    """
    line = points - frame.faced_eye.astype(points.dtype)
    right = np.zeros_like(line)
    far = np.hypot(line[:, 0], line[:, 2])
    # Straight above or below the eye no direction is the one to the side: take the camera's.
    overhead = far < OVERHEAD
    right[:, 0], right[:, 2] = -line[:, 2], line[:, 0]
    right /= np.maximum(far, OVERHEAD)[:, None]
    right[overhead] = upright_axes(frame.right)[0]
    if upright:
        return right, np.array([0.0, 1.0, 0.0], points.dtype)
    up = np.cross(right, line)
    return right, up / np.maximum(np.linalg.norm(up, axis=1), OVERHEAD)[:, None]


def leaning(slopes: np.ndarray) -> np.ndarray:
    """Return slopes (n, 2) = dy/dx, dy/dz limited to STEEPEST, the most that a deer leans."""
    steep = np.hypot(slopes[:, 0], slopes[:, 1])
    return np.asarray(slopes * np.minimum(1.0, STEEPEST / np.maximum(steep, 1e-9))[:, None])


def slope_axes(right: np.ndarray, slopes: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return right and up, (n, 3) each, of billboards that are perpendicular to a slope.

    ``slopes`` (n, 2) = dy/dx, dy/dz. Right is the billboards' own (n, 3), or the camera's (3,),
    tilted into the slope; up is the slope's normal.
    """
    level = right if right.ndim == 2 else upright_axes(right)[0][None]
    across, up = np.empty((2, len(slopes), 3), slopes.dtype)
    across[:] = level
    across[:, 1] = (slopes * across[:, ::2]).sum(axis=1)
    up[:, 0], up[:, 1], up[:, 2] = -slopes[:, 0], 1.0, -slopes[:, 1]
    for axes in (across, up):
        axes /= np.sqrt((axes * axes).sum(axis=1))[:, None]
    return across, up
