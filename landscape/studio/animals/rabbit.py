"""The sitting rabbit, and the texture that the rabbit and the dragon share.

The rabbit is one distance field (:mod:`landscape.studio.shapes`): ellipsoids and limbs joined by
smooth unions, hollowed ears, and fur as noise stretched along the direction of the hair. The vertex
count is that of the Stanford bunny at its second resolution, so the numbers of 2006 hold for this
mesh too.
"""

import math
from collections.abc import Callable

import numpy as np
from numba import njit
from scipy import ndimage

from landscape.studio import images
from landscape.studio.animals.paint import rabbit_colours
from landscape.studio.animals.sculpture import PaintedMesh, sculpt
from landscape.studio.shapes import carve, clamp, ellipsoid, limb, noise, step_smooth, turn, union

VERTICES = 8171  # bun_zipper_res2.ply of the 2006 report
HEAD_YAW = 0.22  # radians; chosen: it looks slightly to one side, which is livelier
STEP = 0.0235  # chosen: grid step, slightly finer than the final edges, which keeps them even
BOX = ((-1.25, -0.06, -0.75), (1.15, 2.05, 0.75))  # chosen: contains the rabbit; ground at y = 0
TUFTS = (9, 12)  # chosen: tufts per tile across and down; the rows must be even in number to tile


@njit
def _ear(x, y, z):  # type: ignore[no-untyped-def]
    """Return the distance to an ear: x along it from the root, y out of the hollow, z across."""
    length = 0.86
    t = clamp(x / length, 0.0, 1.0)
    y = y - 0.10 * t * t + 0.9 * z * z
    half = 0.150 * (0.42 + 1.9 * t - 1.2 * t * t - 1.1 * t**6)
    over = max(x - length * 0.97, 0.0) + max(-x, 0.0)
    shell = ((z * z + (1.9 * y) ** 2 + over * over) ** 0.5 - half) * 0.75
    inside = ((z * z + (1.7 * (y - 0.085)) ** 2 + (1.5 * over) ** 2) ** 0.5 - half * 0.80) * 0.75
    return carve(shell, inside, 0.025)


@njit
def _head(x, y, z):  # type: ignore[no-untyped-def]
    """Return the distance to the head: origin between the cheeks, x to the nose, mirrored in z."""
    a = abs(z)

    # Skull, muzzle, cheeks, lips, chin and nose.
    u, v = turn(x, y, 0.25)
    d = ellipsoid(u + 0.03, v - 0.04, a, 0.33, 0.27, 0.225)
    d = union(d, ellipsoid(x - 0.22, y + 0.06, a, 0.18, 0.150, 0.130), 0.10)
    d = union(d, ellipsoid(x - 0.06, y + 0.11, a - 0.12, 0.18, 0.14, 0.12), 0.08)
    d = union(d, ellipsoid(x - 0.31, y + 0.075, a - 0.055, 0.075, 0.065, 0.06), 0.025)
    d = union(d, ellipsoid(x - 0.29, y + 0.16, a, 0.075, 0.05, 0.055), 0.025)
    d = union(d, ellipsoid(x - 0.375, y + 0.02, a, 0.04, 0.035, 0.05), 0.02)

    # Split lip and mouth, then eye socket and eye.
    d = carve(d, limb(x, y, a, 0.40, -0.06, 0.0, 0.010, 0.385, -0.13, 0.0, 0.010), 0.02)
    d = carve(d, limb(x, y, a, 0.39, -0.135, 0.0, 0.008, 0.29, -0.15, 0.10, 0.008), 0.02)
    d = carve(d, ellipsoid(x - 0.11, y - 0.075, a - 0.225, 0.098, 0.080, 0.045), 0.03)
    d = union(d, ellipsoid(x - 0.11, y - 0.075, a - 0.162, 0.080, 0.068, 0.055), 0.01)

    # Ears: set wide, spread to the sides, laid back to 41 degrees from the horizontal.
    u, w = turn(x + 0.10, a - 0.098, 0.23)
    u, v = turn(u, y - 0.19, 0.72 - math.pi)
    return union(d, _ear(u, -v, w), 0.05)


@njit
def rabbit_field(x: float, y: float, z: float, data: object) -> float:
    """Return the signed distance to the rabbit: x to the front, y up, z to its right."""
    a = abs(z)

    # Trunk, chest, neck, throat.
    u, v = turn(x + 0.36, y - 0.58, 0.20)
    d = ellipsoid(u, v, a, 0.60, 0.52, 0.42)
    d = union(d, ellipsoid(x - 0.22, y - 0.62, a, 0.36, 0.46, 0.33), 0.25)
    d = union(d, limb(x, y, a, 0.20, 0.85, 0.0, 0.30, 0.46, 1.08, 0.0, 0.23), 0.15)
    d = union(d, ellipsoid(x - 0.42, y - 0.70, a, 0.22, 0.27, 0.23), 0.12)

    # Haunch and hind foot, foreleg and paw, with three toes on each.
    u, v = turn(x + 0.38, y - 0.40, -0.35)
    d = union(d, ellipsoid(u, v, a - 0.35, 0.43, 0.36, 0.19), 0.03)
    d = union(d, limb(x, y, a, -0.52, 0.11, 0.40, 0.12, 0.16, 0.085, 0.45, 0.095), 0.04)
    d = union(d, ellipsoid(x - 0.20, y - 0.08, a - 0.455, 0.14, 0.095, 0.115), 0.04)
    d = union(d, limb(x, y, a, 0.33, 0.50, 0.20, 0.18, 0.47, 0.20, 0.17, 0.11), 0.06)
    d = union(d, limb(x, y, a, 0.47, 0.20, 0.17, 0.11, 0.56, 0.08, 0.16, 0.085), 0.04)
    d = union(d, ellipsoid(x - 0.63, y - 0.075, a - 0.16, 0.14, 0.085, 0.095), 0.04)
    for k in range(-1, 2):
        reach = 0.015 * (k + 1) * (1 - k)
        toe = ellipsoid(x - 0.27 - reach, y - 0.062, a - 0.455 - 0.062 * k, 0.12, 0.062, 0.040)
        d = union(d, toe, 0.018)
        toe = ellipsoid(x - 0.70 - reach, y - 0.055, a - 0.16 - 0.050 * k, 0.09, 0.055, 0.032)
        d = union(d, toe, 0.015)

    tuft = noise(6 * x, 6 * y, 6 * z)
    d = union(d, ellipsoid(x + 0.98, y - 0.45, a, 0.19, 0.19, 0.18) + 0.02 * tuft, 0.035)
    hx, hz = turn(x - 0.62, z, HEAD_YAW)
    d = union(d, _head(hx, y - 1.18, hz), 0.10)
    d = max(d, -y)

    # Fur that points backward; head and ears have none.
    fur = noise(4 * x + 2 * y, 11 * y - 4 * x, 11 * z)
    fur += 0.6 * noise(7 * x + 3 * y + 5, 17 * y - 6 * x, 17 * z)
    return d + 0.011 * fur * step_smooth(0.0, 0.1, y) * step_smooth(1.45, 1.0, y)


def rabbit() -> PaintedMesh:
    """Return the rabbit, facing +x.

    Vertices float32 (8171, 3) in -1..1, faces int32 (16338, 3), vertex colours uint8 (8171, 3).
    """
    low, high = np.array(BOX[0]), np.array(BOX[1])
    return sculpt(rabbit_field, 0.0, low, high, STEP, VERTICES, rabbit_colours, HEAD_YAW)


def _tufts(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return overlapping scallops, bright at the tips and dark under a neighbour; x, y in cells."""
    light, free = np.zeros_like(x), np.ones(x.shape, dtype=bool)
    for back in (2, 1, 0):
        row = np.floor(y) - back
        across = (x + 0.5 * (row % 2)) % 1.0 - 0.5
        along = y - row
        rim = (across / 0.60) ** 2 + (along / 1.9) ** 2
        here = free & (rim < 1.0)
        shade = (0.25 + 0.75 * (along / 1.9)) * (1.0 - images.smoothstep(0.72, 1.0, rim))
        light[here] = shade[here]
        free &= ~here
    return light


def animal_texture() -> np.ndarray:
    """Return the tile for both animals, uint8 (256, 256, 3): tufts, soft vertical stripes, hairs.

    It is bright because it multiplies the lit colour of the animal. The stripes make the texture
    mapping visible: meridians on the rabbit's cylinder, lines of equal x on the dragon, where
    (s, t) = (x, z).
    """
    size = 512  # drawn at twice the final size and downsampled, because the tufts have thin rims
    y, x = np.mgrid[:size, :size] / size
    warp = images.spectral_noise(size, 2.0, seed=71, low_cut=1)
    mottle = images.spectral_noise(size, 2.0, seed=72, low_cut=3)
    hairs = ndimage.gaussian_filter1d(
        images.spectral_noise(size, 0.3, seed=73, low_cut=8), 9.0, axis=0, mode="wrap"
    )
    hairs /= hairs.std()
    stripes = 0.5 + 0.5 * np.sin(2 * np.pi * 3 * x + 0.7 * warp)
    stripes = images.smoothstep(0.15, 0.75, stripes)
    tufts = _tufts(TUFTS[0] * x + 0.10 * warp, TUFTS[1] * y + 0.14 * mottle)
    light = 0.645 + 0.15 * stripes + 0.15 * tufts + 0.028 * mottle + 0.045 * hairs
    tint = np.stack([1.01 + 0.012 * mottle, np.ones_like(x), 0.975 - 0.012 * mottle], axis=2)
    return images.to_uint8(images.shrink(light[..., None] * tint, 2))


ASSETS: dict[str, Callable[[], PaintedMesh | np.ndarray]] = {
    "rabbit.ply": rabbit,
    "animal.png": animal_texture,
}
