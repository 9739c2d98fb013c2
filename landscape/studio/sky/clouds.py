"""The clouds of the sky box.

The shapes of the cumulus come from :mod:`landscape.studio.sky.cumulus`; volumes of Worley and
fractal noise displace and fray their surfaces. They are ray marched with Beer's law and a few
octaves of attenuated light for the multiple scattering (Schneider 2015; Wrenninge et al. 2013).
Cirrus lie on a plane above them. Both depend on the view direction only.

There are two looks: TOWERS is that of the sky of the preset 2006, DOMES of that of best.
"""

import functools
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numba
import numpy as np

from landscape.studio.grids import trilinear
from landscape.studio.sky import domes, towers
from landscape.studio.sky.air import Scene
from landscape.studio.sky.cirrus import fibres, streaks
from landscape.studio.sky.cumulus import ACROSS, BELOW, VOXEL, distance_field

# Cumulus, in metres. Chosen: fair-weather clouds, low enough to look near.
BASE = 950.0  # height of the cloud base
BILLOW_PERIOD, BILLOW = 1700.0, 190.0  # period and amplitude of the Worley displacement
WISP_PERIOD, WISP = 900.0, 42.0  # period and amplitude of the fractal displacement
EXTINCTION = 0.055  # per metre at full density
FAR = 27e3  # end of the march; beyond it the air hides the clouds


class Body(NamedTuple):
    """The shape of a cumulus; lengths are in metres."""

    depth: float  # from the base to the highest top
    curl_period: float  # of a second, finer lookup of the Worley displacement
    curl: float  # its amplitude
    frayed: float  # fraction of the fractal displacement at the top; it is whole at the base
    haze: float  # width of the fringe of thin wisps
    soft: float  # depth over which the density rises to 1, at the base
    hard: float  # the same at the top
    fringe: float  # farther out no fine noise is looked up
    solid: float  # nor deeper inside, for light
    from_sample: int  # of those towards the sun; with 1 the nearest is the marched point itself
    gain: float  # brightness of an octave of scattering over that of the one before


@dataclass(frozen=True)
class Look:
    """How the clouds of a sky are made and lit."""

    spheres: Callable[[], np.ndarray]  # of all clouds; see distance_field
    high: int  # voxels, height of the distance field
    body: Body
    air_fade: float  # distance over which a cloud fades into the air by a factor e
    bright: float  # multiplies the light before the tone curve
    contrast: float  # exponent of the light before the tone curve
    toned: float  # fraction of the tone curve that is applied to the brightness alone
    cirrus: Callable[[Scene, np.ndarray], np.ndarray]
    cirrus_sun: float  # fraction of the sunlight on them
    veiled_sun: bool  # haze and clouds are in front of the sun's disc


TOWERS = Look(
    spheres=towers.all_spheres,
    high=34,
    body=Body(1400.0, 360.0, 74.0, 0.25, 52.0, 85.0, 22.0, np.inf, np.inf, 0, 0.54),
    air_fade=23e3,
    bright=1.0,
    contrast=1.15,
    toned=0.0,
    cirrus=streaks,
    cirrus_sun=0.30,
    veiled_sun=True,
)
DOMES = Look(
    spheres=domes.all_spheres,
    high=45,
    body=Body(1950.0, 400.0, 92.0, 0.12, 44.0, 80.0, 15.0, 75.0, 140.0, 1, 0.50),
    air_fade=34e3,
    bright=1.3,
    contrast=1.35,
    toned=0.5,  # or the lit sides would be yellow at sunset
    cirrus=fibres,
    cirrus_sun=0.18,
    veiled_sun=False,
)


@numba.njit(cache=False)
def _worley(size: int, cells: int, points: np.ndarray) -> np.ndarray:
    """Return tiling Worley noise (size,)*3: squared distance to the nearest point, in cells."""
    out = np.empty((size, size, size), np.float32)
    for i in range(size):
        for j in range(size):
            for k in range(size):
                x = i * cells / size
                y = j * cells / size
                z = k * cells / size
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
    i = int(x)
    j = int(y)
    k = int(z)
    f = x - i
    g = y - j
    h = z - k
    a = field[i, k, j] * (1 - g) + field[i, k, j + 1] * g
    b = field[i, k + 1, j] * (1 - g) + field[i, k + 1, j + 1] * g
    c = field[i + 1, k, j] * (1 - g) + field[i + 1, k, j + 1] * g
    d = field[i + 1, k + 1, j] * (1 - g) + field[i + 1, k + 1, j + 1] * g
    return 0.1 * ((a * (1 - h) + b * h) * (1 - f) + (c * (1 - h) + d * h) * f)


@numba.njit
def _density(
    body: Body,
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
    u = x / VOXEL + ACROSS // 2
    v = (y - BASE) / VOXEL + BELOW
    w = z / VOXEL + ACROSS // 2
    if v < 0.0 or v >= field.shape[2] - 1.001:
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
    if not detail and value > body.solid and up > body.solid:
        return 1.0, 0.0
    s = billow_volume.shape[0] / BILLOW_PERIOD
    displaced = BILLOW * trilinear(billow_volume, x * s, y * s, z * s)
    if value + displaced < -body.fringe:
        return min(-4.0, 0.7 * (value + displaced + 0.8 * body.fringe)), displaced
    s = wisp_volume.shape[0] / WISP_PERIOD
    fray = trilinear(wisp_volume, x * s, y * s, z * s)
    if detail:
        s = billow_volume.shape[0] / body.curl_period
        shift = 3.0 * fray
        displaced += body.curl * trilinear(billow_volume, z * s + shift, x * s, y * s - shift)

    loose = 1.0 - min(1.0, max(0.0, up / 300.0))  # more ragged towards the base
    value += (
        displaced + WISP * fray * (body.frayed + (1.0 - body.frayed) * loose) - 14.0 - 10.0 * loose
    )

    # The base is nearly flat: water condenses from one height upwards.
    value = min(value, up * 1.2 + 14.0 * fray)

    # Wisps surround the body and are much thinner.
    edge = value + body.haze * min(1.0, max(0.0, fray - 0.1))
    if edge <= 0.0:
        return min(-4.0, 0.7 * edge), displaced
    soft = (body.hard + (body.soft - body.hard) * loose) * min(3.5, max(0.35, 1.0 + fray))
    return min(1.0, max(value / soft, 0.06 * min(1.0, edge / body.haze))), displaced


@numba.njit
def march(
    d: np.ndarray,
    body: Body,
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
        t, end = (BASE - 40.0) / slope, min((BASE + body.depth) / slope, FAR)
        cos = d[i, 0] * sun[0] + d[i, 1] * sun[1] + d[i, 2] * sun[2]
        through = 1.0
        lit = 0.0
        filled = 0.0
        seen = 0.0
        weight = 1e-6
        jump = 0.0
        while t < end and through > 0.01:
            fine = steps_m + 0.0012 * t
            x = d[i, 0] * t
            y = slope * t
            z = d[i, 2] * t
            rho, displaced = _density(body, field, clear, billow_volume, wisp_volume, x, y, z, True)
            if rho <= 0.0:
                jump = max(fine, -rho)
                t += jump
                continue
            if jump > 0.0:
                # Bisect for the surface between the last clear point and this one.
                low, high = t - jump, t
                for _ in range(5):
                    t = 0.5 * (low + high)
                    x = d[i, 0] * t
                    y = slope * t
                    z = d[i, 2] * t
                    if (
                        _density(body, field, clear, billow_volume, wisp_volume, x, y, z, True)[0]
                        > 0.0
                    ):
                        high = t
                    else:
                        low = t
                t, jump = high + 0.35 * fine, 0.0
                x = d[i, 0] * t
                y = slope * t
                z = d[i, 2] * t
                rho, displaced = _density(
                    body, field, clear, billow_volume, wisp_volume, x, y, z, True
                )
                rho = max(1e-3, rho)
            fine *= 2.0 if rho < 0.07 else 1.0  # wisps take longer steps
            sigma = EXTINCTION * rho
            absorbed = 1.0 - np.exp(-sigma * fine)
            previous = reaches[0] if body.from_sample else 0.0
            tau = EXTINCTION * rho * previous
            for s in range(body.from_sample, 6):
                r = 0.5 * (previous + reaches[s])
                at_x = x + sun[0] * r
                at_y = y + sun[1] * r
                at_z = z + sun[2] * r
                q, _ = _density(
                    body, field, clear, billow_volume, wisp_volume, at_x, at_y, at_z, s < 3
                )
                tau += EXTINCTION * max(q, 0.0) * (reaches[s] - previous)
                previous = reaches[s]
            # Octaves of reduced extinction and anisotropy approximate multiple scattering.
            glow = 0.0
            gain = 1.0
            extinction_scale = 1.0
            g = 0.60
            for _ in range(4):
                forward = (1 - g * g) / (1 + g * g - 2 * g * cos) ** 1.5
                back = (1 - 0.06) / (1 + 0.06 + 0.5 * cos) ** 1.5
                glow += (
                    gain
                    * (0.65 * forward + 0.35 * back)
                    * np.exp(-tau * extinction_scale)
                    / (4 * np.pi)
                )
                gain = gain * body.gain
                extinction_scale = extinction_scale * 0.3
                g = g * 0.5
            up = (y - BASE) / body.depth
            crease = 1.0 / (1.0 + np.exp(-0.06 * displaced))
            lit += through * absorbed * (0.85 + 1.25 * crease) * glow
            overhead, _ = _density(
                body, field, clear, billow_volume, wisp_volume, x, y + 70.0, z, False
            )
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


def add_cumulus(scene: Scene, look: Look, d: np.ndarray, sky: np.ndarray) -> np.ndarray:
    """Return the sky (h, w, 3) with the cumulus composited over it."""
    shapes = distance_field(look.spheres, look.high)
    sun = scene.towards_sun(scene.sun_on_clouds_deg)
    marched = march(d.reshape(-1, 3), look.body, *shapes, billows(), wisps(), sun, 6.0)
    lit, filled, through, far = np.moveaxis(marched.reshape(*d.shape[:2], 4), -1, 0)
    through = np.clip(through, 0.0, 1.0)[..., None]
    cover = np.maximum(
        1.0 - through, 1e-3
    )  # un-premultiply: from here on, the colour of the cloud alone
    lit, filled = lit[..., None] / cover, filled[..., None] / cover
    cloud = lit * np.array(scene.sun) + filled * np.array(scene.shade)
    cloud += 0.7 * np.clip(1.0 - filled, 0.0, None) * np.array(scene.bounce)

    # Chosen: white where lit, grey in the shade.
    cloud = look.bright * cloud**look.contrast
    bright = np.maximum(cloud.max(axis=-1, keepdims=True), 1e-6)
    by_channel, by_brightness = 1.0 - np.exp(-cloud), cloud * (1.0 - np.exp(-bright)) / bright
    cloud = (1.0 - look.toned) * by_channel + look.toned * by_brightness
    clear = np.exp(-np.clip(far, 0.0, FAR) / look.air_fade)[..., None]
    return sky + (1.0 - through) * clear * (cloud - sky)


def add_cirrus(scene: Scene, look: Look, d: np.ndarray, sky: np.ndarray) -> np.ndarray:
    """Return the sky (h, w, 3) with cirrus composited over it."""
    sun = np.array(scene.sun)
    colour = 1.0 - np.exp(-(look.cirrus_sun * sun + 0.7 * np.array(scene.shade)))
    return sky + look.cirrus(scene, d)[..., None] * (colour - sky)
