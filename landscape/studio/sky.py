"""The sky box: five faces of one sky, at noon's light and at sunset.

The air is single scattering (Nishita et al. 1993) in a table over elevation and azimuth from the
sun. The cumulus are a layer of heaps: a map of heights, roughened by a Perlin-Worley volume and
marched with Beer's law and a few octaves of softened light for the multiple scattering (Schneider
2015; Wrenninge et al. 2013). Cirrus lie on a deck above. Behind the open sea stand far islands: a
height field swept column by column from near to far, each step more lost in the air. All is a
function of the direction alone, so that faces agree along their edges.

The box spans x and z in -8..8 and y in 0..5 with the eye at the centre of its floor. The first
and the last texel centres of a face lie ON its edges.
"""

import functools
from collections.abc import Callable
from dataclasses import dataclass

import numba
import numpy as np
from scipy import ndimage

from landscape.studio import light
from landscape.studio.images import smoothstep, spectral_noise, to_linear, to_srgb, to_uint8

HALF, TALL = 8.0, 5.0  # half width and height of the box, as the scene draws it

# Air: Nishita 1993 with the customary constants, metres.
EARTH, AIR_TOP = 6.360e6, 6.420e6
RAYLEIGH = np.array([5.8e-6, 13.5e-6, 33.1e-6])
OZONE = np.array([0.65e-6, 1.88e-6, 0.085e-6])  # absorption, Hillaire 2020: keeps dusk blue above
MIE, MIE_G = 5e-6, 0.76  # 21e-6 is hazy; an island has clean air
SCALE_R, SCALE_M = 7994.0, 1200.0

# Cumulus, metres. Chosen: fair-weather heaps, low enough to look near.
BASE, DEPTH = 950.0, 1150.0
MAP_PERIOD = 46e3  # of the map of heaps
HEAP_SEED = 841  # chosen by eye: the sun stands free
SHAPE_PERIOD = 3100.0  # of the volume that makes them lumpy
DETAIL_PERIOD = 640.0  # of the same volume, again, for the curls
EXTINCTION = 0.026  # per metre in the densest part
FAR = 70e3  # the march ends here; air hides the rest
AIR_FADE = 20e3  # distance in which a cloud is lost in the air by a factor e

CIRRUS_HEIGHT, CIRRUS_PERIOD = 9000.0, 52e3

# Far islands: azimuth (deg), then metres: distance, half width, half depth, height.
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
PANORAMA_DEG = 5.5  # height of the panorama of the islands
RIDGE_PERIOD = 30e3  # of the mountain texture, metres


@dataclass(frozen=True)
class Scene:
    """A time of day: where the sun is, and what the eye makes of it."""

    azimuth_deg: float
    elevation_deg: float
    horizon_srgb: tuple[float, float, float]
    haze_deg: float  # elevation in which the haze thins by a factor e
    exposure: float  # of the scattered light before 1 - exp(-x)
    glow: tuple[float, float, float]  # light scattered more than once, from every side
    saturation: float  # of the clear sky; the curve above pales it
    sun: tuple[float, float, float]  # light on the clouds
    shade: tuple[float, float, float]  # light from the sky above into the clouds
    bounce: tuple[float, float, float]  # light from the sea below
    far_air: tuple[float, float, float]  # what the air before the far land lacks of the haze
    wall_width: int

    def towards_sun(self) -> np.ndarray:
        """Return the unit vector (3,) towards the sun."""
        a, e = np.radians(self.azimuth_deg), np.radians(self.elevation_deg)
        return np.array([np.cos(e) * np.sin(a), np.sin(e), -np.cos(e) * np.cos(a)])


DAY = Scene(
    azimuth_deg=light.SUN_AZIMUTH_DEG,
    elevation_deg=light.SUN_ELEVATION_DEG,
    horizon_srgb=tuple(light.HORIZON_SRGB),
    haze_deg=3.2,
    exposure=0.95,
    glow=(0.10, 0.21, 0.40),
    saturation=1.2,
    sun=(9.6, 9.2, 8.5),
    shade=(0.30, 0.375, 0.50),
    bounce=(0.16, 0.20, 0.24),
    far_air=(0.40, 0.26, 0.11),
    wall_width=2048,
)
SUNSET = Scene(
    azimuth_deg=250.0,
    elevation_deg=5.0,
    horizon_srgb=(0.84, 0.66, 0.54),  # chosen: the fog to use with this sky
    haze_deg=2.6,
    exposure=1.0,
    glow=(0.20, 0.135, 0.30),
    saturation=1.35,
    sun=(6.2, 3.3, 1.5),
    shade=(0.26, 0.23, 0.34),
    bounce=(0.16, 0.11, 0.10),
    far_air=(0.50, 0.44, 0.22),
    wall_width=1024,
)


# ---- directions -------------------------------------------------------------------------------


def directions(face: str, width: int, height: int) -> np.ndarray:
    """Return unit vectors (height, width, 3) through the texel centres of a face."""
    across = np.linspace(-HALF, HALF, width)[None, :] + np.zeros((height, 1))
    if face == "top":
        down = np.linspace(-HALF, HALF, height)[:, None] + np.zeros((1, width))
        d = np.stack([across, np.full_like(across, TALL), down], axis=-1)
    else:
        up = np.linspace(TALL, 0.0, height)[:, None] + np.zeros((1, width))
        wall = np.full_like(across, HALF)
        x, z = {
            "north": (across, -wall),
            "east": (wall, across),
            "south": (-across, wall),
            "west": (-wall, -across),
        }[face]
        d = np.stack([x, up, z], axis=-1)
    # Rounded, so that the same direction met from two faces is the same to the last bit.
    return np.round(d / np.linalg.norm(d, axis=-1, keepdims=True), 9)


# ---- air --------------------------------------------------------------------------------------


def _leave(origin: np.ndarray, direction: np.ndarray, radius: float) -> np.ndarray:
    """Distance along each ray to the sphere of ``radius`` about the earth's centre."""
    b = np.sum(origin * direction, axis=-1)
    return -b + np.sqrt(np.maximum(b * b - np.sum(origin * origin, axis=-1) + radius**2, 0.0))


def scattered(scene: Scene, direction: np.ndarray, sun: np.ndarray) -> np.ndarray:
    """Return the light (..., 3) scattered towards an eye at sea level.

    Once from the sun, and, so that the horizon does not turn yellow, from a uniform glow that
    stands for all later orders (Hillaire 2020 tabulates it; over a clear sea it hardly varies).
    """
    samples = 24
    eye = np.array([0.0, EARTH + 5.0, 0.0])
    reach = _leave(eye, direction, AIR_TOP)
    cos = direction @ sun
    phase_r = 3 / (16 * np.pi) * (1 + cos**2)
    g = MIE_G
    phase_m = 3 / (8 * np.pi) * (1 - g * g) * (1 + cos**2)
    phase_m /= (2 + g * g) * (1 + g * g - 2 * g * cos) ** 1.5
    thick_r = np.zeros_like(cos)
    thick_m = np.zeros_like(cos)
    total_r = np.zeros((*cos.shape, 3))
    total_m = np.zeros((*cos.shape, 3))
    total_glow = np.zeros((*cos.shape, 3))
    for i in range(samples):
        # Quadratic steps: most of the air, and of the change, is near the eye.
        t0, t1 = (i / samples) ** 2, ((i + 1) / samples) ** 2
        point = eye + direction * (reach * (t0 + t1) / 2)[..., None]
        step = reach * (t1 - t0)
        up = np.linalg.norm(point, axis=-1) - EARTH
        air_r, air_m = np.exp(-up / SCALE_R) * step, np.exp(-up / SCALE_M) * step
        thick_r, thick_m = thick_r + air_r, thick_m + air_m
        out = _leave(point, sun, AIR_TOP) / 8
        sun_r = np.zeros_like(cos)
        sun_m = np.zeros_like(cos)
        sun_o = np.zeros_like(cos)
        for j in range(8):
            up = np.linalg.norm(point + sun * (out * (j + 0.5))[..., None], axis=-1) - EARTH
            sun_r = sun_r + np.exp(-up / SCALE_R) * out
            sun_m = sun_m + np.exp(-up / SCALE_M) * out
            sun_o = sun_o + np.clip(1.0 - np.abs(up - 25e3) / 15e3, 0.0, None) * out
        tau = RAYLEIGH * (thick_r + sun_r)[..., None] + 1.1 * MIE * (thick_m + sun_m)[..., None]
        tau = tau + OZONE * sun_o[..., None]
        fade = np.exp(-tau)
        seen = np.exp(-RAYLEIGH * thick_r[..., None] - 1.1 * MIE * thick_m[..., None])
        total_glow += seen * (RAYLEIGH * air_r[..., None] + MIE * air_m[..., None])
        total_r += fade * air_r[..., None]
        total_m += fade * air_m[..., None]
    once = total_r * RAYLEIGH * phase_r[..., None] + total_m * MIE * phase_m[..., None]
    return 20.0 * once + np.array(scene.glow) * total_glow


@functools.lru_cache(maxsize=2)
def air_table(scene: Scene) -> np.ndarray:
    """Return the displayed clear sky, linear (96, 96, 3): square root of elevation, azimuth."""
    elevation = np.radians(90.0) * np.linspace(0.0, 1.0, 96) ** 2
    azimuth = np.linspace(0.0, np.pi, 96)
    e, a = np.meshgrid(elevation, azimuth, indexing="ij")
    d = np.stack([np.cos(e) * np.sin(a), np.sin(e), np.cos(e) * np.cos(a)], axis=-1)
    s = np.radians(scene.elevation_deg)
    shown = 1.0 - np.exp(
        -scene.exposure * scattered(scene, d, np.array([0.0, np.sin(s), np.cos(s)]))
    )
    grey = shown.mean(axis=-1, keepdims=True)
    return np.clip(grey + scene.saturation * (shown - grey), 0.0, 1.0)


def clear_sky(scene: Scene, d: np.ndarray) -> np.ndarray:
    """Return the displayed clear sky, linear, for unit vectors (..., 3) above the horizon."""
    elevation = np.arcsin(np.clip(d[..., 1], 0.0, 1.0))
    turn = np.arctan2(d[..., 0], -d[..., 2]) - np.radians(scene.azimuth_deg)
    away = np.abs((turn + np.pi) % (2 * np.pi) - np.pi)
    where = [np.sqrt(elevation / (np.pi / 2)) * 95, away / np.pi * 95]
    table = air_table(scene)
    return np.stack(
        [ndimage.map_coordinates(table[..., c], where, order=3, mode="mirror") for c in range(3)],
        axis=-1,
    )


# ---- cumulus ----------------------------------------------------------------------------------


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
        spectral_noise(1024, 1.3, HEAP_SEED + 1, low_cut=11.0), 6.0, mode="wrap"
    )
    small = ndimage.gaussian_filter(
        spectral_noise(1024, 1.0, HEAP_SEED + 2, low_cut=26.0), 6.0, mode="wrap"
    )
    wide, small = wide / wide.std(), small / small.std()
    return (0.34 * wide + 0.15 * small + 0.20 * gather - 0.42).astype(np.float32)


@numba.njit
def _flat(grid: np.ndarray, u: float, v: float) -> float:
    """Bilinear lookup in a wrapping square, u and v in texels."""
    n = grid.shape[0]
    i, j = int(np.floor(u)), int(np.floor(v))
    f, g = u - i, v - j
    i, j = i % n, j % n
    i1, j1 = (i + 1) % n, (j + 1) % n
    return (grid[i, j] * (1 - g) + grid[i, j1] * g) * (1 - f) + (
        grid[i1, j] * (1 - g) + grid[i1, j1] * g
    ) * f


@numba.njit
def _solid(grid: np.ndarray, x: float, y: float, z: float) -> float:
    """Trilinear lookup in a wrapping cube, in texels."""
    n = grid.shape[0]
    i, j, k = int(np.floor(x)), int(np.floor(y)), int(np.floor(z))
    f, g, h = x - i, y - j, z - k
    i, j, k = i % n, j % n, k % n
    i1, j1, k1 = (i + 1) % n, (j + 1) % n, (k + 1) % n
    a = grid[i, j, k] * (1 - h) + grid[i, j, k1] * h
    b = grid[i, j1, k] * (1 - h) + grid[i, j1, k1] * h
    c = grid[i1, j, k] * (1 - h) + grid[i1, j, k1] * h
    d = grid[i1, j1, k] * (1 - h) + grid[i1, j1, k1] * h
    return (a * (1 - g) + b * g) * (1 - f) + (c * (1 - g) + d * g) * f


@numba.njit
def _density(
    tops: np.ndarray, volume: np.ndarray, x: float, y: float, z: float, detail: bool
) -> float:
    """Return how deep inside a cloud a point is: density if positive, else depths to go."""
    up = (y - BASE) / DEPTH
    if up < 0.0 or up > 1.25:
        return -0.3
    n = tops.shape[0]
    heap = _flat(tops, x / MAP_PERIOD * n, z / MAP_PERIOD * n)
    # A clearing overhead keeps single clouds from filling the view; far off they are fewer, or
    # perspective would close their ranks into a wall above the horizon.
    away = np.sqrt(x * x + z * z)
    heap -= 0.32 * min(1.0, max(0.0, (away - 7e3) / 30e3))
    heap -= 0.60 * min(1.0, max(0.0, (4.6e3 - away) / 3.0e3))
    # A round shoulder above the edge; outside, a steep fall, so that no crumbs float about.
    heap = 1.25 * heap**0.6 / (1.0 + 0.35 * heap) if heap > 0.0 else heap * 2.6
    value = heap - up
    if value < -0.55:
        return value + 0.45
    s = volume.shape[0] / SHAPE_PERIOD
    lump = _solid(volume, x * s, y * s, z * s)
    value += 0.22 * lump
    if detail and value > -0.2:
        s = volume.shape[0] / DETAIL_PERIOD
        curl = _solid(volume, z * s + 31.0, x * s, y * s * 1.1)
        value += 0.06 * curl - 0.02
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
            fine = steps_m + 0.0035 * t
            x, y, z = d[i, 0] * t, slope * t, d[i, 2] * t
            rho = _density(tops, volume, x, y, z, True)
            if rho <= 0.0:
                jump = max(fine, -rho * 220.0)
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
            sigma = EXTINCTION * min(1.0, rho * 8.0)
            absorbed = 1.0 - np.exp(-sigma * fine)
            tau, before = 0.0, 0.0
            for s in range(6):
                r = 0.5 * (before + reaches[s])
                q = _density(tops, volume, x + sun[0] * r, y + sun[1] * r, z + sun[2] * r, s < 2)
                tau += EXTINCTION * min(1.0, max(q, 0.0) * 8.0) * (reaches[s] - before)
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


# ---- far islands ------------------------------------------------------------------------------


@functools.lru_cache(maxsize=1)
def ridges() -> np.ndarray:
    """Return the tiling mountain texture, (1024, 1024) float32 in about 0..1."""
    total = np.zeros((1024, 1024))
    weight = np.ones((1024, 1024))
    for octave in range(6):
        noise = spectral_noise(1024, 3.0, 61 + octave, low_cut=3.0 * 2**octave)
        sharp = (1.0 - np.minimum(np.abs(noise) / 2.4, 1.0)) ** 1.5
        total += sharp * weight * 0.5**octave
        weight = np.clip(sharp * 1.6, 0.0, 1.0)
    total -= total.min()
    return (total / total.max()).astype(np.float32)


@numba.njit
def _ground(x: float, z: float, islands: np.ndarray, texture: np.ndarray) -> float:
    """Height of the far land at a point, negative at sea; metres."""
    n = texture.shape[0]
    peak = _flat(texture, x / RIDGE_PERIOD * n, z / RIDGE_PERIOD * n)
    wobble = _flat(texture, x / 90e3 * n + 200.0, z / 90e3 * n) - 0.4
    best = -50.0
    for k in range(islands.shape[0]):
        a = np.radians(islands[k, 0])
        c, s = np.cos(a), np.sin(a)
        away = (x * s - z * c - islands[k, 1]) / islands[k, 3]
        side = (x * c + z * s) / islands[k, 2]
        r = away * away + side * side
        if r < 4.0:
            mask = np.exp(-1.6 * r) - 0.10 + 0.35 * wobble * np.exp(-0.6 * r)
            best = max(best, islands[k, 4] * mask * (0.35 + 1.75 * peak))
    return best


@numba.njit
def _sweep(
    columns: int, rows: int, islands: np.ndarray, texture: np.ndarray, sun: np.ndarray
) -> np.ndarray:
    """Return (rows, columns, 3), row 0 at the horizon: cover, light on the land, distance."""
    out = np.zeros((rows, columns, 3), np.float32)
    for i in range(columns):
        a = 2 * np.pi * (i + 0.5) / columns
        s, c = np.sin(a), -np.cos(a)
        filled, t = 0, 17e3
        while t < 75e3:
            y = _ground(s * t, c * t, islands, texture)
            if y > 0.0:
                top = (y - t * t / 14.9e6) / t  # the sea curves away; air bends the light a little
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
    """Return the islands all round, (192, 8192, 3): cover, cover * light, cover * clearness."""
    swept = _sweep(16384, 768, ISLANDS, ridges(), scene.towards_sun())
    cover = swept[..., 0]
    clear = np.exp(-swept[..., 2] / 26e3) * 2.0
    layers = np.stack([cover, cover * swept[..., 1], cover * np.minimum(clear, 1.0)], axis=-1)
    return layers.reshape(192, 4, 8192, 2, 3).mean(axis=(1, 3))


def add_islands(scene: Scene, d: np.ndarray, sky: np.ndarray, haze: np.ndarray) -> np.ndarray:
    """Return the sky with the far islands before it; ``haze`` (3,) is the colour at sea level."""
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
    # The feet dissolve in the haze; above it the air before the land is bluer than the sky's.
    risen = 1.0 - np.exp(-np.clip(elevation, 0.0, None)[..., None] / 0.7)
    clear = clear[..., None] * risen
    tone = np.array([0.035, 0.062, 0.075]) + lit[..., None] * np.array(scene.sun) * np.array(
        [0.017, 0.019, 0.013]
    )
    air = haze * (1.0 - risen * np.array(scene.far_air))
    land = clear * tone + (1.0 - clear) * air
    return sky + cover[..., None] * (land - sky)


# ---- faces ------------------------------------------------------------------------------------


def compose(scene: Scene, d: np.ndarray) -> np.ndarray:
    """Return the linear colours (h, w, 3) of the directions, all layers over one another."""
    sky = clear_sky(scene, d)
    away = np.degrees(np.arccos(np.clip(d @ scene.towards_sun(), -1.0, 1.0)))
    glow = 0.30 * np.exp(-away / 5.0) + 0.5 * np.exp(-away / 1.4) + 3.0 * smoothstep(0.9, 0.6, away)
    tint = np.array(scene.sun) / max(scene.sun)
    sky = 1.0 - (1.0 - sky) * np.exp(-glow[..., None] * tint)
    sky = add_cirrus(scene, d, sky)
    sky = add_cumulus(scene, d, sky)
    haze = to_linear(np.array(scene.horizon_srgb))
    elevation = np.degrees(np.arcsin(np.clip(d[..., 1:2], 0.0, 1.0)))
    sky = sky + np.exp(-elevation / scene.haze_deg) * (haze - sky)
    return add_islands(scene, d, sky, haze)


def paint(scene: Scene, face: str) -> np.ndarray:
    """Return one face of the box, (h, w, 3) uint8."""
    width, height = scene.wall_width, scene.wall_width // 4
    if face == "top":
        width = height = scene.wall_width // 2
    d = directions(face, width, height)
    sky = to_srgb(compose(scene, d))
    if face != "top":
        # The top face has half the texels along this edge: take its colours, or cloud edges finer
        # than its texels would show as a seam.
        coarse = to_srgb(compose(scene, directions(face, width // 2, 2)[:1])[0])
        x, x_coarse = np.linspace(0, 1, width), np.linspace(0, 1, width // 2)
        sky[0] = np.stack([np.interp(x, x_coarse, channel) for channel in coarse.T], axis=-1)
    # Less than a level of noise breaks the contours that 8 bits draw in a smooth sky; none at the
    # horizon, which is the colour of the fog.
    dither = np.random.default_rng(71).random((height, width, 1)) - 0.5
    dither = dither * smoothstep(0.0, 0.007, d[..., 1:2])
    return to_uint8(sky + 0.7 * dither / 255.0)


FACES = ("north", "east", "south", "west", "top")
ASSETS: dict[str, Callable[[], np.ndarray]] = {
    **{f"sky_{face}.png": functools.partial(paint, DAY, face) for face in FACES},
    **{f"sky_sunset_{face}.png": functools.partial(paint, SUNSET, face) for face in FACES},
}
