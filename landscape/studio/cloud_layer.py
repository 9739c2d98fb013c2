"""The moving cloud layer: thin broken cloud that drifts over the painted sky (R1).

Method: tileable fractal noise, bent by another, whose excess over a coverage is the thickness;
opacity is 1 - exp(-k thickness), and a short march towards the sun within the layer's plane shades
the side that is turned away.
"""

from collections.abc import Callable

import numpy as np
from scipy import ndimage

from landscape.studio.images import bleed, smoothstep, spectral_noise, to_uint8
from landscape.studio.light import sun_direction

SIZE = 512
COVERAGE = 0.35  # chosen: noise below this leaves blue sky, in deviations
OPACITY = 0.8  # chosen
BEND = 14.0  # chosen: texels the noise is bent by, which draws it out into wisps
MARCH = 9  # chosen: texels towards the sun that cast shade


def clouds() -> np.ndarray:
    """Return the layer, uint8 (512, 512, 4), tileable; the texture's top is north."""
    rows, columns = np.indices((SIZE, SIZE), dtype=float)
    bend = [BEND * spectral_noise(SIZE, 1.9, seed, 2.0) for seed in (31, 32)]
    noise = 0.85 * spectral_noise(SIZE, 1.9, 33, 2.0) + 0.25 * spectral_noise(SIZE, 1.5, 34, 6.0)
    places = [columns + bend[0], rows + bend[1]][::-1]
    noise = ndimage.map_coordinates(noise, places, order=1, mode="grid-wrap")
    thickness = np.maximum(noise - COVERAGE, 0.0)
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
