"""Details of bare ground, repeated over the island beside the turf: sand, and rock.

Both are drawn as heights on a torus, lit from one side, and brought to a mean of one half: laid
over the large colours at double strength they change the grain and not the colour.
"""

from collections.abc import Callable

import numpy as np
from scipy import ndimage

from landscape.studio.ground import DETAIL, draw_pebbles
from landscape.studio.images import spectral_noise, to_uint8

ROCK = 1024  # chosen: seen from afar as well as from near, where it is repeated every 2 units


def level(tone: np.ndarray, strength: float, reach: float) -> np.ndarray:
    """Return ``tone`` (n, n) without what is wider than ``reach`` texels, soft-limited, mean 0.

    What is wide shows as a pattern when the picture is repeated.
    """
    tone = tone - ndimage.gaussian_filter(tone, reach, mode="wrap")
    tone = np.tanh(tone / tone.std() * 0.6) * strength
    return np.asarray(tone - tone.mean())


def slope_light(height: np.ndarray) -> np.ndarray:
    """Return the light (n, n), mean about 0, on heights in texels, from the upper left."""
    dx = (np.roll(height, -1, 1) - np.roll(height, 1, 1)) / 2
    dy = (np.roll(height, -1, 0) - np.roll(height, 1, 0)) / 2
    return np.asarray((-0.6 * dx - 0.8 * dy) / np.sqrt(1.0 + dx * dx + dy * dy))


def ground_sand() -> np.ndarray:
    """Return trodden sand with grains, dimples and a few stones, tileable uint8 (n, n, 3)."""
    n = DETAIL
    grain = spectral_noise(n, 0.15, 61, 90.0)
    dimples = spectral_noise(n, 2.2, 62, 9.0)
    light = slope_light(2.6 * dimples)
    tone = 0.06 * grain + 0.55 * light + 0.05 * spectral_noise(n, 1.1, 63, 10.0)
    tone = level(tone, 0.10, 60.0) + 0.5
    hue = 0.5 * spectral_noise(n, 0.8, 64, 20.0)
    draw_pebbles(tone, np.zeros((n, n)), hue, 70, np.random.default_rng(65))
    tone -= tone.mean()
    rgb = np.stack([tone + 0.008 * hue, tone, tone - 0.014 * hue], axis=-1)
    return to_uint8(rgb - rgb.mean(axis=(0, 1)) + 0.5)


def ground_rock() -> np.ndarray:
    """Return weathered rock, faces between clefts, tileable uint8 (n, n, 3)."""
    n = ROCK
    folds = sum(
        weight * np.abs(spectral_noise(n, 2.3, seed, low))
        for weight, seed, low in ((1.0, 71, 4.0), (0.6, 72, 12.0), (0.35, 73, 36.0))
    )
    clefts = np.exp(-((np.asarray(folds) / 0.35) ** 2))
    height = 9.0 * np.asarray(folds) + 0.7 * spectral_noise(n, 1.0, 74, 60.0)
    tone = 0.9 * slope_light(height) - 0.35 * clefts + 0.06 * spectral_noise(n, 0.4, 75, 50.0)
    tone = level(tone, 0.22, 90.0)
    hue = spectral_noise(n, 1.3, 76, 6.0)
    rgb = np.stack([tone + 0.008 * hue, tone, tone - 0.010 * hue], axis=-1)
    return to_uint8(rgb - rgb.mean(axis=(0, 1)) + 0.5)


ASSETS: dict[str, Callable[[], np.ndarray]] = {
    "ground_sand.png": ground_sand,
    "ground_rock.png": ground_rock,
}
