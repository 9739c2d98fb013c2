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
CALM_DEPTH = 0.5
CALM_DISTANCE = 1.6
CALM = 0.045
INDEX = 1.33  # the refractive index of water
FLATTEST = 0.2  # chosen: how little a refracted ray may sink per unit of its length
FADE = 4  # rows and columns at the screen's edges, beyond which there is no picture to look up


def screen_fade() -> np.ndarray:
    """Return 1 within the screen, falling to 0 at its edges, float32 (n,); not at its top."""
    columns, rows = np.arange(COLUMNS), np.arange(ROWS)
    sides = np.minimum(columns, COLUMNS - 1 - columns) / FADE
    found = np.minimum(np.minimum.outer((ROWS - 1 - rows) / FADE, sides), 1.0)
    return found.ravel().astype(np.float32)


DEGREES, LENGTHS, SPEEDS, SLOPES = np.array(RIPPLES).T
ALONG = np.stack([np.cos(np.radians(DEGREES)), np.sin(np.radians(DEGREES))])
WAVES = (ALONG / LENGTHS).astype(np.float32)  # of each ripple, lengths per unit along x and z
STEEPEST = (SLOPES * ALONG).T.astype(np.float32)
TURN = np.float32(2 * math.pi)
ON_SCREEN = screen_fade()
ACROSS, RISE = np.linspace(-MARGIN, MARGIN, COLUMNS), np.linspace(MARGIN, -MARGIN, ROWS)


def water_grid(frame: Frame, level: float, far: float) -> np.ndarray | None:
    """Return points of the water at ``level``, float32 (n, 3), or None if none is seen.

    They are row by row as on the screen, from the farthest row on, ``far`` units in front of the
    eye where the water reaches so far.
    """
    top = math.tan(math.radians(frame.fov) / 2)
    side = top * frame.size[0] / frame.size[1]
    across, rise = ACROSS * side, RISE * top
    height = frame.eye_y - level

    # A line of sight, back * -1 + right * across + up * rise, sinks by -(...).y per unit of depth.
    # Without roll ``right`` is level, so that a row of the screen sinks all alike.
    down, up = (float(axis[1]) for axis in (frame.back, frame.up))
    sink = down - rise * up
    if abs(frame.right[1]) > 1e-6:
        steepest = down - np.add.outer(rise * up, across * frame.right[1])
        sink = steepest.min(axis=1)
    least, side_of_it = abs(height) / far, float(np.sign(height))
    seen = sink * side_of_it > least
    if not seen.any():
        return None
    if not seen.all():
        # The rows between the horizon and the edge of the screen. From above the horizon is at the
        # top of them, from below at their bottom.
        horizon = (down - side_of_it * least) / up if up else 0.0
        near = -MARGIN * top if (height > 0) == (up > 0) else MARGIN * top
        rise = horizon + (near - horizon) * np.arange(ROWS) / (ROWS - 1)

    rays = (frame.up * rise[:, None] - frame.back)[:, None] + frame.right * across[:, None]
    rays = rays.reshape(-1, 3).astype(np.float32)
    sink = rays[:, 1] * -side_of_it
    sink[sink < least / 4] = least  # what does not meet the water in front of the eye
    points = rays * (abs(height) / sink)[:, None] + frame.eye.astype(np.float32)
    points[:, 1] = level
    return points


def ripple_slopes(points: np.ndarray, kt: float) -> np.ndarray:
    """Return the slopes, float32 (n, 2), along x and z of the ripples at points (n, 3)."""
    # Whole lengths are left out before 32 bits are too few for them.
    begun = (kt * SPEEDS / 100.0 % 1.0).astype(np.float32)
    phase = points[:, ::2] @ WAVES + begun
    return np.asarray(np.cos(TURN * phase) @ STEEPEST)


def disturbed(
    points: np.ndarray, away: np.ndarray, depth: np.ndarray, kt: float, strength: float
) -> np.ndarray:
    """Return points (n, 3) of the water moved to where its ripples let one see.

    They stay in its plane. ``away`` (n,) is how far they are from the eye, and ``depth`` (n,) that
    of the water there, in units.
    """
    reach = np.minimum(np.minimum(PER_DISTANCE * away, PER_DEPTH * depth), DEEP)
    reach = np.maximum(reach, 0.0) * ON_SCREEN * strength
    found = points.copy()
    found[:, ::2] += reach[:, None] * ripple_slopes(points, kt)
    return found


def refracted(
    points: np.ndarray,
    ways: np.ndarray,
    away: np.ndarray,
    depth: np.ndarray,
    kt: float,
    strength: float,
) -> np.ndarray:
    """Return where lines of sight that the ripples refract meet the bed, float32 (n, 3).

    Walter's model (Walter et al. 2007, equation 40): a ray from the eye is refracted by Snell's law
    at the normal of the ripple that it meets. ``ways`` (n, 3) lead from the eye to points (n, 3),
    and are ``away`` (n,) long. The bed is taken to be level there, ``depth`` (n,) under the point.
    """
    slopes = strength * ripple_slopes(points, kt) * ON_SCREEN[:, None]
    normal = np.stack([-slopes[:, 0], np.ones(len(points), np.float32), -slopes[:, 1]], axis=1)
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    incident = -ways / away[:, None]
    cosine = np.einsum("ij,ij->i", incident, normal)
    ratio = 1.0 / INDEX
    along = ratio * cosine - np.sqrt(1.0 + ratio**2 * (cosine**2 - 1.0))
    ray = along[:, None] * normal - ratio * incident
    gone = np.maximum(depth, 0.0) / np.maximum(-ray[:, 1], FLATTEST)
    return np.asarray(points + gone[:, None] * ray, np.float32)


def half_vectors(ways: np.ndarray, away: np.ndarray, sun: np.ndarray) -> np.ndarray:
    """Return the unit vectors (n, 3) half way between the sun and the eye, seen from points.

    ``ways`` (n, 3) lead from the eye to the points, and ``away`` (n,) is how long they are.
    """
    half = sun - ways / away[:, None]
    # The square of the length of a sum of two unit vectors.
    length = 2.0 * (half @ sun)
    return np.asarray(half / np.sqrt(np.maximum(length, 1e-9))[:, None])


def calmed(half: np.ndarray, away: np.ndarray, depth: np.ndarray) -> np.ndarray:
    """Return half vectors (n, 3) a little shorter where fewer glints are wanted.

    So no ripple's product with them gets as large. ``away`` and ``depth`` (n,) are as for
    :func:`disturbed`.
    """
    wild = np.minimum(depth * (1.0 / CALM_DEPTH), away * (1.0 / CALM_DISTANCE))
    calm = 1.0 - np.minimum(np.maximum(wild, 0.0), 1.0)
    return np.asarray(half * (1.0 - CALM * calm)[:, None])


def grid_quads() -> np.ndarray:
    """Return the indices, uint32 (m,), of the quads between the points of the grid."""
    index = np.arange(ROWS * COLUMNS, dtype=np.uint32).reshape(ROWS, COLUMNS)
    corners = index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:]
    return np.ascontiguousarray(np.stack(corners, axis=-1).reshape(-1))
