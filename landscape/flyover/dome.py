"""The sky as a picture made once: colours by azimuth and elevation, with clouds, haze and sun.

A row is an elevation e: with t = tan(e), row ``t / (1 + t)`` of the height, so that half of the
rows are below 45 degrees, where one looks. Row 0 is the horizon: far ground fades into its colour,
and then no edge is seen where the terrain ends.
"""

import numpy as np

from landscape.flyover.clouds import clouds
from landscape.flyover.ground import colour
from landscape.flyover.sunlight import smooth_step

# Colours, sRGB 0..1, chosen.
ZENITH = colour(0.16, 0.34, 0.66)
BLUE = colour(0.40, 0.62, 0.88)
HORIZON = colour(0.78, 0.85, 0.91)
GLOW = colour(1.0, 0.93, 0.78)
LIT = colour(1.0, 0.985, 0.96)
SHADED = colour(0.62, 0.68, 0.77)
DISC = colour(1.0, 0.98, 0.90)


def dome(towards: np.ndarray, cloudy: bool, rows: int) -> np.ndarray:
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
    if cloudy:
        amount, light = cover(rows, towards)
        shown = SHADED + (LIT - SHADED) * light[..., None]
        shown = shown + (GLOW - shown) * (0.4 * to_sun**8)
        sky = sky + (shown - sky) * amount[..., None]

    sun = np.maximum(smooth_step(0.99982, 0.99990, to_sun), 0.6 * to_sun**900)
    if cloudy:
        sun = sun * (1 - 0.8 * amount[..., None])
    sky = sky + (DISC - sky) * sun
    packed = np.full((rows, columns, 4), 255, np.uint8)
    packed[..., :3] = np.clip(sky, 0, 1) * 255 + 0.5
    return packed.view(np.uint32)[..., 0]


def cover(rows: int, towards: np.ndarray) -> list[np.ndarray]:
    """Return how much cloud there is and how bright it is, 0..1, float32 (rows, 4 * rows).

    They are computed for every second row and column: clouds are soft.
    """
    few = rows // 2
    v = (np.arange(few, dtype=np.float32) + 0.5) / few
    azimuth = (np.arange(4 * few, dtype=np.float32) + 0.5) * np.float32(np.pi / 2 / few)
    found = clouds((v / (1 - v))[:, None], azimuth, towards)
    return [doubled(doubled(each, "edge").T, "wrap").T for each in found]


def doubled(picture: np.ndarray, beyond: str) -> np.ndarray:
    """Return twice as many rows, linear between those of (n, m); ``beyond`` as for np.pad."""
    padded = np.pad(picture, ((1, 1), (0, 0)), beyond)  # type: ignore[call-overload]
    out = np.empty((2 * len(picture), picture.shape[1]), np.float32)
    out[::2] = 0.75 * picture + 0.25 * padded[:-2]
    out[1::2] = 0.75 * picture + 0.25 * padded[2:]
    return out
