"""Interpolated lookups in tiling 2D and 3D grids of noise, for use in compiled functions."""

import numba
import numpy as np


@numba.njit
def bilinear(grid: np.ndarray, u: float, v: float) -> float:
    """Look up a tiling square grid bilinearly; u and v in texels."""
    n = grid.shape[0]
    i, j = int(np.floor(u)), int(np.floor(v))
    f, g = u - i, v - j
    i, j = i % n, j % n
    i1, j1 = (i + 1) % n, (j + 1) % n
    return (grid[i, j] * (1 - g) + grid[i, j1] * g) * (1 - f) + (
        grid[i1, j] * (1 - g) + grid[i1, j1] * g
    ) * f


@numba.njit
def trilinear(grid: np.ndarray, x: float, y: float, z: float) -> float:
    """Look up a tiling cubic grid trilinearly; x, y and z in texels."""
    n = grid.shape[0]
    i = int(np.floor(x))
    j = int(np.floor(y))
    k = int(np.floor(z))
    f = x - i
    g = y - j
    h = z - k
    i = i % n
    j = j % n
    k = k % n
    i1 = (i + 1) % n
    j1 = (j + 1) % n
    k1 = (k + 1) % n
    a = grid[i, j, k] * (1 - h) + grid[i, j, k1] * h
    b = grid[i, j1, k] * (1 - h) + grid[i, j1, k1] * h
    c = grid[i1, j, k] * (1 - h) + grid[i1, j, k1] * h
    d = grid[i1, j1, k] * (1 - h) + grid[i1, j1, k1] * h
    return (a * (1 - g) + b * g) * (1 - f) + (c * (1 - g) + d * g) * f
