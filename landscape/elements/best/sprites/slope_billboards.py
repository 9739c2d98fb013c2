"""The axes of billboards that stand upright (R4), or perpendicular to a slope, as deer do (R5).

The lesson's billboards are spanned by the camera's right and up (section 5.1.1), so they lean back
when the camera looks down. No OpenGL here.
"""

import numpy as np

STEEPEST = 0.7  # chosen: rise over run; a deer leans no farther


def upright_axes(right: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return right and up of billboards that turn about the y axis only."""
    level = np.array([right[0], 0.0, right[2]])
    return level / max(float(np.linalg.norm(level)), 1e-9), np.array([0.0, 1.0, 0.0])


def leaning(slopes: np.ndarray) -> np.ndarray:
    """Return slopes (n, 2) = dy/dx, dy/dz limited to STEEPEST, the most that a deer leans."""
    steep = np.hypot(slopes[:, 0], slopes[:, 1])
    return np.asarray(slopes * np.minimum(1.0, STEEPEST / np.maximum(steep, 1e-9))[:, None])


def slope_axes(right: np.ndarray, slopes: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return right and up, (n, 3) each, of billboards that are perpendicular to a slope.

    ``slopes`` (n, 2) = dy/dx, dy/dz. Right is the camera's, tilted into the slope; up is the
    slope's normal.
    """
    level, _ = upright_axes(right)
    across, up = np.empty((2, len(slopes), 3), slopes.dtype)
    across[:], across[:, 1] = level, slopes @ level[[0, 2]].astype(slopes.dtype)
    up[:, 0], up[:, 1], up[:, 2] = -slopes[:, 0], 1.0, -slopes[:, 1]
    for axes in (across, up):
        axes /= np.sqrt((axes * axes).sum(axis=1))[:, None]
    return across, up
