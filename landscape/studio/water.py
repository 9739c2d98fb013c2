"""The water texture: a tile of wind waves as a brightness map, laid over the reflection.

A sea surface is a sum of sines whose amplitudes follow the Phillips spectrum with a directional
spread about the wind (Tessendorf, "Simulating Ocean Water", SIGGRAPH course 2001). Every wave
number is an integer per tile, so the sum repeats exactly; the longest waves are left out, because
one long crest in the tile shows as a pattern once the tile is laid many times. The picture is not
a photograph of water: it is what *modulates* the dark blue of the water layer. Facets that lean
to the bright horizon are light, facets that lean to the viewer are dark, a few mirror the sun.
"""

from collections.abc import Callable

import numpy as np
from scipy import ndimage

from landscape.studio.images import smoothstep, to_uint8

SIZE = 512  # texels; the report has a power of two
SEED = 2006  # chosen
WIND_DEG = 78.0  # chosen: across the tile, off the axis so that no crest follows the grid
SPREAD = 4.0  # chosen: exponent of the cosine about the wind; 2 is choppy, 20 is swell
LONGEST = 6.0  # chosen: waves per tile of the longest wave kept
PEAK = 10.0  # chosen: waves per tile where the spectrum stops growing
FINEST = 64.0  # chosen: waves per tile beyond which ripples are damped
MEAN = 0.75  # chosen: mean brightness; the water colour is already dark
TINT = np.array([0.89, 1.06, 1.04])  # chosen: the water colour is (0.2, 0.2, 0.4); add some green


def wave_field(seed: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return height and its slopes along columns and rows, each (SIZE, SIZE), tiling.

    The heights have deviation 1; slopes are per texel of the same scale.
    """
    rng = np.random.default_rng(seed)
    k_x = np.fft.fftfreq(SIZE)[None, :] * SIZE
    k_y = np.fft.fftfreq(SIZE)[:, None] * SIZE
    k = np.hypot(k_x, k_y)
    angle = np.arctan2(k_y, k_x) - np.radians(WIND_DEG)
    safe = np.maximum(k, 1.0)
    # Phillips: k^-4 in energy, cut below by the wind's longest wave and above by viscosity.
    energy = np.exp(-((PEAK / safe) ** 2)) * safe**-4.3 * np.exp(-((k / FINEST) ** 2))
    # Short ripples run in all directions, long waves follow the wind.
    spread = np.abs(np.cos(angle)) ** (2.0 * SPREAD / (1.0 + k / 60.0)) + 0.04
    amplitude = np.where(k >= LONGEST, np.sqrt(energy * spread), 0.0)
    spectrum = np.fft.fft2(rng.standard_normal((SIZE, SIZE))) * amplitude
    height = np.fft.ifft2(spectrum).real
    slope_x = np.fft.ifft2(spectrum * 2j * np.pi * k_x / SIZE).real
    slope_y = np.fft.ifft2(spectrum * 2j * np.pi * k_y / SIZE).real
    scale = height.std()
    return height / scale, slope_x / scale, slope_y / scale


def evened(field: np.ndarray, reach: float) -> np.ndarray:
    """Return a tiling field with the same strength everywhere, deviation 1.

    A group of waves that happens to be higher than the rest is what the eye finds again in every
    copy of the tile.
    """
    power = ndimage.gaussian_filter(field**2, reach, mode="wrap")
    return field / np.sqrt(power)


def water() -> np.ndarray:
    """Return the tile, (512, 512, 3) uint8, of mean brightness ``MEAN``."""
    height, slope_x, slope_y = wave_field(SEED)
    height = evened(height, 40.0)
    # Gerstner's sharpening without its displacement: crests narrow, troughs wide.
    crest = height + 0.22 * (height**2 - 1.0)
    wind = np.radians(WIND_DEG)
    facing = slope_x * np.cos(wind) + slope_y * np.sin(wind)
    facing = evened(facing, 26.0)
    tone = 0.12 * np.tanh(0.8 * facing) + 0.06 * np.tanh(crest)
    # Glints: facets near the one slope that mirrors the sun, strongest on the crests.
    across = evened(-slope_x * np.sin(wind) + slope_y * np.cos(wind), 26.0)
    glint = np.exp(-(((facing - 1.9) / 0.42) ** 2) - (across / 0.9) ** 2)
    glint *= smoothstep(-0.3, 1.2, crest)
    glint = 0.7 * glint + 0.3 * ndimage.gaussian_filter(glint, 1.2, mode="wrap")
    tone = tone + 0.30 * glint
    rgb = (tone - tone.mean() + MEAN)[..., None] * TINT / TINT.mean()
    rgb = rgb + 0.14 * glint[..., None] * np.array([1.0, 0.5, 0.3])  # glints lose the tint
    # A tile that repeats may begin anywhere: begin it where its columns differ least.
    change = np.abs(rgb - np.roll(rgb, 1, axis=1)).mean(axis=(0, 2))
    return to_uint8(np.roll(rgb, -int(change.argmin()), axis=1))


ASSETS: dict[str, Callable[[], np.ndarray]] = {"water.png": water}
