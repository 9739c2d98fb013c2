"""The ripples' slopes as arrays: a tile with waves of many lengths, and gusts of wind on the sea.

No OpenGL here. A tile is a random sea (Tessendorf, "Simulating Ocean Water", SIGGRAPH course
2001): waves of whole numbers of cycles per tile, so that it repeats without a seam. All octaves
are equally steep, as on a real sea, and each has a heading of its own; so no length and no
direction stands out.
"""

import numpy as np

SIZE = 512  # chosen: texels per side of a tile
LONGEST, SHORTEST = 4.0, 110.0  # chosen: cycles per tile of the longest and shortest waves
SPREAD = 1.5  # chosen: exponent of the cosine around the wind; 0 is from everywhere
ASTRAY = 0.25  # chosen: energy of the waves across the wind and against it
TURNED = 0.55  # chosen: radians by which the octaves' headings swing about the wind
SHARPER = 0.4  # chosen: how far crests are drawn together: at 1 the steepest would break
PATCHES = 0.2  # chosen: how unevenly short waves are spread over the tile
PATCH = 2.5  # chosen: cycles per tile of these patches
RANGE = 3.2  # chosen: standard deviations of a slope that a texel can hold
# Chosen: gusts as wave numbers along x and z (radians per unit), and how far one bends the next.
GUSTS = np.array(
    [(0.31, 0.13), (-0.17, 0.39), (0.83, -0.35), (0.29, 1.07), (2.3, -1.1), (1.2, 2.9)], np.float32
)
BENT = 1.4
GUST_SPEED = 0.06  # chosen: radians per t


def noise(rng: np.random.Generator, size: int) -> np.ndarray:
    """Return the spectrum of white noise, (size, size)."""
    return np.asarray(np.fft.fft2(rng.standard_normal((size, size))))


def slopes(
    seed: int, size: int = SIZE, longest: float = LONGEST, patches: float = PATCHES
) -> np.ndarray:
    """Return a tile's slopes along columns and rows, (size, size, 2), of standard deviation 1."""
    rng = np.random.default_rng(seed)
    number = np.fft.fftfreq(size) * size
    k_x, k_y = np.meshgrid(number, number)
    k = np.maximum(np.hypot(k_x, k_y), 1e-9)
    octave = np.log2(k)
    heading = np.arctan2(k_y, k_x) - TURNED * np.sin(2.3 * octave + 1.7 * seed)

    # Per area of the plane of wave numbers: an octave's area grows with k squared.
    energy = (np.abs(np.cos(heading)) ** (2 * SPREAD) + ASTRAY) / k**2
    energy *= np.exp(-((longest / k) ** 4) - (k / SHORTEST) ** 2)
    height = noise(rng, size) * np.sqrt(energy) / k
    step = 2j * np.pi / size
    along = [np.fft.ifft2(height * step * each).real for each in (k_x, k_y)]
    scale = np.sqrt(np.mean(np.square(along)))

    # Water moves towards the crests, as in Gerstner's waves: narrow crests, wide troughs.
    drawn = [np.fft.ifft2(height * 1j * each / k).real / scale for each in (k_x, k_y)]
    at = [
        (np.arange(size)[None, :] + SHARPER * drawn[0]) % size,
        (np.arange(size)[:, None] + SHARPER * drawn[1]) % size,
    ]
    swell = np.fft.ifft2(noise(rng, size) * np.exp(-((k / PATCH) ** 2))).real
    rough = np.exp(patches * swell / swell.std())
    tile = np.stack([sampled(each * rough, *at) for each in along], axis=2)
    tile -= tile.mean(axis=(0, 1))
    return np.asarray(tile / np.sqrt(np.mean(np.square(tile))))


def sampled(values: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return a tile's values (n, n) at places in texels, 0 <= x, y < n, bilinear."""
    size = len(values)
    column, row = x.astype(int) % size, y.astype(int) % size
    right, below = (column + 1) % size, (row + 1) % size
    u, v = x - np.floor(x), y - np.floor(y)
    upper = values[row, column] * (1 - u) + values[row, right] * u
    lower = values[below, column] * (1 - u) + values[below, right] * u
    return np.asarray(upper * (1 - v) + lower * v)


def slope_picture(tile: np.ndarray, held: float = RANGE) -> np.ndarray:
    """Return slopes (n, n, 2) as a texture, uint8 (n, n, 3): red and green, and blue is 1.

    ``held`` is the slope at the ends of a texel's range; what is steeper is clipped.
    """
    picture = np.full((*tile.shape[:2], 3), 255, np.uint8)
    picture[..., :2] = np.rint(np.clip(0.5 + tile / (2 * held), 0.0, 1.0) * 255)
    return picture


def gusts(x: np.ndarray, z: np.ndarray, t: float) -> np.ndarray:
    """Return how rough the wind makes the sea at places x, z in units: 0 a slick, 1 a gust."""
    total = np.zeros_like(x)
    bend = np.zeros_like(x)
    for along_x, along_z in GUSTS:
        phase = np.float32(BENT) * bend - np.float32(GUST_SPEED * t)
        bend = np.sin(x * along_x + z * along_z + phase)
        total += bend
    return np.asarray(0.5 + 0.5 * np.tanh(0.8 * total))
