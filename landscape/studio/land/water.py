"""The water texture: a tile of wind waves as a brightness map, blended over the reflection.

The sea surface is a sum of sines whose amplitudes follow the Phillips spectrum with a directional
spread around the wind (Tessendorf, "Simulating Ocean Water", SIGGRAPH course 2001). All wave
numbers are integers per tile, so the sum tiles exactly. The longest waves are left out, because a
single long crest shows as a pattern when the tile is repeated. The texture *modulates* the dark
blue of the water surface: facets tilted towards the bright horizon are light, facets tilted towards
the viewer are dark, and a few reflect the sun.
"""

from collections.abc import Callable

import numpy as np
from scipy import ndimage

from landscape.studio.images import smoothstep, to_uint8

SIZE = 512  # texels; a power of two, as in the report
SEED = 2006  # chosen
WIND_DEG = 78.0  # chosen: off the axes, so that no crest is aligned with the tile
SPREAD = 4.0  # chosen: exponent of the cosine around the wind; 2 is choppy, 20 is swell
LONGEST = 6.0  # chosen: wave number of the longest wave, cycles per tile
PEAK = 10.0  # chosen: wave number of the peak of the spectrum, cycles per tile
FINEST = 64.0  # chosen: wave number beyond which ripples are damped, cycles per tile
MEAN = 0.75  # chosen: mean brightness; the water colour is already dark
TINT = np.array([0.89, 1.06, 1.04])  # chosen: adds some green to the water colour (0.2, 0.2, 0.4)


def wave_field(seed: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return heights and their slopes along columns and rows, each (SIZE, SIZE), tiling.

    Heights have standard deviation 1; slopes are in units of height per texel.
    """
    rng = np.random.default_rng(seed)
    k_x = np.fft.fftfreq(SIZE)[None, :] * SIZE
    k_y = np.fft.fftfreq(SIZE)[:, None] * SIZE
    k = np.hypot(k_x, k_y)
    angle = np.arctan2(k_y, k_x) - np.radians(WIND_DEG)
    safe = np.maximum(k, 1.0)

    # Phillips: energy ~ k^-4, limited below by the longest wave of the wind, above by viscosity.
    energy = np.exp(-((PEAK / safe) ** 2)) * safe**-4.3 * np.exp(-((k / FINEST) ** 2))

    # Short ripples travel in all directions, long waves with the wind.
    spread = np.abs(np.cos(angle)) ** (2.0 * SPREAD / (1.0 + k / 60.0)) + 0.04
    amplitude = np.where(k >= LONGEST, np.sqrt(energy * spread), 0.0)
    spectrum = np.fft.fft2(rng.standard_normal((SIZE, SIZE))) * amplitude
    height = np.fft.ifft2(spectrum).real
    slope_x = np.fft.ifft2(spectrum * 2j * np.pi * k_x / SIZE).real
    slope_y = np.fft.ifft2(spectrum * 2j * np.pi * k_y / SIZE).real
    scale = height.std()
    return height / scale, slope_x / scale, slope_y / scale


def equalised(field: np.ndarray, reach: float) -> np.ndarray:
    """Return a tiling field divided by its local standard deviation (over ``reach`` texels).

    The eye would recognise a group of higher waves in every copy of the tile.
    """
    power = ndimage.gaussian_filter(field**2, reach, mode="wrap")
    return field / np.sqrt(power)


def water() -> np.ndarray:
    """Return the tile, uint8 (512, 512, 3), with mean brightness ``MEAN``."""
    height, slope_x, slope_y = wave_field(SEED)
    height = equalised(height, 40.0)

    # Like Gerstner waves, but without horizontal displacement: narrow crests, wide troughs.
    crest = height + 0.22 * (height**2 - 1.0)
    wind = np.radians(WIND_DEG)
    facing = slope_x * np.cos(wind) + slope_y * np.sin(wind)
    facing = equalised(facing, 26.0)
    tone = 0.12 * np.tanh(0.8 * facing) + 0.06 * np.tanh(crest)

    # Glints: facets near the slope that reflects the sun, strongest on the crests.
    across = equalised(-slope_x * np.sin(wind) + slope_y * np.cos(wind), 26.0)
    glint = np.exp(-(((facing - 1.9) / 0.42) ** 2) - (across / 0.9) ** 2)
    glint *= smoothstep(-0.3, 1.2, crest)
    glint = 0.7 * glint + 0.3 * ndimage.gaussian_filter(glint, 1.2, mode="wrap")
    tone = tone + 0.30 * glint
    rgb = (tone - tone.mean() + MEAN)[..., None] * TINT / TINT.mean()
    rgb = rgb + 0.14 * glint[..., None] * np.array([1.0, 0.5, 0.3])  # glints are not tinted

    # A tile may start at any column: start where neighbouring columns differ least.
    change = np.abs(rgb - np.roll(rgb, 1, axis=1)).mean(axis=(0, 2))
    return to_uint8(np.roll(rgb, -int(change.argmin()), axis=1))


ASSETS: dict[str, Callable[[], np.ndarray]] = {"water.png": water}
