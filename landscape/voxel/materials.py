"""What the ground is made of: sorted by height, then by slope (TP2, part 3).

The document sorts the columns of each region by height into materials, and those of one material
by slope: where it is too steep for grass there is earth. Here the same choice is made for all
columns at once, and the borders between materials follow a noise, so that none is a contour line.
"""

import numpy as np

from landscape.voxel.blocks import block
from landscape.voxel.heights import Heights

# All chosen. Heights in blocks above the sea, as fractions of the relief where they are marked.
BEACH = 2.2  # sand up to here
SHALLOWS = -2.5  # and down to here; deeper lies gravel
SNOW = 0.60  # of the highest land
EARTHY, ROCKY = 0.95, 1.3  # rise over run from which there is earth, or bare rock
SOIL = 3  # blocks of earth under grass, or of sand under sand


def smooth_noise(side: int, cells: int, rng: np.random.Generator) -> np.ndarray:
    """Return noise (side, side) in -1..1: random values of a coarse grid, interpolated smoothly."""
    coarse = rng.uniform(-1.0, 1.0, (cells + 2, cells + 2)).astype(np.float32)
    at = np.arange(side, dtype=np.float32) * (cells / side)
    k = at.astype(int)
    t = at - k
    t = t * t * (3 - 2 * t)
    rows = coarse[k] * (1 - t)[:, None] + coarse[k + 1] * t[:, None]
    return np.asarray(rows[:, k] * (1 - t) + rows[:, k + 1] * t)


def variation(side: int, size: float, rng: np.random.Generator) -> np.ndarray:
    """Return noise (side, side) of about -1..1 whose largest features measure ``size`` columns."""
    cells = max(1, round(side / size))
    total = smooth_noise(side, cells, rng)
    for octave in (1, 2):
        total += smooth_noise(side, min(side, cells << octave), rng) / 2**octave
    return total / 1.2


def top_materials(source: Heights, sea: int, rng: np.random.Generator) -> np.ndarray:
    """Return the topmost block of each column, uint8 (n, n)."""
    above, steep = source.field - sea, source.steepness
    wander = variation(len(above), 24.0, rng)
    highest = max(float(above.max()), 1.0)
    found = np.full(above.shape, block("grass"), np.uint8)
    found[steep + 0.25 * wander > EARTHY] = block("earth")
    found[(above + 0.07 * highest * wander > SNOW * highest) & (steep < ROCKY)] = block("snow")
    found[steep + 0.3 * wander > ROCKY] = block("rock")
    found[(above + 0.8 * wander < BEACH) & (steep < ROCKY)] = block("sand")
    found[above + 1.5 * wander < SHALLOWS] = block("gravel")
    return found


def soil_profiles(height: int) -> np.ndarray:
    """Return what lies under each kind of top, uint8 (kinds, 2 * height): one column each.

    Level ``height - 1`` is the top; above it is air, below it soil and then rock.
    """
    found = np.full((256, 2 * height), block("rock"), np.uint8)
    found[:, height:] = 0
    found[np.arange(256), height - 1] = np.arange(256)
    under = {"grass": "earth", "earth": "earth", "snow": "earth", "sand": "sand"}
    for top, soil in under.items():
        found[block(top), height - 1 - SOIL : height - 1] = block(soil)
    return found


def filled(tops: np.ndarray, kinds: np.ndarray, height: int) -> np.ndarray:
    """Return the blocks [x, z, y], uint8 (n, n, ``height``), of columns (n, n) with these tops."""
    profiles = soil_profiles(height)
    windows = np.lib.stride_tricks.sliding_window_view(profiles, height, axis=1)
    return np.asarray(windows[kinds, height - tops])
