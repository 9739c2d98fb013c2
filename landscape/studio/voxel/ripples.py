"""Ripples on the water of the island in voxels: normals of waves with a spectrum."""

from collections.abc import Callable

import numpy as np

from landscape.studio.images import to_uint8
from landscape.voxel.tiles import RIPPLES_FILE, RIPPLES_SIDE

# All chosen. Wave numbers are in waves per tile.
PEAK = 5.0
LONGEST = 2.5
SHORTEST = 12.0
WIND = 0.6  # radians from the x axis
FOCUS = 2.0  # exponent of the cosine of the angle to the wind
SLOPE = 0.20  # root mean square of the slope


def heights() -> np.ndarray:
    """Return the height of the waves (RIPPLES_SIDE, RIPPLES_SIDE), up to a factor; it tiles."""
    rng = np.random.default_rng(401)
    k = np.fft.fftfreq(RIPPLES_SIDE) * RIPPLES_SIDE
    kx, ky = np.meshgrid(k, k)
    number = np.maximum(np.hypot(kx, ky), 1e-9)
    along = np.abs(np.cos(np.arctan2(ky, kx) - WIND)) ** FOCUS
    # Amplitudes of a Phillips spectrum, with a share of waves across the wind.
    power = np.exp(-((PEAK / number) ** 2)) * number**-4.0 * (0.35 + along)
    power *= (number > LONGEST) * np.exp(-((number / SHORTEST) ** 2))
    waves = np.fft.fft2(rng.standard_normal((RIPPLES_SIDE, RIPPLES_SIDE))) * np.sqrt(power)
    return np.asarray(np.fft.ifft2(waves).real)


def voxel_ripples() -> np.ndarray:
    """Return unit normals, uint8 (n, n, 3), n RIPPLES_SIDE: x right, y down the picture, z up.

    A component n is coded as (n + 1) / 2.
    """
    height = heights()
    slopes = [(np.roll(height, -1, axis) - np.roll(height, 1, axis)) / 2 for axis in (1, 0)]
    scale = SLOPE / np.sqrt(np.mean(slopes[0] ** 2 + slopes[1] ** 2))
    normal = np.stack([-slopes[0] * scale, -slopes[1] * scale, np.ones_like(height)], axis=-1)
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    return to_uint8((normal + 1.0) / 2.0)


ASSETS: dict[str, Callable[[], np.ndarray]] = {RIPPLES_FILE: voxel_ripples}
