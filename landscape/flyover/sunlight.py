"""Light on a height field, computed once: the sun's shadows, and how much sky each point sees.

Both work on whole arrays by shifting them. Arrays are heights on a torus, (n, n) float32, row along
y and column along x, in texels: a height of 1 is as high as a texel is wide.
"""

import numpy as np

AZIMUTHS = 8  # directions in which the horizon is looked up, chosen
SKY_STEPS = (1, 2, 4, 8, 16, 32, 64)  # how far away, texels of the reduced field, chosen
NEAREST = 1.5  # how far away ground is that may shade a point, texels, chosen
PENUMBRA = 1.6  # of a shadow's edge: how far the sun's rays rise across it, texels, chosen
TEETH = 1.0  # the same, times how much higher the next texel is, chosen


def smooth_step(low: float, high: float, x: np.ndarray) -> np.ndarray:
    """Return 0 below ``low``, 1 above ``high``, and a smooth curve between."""
    t = np.clip((x - np.float32(low)) / np.float32(high - low), 0, 1)
    return np.asarray(t * t * (3 - 2 * t))


def moved(field: np.ndarray, x: float, y: float) -> np.ndarray:
    """Return a field on a torus looked up x columns and y rows further on, bilinearly."""
    column, row = int(np.floor(x)), int(np.floor(y))
    u, v = np.float32(x - column), np.float32(y - row)
    base = np.roll(field, (-row, -column), (0, 1))
    across = base + (np.roll(base, -1, 1) - base) * u if u else base
    return np.asarray(across + (np.roll(across, -1, 0) - across) * v if v else across)


def sun_light(heights: np.ndarray, towards: np.ndarray) -> np.ndarray:
    """Return how much of the sun each point sees, 0..1 (n, n).

    ``towards`` (3,) points to the sun. A point is in shadow if the ray to the sun passes below the
    ground somewhere. Of M_k(p), the greatest of ``h(p + t s) - t tan(e)`` for t < 2^k, and M_k
    shifted by 2^k the greater one is M_k+1: ten shifts do the work of a thousand.
    """
    flat = float(np.hypot(towards[0], towards[1]))
    if flat < 1e-6:
        return np.ones_like(heights)
    step, rise = towards[:2] / flat, np.float32(towards[2] / flat)
    reach = float(np.ptp(heights)) / max(float(rise), 1e-3)

    # The nearest texels are left out: a slope that is turned away is dark by its normal already.
    highest = moved(heights, *(step * NEAREST)) - np.float32(NEAREST) * rise
    length = 1.0
    while length < min(reach, len(heights)):
        further = moved(highest, *(step * length)) - np.float32(length) * rise
        np.maximum(highest, further, out=highest)
        length *= 2

    # On a wall the next texel is much higher. The edge of a shadow is then wide enough for some of
    # them, as otherwise it would show them as teeth.
    wide = np.float32(PENUMBRA) + np.float32(TEETH) * steepness(heights)

    # Ground that nothing shades is just so much above the plane of the nearest texels' rays.
    return smooth_step(-1, 0, (heights - highest - np.float32(NEAREST) * rise) / wide)


def steepness(heights: np.ndarray) -> np.ndarray:
    """Return how much higher or lower the ground is a texel further on, (n, n)."""
    across, along = ((np.roll(heights, -1, k) - np.roll(heights, 1, k)) / 2 for k in (0, 1))
    return np.asarray(np.hypot(across, along))


def sky_seen(heights: np.ndarray) -> np.ndarray:
    """Return how much of the sky's dome each point sees, 0..1 (n, n): 1 on a plain.

    In each of eight directions the steepest angle to the horizon is kept; ground that rises to the
    angle a hides sin²(a) of the light from that side.
    """
    seen = np.zeros_like(heights)
    for turn in range(AZIMUTHS):
        angle = 2 * np.pi * (turn + 0.5) / AZIMUTHS
        steepest = np.zeros_like(heights)
        for step in SKY_STEPS:
            shift = (-round(step * np.sin(angle)), -round(step * np.cos(angle)))
            away = float(np.hypot(*shift))
            rise = (np.roll(heights, shift, (0, 1)) - heights) / np.float32(max(away, 1))
            np.maximum(steepest, rise, out=steepest)
        seen += 1 / (1 + steepest * steepest)
    return seen / AZIMUTHS


def normals(heights: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the unit normals' x, y and z, each (n, n), by central differences."""
    x = (np.roll(heights, 1, 1) - np.roll(heights, -1, 1)) / 2
    y = (np.roll(heights, 1, 0) - np.roll(heights, -1, 0)) / 2
    z = 1 / np.sqrt(x * x + y * y + 1)
    return x * z, y * z, z
