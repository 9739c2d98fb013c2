"""The vertices of the water: a grid that is even on the screen, and its ripples. No OpenGL.

Each vertex is where a line of sight meets the water (a projected grid, Johanson 2004): near the eye
the vertices are close together, and none is outside the view.
"""

import math

import numpy as np

from landscape.frame import Frame

COLUMNS, ROWS = 40, 30  # chosen
MARGIN = 1.04  # chosen: the grid is a little larger than the screen
# Ripples: direction in degrees, length in units, speed in lengths per 100 kt, slope. All chosen.
RIPPLES = (
    (17.0, 0.83, 5.0, 0.030),
    (71.0, 0.52, 6.5, 0.028),
    (133.0, 0.37, 8.0, 0.024),
    (-38.0, 0.29, 9.0, 0.022),
    (-97.0, 1.31, 4.0, 0.026),
)
DEEP = 1.2  # units, chosen: what is mirrored or refracted is taken to be this far from the surface


def water_grid(frame: Frame, level: float, far: float) -> np.ndarray | None:
    """Return points of the water at ``level``, float64 (rows, columns, 3), or None if none is seen.

    The first row is the farthest, ``far`` units in front of the eye where the water reaches so far.
    """
    top = math.tan(math.radians(frame.fov) / 2)
    side = top * frame.size[0] / frame.size[1]
    across = np.linspace(-MARGIN, MARGIN, COLUMNS) * side
    rise = np.linspace(MARGIN, -MARGIN, ROWS) * top
    height = frame.eye_y - level
    # A line of sight, back * -1 + right * across + up * rise, sinks by -(...).y per unit of depth.
    # Without roll ``right`` is level, so that a row of the screen sinks all alike.
    sink = frame.back[1] - rise * frame.up[1]
    if abs(frame.right[1]) > 1e-6:
        steepest = frame.back[1] - np.add.outer(rise * frame.up[1], across * frame.right[1])
        sink = steepest.min(axis=1)
    least = abs(height) / far
    seen = sink * np.sign(height) > least
    if not seen.any():
        return None
    if not seen.all():
        # The rows between the horizon and the edge of the screen. From above the horizon is at the
        # top of them, from below at their bottom.
        horizon = (frame.back[1] - np.sign(height) * least) / frame.up[1] if frame.up[1] else 0.0
        near = -MARGIN * top if (height > 0) == (frame.up[1] > 0) else MARGIN * top
        rise = np.linspace(horizon, near, ROWS)
    rays = -frame.back + across[None, :, None] * frame.right + rise[:, None, None] * frame.up
    depth = height / np.where(np.abs(rays[..., 1]) < 1e-9, -1e-9, -rays[..., 1])
    depth = np.where((depth < 0) | (depth > 4 * far), far, depth)
    points = frame.eye + rays * depth[..., None]
    points[..., 1] = level
    return points


def ripple_slopes(x: np.ndarray, z: np.ndarray, kt: float) -> np.ndarray:
    """Return the slopes (..., 2) along x and z of the ripples at x, z at time ``kt``."""
    found = np.zeros((*x.shape, 2))
    for degrees, length, speed, slope in RIPPLES:
        angle = math.radians(degrees)
        along = np.array([math.cos(angle), math.sin(angle)])
        phase = (x * along[0] + z * along[1]) / length + kt * speed / 100.0
        found += (slope * np.cos(2 * math.pi * phase))[..., None] * along
    return found


def disturbed(points: np.ndarray, kt: float, strength: float) -> np.ndarray:
    """Return points (..., 3) of the water moved to where its ripples let one see, in the plane."""
    found = points.copy()
    moved = strength * DEEP * ripple_slopes(points[..., 0], points[..., 2], kt)
    found[..., [0, 2]] += moved
    return found


def half_vectors(points: np.ndarray, eye: np.ndarray, sun: np.ndarray) -> np.ndarray:
    """Return the unit vectors (..., 3) half way between the sun and the eye, seen from points."""
    to_eye = eye - points
    to_eye /= np.linalg.norm(to_eye, axis=-1, keepdims=True)
    half = to_eye + sun
    return np.asarray(half / np.maximum(np.linalg.norm(half, axis=-1, keepdims=True), 1e-9))


def grid_quads() -> np.ndarray:
    """Return the indices, uint32 (m,), of the quads between the points of the grid."""
    index = np.arange(ROWS * COLUMNS, dtype=np.uint32).reshape(ROWS, COLUMNS)
    corners = index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:]
    return np.ascontiguousarray(np.stack(corners, axis=-1).reshape(-1))
