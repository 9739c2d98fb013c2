"""The sea's waves as arrays: heights, slopes, normals, and how they move the mirror image.

No OpenGL here. The sea is a sum of sine waves: the height of one is a sine of its phase, its slope
the cosine. Long waves lift the surface; all of them tilt it.
"""

import numpy as np

from landscape.elements.best.sea.eye_grid import EyeGrid

FRESNEL_POWER = 3.6  # chosen: Schlick has 5, but a rough sea mirrors strongly at steeper angles
CLEARED = 0.94  # chosen: fraction of its opacity that the water loses at a grazing angle

# Chosen: waves as length in units, direction in radians (the wind blows to 0.5), and slope.
WAVES = np.array(
    [
        (2.30, 0.35, 0.022),
        (1.45, 0.90, 0.024),
        (0.95, 0.05, 0.026),
        (0.64, 1.35, 0.026),
        (0.43, -0.45, 0.030),
        (0.29, 0.75, 0.030),
        (0.20, 2.00, 0.028),
        (0.135, -0.15, 0.026),
        (0.092, 1.10, 0.024),
        (0.061, -1.00, 0.024),
        (0.041, 0.55, 0.024),
        (0.028, -0.60, 0.024),
    ]
)
LENGTHS, STEEP = (WAVES[:, column].astype(np.float32)[:, None] for column in (0, 2))
NUMBERS = 2 * np.pi / WAVES[:, 0]  # wave numbers, radians per unit
HEADINGS = np.stack([np.cos(WAVES[:, 1]), np.sin(WAVES[:, 1])]).astype(np.float32)  # x and z
ALONG_X, ALONG_Z = (NUMBERS * HEADINGS).astype(np.float32)[..., None, None]  # radians per unit
PHASES = 1.7 * np.arange(len(WAVES))  # chosen: radians at t = 0, so that no two crests coincide
FREQUENCIES = 1.3 * np.sqrt(NUMBERS)  # radians per t: deep-water waves; 1.3 is chosen
RELIEF_FROM = 0.4  # chosen: units, shorter waves tilt the surface but do not lift it
LIFTING = int((WAVES[:, 0] >= RELIEF_FROM).sum())  # the longest come first
DAMPED = 0.02  # chosen: fraction of its slope below which a wave is left out
MIRRORED = 0.6  # chosen: fraction of a ripple's tilt that moves the mirror image; 1 is a rough sea
FOLD = 0.6  # chosen: how far one wave may compress the mirror image; at 1 it would begin to fold
CALM = 0.8  # chosen: how far towards the horizon a ripple may move the image, as a fraction
ROUGH = 0.2  # chosen: slope towards the eye of the facets that one sees of the far sea
ROUGH_FROM = 14.0  # chosen: units away at which half of that is reached


def opacity(cosine: np.ndarray, alpha: float) -> np.ndarray:
    """Return the water's opacity over the mirror image, by the cosine of the angle of view.

    ``alpha`` straight down; at a grazing angle a third of it, so that the mirror image dominates.
    """
    return alpha * (1.0 - CLEARED * (1.0 - cosine) ** FRESNEL_POWER)


def change_of_opacity(grid: EyeGrid, cosine: np.ndarray, alpha: float) -> np.ndarray:
    """Return by how much a slope of 1 towards the eye would change the opacity, (rows, columns)."""
    change = CLEARED * FRESNEL_POWER * alpha * (1.0 - cosine) ** (FRESNEL_POWER - 1.0)
    return np.asarray(change * (grid.ring[:, None] / grid.sight))


def damped_slopes(cell: np.ndarray) -> np.ndarray:
    """Return each wave's slope in each row, float32 (waves, rows).

    ``cell`` (rows,) is the distance to the next row: a wave too short for it is damped, as it would
    alias. This is why the far sea is calm.
    """
    # Within float32 from an eye of any height; a wave is left out long before.
    ratio = np.minimum(2.0 / LENGTHS * cell, 1e6)
    slopes = STEEP / (1.0 + np.square(np.square(ratio)))
    slopes[slopes < DAMPED * STEEP] = 0.0
    return slopes


def unfolded(grid: EyeGrid) -> np.ndarray:
    """Return the fraction of each wave's tilt that moves the mirror image, float32 (waves, rows).

    Seen at a grazing angle the rows of the grid lie far apart, and the image, moved by a short wave
    as far as a mirror would move it, folds over itself again and again: the eye sees a smear. Moved
    so far at a few vertices it breaks up into ovals; so the movement is kept below a fold.
    """
    # By how much a wave moves the image, per radian of depression: slope x wave number x r^2 / h.
    steps = np.square(grid.sight[:, 0]) / np.float32(grid.height)
    folds = 2.0 * MIRRORED * STEEP * NUMBERS.astype(np.float32)[:, None] * steps
    return np.asarray(FOLD / np.maximum(folds, FOLD), np.float32)


def waves(
    x: np.ndarray,
    z: np.ndarray,
    cell: np.ndarray,
    t: float,
    moved: np.ndarray | None = None,
) -> tuple[np.ndarray, ...]:
    """Return height and slopes along x and z, float32 (rows, columns), of the sea at time ``t``.

    ``x`` and ``z`` (rows, columns) are places in units, ``cell`` (rows,) the distance to the next
    row. The same as :func:`waves_one_by_one`, with all waves in one array: a quarter of the NumPy
    calls. ``moved`` (waves, rows) adds two more arrays: the sums of the slopes times these factors.
    """
    slope = damped_slopes(cell)[..., None]

    # Reduced to one turn before the sum: float32 has too few digits for a large t.
    turns = (PHASES - FREQUENCIES * t) % (2 * np.pi)
    phase = x * ALONG_X + (z * ALONG_Z + turns.astype(np.float32)[:, None, None])
    tilts = np.cos(phase) * slope
    slopes = [*(HEADINGS @ tilts.reshape(len(WAVES), -1)).reshape(2, *x.shape)]
    if moved is not None:
        tilts *= moved[..., None]
        slopes += [*(HEADINGS @ tilts.reshape(len(WAVES), -1)).reshape(2, *x.shape)]
    lengths = (np.float32(1.0) / NUMBERS[:LIFTING]).astype(np.float32)
    height = lengths @ (np.sin(phase[:LIFTING]) * slope[:LIFTING]).reshape(LIFTING, -1)
    return height.reshape(x.shape), *slopes


def waves_one_by_one(
    x: np.ndarray, z: np.ndarray, cell: np.ndarray, t: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return what :func:`waves` does, float64: the same sum, written out."""
    height, slope_x, slope_z = np.zeros((3, *x.shape))
    for k, slope in enumerate(damped_slopes(cell)):
        east, south = HEADINGS[:, k]
        phase = NUMBERS[k] * (x * east + z * south) + PHASES[k] - FREQUENCIES[k] * t
        slope_x += slope[:, None] * east * np.cos(phase)
        slope_z += slope[:, None] * south * np.cos(phase)
        if k < LIFTING:
            height += slope[:, None] / NUMBERS[k] * np.sin(phase)
    return height, slope_x, slope_z


def surface_normals(slope_x: np.ndarray, slope_z: np.ndarray) -> np.ndarray:
    """Return the unit normals, float32 (n, 3), of a surface with these slopes, any shape."""
    length = 1.0 / np.sqrt(1.0 + np.square(slope_x) + np.square(slope_z))
    out = np.empty((slope_x.size, 3), np.float32)
    out[:, 0] = -(slope_x * length).ravel()
    out[:, 1] = length.ravel()
    out[:, 2] = -(slope_z * length).ravel()
    return out


def mirror_places(
    grid: EyeGrid,
    y: np.ndarray,
    slope_x: np.ndarray,
    slope_z: np.ndarray,
    tilt: np.ndarray | float = 0.0,
) -> np.ndarray:
    """Return where each vertex looks up the mirror image, float32 (n, 3) in units.

    ``tilt`` is a slope towards the eye that is added.

    A mirror tilted by a slope turns the ray by twice that angle. Along the line of sight this
    moves the image up or down by that angle; across it, by the fraction height / distance of it.
    """
    along = slope_x * grid.east + slope_z * grid.south
    across = slope_x * -grid.south + slope_z * grid.east
    up = np.minimum(-2.0 * MIRRORED * (along + tilt) * grid.sight, CALM * grid.height)
    aside = -2.0 * MIRRORED * across * np.float32(grid.height)
    out = np.empty((grid.x.size, 3), np.float32)
    out[:, 0] = (grid.x - aside * grid.south).ravel()
    out[:, 1] = (y + up).ravel()
    out[:, 2] = (grid.z + aside * grid.east).ravel()
    return out


def facing(
    grid: EyeGrid, slope_x: np.ndarray, slope_z: np.ndarray, rough: np.ndarray | float = 1.0
) -> np.ndarray:
    """Return the cosine of the angle between each facet's normal and the view, (rows, columns).

    Of far waves, too short for the grid, one sees the sides that lean towards the eye.
    """
    along = slope_x * grid.east + slope_z * grid.south
    far = np.square(grid.ring[:, None])
    along += np.float32(ROUGH) * far / (far + np.float32(ROUGH_FROM**2)) * rough
    return np.clip((grid.height + along * grid.ring[:, None]) / grid.sight, 0.0, 1.0)
