"""The cumulus clouds as a distance field, rasterized from the spheres that a cloud is made of.

A cloud is a hierarchy of spheres (Bouthors and Neyret 2004): towers of them in
:mod:`landscape.studio.sky.towers`, domes side by side in :mod:`landscape.studio.sky.domes`.
"""

import functools
from collections.abc import Callable

import numba
import numpy as np
from scipy import ndimage

# Lengths are in metres.
VOXEL = 48.0  # voxel size of the distance field
ACROSS = 1200  # width of the field in voxels; the eye is below its centre
HALF = 0.5 * ACROSS * VOXEL - 2e3  # clouds stand in a square of this half width
BELOW = 3  # layers of voxels below the cloud base
REACH = 150.0  # the field holds distances up to this far outside a cloud


@numba.njit
def _rasterize(field: np.ndarray, spheres: np.ndarray) -> None:
    """Write the depth of each voxel inside the nearest sphere (decimetres) into the field."""
    for s in range(spheres.shape[0]):
        x, y, z, r = spheres[s]
        i0, i1 = int((x - r - REACH) / VOXEL) + ACROSS // 2, int((x + r + REACH) / VOXEL)
        k0, k1 = int((z - r - REACH) / VOXEL) + ACROSS // 2, int((z + r + REACH) / VOXEL)
        for i in range(max(0, i0), min(ACROSS, i1 + ACROSS // 2 + 2)):
            for k in range(max(0, k0), min(ACROSS, k1 + ACROSS // 2 + 2)):
                a, c = (i - ACROSS // 2) * VOXEL - x, (k - ACROSS // 2) * VOXEL - z
                for j in range(field.shape[2]):
                    b = (j - BELOW) * VOXEL - y
                    deep = r - np.sqrt(a * a + b * b + c * c)
                    if deep > -REACH:
                        field[i, k, j] = max(field[i, k, j], int(deep * 10.0))


@functools.lru_cache(maxsize=1)
def distance_field(spheres: Callable[[], np.ndarray], high: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the distance field of all clouds and the map of the free distance.

    ``spheres`` returns those of all clouds (n, 4): x, height of the centre above the base, z,
    radius. The field is the depth inside a cloud in decimetres, int16 (x, z, up), ``high`` voxels
    high, negative outside. The map is the horizontal distance in metres to the nearest column with
    any cloud, float32 (x, z).
    """
    field = np.full((ACROSS, ACROSS, high), int(-10 * REACH), np.int16)
    _rasterize(field, spheres())
    clear = ndimage.distance_transform_edt(field.max(axis=2) <= int(-10 * REACH)) * VOXEL
    return field, clear.astype(np.float32)
