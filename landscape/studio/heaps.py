"""The heaps that the cumulus are: domes upon domes over a flat base.

A cloud is a tree of spheres (Bouthors and Neyret 2004): towers of them, smaller ones on these and
smaller ones again on those. All clouds of the sky are stamped into one field of distances.
"""

import functools

import numba
import numpy as np
from scipy import ndimage

from landscape.studio.images import spectral_noise

# Lengths are metres.
VOXEL = 48.0  # of the field of distances
ACROSS, HIGH = 1200, 34  # its voxels; the eye stands under its middle
BELOW = 3  # voxels of it that lie under the base
REACH = 150.0  # distance from a cloud up to which the field knows it
SEED = 849  # chosen by eye: clouds on every side, the sun free at noon and at sunset
CLEARING = 3100.0  # chosen: nearer ones would fill the view
# Chosen: the widths of the great, middling and small ones, and how many are tried for.
SIZES = ((1700.0, 3200.0, 44), (700.0, 1600.0, 170), (280.0, 650.0, 480))


def _heap(rng: np.random.Generator, x: float, z: float, width: float) -> list[list[float]]:
    """Return the spheres (x, height of the centre over the base, z, radius) of one cloud."""
    turn, stretch = rng.uniform(0.0, np.pi), rng.uniform(1.0, 1.9)
    tall = min(0.65 * width, 21.0 * width**0.5, 1000.0) * rng.uniform(0.65, 1.1)
    peak = rng.uniform(-0.7, 0.7)  # off the middle, or every cloud were a pyramid
    spheres = []
    for tower in range(int(7 + width / 100.0)):
        # The first few towers are a core that holds the others together; some are hangers-on.
        away, angle = rng.random() ** 0.65, rng.uniform(0.0, 2.0 * np.pi)
        away = 0.4 * away if tower < 4 else 0.95 + 0.35 * away if tower % 5 == 4 else away
        along, across = np.cos(angle) * away * stretch, np.sin(angle) * away / stretch
        u = x + 0.5 * width * (along * np.cos(turn) - across * np.sin(turn))
        v = z + 0.5 * width * (along * np.sin(turn) + across * np.cos(turn))
        radius = min(width * rng.uniform(0.10, 0.20), 330.0) * (1.2 - 0.55 * away)
        radius = max(75.0, radius)
        lower = min(1.0, np.hypot(along - peak, across)) ** 2
        top = tall * (1.0 - 0.6 * lower) * rng.uniform(0.45, 1.0)
        top = min(top, 4.5 * radius)  # or thin ones were spikes
        up = 0.25 * radius
        while True:
            r = radius * rng.uniform(0.8, 1.15)
            spheres.append([u, up, v, r])
            up += 0.8 * r
            if up + 0.6 * r > top:
                break
            u, v = u + rng.normal(0.12, 0.22) * r, v + rng.normal(0.0, 0.22) * r
    parents = list(spheres)
    for children in (6, 4):
        born = []
        for u, up, v, r in parents:
            for _ in range(children):
                d = rng.normal(size=3)
                d /= np.linalg.norm(d)
                small = r * rng.uniform(0.35, 0.6)
                if small > 45.0 and d[1] > -0.25:
                    reach = r * rng.uniform(0.72, 0.95)
                    born.append([u + d[0] * reach, up + d[1] * reach, v + d[2] * reach, small])
        spheres += born
        parents = born
    return spheres


def _plan() -> np.ndarray:
    """Return the spheres of all clouds, (n, 4)."""
    rng = np.random.default_rng(SEED)
    gather = spectral_noise(256, 1.6, SEED, low_cut=2.0)  # streets and clearings
    half = 0.5 * ACROSS * VOXEL - 2e3
    spheres: list[list[float]] = []
    taken: list[tuple[float, float, float]] = []
    for low, high, count in SIZES:
        for _ in range(count):
            for _ in range(60):
                x, z = rng.uniform(-half, half, 2)
                width = low * (high / low) ** rng.random()
                away = float(np.hypot(x, z))
                # Near by, small ones alone would look like crumbs.
                if away < (2.0 * CLEARING if width < 700.0 else CLEARING + 0.55 * width):
                    continue
                at = gather[int((x / half + 1) * 127.9), int((z / half + 1) * 127.9)]
                if at < rng.uniform(-0.3, 1.5):
                    continue
                # Wide ones keep clear of one another; small ones join them.
                room = 0.42 if width > 700.0 else 0.0
                if all(np.hypot(x - a, z - b) > room * (width + w) for a, b, w in taken):
                    break
            else:
                continue
            taken.append((x, z, width))
            # Its own numbers, so that no cloud's shape moves the next; far ones are smaller.
            shape = np.random.default_rng([SEED, len(taken)])
            spheres += _heap(shape, x, z, width * (1.0 - 0.3 * away / half))
    return np.array(spheres)


@numba.njit
def _stamp(field: np.ndarray, spheres: np.ndarray) -> None:
    """Write into the field how deep each voxel lies in the nearest sphere, in decimetres."""
    for s in range(spheres.shape[0]):
        x, y, z, r = spheres[s]
        i0, i1 = int((x - r - REACH) / VOXEL) + ACROSS // 2, int((x + r + REACH) / VOXEL)
        k0, k1 = int((z - r - REACH) / VOXEL) + ACROSS // 2, int((z + r + REACH) / VOXEL)
        for i in range(max(0, i0), min(ACROSS, i1 + ACROSS // 2 + 2)):
            for k in range(max(0, k0), min(ACROSS, k1 + ACROSS // 2 + 2)):
                a, c = (i - ACROSS // 2) * VOXEL - x, (k - ACROSS // 2) * VOXEL - z
                for j in range(HIGH):
                    b = (j - BELOW) * VOXEL - y
                    deep = r - np.sqrt(a * a + b * b + c * c)
                    if deep > -REACH:
                        field[i, k, j] = max(field[i, k, j], int(deep * 10.0))


@functools.lru_cache(maxsize=1)
def heaps() -> tuple[np.ndarray, np.ndarray]:
    """Return the depth inside a cloud, int16 (x, z, up), decimetres, and how far none is, metres.

    The second is a map, float32 (x, z): the distance to the next column with any cloud in it.
    """
    field = np.full((ACROSS, ACROSS, HIGH), int(-10 * REACH), np.int16)
    _stamp(field, _plan())
    clear = ndimage.distance_transform_edt(field.max(axis=2) <= int(-10 * REACH)) * VOXEL
    return field, clear.astype(np.float32)
