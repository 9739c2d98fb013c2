"""The clouds of the sky box.

The cumulus are a layer of heaps: a map of heights, roughened by a Perlin-Worley volume and marched
with Beer's law and a few octaves of softened light for the multiple scattering (Schneider 2015;
Wrenninge et al. 2013). Cirrus lie on a deck above. Both are functions of the direction alone.
"""

import functools

import numba
import numpy as np
from scipy import ndimage

from landscape.studio.air import Scene
from landscape.studio.grids import flat, solid
from landscape.studio.images import smoothstep, spectral_noise

# Cumulus, metres. Chosen: fair-weather heaps, low enough to look near.
BASE, DEPTH = 950.0, 1150.0
MAP_PERIOD = 46e3  # of the map of heaps
SPECK = 260.0  # texels of the map of heaps: smaller ones are left out
HEAP_SEED = 841  # chosen by eye: the sun stands free
SHAPE_PERIOD = 3100.0  # of the volume that makes them lumpy
DETAIL_PERIOD = 640.0  # of the same volume, again, for the curls
EXTINCTION = 0.026  # per metre in the densest part
SOFT = 5.0  # a depth of 1 / SOFT heaps under the surface the cloud is at its densest
FAR = 70e3  # the march ends here; air hides the rest
AIR_FADE = 20e3  # distance in which a cloud is lost in the air by a factor e
CIRRUS_HEIGHT, CIRRUS_PERIOD = 9000.0, 52e3


@numba.njit(cache=False)
def _worley(size: int, cells: int, points: np.ndarray) -> np.ndarray:
    """Distance to the nearest of one point per cell, in cells, wrapping; (size,)*3."""
    out = np.empty((size, size, size), np.float32)
    for i in range(size):
        for j in range(size):
            for k in range(size):
                x, y, z = i * cells / size, j * cells / size, k * cells / size
                best = 9.0
                for a in range(int(x) - 1, int(x) + 2):
                    for b in range(int(y) - 1, int(y) + 2):
                        for c in range(int(z) - 1, int(z) + 2):
                            p = points[a % cells, b % cells, c % cells]
                            r = (a + p[0] - x) ** 2 + (b + p[1] - y) ** 2 + (c + p[2] - z) ** 2
                            best = min(best, r)
                out[i, j, k] = np.sqrt(best)
    return out


@functools.lru_cache(maxsize=1)
def lumps() -> np.ndarray:
    """Return the tiling volume of lumps, (96, 96, 96) float32, mean 0, deviation 1."""
    size = 96
    rng = np.random.default_rng(31)
    total = np.zeros((size, size, size), np.float32)
    for cells, weight in ((4, 1.0), (8, 0.62), (16, 0.36), (32, 0.18)):
        points = rng.random((cells, cells, cells, 3))
        total -= weight * _worley(size, cells, points)  # near a point is inside a lump
    k = np.fft.fftfreq(size) * size
    k3 = np.sqrt(k[:, None, None] ** 2 + k[None, :, None] ** 2 + k[None, None, :] ** 2)
    spectrum = np.fft.fftn(rng.standard_normal((size,) * 3)) * np.maximum(k3, 1.0) ** -2.6
    soft = np.fft.ifftn(np.where(k3 > 0, spectrum, 0)).real
    total = (total - total.mean()) / total.std() + 0.8 * soft / soft.std()
    return ((total - total.mean()) / total.std()).astype(np.float32)


@functools.lru_cache(maxsize=1)
def heaps() -> np.ndarray:
    """Return the map of cloud tops, (1024, 1024) float32: in depths, negative where clear."""
    gather = spectral_noise(1024, 1.5, HEAP_SEED, low_cut=3.0)  # streets and clearings
    wide = ndimage.gaussian_filter(
        spectral_noise(1024, 1.5, HEAP_SEED + 1, low_cut=8.0), 7.0, mode="wrap"
    )
    small = ndimage.gaussian_filter(
        spectral_noise(1024, 1.0, HEAP_SEED + 2, low_cut=22.0), 6.0, mode="wrap"
    )
    wide, small = wide / wide.std(), small / small.std()
    tops = 0.30 * wide + 0.07 * small + 0.22 * gather - 0.40
    # A clearing overhead keeps single clouds from filling the view.
    at = (np.arange(1024) + 512) % 1024 - 512.0
    away = np.hypot(at[:, None], at[None, :]) * (MAP_PERIOD / 1024)
    tops -= 0.74 * np.clip((4.6e3 - away) / 3.0e3, 0.0, 1.0)
    # Specks of cloud are taken away: they look like dirt on the sky.
    span = np.arange(-5, 6)
    disc = np.hypot(span[:, None], span[None, :]) < 5.5
    for _ in range(8):
        cloud = tops > 0.0
        labels, count = ndimage.label(cloud)
        sizes = ndimage.sum_labels(cloud, labels, np.arange(count + 1))
        # Small ones, and what hangs on a large one by a thread.
        broad = ndimage.binary_dilation(ndimage.binary_opening(cloud, disc), iterations=4)
        small = cloud & ((sizes[labels] < SPECK) | ~broad)
        if not small.any():
            break
        # Softly, which may leave specks of what was joined to one: so again.
        specks = ndimage.binary_dilation(small, iterations=7)
        tops -= 1.1 * ndimage.gaussian_filter(specks.astype(float), 4.5, mode="wrap")
    return np.asarray(tops, np.float32)


@numba.njit
def _density(
    tops: np.ndarray, volume: np.ndarray, x: float, y: float, z: float, detail: bool
) -> float:
    """Return how deep inside a cloud a point is: density if positive, else depths to go."""
    up = (y - BASE) / DEPTH
    if up < 0.0 or up > 1.25:
        return -0.3
    n = tops.shape[0]
    heap = flat(tops, x / MAP_PERIOD * n, z / MAP_PERIOD * n)
    # Far off they are fewer, or perspective would close their ranks into a wall over the horizon.
    away = np.sqrt(x * x + z * z)
    heap -= 0.32 * min(1.0, max(0.0, (away - 7e3) / 30e3))
    # A dome over the heap; beside it a steep fall, so that no crumbs float about.
    value = (heap**0.7 if heap > 0.0 else heap * 4.0) - up
    if value < -0.55:
        return value + 0.30
    # Lumps bend the surface where it is near and make none of their own: what they add is less
    # than what is missing a little way off.
    near = min(1.0, max(0.0, 1.0 + value / 0.26)) ** 2
    s = volume.shape[0] / SHAPE_PERIOD
    lump = np.tanh(solid(volume, x * s, y * s * 1.2, z * s))
    outside = min(1.0, max(0.0, -10.0 * value))
    value += 0.30 * near * (lump - 0.20 - 0.25 * outside)
    if detail and value > -0.2:
        s = volume.shape[0] / DETAIL_PERIOD
        curl = np.tanh(solid(volume, z * s + 31.0, x * s, y * s * 1.1))
        value += near * (0.085 * curl - 0.03)
    # The base is flat where the air becomes moist enough, and only a little ragged.
    return min(value, up * 4.0 - 0.10 + 0.06 * lump)


@numba.njit
def march(
    d: np.ndarray, tops: np.ndarray, volume: np.ndarray, sun: np.ndarray, steps_m: float
) -> np.ndarray:
    """March each direction (n, 3); return (n, 4): sunlight, skylight, transmittance, distance.

    Sunlight and skylight are what the cloud sends to the eye for a unit of each.
    """
    out = np.zeros((d.shape[0], 4), np.float32)
    reaches = np.array([25.0, 70.0, 140.0, 260.0, 460.0, 800.0])
    for i in range(d.shape[0]):
        out[i, 2], out[i, 3] = 1.0, FAR
        slope = d[i, 1]
        if slope < 0.008:
            continue
        t, end = BASE / slope, min((BASE + DEPTH * 1.25) / slope, FAR)
        cos = d[i, 0] * sun[0] + d[i, 1] * sun[1] + d[i, 2] * sun[2]
        through, lit, filled, seen, weight, jump = 1.0, 0.0, 0.0, 0.0, 1e-6, 0.0
        while t < end and through > 0.01:
            fine = steps_m + 0.0018 * t
            x, y, z = d[i, 0] * t, slope * t, d[i, 2] * t
            rho = _density(tops, volume, x, y, z, True)
            if rho <= 0.0:
                jump = max(fine, -rho * 70.0)
                t += jump
                continue
            if jump > 0.0:
                # Find the surface between the last clear point and this one.
                low, high = t - jump, t
                for _ in range(5):
                    t = 0.5 * (low + high)
                    if _density(tops, volume, d[i, 0] * t, slope * t, d[i, 2] * t, True) > 0.0:
                        high = t
                    else:
                        low = t
                t, jump = high + 0.35 * fine, 0.0
                x, y, z = d[i, 0] * t, slope * t, d[i, 2] * t
                rho = max(1e-3, _density(tops, volume, x, y, z, True))
            sigma = EXTINCTION * min(1.0, rho * SOFT)
            absorbed = 1.0 - np.exp(-sigma * fine)
            tau, before = 0.0, 0.0
            for s in range(6):
                r = 0.5 * (before + reaches[s])
                q = _density(tops, volume, x + sun[0] * r, y + sun[1] * r, z + sun[2] * r, s < 2)
                tau += EXTINCTION * min(1.0, max(q, 0.0) * SOFT) * (reaches[s] - before)
                before = reaches[s]
            # Octaves of softened light stand for light scattered more than once.
            glow, part, thin, g = 0.0, 1.0, 1.0, 0.60
            for _ in range(4):
                forward = (1 - g * g) / (1 + g * g - 2 * g * cos) ** 1.5
                back = (1 - 0.06) / (1 + 0.06 + 0.5 * cos) ** 1.5
                glow += part * (0.65 * forward + 0.35 * back) * np.exp(-tau * thin) / (4 * np.pi)
                part, thin, g = part * 0.62, thin * 0.32, g * 0.5
            up = (y - BASE) / DEPTH
            lit += through * absorbed * glow
            roof = max(0.0, _density(tops, volume, x, y + 80.0, z, True))
            filled += through * absorbed * (0.3 + 0.7 * min(1.0, up * 1.5) * np.exp(-9.0 * roof))
            seen += through * absorbed * t
            weight += through * absorbed
            through *= 1.0 - absorbed
            t += fine
        out[i, 0], out[i, 1] = lit, filled
        out[i, 2] = max(0.0, (through - 0.01) / 0.99)
        out[i, 3] = seen / weight if weight > 1e-5 else FAR
    return out


def add_cumulus(scene: Scene, d: np.ndarray, sky: np.ndarray) -> np.ndarray:
    """Return the sky (h, w, 3) with the cumulus before it."""
    marched = march(d.reshape(-1, 3), heaps(), lumps(), scene.towards_sun(), 6.0)
    lit, filled, through, far = np.moveaxis(marched.reshape(*d.shape[:2], 4), -1, 0)
    through = np.clip(through, 0.0, 1.0)[..., None]
    bounce = np.clip((1.0 - through) - filled[..., None], 0.0, None)
    cloud = lit[..., None] * np.array(scene.sun) + filled[..., None] * np.array(scene.shade)
    cloud = cloud + bounce * np.array(scene.bounce)
    cloud = 1.0 - np.exp(-np.clip(cloud, 0.0, None) * 1.15)
    clear = np.exp(-np.clip(far, 0.0, FAR) / AIR_FADE)[..., None]
    cloud = clear * cloud + (1.0 - clear) * (1.0 - through) * sky
    return sky * through + cloud


def add_cirrus(scene: Scene, d: np.ndarray, sky: np.ndarray) -> np.ndarray:
    """Return the sky with thin streaks of ice on a high deck."""
    up = np.maximum(d[..., 1], 0.02)
    x, z = d[..., 0] / up * CIRRUS_HEIGHT, d[..., 2] / up * CIRRUS_HEIGHT
    n = 1024
    fine, wide = _cirrus_tiles()
    turn = np.radians(28.0)
    along = (x * np.cos(turn) + z * np.sin(turn)) / CIRRUS_PERIOD * n
    across = (-x * np.sin(turn) + z * np.cos(turn)) / CIRRUS_PERIOD * n

    def at(tile: np.ndarray, u: np.ndarray, v: np.ndarray) -> np.ndarray:
        return ndimage.map_coordinates(tile, [u % n, v % n], order=1, mode="grid-wrap")

    bend = 26.0 * at(wide, along * 0.7 + 300.0, across * 0.7)
    streak = at(fine, along * 0.7 + bend, across * 1.7 + 1.4 * bend)
    gather = at(wide, along * 0.8, across * 0.8)
    amount = smoothstep(-0.3, 3.4, streak + 0.9 * gather) * smoothstep(-0.2, 1.6, gather)
    amount = 0.45 * amount * smoothstep(np.sin(0.07), np.sin(0.42), d[..., 1])
    sun = np.array(scene.sun)
    colour = 1.0 - np.exp(-(0.30 * sun + 0.7 * np.array(scene.shade)))
    return sky + amount[..., None] * (colour - sky)


@functools.lru_cache(maxsize=1)
def _cirrus_tiles() -> tuple[np.ndarray, np.ndarray]:
    """Return fine and wide noise for the cirrus, each (1024, 1024), tiling."""
    return spectral_noise(1024, 1.75, 51, low_cut=4.0), spectral_noise(1024, 2.4, 52, low_cut=1.0)
