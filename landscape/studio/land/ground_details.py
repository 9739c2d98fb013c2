"""Detail textures of bare ground, used beside the turf: sand and rock.

Both are tiling height fields, lit from one side and normalised to a mean of one half. Multiplied
with the large texture at a scale of two, they add grain without changing its colour.
"""

from collections.abc import Callable

import numpy as np
from scipy import ndimage
from scipy.spatial import cKDTree

from landscape.studio.images import smoothstep, spectral_noise, to_uint8
from landscape.studio.land.ground import DETAIL, draw_pebbles

ROCK = 1024  # chosen: repeated every 2 units, and seen from near and far

# Chosen: number of faces along a side, seed, warp of their borders in texels, strength.
ROCK_FACES = ((7, 81, 26.0, 1.0), (19, 85, 12.0, 0.7), (48, 89, 6.0, 0.45))


def high_pass(tone: np.ndarray, strength: float, reach: float) -> np.ndarray:
    """Return ``tone`` (n, n) without features wider than ``reach`` texels, soft-clipped, mean 0.

    Wide features show as a pattern when the texture is repeated.
    """
    tone = tone - ndimage.gaussian_filter(tone, reach, mode="wrap")
    tone = np.tanh(tone / tone.std() * 0.6) * strength
    return np.asarray(tone - tone.mean())


def shade_slopes(height: np.ndarray) -> np.ndarray:
    """Return the shading (n, n), mean about 0, of heights in texels lit from the upper left."""
    dx = (np.roll(height, -1, 1) - np.roll(height, 1, 1)) / 2
    dy = (np.roll(height, -1, 0) - np.roll(height, 1, 0)) / 2
    return np.asarray((-0.6 * dx - 0.8 * dy) / np.sqrt(1.0 + dx * dx + dy * dy))


def draw_roots(tone: np.ndarray, hue: np.ndarray, count: int, rng: np.random.Generator) -> None:
    """Draw dry stalks and roots, in place: bright lines with a shadow, warm in hue."""
    n = len(tone)
    for _ in range(count):
        place, angle = rng.uniform(0, n, 2), rng.uniform(0, 2 * np.pi)
        bend, length = rng.normal(0, 0.03), int(rng.uniform(8, 34))
        value = rng.uniform(-0.16, 0.20)
        for _ in range(length):
            place = place + (np.sin(angle), np.cos(angle))
            angle += bend + rng.normal(0, 0.12)
            row, column = (place.astype(int) % n).tolist()
            tone[(row + 1) % n, (column + 1) % n] -= 0.10
            tone[row, column] = 0.5 + value
            hue[row, column] += 1.2


def crust(n: int) -> np.ndarray:
    """Return the heights in texels (n, n), tileable, of earth: hollows, clods and plain patches.

    No direction is preferred: ripples side by side would look like scales on a slope.
    """
    hollows = spectral_noise(n, 1.9, 62, 7.0)
    clods = np.maximum(spectral_noise(n, 1.3, 69, 22.0) - 0.5, 0.0)
    crumbs = np.maximum(spectral_noise(n, 0.9, 66, 60.0) - 0.9, 0.0)
    rough = smoothstep(-0.4, 1.0, spectral_noise(n, 2.2, 68, 3.0))
    return np.asarray(1.1 * hollows + rough * (1.0 * clods + 0.9 * crumbs))


def ground_sand() -> np.ndarray:
    """Return sand and earth: clods, grit, stones, roots, tileable uint8 (n, n, 3)."""
    n = DETAIL
    grain = spectral_noise(n, 0.15, 61, 90.0)
    light = shade_slopes(crust(n))
    tone = 0.10 * grain + 0.55 * light + 0.10 * spectral_noise(n, 1.1, 63, 8.0)
    tone = high_pass(tone, 0.12, 60.0) + 0.5
    hue = 0.5 * spectral_noise(n, 0.8, 64, 20.0)
    rng = np.random.default_rng(65)
    draw_roots(tone, hue, 40, rng)
    draw_pebbles(tone, np.zeros((n, n)), hue, 90, rng)
    tone -= tone.mean()
    rgb = np.stack([tone + 0.008 * hue, tone, tone - 0.014 * hue], axis=-1)
    return to_uint8(rgb - rgb.mean(axis=(0, 1)) + 0.5)


def facets(n: int, cells: int, seed: int, warp: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the heights of broken faces and the clefts between them, each (n, n), tileable.

    The faces are the Voronoi cells of ``cells`` x ``cells`` jittered points, warped by ``bend``
    texels of noise; each is tilted at random. Heights are in texels; clefts are 1 on a border and
    fall to 0 within a few texels.
    """
    rng = np.random.default_rng(seed)
    rows, columns = np.indices((n, n), dtype=float)
    rows += warp * spectral_noise(n, 2.0, seed + 1, 3.0)
    columns += warp * spectral_noise(n, 2.0, seed + 2, 3.0)
    grid = np.indices((cells, cells)).reshape(2, -1).T
    points = (grid + rng.uniform(0.05, 0.95, grid.shape)) * (n / cells) % n
    positions = np.stack([rows, columns], axis=-1).reshape(-1, 2) % n
    distance, nearest = cKDTree(points, boxsize=n).query(positions, k=2)
    tilt = rng.normal(0.0, 0.33, (len(points), 2))[nearest[:, 0]]
    off = (positions - points[nearest[:, 0]] + n / 2) % n - n / 2
    height = (tilt * off).sum(axis=1) + rng.normal(0.0, 0.10 * n / cells, len(points))[
        nearest[:, 0]
    ]
    cleft = np.exp(-(((distance[:, 1] - distance[:, 0]) / (0.045 * n / cells)) ** 2))
    return height.reshape(n, n), cleft.reshape(n, n)


def ground_rock() -> np.ndarray:
    """Return weathered rock: broken faces between clefts, tileable uint8 (n, n, 3)."""
    n = ROCK
    height, hollow = np.zeros((n, n)), np.zeros((n, n))
    for cells, seed, warp, weight in ROCK_FACES:
        faces, clefts = facets(n, cells, seed, warp)
        patchy = smoothstep(-0.6, 0.7, spectral_noise(n, 2.0, seed + 3, 2.0))
        height += weight * patchy * (faces - 0.05 * n / cells * clefts)
        hollow = np.maximum(hollow, weight * patchy * clefts)

    height = ndimage.gaussian_filter(height, 1.1, mode="wrap")
    height += 0.5 * spectral_noise(n, 1.1, 74, 50.0)

    # Ambient occlusion: low areas see less of the sky.
    low = ndimage.gaussian_filter(height, 14.0, mode="wrap") - height
    tone = 0.62 * shade_slopes(height) - 0.40 * hollow - 0.022 * np.clip(low, 0.0, 12.0)
    tone += 0.05 * spectral_noise(n, 0.4, 75, 50.0)
    tone = high_pass(tone, 0.30, 110.0)
    lichen = smoothstep(1.1, 1.9, spectral_noise(n, 1.5, 77, 14.0)) * (1.0 - hollow)
    tone += 0.05 * lichen
    hue = spectral_noise(n, 1.3, 76, 6.0)
    rgb = np.stack([tone + 0.012 * hue, tone + 0.012 * lichen, tone - 0.016 * hue], axis=-1)
    return to_uint8(rgb - rgb.mean(axis=(0, 1)) + 0.5)


ASSETS: dict[str, Callable[[], np.ndarray]] = {
    "ground_sand.png": ground_sand,
    "ground_rock.png": ground_rock,
}
