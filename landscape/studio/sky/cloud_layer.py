"""The moving cloud layer: thin broken cloud that drifts over the sky box (R1).

The thickness is domain-warped tileable fractal noise above a threshold; the opacity is
1 - exp(-k thickness). A short march towards the sun in the plane of the layer shades the side that
faces away from it.
"""

from collections.abc import Callable

import numpy as np
from scipy import ndimage

from landscape.studio.images import bleed, smoothstep, spectral_noise, to_uint8
from landscape.studio.light import sun_direction

SIZE = 512
THRESHOLD = 0.35  # chosen: noise below this is clear sky, in standard deviations
OPACITY = 0.8  # chosen
WARP = 14.0  # chosen: domain warp in texels, which stretches the noise into wisps
MARCH = 9  # chosen: length of the march towards the sun, texels


def _thickness() -> np.ndarray:
    """Return how thick the layer is, (512, 512), tileable: warped noise above a threshold."""
    rows, columns = np.indices((SIZE, SIZE), dtype=float)
    warp = [WARP * spectral_noise(SIZE, 1.9, seed, 2.0) for seed in (31, 32)]
    noise = 0.85 * spectral_noise(SIZE, 1.9, 33, 2.0) + 0.25 * spectral_noise(SIZE, 1.5, 34, 6.0)
    positions = [columns + warp[0], rows + warp[1]][::-1]
    noise = ndimage.map_coordinates(noise, positions, order=1, mode="grid-wrap")
    return np.maximum(noise - THRESHOLD, 0.0)


def clouds() -> np.ndarray:
    """Return the layer, uint8 (512, 512, 4), tileable; row 0 is north."""
    thickness = _thickness()
    alpha = 1.0 - np.exp(-OPACITY * thickness)
    x, _, z = sun_direction()
    shade = np.zeros_like(thickness)
    for step in range(1, MARCH):
        shade += np.roll(thickness, (-round(step * z), -round(step * x)), axis=(0, 1))
    light = 0.78 + 0.22 * np.exp(-0.25 * shade)
    warm = np.array([1.0, 0.985, 0.96])
    rgb = light[..., None] * warm + (1 - light[..., None]) * np.array([0.62, 0.68, 0.78])
    alpha = alpha * smoothstep(0.0, 0.06, alpha)
    return bleed(to_uint8(np.dstack([rgb, alpha])))


ASSETS: dict[str, Callable[[], np.ndarray]] = {"clouds.png": clouds}
