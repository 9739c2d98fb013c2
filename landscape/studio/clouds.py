"""The clouds of the sky box.

The shapes of the cumulus come from :mod:`landscape.studio.cumulus`; volumes of Worley and fractal
noise displace and fray their surfaces. They are ray marched with Beer's law and a few octaves of
attenuated light for the multiple scattering (Schneider 2015; Wrenninge et al. 2013). Cirrus lie on
a plane above them. Both depend on the view direction only.
"""

import functools

import numba
import numpy as np
from scipy import ndimage

from landscape.studio.air import Scene
from landscape.studio.cumulus import ACROSS, BELOW, HIGH, VOXEL, distance_field
from landscape.studio.grids import trilinear
from landscape.studio.images import smoothstep, spectral_noise

# Cumulus, in metres. Chosen: fair-weather clouds, low enough to look near.
BASE, DEPTH = 950.0, 1400.0  # height of the cloud base, and from there to the highest top
BILLOW_PERIOD, BILLOW = 1700.0, 190.0  # period and amplitude of the Worley displacement
CURL_PERIOD, CURL = 360.0, 74.0  # the same for a second, finer lookup in the same volume
WISP_PERIOD, WISP = 900.0, 42.0  # period and amplitude of the fractal displacement
EXTINCTION = 0.055  # per metre at full density
HAZE = 52.0  # width of the fringe of thin wisps
SOFT, HARD = 85.0, 22.0  # depth over which the density rises to 1, at the base and at the top
FAR = 27e3  # end of the march; beyond it the air hides the clouds
AIR_FADE = 23e3  # distance over which a cloud fades into the air by a factor e
CIRRUS_HEIGHT, CIRRUS_PERIOD = 9000.0, 52e3


@numba.njit(cache=False)
def _worley(size: int, cells: int, points: np.ndarray) -> np.ndarray:
    """Return tiling Worley noise (size,)*3: squared distance to the nearest point, in cells."""
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
                out[i, j, k] = best
    return out


@functools.lru_cache(maxsize=1)
def billows() -> np.ndarray:
    """Return inverted Worley noise of three sizes, tiling, (128, 128, 128) float32, mean 0."""
    rng = np.random.default_rng(31)
    total = np.zeros((128, 128, 128), np.float32)
    for cells, weight in ((4, 0.44), (8, 0.31), (16, 0.25)):
        # The squared distance gives round domes with creases between them; the distance, cones.
        total -= weight * _worley(128, cells, rng.random((cells, cells, cells, 3)))
    return total - total.mean()


@functools.lru_cache(maxsize=1)
def wisps() -> np.ndarray:
    """Return tiling fractal noise, (96, 96, 96) float32, mean 0, standard deviation 1."""
    size = 96
    k = np.fft.fftfreq(size) * size
    k3 = np.sqrt(k[:, None, None] ** 2 + k[None, :, None] ** 2 + k[None, None, :] ** 2)
    spectrum = np.fft.fftn(np.random.default_rng(32).standard_normal((size,) * 3))
    spectrum *= np.where(k3 > 1.5, np.maximum(k3, 1.0) ** -2.15, 0.0)
    noise = np.fft.ifftn(spectrum).real
    return (noise / noise.std()).astype(np.float32)


@numba.njit
def _depth(field: np.ndarray, x: float, y: float, z: float) -> float:
    """Look up the distance field (decimetres) trilinearly at a voxel position; return metres."""
    i, j, k = int(x), int(y), int(z)
    f, g, h = x - i, y - j, z - k
    a = field[i, k, j] * (1 - g) + field[i, k, j + 1] * g
    b = field[i, k + 1, j] * (1 - g) + field[i, k + 1, j + 1] * g
    c = field[i + 1, k, j] * (1 - g) + field[i + 1, k, j + 1] * g
    d = field[i + 1, k + 1, j] * (1 - g) + field[i + 1, k + 1, j + 1] * g
    return 0.1 * ((a * (1 - h) + b * h) * (1 - f) + (c * (1 - h) + d * h) * f)


@numba.njit
def _density(
    field: np.ndarray,
    clear: np.ndarray,
    billow_volume: np.ndarray,
    wisp_volume: np.ndarray,
    x: float,
    y: float,
    z: float,
    detail: bool,
) -> tuple[float, float]:
    """Return the density (0..1) and the surface displacement (metres) at a point (x, y, z).

    A negative density is minus a distance that is free of cloud. A negative displacement marks a
    crease, which sees little of the sky.
    """
    u, v, w = x / VOXEL + ACROSS // 2, (y - BASE) / VOXEL + BELOW, z / VOXEL + ACROSS // 2
    if v < 0.0 or v >= HIGH - 1.001:
        return -60.0, 0.0
    if u < 1.0 or u > ACROSS - 2.0 or w < 1.0 or w > ACROSS - 2.0:
        return -400.0, 0.0
    free_distance = clear[int(u), int(w)]
    if free_distance > 2.5 * VOXEL:
        return -(free_distance - 1.5 * VOXEL), 0.0
    value = _depth(field, u, v, w)
    if value < -95.0:
        return min(-8.0, value + 75.0), 0.0
    up = y - BASE
    s = wisp_volume.shape[0] / WISP_PERIOD
    fray = trilinear(wisp_volume, x * s, y * s, z * s)
    s = billow_volume.shape[0] / BILLOW_PERIOD
    displaced = BILLOW * trilinear(billow_volume, x * s, y * s, z * s)
    if detail:
        s = billow_volume.shape[0] / CURL_PERIOD
        displaced += CURL * trilinear(billow_volume, z * s + 3.0 * fray, x * s, y * s - 3.0 * fray)
    loose = 1.0 - min(1.0, max(0.0, up / 300.0))  # more ragged towards the base
    value += displaced + WISP * fray * (0.25 + 0.75 * loose) - 14.0 - 10.0 * loose
    # The base is nearly flat: water condenses from one height upwards.
    value = min(value, up * 1.2 + 14.0 * fray)
    # Wisps surround the body and are much thinner.
    edge = value + HAZE * min(1.0, max(0.0, fray - 0.1))
    if edge <= 0.0:
        return min(-4.0, 0.7 * edge), displaced
    soft = (HARD + (SOFT - HARD) * loose) * min(3.5, max(0.35, 1.0 + fray))
    return min(1.0, max(value / soft, 0.06 * min(1.0, edge / HAZE))), displaced


@numba.njit
def march(
    d: np.ndarray,
    field: np.ndarray,
    clear: np.ndarray,
    billow_volume: np.ndarray,
    wisp_volume: np.ndarray,
    sun: np.ndarray,
    steps_m: float,
) -> np.ndarray:
    """March each direction (n, 3); return (n, 4): sunlight, skylight, transmittance, distance.

    Sunlight and skylight are the light that reaches the eye per unit of each incident light.
    """
    out = np.zeros((d.shape[0], 4), np.float32)
    reaches = np.array([18.0, 50.0, 110.0, 220.0, 430.0, 800.0])
    for i in range(d.shape[0]):
        out[i, 2], out[i, 3] = 1.0, FAR
        slope = d[i, 1]
        if slope < 0.008:
            continue
        t, end = (BASE - 40.0) / slope, min((BASE + DEPTH) / slope, FAR)
        cos = d[i, 0] * sun[0] + d[i, 1] * sun[1] + d[i, 2] * sun[2]
        through, lit, filled, seen, weight, jump = 1.0, 0.0, 0.0, 0.0, 1e-6, 0.0
        while t < end and through > 0.01:
            fine = steps_m + 0.0012 * t
            x, y, z = d[i, 0] * t, slope * t, d[i, 2] * t
            rho, displaced = _density(field, clear, billow_volume, wisp_volume, x, y, z, True)
            if rho <= 0.0:
                jump = max(fine, -rho)
                t += jump
                continue
            if jump > 0.0:
                # Bisect for the surface between the last clear point and this one.
                low, high = t - jump, t
                for _ in range(5):
                    t = 0.5 * (low + high)
                    x, y, z = d[i, 0] * t, slope * t, d[i, 2] * t
                    if _density(field, clear, billow_volume, wisp_volume, x, y, z, True)[0] > 0.0:
                        high = t
                    else:
                        low = t
                t, jump = high + 0.35 * fine, 0.0
                x, y, z = d[i, 0] * t, slope * t, d[i, 2] * t
                rho, displaced = _density(field, clear, billow_volume, wisp_volume, x, y, z, True)
                rho = max(1e-3, rho)
            fine *= 2.0 if rho < 0.07 else 1.0  # wisps take longer steps
            sigma = EXTINCTION * rho
            absorbed = 1.0 - np.exp(-sigma * fine)
            tau, previous = 0.0, 0.0
            for s in range(6):
                r = 0.5 * (previous + reaches[s])
                at_x, at_y, at_z = x + sun[0] * r, y + sun[1] * r, z + sun[2] * r
                q, _ = _density(field, clear, billow_volume, wisp_volume, at_x, at_y, at_z, s < 3)
                tau += EXTINCTION * max(q, 0.0) * (reaches[s] - previous)
                previous = reaches[s]
            # Octaves of reduced extinction and anisotropy approximate multiple scattering.
            glow, gain, extinction_scale, g = 0.0, 1.0, 1.0, 0.60
            for _ in range(4):
                forward = (1 - g * g) / (1 + g * g - 2 * g * cos) ** 1.5
                back = (1 - 0.06) / (1 + 0.06 + 0.5 * cos) ** 1.5
                glow += (
                    gain
                    * (0.65 * forward + 0.35 * back)
                    * np.exp(-tau * extinction_scale)
                    / (4 * np.pi)
                )
                gain, extinction_scale, g = gain * 0.54, extinction_scale * 0.3, g * 0.5
            up = (y - BASE) / DEPTH
            crease = 1.0 / (1.0 + np.exp(-0.06 * displaced))
            lit += through * absorbed * (0.85 + 1.25 * crease) * glow
            overhead, _ = _density(field, clear, billow_volume, wisp_volume, x, y + 70.0, z, False)
            # Cloud overhead and creases hide the sky.
            open_sky = np.exp(-1.1 * max(0.0, overhead)) * crease
            filled += through * absorbed * (0.25 + 1.3 * min(1.0, 0.2 + up * 2.0) * open_sky)
            seen += through * absorbed * t
            weight += through * absorbed
            through *= 1.0 - absorbed
            t += fine
        out[i, 0], out[i, 1] = lit, filled
        out[i, 2] = max(0.0, (through - 0.01) / 0.99)
        out[i, 3] = seen / weight if weight > 1e-5 else FAR
    return out


def add_cumulus(scene: Scene, d: np.ndarray, sky: np.ndarray) -> np.ndarray:
    """Return the sky (h, w, 3) with the cumulus composited over it."""
    marched = march(
        d.reshape(-1, 3), *distance_field(), billows(), wisps(), scene.towards_sun(), 6.0
    )
    lit, filled, through, far = np.moveaxis(marched.reshape(*d.shape[:2], 4), -1, 0)
    through = np.clip(through, 0.0, 1.0)[..., None]
    cover = np.maximum(
        1.0 - through, 1e-3
    )  # un-premultiply: from here on, the colour of the cloud alone
    lit, filled = lit[..., None] / cover, filled[..., None] / cover
    cloud = lit * np.array(scene.sun) + filled * np.array(scene.shade)
    cloud += 0.7 * np.clip(1.0 - filled, 0.0, None) * np.array(scene.bounce)
    cloud = 1.0 - np.exp(-(cloud**1.15))  # chosen: white where lit, grey in the shade
    clear = np.exp(-np.clip(far, 0.0, FAR) / AIR_FADE)[..., None]
    return sky + (1.0 - through) * clear * (cloud - sky)


def add_cirrus(scene: Scene, d: np.ndarray, sky: np.ndarray) -> np.ndarray:
    """Return the sky (h, w, 3) with thin streaks of cirrus composited over it."""
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
    clusters = at(wide, along * 0.8, across * 0.8)
    amount = smoothstep(-0.3, 3.4, streak + 0.9 * clusters) * smoothstep(-0.2, 1.6, clusters)
    amount = 0.45 * amount * smoothstep(np.sin(0.07), np.sin(0.42), d[..., 1])
    sun = np.array(scene.sun)
    colour = 1.0 - np.exp(-(0.30 * sun + 0.7 * np.array(scene.shade)))
    return sky + amount[..., None] * (colour - sky)


@functools.lru_cache(maxsize=1)
def _cirrus_tiles() -> tuple[np.ndarray, np.ndarray]:
    """Return tiling noise for the cirrus, fine and coarse, each (1024, 1024)."""
    return spectral_noise(1024, 1.75, 51, low_cut=4.0), spectral_noise(1024, 2.4, 52, low_cut=1.0)
