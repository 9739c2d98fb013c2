"""Clouds: a layer of cumulus with thickness, lit by the sun through itself, and a veil far above.

A field of noise says how high the cloud towers above each place, on a plane that repeats without
end. The layer is cut into slices, each a picture of how dense the cloud is there and how much
sunlight reaches it. A ray from the ground crosses them from the lowest up, so that a cloud has a
dark flat base, bright sides, and edges as soft as it is thin there.
"""

import numpy as np

from landscape.flyover.noise import noise
from landscape.flyover.sunlight import smooth_step

# All chosen. Lengths are in heights of the clouds' base above the ground.
SCALE = 0.16  # of the pattern: repeats per length
SLICES, THICK = 12, 0.26
COVER, TOWER = 0.55, 1.7  # there is cloud where the noise exceeds the first; how soon it is high
SOFT = 0.45  # of the thickness: how far below its surface a cloud is dense
DENSE, SHADE = 22.0, 10.0  # light lost per length, from the eye and from the sun
CIRRUS = 0.05  # the veil's pattern
VEIL = 0.34  # how dense it is
HIGH = 3.0  # its height
SEED = 5


def clouds(
    tangent: np.ndarray, azimuth: np.ndarray, towards: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return how much cloud there is and how bright it is, 0..1 each, float32 (rows, columns).

    ``tangent`` (rows, 1) are those of the elevations, ``azimuth`` (columns,) in radians;
    ``towards`` (3,) points to the sun.
    """
    size = len(tangent)
    turns = np.stack([np.cos(azimuth), np.sin(azimuth)]).astype(np.float32)
    slices = lit_slices(size, towards)
    amount, light = veil(size, tangent, turns)
    through = np.ones_like(amount)
    shown = np.zeros_like(amount)
    steep = tangent / np.sqrt(1 + tangent * tangent)
    crossed = np.minimum(THICK / SLICES / np.maximum(steep, 1e-3), 0.5)
    for k, (dense, bright) in enumerate(slices):
        away = (1 + THICK * (k + 0.5) / SLICES) / np.maximum(tangent, 0.02)
        found = looked_up((dense, bright), away * np.float32(SCALE * size), turns)
        here = 1 - np.exp(-DENSE * crossed * found[0])
        here *= through
        shown += here * found[1] / np.maximum(found[0], np.float32(1e-6))
        through -= here

    near = smooth_step(0.035, 0.16, tangent)
    solid = 1 - through
    shown /= np.maximum(solid, 1e-6)
    solid *= near
    both = solid + (1 - solid) * amount
    bright = (shown * solid + light * amount * (1 - solid)) / np.maximum(both, 1e-6)
    return both, bright


def lit_slices(size: int, towards: np.ndarray) -> list[tuple[np.ndarray, np.ndarray]]:
    """Return the slices from the lowest up: how dense they are, and that times how bright.

    Both are float32 (size, size) of 0..1.
    """
    where = noise(size, SEED, 1.2, 3, 9)

    # Noise folded at 0 has round heaps with creases between them.
    heaps = [np.abs(noise(size, SEED + 1 + k, 0.6, 10 * 2**k, 20 * 2**k)) for k in range(4)]
    puffs = sum(heap * 0.55**k for k, heap in enumerate(heaps))
    field = where + 0.42 * (puffs - 1.4)
    height = np.sqrt(np.clip((field - COVER) / TOWER, 0, 1)) * 1.15
    levels = (np.arange(SLICES, dtype=np.float32) + 0.5) / SLICES
    dense = [smooth_step(0, SOFT, height - level) for level in levels]
    texels = THICK / SLICES * SCALE * size / max(float(towards[2]), 0.15)
    column, row = (round(float(each) * texels) for each in towards[:2])
    step = THICK / SLICES / max(float(towards[2]), 0.15)
    above = np.zeros_like(field)
    found = []
    for level, each in zip(levels[::-1], dense[::-1], strict=True):
        sun = np.exp(-SHADE * above) * np.exp(-0.5 * SHADE * step * each)
        sky = 0.25 + 0.35 * level
        bright = np.clip(0.16 + 0.6 * sky + 0.60 * sun, 0, 1)
        found.append((each, (each * bright).astype(np.float32)))
        above = np.roll(above + each * step, (-row, -column), (0, 1))

    return found[::-1]


def veil(size: int, tangent: np.ndarray, turns: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return how much there is of the thin clouds high above, and how bright they are."""
    wide = noise(size, SEED + 7, 1.3, 2, 40)
    # Combed along one direction: streaks in the wind.
    streaks = noise(size, SEED + 8, 1.0, 6, 120)
    for step in (1, 2, 4, 8, 16):
        streaks = (streaks + np.roll(streaks, (step, 2 * step), (0, 1))) / 2
    streaks /= max(float(streaks.std()), 1e-6)
    thin = VEIL * smooth_step(0.2, 2.6, wide + 0.7 * streaks)
    away = HIGH / np.maximum(tangent, 0.02)
    found = looked_up((thin,), away * np.float32(CIRRUS * size), turns)[0]
    return found * smooth_step(0.06, 0.35, tangent), np.ones_like(found)


def looked_up(
    layers: tuple[np.ndarray, ...], away: np.ndarray, turns: np.ndarray
) -> list[np.ndarray]:
    """Return layers (n, n) that repeat, in all directions ``turns`` (2, columns).

    ``away`` (rows, 1) is how far in texels. Far clouds are close together: they are looked up in
    smaller copies.
    """
    n = len(layers[0])
    between = np.abs(np.gradient(away[:, 0])) if len(away) > 1 else np.ones(1)
    texels = np.maximum(np.minimum(between, 1e9), away[:, 0] * 2 * np.pi / turns.shape[1])
    level = np.clip(np.log2(np.maximum(texels, 1e-6)), 0, n.bit_length() - 2).astype(int)
    found = [np.empty((len(away), turns.shape[1]), np.float32) for _ in layers]
    for k in range(int(level.max()) + 1):
        rows = np.flatnonzero(level == k)
        x, y = (away[rows] / 2**k * turn for turn in turns)
        for out, layer in zip(found, layers, strict=True):
            out[rows] = sampled(layer, x, y)
        layers = tuple(
            (each[::2, ::2] + each[1::2, ::2] + each[::2, 1::2] + each[1::2, 1::2]) / 4
            for each in layers
        )

    return found


def sampled(layer: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return a pattern (n, n), repeated without end, at x, y in its texels, bilinearly."""
    n = len(layer)
    left, top = np.floor(x), np.floor(y)
    u, v = (x - left).astype(np.float32), (y - top).astype(np.float32)
    column, row = left.astype(np.int32), top.astype(np.int32)
    right, below = (column + 1) & (n - 1), ((row + 1) & (n - 1)) * n
    column &= n - 1
    row &= n - 1
    row *= n
    flat = layer.ravel()
    upper = flat.take(row + column)
    upper += (flat.take(row + right) - upper) * u
    lower = flat.take(below + column)
    lower += (flat.take(below + right) - lower) * u
    lower -= upper
    lower *= v
    return np.asarray(upper + lower)
