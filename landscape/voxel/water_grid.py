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
# What is mirrored or refracted is taken to be this far from the surface, in units: at most DEEP,
# and less near the shore and near the eye, where so much would smear it. All chosen.
DEEP = 1.2
PER_DEPTH = 2.5  # times the depth of the water
PER_DISTANCE = 0.22  # times the distance from the eye
# Glints are dim in less water, and nearer to the eye, than this many units: they would be large
# spots. How much shorter half vectors are there; all chosen.
CALM_DEPTH, CALM_DISTANCE, CALM = 0.5, 1.6, 0.045
FADE = 4  # rows and columns at the screen's edges, beyond which there is no picture to look up


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
    degrees, length, speed, slope = np.array(RIPPLES).T
    angle = np.radians(degrees)
    along = np.stack([np.cos(angle), np.sin(angle)])
    # Whole lengths are left out before 32 bits are too few for them.
    begun = (kt * speed / 100.0) % 1.0
    phase = np.stack([x, z], axis=-1) @ (along / length) + begun
    return np.asarray(
        (slope * np.cos(np.float32(2 * math.pi) * phase.astype(np.float32))) @ along.T
    )


def screen_fade() -> np.ndarray:
    """Return 1 within the screen, falling to 0 at its edges, (rows, columns); not at its top."""
    columns, rows = np.arange(COLUMNS), np.arange(ROWS)
    sides = np.minimum(columns, COLUMNS - 1 - columns) / FADE
    return np.minimum(np.minimum.outer((ROWS - 1 - rows) / FADE, sides), 1.0)


def disturbed(
    points: np.ndarray, eye: np.ndarray, depth: np.ndarray, kt: float, strength: float
) -> np.ndarray:
    """Return points (rows, columns, 3) of the water moved to where its ripples let one see.

    They stay in its plane. ``depth`` (rows, columns) is that of the water at the points, in units.
    """
    far = np.minimum(PER_DISTANCE * np.linalg.norm(points - eye, axis=-1), PER_DEPTH * depth)
    reach = strength * np.clip(far, 0.0, DEEP) * screen_fade()
    found = points.copy()
    slopes = ripple_slopes(points[..., 0], points[..., 2], kt)
    found[..., [0, 2]] += reach[..., None] * slopes
    return found


def half_vectors(points: np.ndarray, eye: np.ndarray, sun: np.ndarray) -> np.ndarray:
    """Return the unit vectors (..., 3) half way between the sun and the eye, seen from points."""
    to_eye = eye - points
    to_eye /= np.linalg.norm(to_eye, axis=-1, keepdims=True)
    half = to_eye + sun
    return np.asarray(half / np.maximum(np.linalg.norm(half, axis=-1, keepdims=True), 1e-9))


def calmed(half: np.ndarray, points: np.ndarray, eye: np.ndarray, depth: np.ndarray) -> np.ndarray:
    """Return half vectors (n, 3) a little shorter where fewer glints are wanted.

    So no ripple's product with them gets as large. ``depth`` (n,) is that of the water, in units.
    """
    far = np.linalg.norm(points - eye, axis=-1) / CALM_DISTANCE
    wild = np.clip(np.minimum(depth / CALM_DEPTH, far), 0.0, 1.0)
    return np.asarray(half * (1.0 - CALM * (1.0 - wild))[..., None])


def grid_quads() -> np.ndarray:
    """Return the indices, uint32 (m,), of the quads between the points of the grid."""
    index = np.arange(ROWS * COLUMNS, dtype=np.uint32).reshape(ROWS, COLUMNS)
    corners = index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:]
    return np.ascontiguousarray(np.stack(corners, axis=-1).reshape(-1))
