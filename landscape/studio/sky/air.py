"""The atmosphere: the clear sky at a given time of day.

Single scattering (Nishita et al. 1993), tabulated over elevation and azimuth relative to the sun.
All values are linear light; the axes are those of :mod:`landscape.studio.light`.
"""

import functools
from dataclasses import dataclass, replace

import numpy as np
from scipy import ndimage

from landscape.studio import light

# Atmosphere: the usual constants of Nishita 1993, in metres.
EARTH, AIR_TOP = 6.360e6, 6.420e6
RAYLEIGH = np.array([5.8e-6, 13.5e-6, 33.1e-6])
OZONE = np.array(
    [0.65e-6, 1.88e-6, 0.085e-6]
)  # absorption, Hillaire 2020: keeps the zenith blue at dusk
MIE, MIE_G = 5e-6, 0.76  # chosen: clean sea air; the usual 21e-6 is hazy
SCALE_R, SCALE_M = 7994.0, 1200.0


@dataclass(frozen=True)
class Scene:
    """A time of day: the sun's position and the colours and exposure of the sky."""

    azimuth_deg: float
    elevation_deg: float
    horizon_srgb: tuple[float, float, float]
    haze_deg: float  # elevation over which the haze thins by a factor e
    exposure: float  # multiplies the scattered light before the tone curve 1 - exp(-x)
    glow: tuple[float, float, float]  # uniform light that stands for multiple scattering
    saturation: float  # of the clear sky; makes up for the tone curve, which desaturates it
    tint: tuple[float, float, float]  # multiplies the sunlight scattered once
    sun: tuple[float, float, float]  # sunlight on the clouds
    sun_on_clouds_deg: float  # elevation of that sunlight; a low one reaches the bases
    shade: tuple[float, float, float]  # skylight on the clouds
    bounce: tuple[float, float, float]  # light from the sea on the undersides of the clouds
    far_air: tuple[float, float, float]  # fraction of the haze's colour lost in front of far land
    wall_width: int

    def towards_sun(self, elevation_deg: float | None = None) -> np.ndarray:
        """Return the unit vector (3,) towards the sun, or one at another elevation below it."""
        high = self.elevation_deg if elevation_deg is None else elevation_deg
        a, e = np.radians(self.azimuth_deg), np.radians(high)
        return np.array([np.cos(e) * np.sin(a), np.sin(e), -np.cos(e) * np.cos(a)])


DAY = Scene(
    azimuth_deg=light.SUN_AZIMUTH_DEG,
    elevation_deg=light.SUN_ELEVATION_DEG,
    horizon_srgb=tuple(light.HORIZON_SRGB),
    haze_deg=3.2,
    exposure=0.95,
    glow=(0.10, 0.21, 0.40),
    saturation=1.2,
    tint=(1.0, 1.0, 1.0),
    sun=(9.6, 9.2, 8.5),
    sun_on_clouds_deg=light.SUN_ELEVATION_DEG,
    shade=(0.30, 0.375, 0.50),
    bounce=(0.16, 0.20, 0.24),
    far_air=(0.40, 0.26, 0.11),
    wall_width=2048,
)
SUNSET = Scene(
    azimuth_deg=250.0,
    elevation_deg=4.0,
    horizon_srgb=(0.86, 0.62, 0.50),  # chosen: the fog to use with this sky
    haze_deg=4.5,
    exposure=0.85,
    glow=(0.30, 0.10, 0.22),
    saturation=2.0,
    tint=(1.0, 1.0, 1.0),
    sun=(9.5, 2.9, 0.8),
    sun_on_clouds_deg=4.0,
    shade=(0.24, 0.15, 0.32),
    bounce=(0.20, 0.10, 0.08),
    far_air=(0.50, 0.44, 0.22),
    wall_width=1024,
)
FAIR = replace(DAY, sun=(9.6, 9.3, 8.7), shade=(0.30, 0.40, 0.58))
DUSK = replace(
    SUNSET,
    haze_deg=5.5,
    exposure=1.15,
    glow=(0.15, 0.20, 0.33),
    saturation=1.7,
    tint=(1.1, 0.88, 0.82),
    sun=(8.6, 3.0, 1.05),
    sun_on_clouds_deg=-1.0,
    shade=(0.20, 0.17, 0.36),
    wall_width=2048,
)


def _distance_to_sphere(origin: np.ndarray, direction: np.ndarray, radius: float) -> np.ndarray:
    """Return the distance along each ray to the sphere of ``radius`` about the earth's centre."""
    b = np.sum(origin * direction, axis=-1)
    return -b + np.sqrt(np.maximum(b * b - np.sum(origin * origin, axis=-1) + radius**2, 0.0))


def scattered(scene: Scene, direction: np.ndarray, sun: np.ndarray) -> np.ndarray:
    """Return the light (..., 3) scattered towards an eye at sea level.

    This is single scattering of sunlight plus a uniform glow that stands for all higher orders;
    without the glow the horizon turns yellow. (Hillaire 2020 tabulates the higher orders; over a
    clear sea they hardly vary.)
    """
    samples = 24
    eye = np.array([0.0, EARTH + 5.0, 0.0])
    ray_length = _distance_to_sphere(eye, direction, AIR_TOP)
    cos = direction @ sun
    phase_r = 3 / (16 * np.pi) * (1 + cos**2)
    g = MIE_G
    phase_m = 3 / (8 * np.pi) * (1 - g * g) * (1 + cos**2)
    phase_m /= (2 + g * g) * (1 + g * g - 2 * g * cos) ** 1.5
    depth_r = np.zeros_like(cos)
    depth_m = np.zeros_like(cos)
    total_r = np.zeros((*cos.shape, 3))
    total_m = np.zeros((*cos.shape, 3))
    total_glow = np.zeros((*cos.shape, 3))
    for i in range(samples):
        # Quadratic steps, because most of the air and most of the change is near the eye.
        t0, t1 = (i / samples) ** 2, ((i + 1) / samples) ** 2
        point = eye + direction * (ray_length * (t0 + t1) / 2)[..., None]
        step = ray_length * (t1 - t0)
        up = np.linalg.norm(point, axis=-1) - EARTH
        air_r, air_m = np.exp(-up / SCALE_R) * step, np.exp(-up / SCALE_M) * step
        depth_r, depth_m = depth_r + air_r, depth_m + air_m
        out = _distance_to_sphere(point, sun, AIR_TOP) / 8
        sun_r = np.zeros_like(cos)
        sun_m = np.zeros_like(cos)
        sun_o = np.zeros_like(cos)
        for j in range(8):
            up = np.linalg.norm(point + sun * (out * (j + 0.5))[..., None], axis=-1) - EARTH
            sun_r = sun_r + np.exp(-up / SCALE_R) * out
            sun_m = sun_m + np.exp(-up / SCALE_M) * out
            sun_o = sun_o + np.clip(1.0 - np.abs(up - 25e3) / 15e3, 0.0, None) * out
        tau = RAYLEIGH * (depth_r + sun_r)[..., None] + 1.1 * MIE * (depth_m + sun_m)[..., None]
        tau = tau + OZONE * sun_o[..., None]
        attenuation = np.exp(-tau)
        transmitted = np.exp(-RAYLEIGH * depth_r[..., None] - 1.1 * MIE * depth_m[..., None])
        total_glow += transmitted * (RAYLEIGH * air_r[..., None] + MIE * air_m[..., None])
        total_r += attenuation * air_r[..., None]
        total_m += attenuation * air_m[..., None]

    single = total_r * RAYLEIGH * phase_r[..., None] + total_m * MIE * phase_m[..., None]
    return 20.0 * np.array(scene.tint) * single + np.array(scene.glow) * total_glow


@functools.lru_cache(maxsize=2)
def air_table(scene: Scene) -> np.ndarray:
    """Return the tone-mapped clear sky, linear (96, 96, 3), over sqrt(elevation) and azimuth."""
    elevation = np.radians(90.0) * np.linspace(0.0, 1.0, 96) ** 2
    azimuth = np.linspace(0.0, np.pi, 96)
    e, a = np.meshgrid(elevation, azimuth, indexing="ij")
    d = np.stack([np.cos(e) * np.sin(a), np.sin(e), np.cos(e) * np.cos(a)], axis=-1)
    s = np.radians(scene.elevation_deg)
    displayed = 1.0 - np.exp(
        -scene.exposure * scattered(scene, d, np.array([0.0, np.sin(s), np.cos(s)]))
    )
    grey = displayed.mean(axis=-1, keepdims=True)
    return np.clip(grey + scene.saturation * (displayed - grey), 0.0, 1.0)


def clear_sky(scene: Scene, d: np.ndarray) -> np.ndarray:
    """Return the tone-mapped clear sky, linear, for unit vectors (..., 3) above the horizon."""
    elevation = np.arcsin(np.clip(d[..., 1], 0.0, 1.0))
    turn = np.arctan2(d[..., 0], -d[..., 2]) - np.radians(scene.azimuth_deg)
    from_sun = np.abs((turn + np.pi) % (2 * np.pi) - np.pi)
    where = [np.sqrt(elevation / (np.pi / 2)) * 95, from_sun / np.pi * 95]
    table = air_table(scene)
    return np.stack(
        [ndimage.map_coordinates(table[..., c], where, order=3, mode="mirror") for c in range(3)],
        axis=-1,
    )
