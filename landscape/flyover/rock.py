"""Layered rock: what walls show that a picture of the ground, seen from above, has no room for.

A steep wall covers few texels of a picture that is seen from above, and each would be drawn as a
bar from its top to its foot. So steep ground has a second picture, seen from the side. Its rows are
heights, and its columns are places: so whatever changes along the columns changes from place to
place, and costs a frame nothing. Layers dip, here more and there less, and are broken by faults;
thin layers, thick ones and massive rock with upright joints take turns. Like the picture of the
ground, it has smaller copies for the distance.
"""

from dataclasses import dataclass

import numpy as np

from landscape.files.images import half_size
from landscape.flyover.noise import noise
from landscape.flyover.sunlight import smooth_step

BITS = 10  # of a texel's row and column, chosen
SIDE = 1 << BITS  # texels a side; a power of two, so that it repeats
THICK, WIDE = 16.0, 2.5  # texels for each texel of the ground up a wall, and along it, chosen
BEND = 7.0  # how far layers are bent up and down, texels, chosen
DARKEST = 0.50  # light of the darkest rock, of the brightest, chosen
# Of a plateau and of a mountain range: how often the dip of the layers takes them once through the
# picture, and how much it changes on the way, rows a column; both chosen.
DIP, FOLDED = (0, 1), (0.35, 2.6)
FAULTS, THROW = 6, 60.0  # how many there are, and how far they move the layers, rows; chosen
SEED = 31


@dataclass(frozen=True)
class Rock:
    """A square picture of rock from the side and its copies of half the size, in one array.

    ``texels`` are uint8, 0..255: the light of rock, as a factor. Copy k begins at ``offsets[k]``
    and has ``SIDE >> k`` texels a side.
    """

    texels: np.ndarray
    offsets: np.ndarray


def rock(folded: bool) -> Rock:
    """Return the picture of rock: of a plateau, or ``folded``, of a mountain range."""
    bend = BEND * noise(SIDE, SEED, 1.8, 2, 40) + 1.5 * noise(SIDE, SEED + 1, 0.8, 30)

    # Faults are no straight lines, either.
    column = np.arange(SIDE) + np.rint(9 * noise(SIDE, SEED + 11, 1.3, 1, 60)).astype(int)
    at = np.arange(SIDE)[:, None] + bend + dip(folded)[column % SIDE]
    thin, thick = (beds(at, *each) for each in ((SEED + 4, 90, 0.7), (SEED + 5, 26, 1.0)))

    # What is beside each other changes sooner than what is above each other.
    kinds = noise(SIDE, SEED + 6, 1.0, 2, 7), noise(SIDE, SEED + 7, 1.0, 2, 7)
    some, massive = smooth_step(-0.5, 0.5, kinds[0]), smooth_step(0.2, 1.2, kinds[1])
    level = thin + (thick - thin) * some
    level += (0.45 + 0.35 * (level - 0.5) - level) * massive
    cracks = np.clip(np.abs(noise(SIDE, SEED + 2, 1.1, 8, 120)) * 6, 0, 1)
    joints = np.clip(np.abs(upright(noise(SIDE, SEED + 8, 0.7, 16, 160))) * 4, 0, 1)
    level *= 0.78 + 0.22 * cracks
    level *= 1 - (0.18 + 0.3 * massive) * (1 - joints)
    level += 0.07 * noise(SIDE, SEED + 3, 0.5, 40) + 0.08 * upright(noise(SIDE, SEED + 9, 0.9, 3))
    low, high = np.percentile(level, (1, 99))
    level = DARKEST + (1 - DARKEST) * np.clip((level - low) / (high - low), 0, 1)
    parts = []
    offsets = []
    count = 0
    while True:
        parts.append((level * 255 + 0.5).astype(np.uint8).ravel())
        offsets.append(count)
        count += level.size
        if len(level) == 1:
            return Rock(np.concatenate(parts), np.array(offsets))
        level = half_size(level)


def dip(folded: bool) -> np.ndarray:
    """Return how many rows the layers are lower at each column, (SIDE,), on a torus."""
    slope = FOLDED[folded] * noise(SIDE, SEED + 10, 1.2, 1, 8)[0]
    lower = np.cumsum(slope - slope.mean() + DIP[folded])
    generator = np.random.default_rng(SEED)
    places = np.sort(generator.choice(SIDE, FAULTS, replace=False))
    moves = THROW * generator.uniform(-1, 1, FAULTS)
    moves -= moves.mean()
    for place, move in zip(places, moves, strict=True):
        lower[place:] += move
    return np.asarray(lower)


def beds(at: np.ndarray, seed: int, count: int, spread: float) -> np.ndarray:
    """Return the light of layers at rows ``at`` (n, m) of a torus.

    ``count`` layers are as different in thickness as ``spread`` says.
    """
    generator = np.random.default_rng(seed)
    thickness = np.exp(spread * generator.normal(size=count)) + 0.15
    ends = np.concatenate([[0], np.cumsum(thickness)]) / thickness.sum() * SIDE
    rows = np.arange(4 * SIDE) / 4
    which = np.searchsorted(ends, rows, "right") - 1
    depth = (rows - ends[which]) / np.diff(ends)[which]
    light = generator.uniform(0.15, 1.0, count)[which]
    # The upper part of a layer stands out and catches the light, its lower edge is in shadow.
    light = 0.75 * light + 0.25 * np.minimum(depth * 4, 1)
    light += 0.10 * generator.normal(size=SIDE).repeat(4)
    return np.interp(at.ravel(), rows, light, period=SIDE).reshape(at.shape)


def upright(pattern: np.ndarray) -> np.ndarray:
    """Return a pattern (n, n) smeared along its columns, with deviation 1."""
    for step in (1, 2, 4, 8, 16, 32):
        pattern = (pattern + np.roll(pattern, step, 0)) / 2
    return np.asarray(pattern / (pattern.std() or 1))
