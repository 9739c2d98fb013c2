"""Materials of the ground: chosen by height, then by slope (TP2, part 3).

The document sorts the columns of each region by height into materials, and those of one material
by slope: where it is too steep for grass there is earth. Here the same choice is made for all
columns at once, and the borders between materials follow a noise, so that none is a contour line.
"""

import numpy as np

from landscape.voxel.blocks import block
from landscape.voxel.heights import Heights

# All chosen, for the land that Heights compares with: a larger one has its materials in the same
# places. Heights are in blocks above the sea.
BEACH = 2.2  # sand up to here
SHALLOWS = -2.5  # and down to here; deeper lies gravel
SNOW = 0.58  # a fraction of the highest land
EARTHY, ROCKY = 1.02, 1.3  # rise over run from which there is earth, or bare rock
SNOWY = 2.2  # how much steeper than ROCKY snow may lie on the highest land
SOIL = 3  # blocks of earth under grass, or of sand under sand
# Layers of rock from below, again and again: block and thickness. Where they lie varies by BENT
# blocks over BENT_SIZE columns. All chosen.
STRATA = (
    ("rock", 3),
    ("dark rock", 1),
    ("rock", 2),
    ("pale rock", 2),
    ("rock", 2),
    ("warm rock", 2),
)
BENT, BENT_SIZE = 7.0, 70.0
BARE, BARE_SIZE = 0.03, 11.0  # chosen: fraction of the grass that is bare, in patches of this size


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
    above = (source.field - sea) / np.float32(source.tall)
    steep = source.steepness / np.float32(source.grade)
    wander = variation(len(above), 24.0, rng)
    highest = max(float(above.max()), 1.0)
    found = np.full(above.shape, block("grass"), np.uint8)
    found[steep + 0.25 * wander > EARTHY] = block("earth")
    found[steep + 0.3 * wander > ROCKY] = block("rock")
    bare = variation(len(above), BARE_SIZE, rng)
    worn = bare > np.quantile(bare, 1.0 - BARE)
    found[(found == block("grass")) & worn] = block("path")
    high = above / highest + 0.07 * wander - SNOW
    white = (high > 0) & (steep < ROCKY + SNOWY / (1 - SNOW) * high)
    found[white] = np.where(steep < EARTHY / 2, block("snow"), block("deep snow"))[white]
    found[(above + 0.8 * wander < BEACH) & (steep < ROCKY)] = block("sand")
    found[above + 1.5 * wander < SHALLOWS] = block("gravel")
    return found


def strata(side: int, rng: np.random.Generator) -> np.ndarray:
    """Return by how many blocks the layers of rock are shifted, intp (side, side)."""
    period = sum(thick for _, thick in STRATA)
    return np.rint(BENT * variation(side, BENT_SIZE, rng)).astype(np.intp) % period


def profiles(kinds: np.ndarray, height: int, shifts: int) -> np.ndarray:
    """Return columns of blocks, uint8 (kinds, height + 1, shifts, height).

    They are those with each of ``kinds`` on top, of each number of blocks, with the layers of rock
    shifted by each number of blocks. Under the top is soil, and then rock.
    """
    layers = np.repeat([block(name) for name, _ in STRATA], [thick for _, thick in STRATA])
    level = np.arange(height)
    rock = layers[(level + np.arange(shifts)[:, None]) % len(layers)]
    under = {"grass": "earth", "path": "earth", "earth": "earth", "snow": "earth", "sand": "sand"}
    soils = {block(top): block(soil) for top, soil in under.items()}
    found = np.zeros((len(kinds), height + 1, shifts, height), np.uint8)
    for columns, kind in zip(found, kinds.tolist(), strict=True):
        for top in range(1, height + 1):
            columns[top, :, :top] = rock[:, :top]
            if kind in soils:
                columns[top, :, max(top - 1 - SOIL, 0) : top] = soils[kind]
            if kind != block("rock"):
                columns[top, :, top - 1] = kind

    return found


def filled(tops: np.ndarray, kinds: np.ndarray, height: int, shifts: np.ndarray) -> np.ndarray:
    """Return the blocks [x, z, y], uint8 (n, n, ``height``), of columns (n, n) with these tops.

    ``shifts`` (n, n) is by how many blocks the layers of rock are lower there.
    """
    some, which = np.unique(kinds, return_inverse=True)
    table = profiles(some, height, int(shifts.max()) + 1)
    return np.asarray(table[which.reshape(kinds.shape), tops, shifts])
