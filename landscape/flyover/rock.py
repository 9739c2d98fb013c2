"""Layered rock: what walls show that a picture of the ground, seen from above, has no room for.

A steep wall covers few texels of a picture that is seen from above, and each would be drawn as a
bar from its top to its foot. So steep ground has a second picture, seen from the side: layers of
rock by height, some hard and bright, some soft and dark, bent and broken along the wall. Like the
picture of the ground, it has smaller copies for the distance.
"""

from dataclasses import dataclass

import numpy as np

from landscape.flyover.noise import noise

BITS = 9
SIDE = 1 << BITS  # texels a side; a power of two, so that it repeats
THICK, WIDE = 16.0, 5.0  # texels for each texel of the ground up a wall, and along it, chosen
LAYERS = 44  # in the height of the picture, chosen
BEND = 11.0  # how far layers are bent up and down, texels, chosen
DARKEST = 0.52  # light of the darkest rock, of the brightest, chosen
SEED = 31


@dataclass(frozen=True)
class Rock:
    """A square picture of rock from the side and its copies of half the size, in one array.

    ``texels`` are uint32, 0..256: the light of rock, as a factor. Copy k begins at ``offsets[k]``
    and has ``SIDE >> k`` texels a side.
    """

    texels: np.ndarray
    offsets: np.ndarray


def rock() -> Rock:
    """Return the picture of layered rock."""
    generator = np.random.default_rng(SEED)
    ends = np.sort(generator.choice(np.arange(2, SIDE - 2), LAYERS - 1, replace=False))
    thickness = np.diff([0, *ends, SIDE])
    light = np.repeat(generator.uniform(0.2, 1.0, LAYERS), thickness)
    depth = np.concatenate([np.linspace(0, 1, count) for count in thickness])
    # The upper part of a layer stands out and catches the light, its lower edge is in shadow.
    light = 0.75 * light + 0.25 * np.minimum(depth * 4, 1)
    bend = BEND * noise(SIDE, SEED, 1.8, 2, 40) + 1.5 * noise(SIDE, SEED + 1, 0.8, 30)
    at = np.arange(SIDE)[:, None] + bend
    level = np.interp(at.ravel(), np.arange(SIDE), light, period=SIDE).reshape(at.shape)
    cracks = np.clip(np.abs(noise(SIDE, SEED + 2, 1.1, 8, 120)) * 6, 0, 1)
    level = level * (0.75 + 0.25 * cracks) + 0.07 * noise(SIDE, SEED + 3, 0.5, 40)
    low, high = np.percentile(level, (1, 99))
    level = DARKEST + (1 - DARKEST) * np.clip((level - low) / (high - low), 0, 1)
    parts, offsets, count = [], [], 0
    while True:
        parts.append((level * 256 + 0.5).astype(np.uint32).ravel())
        offsets.append(count)
        count += level.size
        if len(level) == 1:
            return Rock(np.concatenate(parts), np.array(offsets))
        level = (level[::2, ::2] + level[1::2, ::2] + level[::2, 1::2] + level[1::2, 1::2]) / 4
