"""The sky as a picture made once: colours by azimuth and elevation, with clouds, haze and sun.

A row is an elevation e: with t = tan(e), row ``t / (1 + t)`` of the height, so that half of the
rows are below 45 degrees, where one looks. Row 0 is the horizon: far ground fades into its colour,
and then no edge is seen where the terrain ends.
"""

import numpy as np

from landscape.flyover.ground import colour, smooth_step
from landscape.flyover.noise import noise

# Colours, sRGB 0..1, chosen.
ZENITH, BLUE, HORIZON = colour(0.16, 0.34, 0.66), colour(0.40, 0.62, 0.88), colour(0.78, 0.85, 0.91)
GLOW, LIT, SHADED = colour(1.0, 0.93, 0.78), colour(1.0, 0.985, 0.96), colour(0.62, 0.68, 0.77)
DISC = colour(1.0, 0.98, 0.90)
SCALE = 0.16  # of the clouds' pattern: repeats per height of the clouds, chosen
COVER = 0.35  # clouds are where the noise exceeds this, chosen


def dome(towards: np.ndarray, clouds: bool, rows: int) -> np.ndarray:
    """Return the sky's colours as uint32 (rows, 4 * rows), red lowest; column 0 looks along +x.

    ``towards`` (3,) points to the sun.
    """
    columns = 4 * rows
    v = (np.arange(rows, dtype=np.float32) + 0.5) / rows
    tangent = (v / (1 - v))[:, None]
    azimuth = (np.arange(columns, dtype=np.float32) + 0.5) * np.float32(2 * np.pi / columns)
    flat = 1 / np.sqrt(1 + tangent * tangent)
    to_sun = flat * (np.cos(azimuth) * towards[0] + np.sin(azimuth) * towards[1])
    to_sun = np.clip(to_sun + tangent * flat * towards[2], 0, 1)[..., None]
    height = (tangent * flat)[..., None]
    sky = BLUE + (HORIZON - BLUE) * np.exp(-9 * height)
    sky = sky + (ZENITH - sky) * (1 - np.exp(-1.6 * height))
    haze = 0.45 * to_sun**6 * np.exp(-3 * height) + 0.30 * to_sun**40
    sky = sky + (GLOW - sky) * haze
    if clouds:
        amount, light = cloud_cover(tangent, azimuth, towards)
        shown = SHADED + (LIT - SHADED) * light[..., None]
        shown = shown + (GLOW - shown) * (0.4 * to_sun**8)
        sky = sky + (shown - sky) * amount[..., None]
    disc = smooth_step(0.99982, 0.99990, to_sun)
    sky = sky + (DISC - sky) * np.maximum(disc, 0.6 * to_sun**900)
    packed = np.full((rows, columns, 4), 255, np.uint8)
    packed[..., :3] = np.clip(sky, 0, 1) * 255 + 0.5
    return packed.view(np.uint32)[..., 0]


def cloud_cover(
    tangent: np.ndarray, azimuth: np.ndarray, towards: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return how much cloud there is and how bright it is, 0..1 each, for each row and column.

    The clouds are a flat layer; each is lit on the side of the sun.
    """
    size = len(tangent)
    field = noise(size, 5, 1.45, 4)
    bulk = np.clip((field - COVER) / 1.5, 0, 1)
    step = towards[:2] / max(float(np.hypot(*towards[:2])), 1e-6) * 9
    behind = np.roll(bulk, (-round(step[1]), -round(step[0])), (0, 1))
    bright = np.clip(0.70 + 1.2 * (bulk - behind) - 0.25 * bulk, 0, 1)
    layers = [smooth_step(0.0, 0.5, bulk), bright]
    away = (SCALE * size / np.maximum(tangent, 1e-3))[:, 0]
    # Far clouds are close together: they are looked up in smaller copies of the pattern.
    texels = away * (2 * np.pi / len(azimuth)) * np.hypot(1, 1 / np.maximum(tangent[:, 0], 1e-3))
    level = np.clip(np.log2(texels) - 0.5, 0, size.bit_length() - 2).astype(int)
    amount, light = np.empty((2, len(tangent), len(azimuth)), np.float32)
    for k in range(int(level.max()) + 1):
        rows = np.flatnonzero(level == k)
        x, y = (away[rows, None] / 2**k * turn(azimuth) for turn in (np.cos, np.sin))
        for found, layer in zip((amount, light), layers, strict=True):
            found[rows] = sampled(layer, x, y)
        layers = [
            (each[::2, ::2] + each[1::2, ::2] + each[::2, 1::2] + each[1::2, 1::2]) / 4
            for each in layers
        ]
    visible = smooth_step(0.05, 0.30, tangent)
    return amount * visible, light


def sampled(layer: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return a pattern (n, n), repeated without end, at x, y in its texels, bilinearly."""
    n = len(layer)
    column, row = np.floor(x).astype(np.int64), np.floor(y).astype(np.int64)
    u, v = (x - column).astype(np.float32), (y - row).astype(np.float32)
    left, right, top, below = column % n, (column + 1) % n, row % n, (row + 1) % n
    upper = layer[top, left] * (1 - u) + layer[top, right] * u
    lower = layer[below, left] * (1 - u) + layer[below, right] * u
    return np.asarray(upper * (1 - v) + lower * v)
