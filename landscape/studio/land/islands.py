"""The distant islands on the sky box.

A height field is rendered into a full panorama by marching each column from near to far; the
farther a hit, the more the air hides it.
"""

import functools

import numba
import numpy as np
from scipy import ndimage

from landscape.studio.grids import bilinear
from landscape.studio.images import ridged
from landscape.studio.sky.air import Scene

# Chosen: azimuth (degrees), then in metres distance, half width, half depth and height.
ISLANDS = np.array(
    [
        [4.0, 34e3, 9.0e3, 4.0e3, 1900.0],
        [22.0, 46e3, 11.0e3, 5.0e3, 2300.0],
        [-19.0, 52e3, 9.0e3, 5.0e3, 1900.0],
        [62.0, 26e3, 4.2e3, 2.5e3, 850.0],
        [84.0, 50e3, 14.0e3, 5.0e3, 2500.0],
        [101.0, 36e3, 5.5e3, 3.0e3, 1150.0],
        [152.0, 58e3, 13.0e3, 5.0e3, 2300.0],
        [171.0, 40e3, 7.0e3, 3.5e3, 1350.0],
        [206.0, 24e3, 3.6e3, 2.4e3, 720.0],
        [222.0, 48e3, 12.0e3, 5.0e3, 2350.0],
        [268.0, 38e3, 10.0e3, 4.0e3, 2000.0],
        [285.0, 56e3, 13.0e3, 5.0e3, 2700.0],
        [308.0, 29e3, 4.6e3, 2.6e3, 950.0],
    ]
)
PANORAMA_DEG = 5.5  # height of the panorama
FOOT_DEG = 1.1  # chosen: elevation over which the haze at the foot of the land thins by a factor e
RIDGE_PERIOD = 30e3  # period of the ridge texture, metres


@functools.lru_cache(maxsize=1)
def ridges() -> np.ndarray:
    """Return the tiling ridge texture (ridged multifractal), (1024, 1024) float32 in 0..1."""
    return ridged(1024, 61, 6, 3.0).astype(np.float32)


@numba.njit
def _ground(x: float, z: float, islands: np.ndarray, texture: np.ndarray) -> float:
    """Return the height of the far land at a point in metres, negative at sea."""
    n = texture.shape[0]
    peak = bilinear(texture, x / RIDGE_PERIOD * n, z / RIDGE_PERIOD * n)
    variation = bilinear(texture, x / 90e3 * n + 200.0, z / 90e3 * n) - 0.4
    best = -50.0
    for k in range(islands.shape[0]):
        a = np.radians(islands[k, 0])
        c, s = np.cos(a), np.sin(a)
        along_view = (x * s - z * c - islands[k, 1]) / islands[k, 3]
        across_view = (x * c + z * s) / islands[k, 2]
        r = along_view * along_view + across_view * across_view
        if r < 4.0:
            mask = np.exp(-1.6 * r) - 0.10 + 0.35 * variation * np.exp(-0.6 * r)
            best = max(best, islands[k, 4] * mask * (0.35 + 1.75 * peak))
    return best


@numba.njit
def _sweep(
    columns: int, rows: int, islands: np.ndarray, texture: np.ndarray, sun: np.ndarray
) -> np.ndarray:
    """Return cover, sunlight and distance, (rows, columns, 3), with row 0 at the horizon."""
    out = np.zeros((rows, columns, 3), np.float32)
    for i in range(columns):
        a = 2 * np.pi * (i + 0.5) / columns
        s, c = np.sin(a), -np.cos(a)
        filled, t = 0, 17e3
        while t < 75e3:
            y = _ground(s * t, c * t, islands, texture)
            if y > 0.0:
                top = (y - t * t / 14.9e6) / t  # earth's curvature, with refraction
                row = min(int(np.degrees(top) / PANORAMA_DEG * rows), rows)
                if row > filled:
                    e = 60.0
                    d_x = _ground(s * t + e, c * t, islands, texture) - y
                    d_z = _ground(s * t, c * t + e, islands, texture) - y
                    size = np.sqrt(d_x * d_x + e * e + d_z * d_z)
                    lit = max(0.0, (-d_x * sun[0] + e * sun[1] - d_z * sun[2]) / size)
                    for j in range(filled, row):
                        out[j, i, 0], out[j, i, 1], out[j, i, 2] = 1.0, lit, t
                    filled = row
            t *= 1.0022

    return out


@functools.lru_cache(maxsize=2)
def panorama(scene: Scene) -> np.ndarray:
    """Return the panorama, (192, 8192, 3): cover, cover * sunlight, cover * transmittance."""
    swept = _sweep(16384, 768, ISLANDS, ridges(), scene.towards_sun())
    cover = swept[..., 0]
    clear = np.exp(-swept[..., 2] / 26e3) * 2.0
    layers = np.stack([cover, cover * swept[..., 1], cover * np.minimum(clear, 1.0)], axis=-1)
    return layers.reshape(192, 4, 8192, 2, 3).mean(axis=(1, 3))


def add_islands(scene: Scene, d: np.ndarray, sky: np.ndarray, haze: np.ndarray) -> np.ndarray:
    """Return the sky with the islands composited over it; ``haze`` (3,) is the sea-level colour."""
    elevation = np.degrees(np.arcsin(d[..., 1]))
    azimuth = np.arctan2(d[..., 0], -d[..., 2]) / (2 * np.pi) % 1.0
    layers = panorama(scene)
    rows, columns = layers.shape[:2]
    row = np.clip(elevation / PANORAMA_DEG * rows - 0.5, 0, rows - 1)
    where = [row, azimuth * columns - 0.5]
    cover, lit, clear = (
        ndimage.map_coordinates(layers[..., c], where, order=1, mode="grid-wrap") for c in range(3)
    )
    cover = np.where(elevation < PANORAMA_DEG - 0.1, cover, 0.0)
    whole = np.maximum(cover, 1e-4)
    lit, clear = lit / whole, clear / whole

    # The foot of the land fades into the haze; above it, the air in front of it is bluer.
    risen = 1.0 - np.exp(-np.clip(elevation, 0.0, None)[..., None] / FOOT_DEG)
    clear = clear[..., None] * risen
    tone = np.array([0.035, 0.062, 0.075]) + lit[..., None] * np.array(scene.sun) * np.array(
        [0.017, 0.019, 0.013]
    )
    air = haze * (1.0 - risen * np.array(scene.far_air))
    land = clear * tone + (1.0 - clear) * air
    return sky + cover[..., None] * (land - sky)
