"""Turf that looks like the sward that grows on it (``ground.verdure``).

Far away the sward thins out, and between its cards the ground is seen. Here the ground's large
texture takes the sward's mean colour where turf grows, so that the meadow has one colour whether
cards cover it or not; and the mip levels of the details keep some of the contrast that averaging
would take from them, so that ground many strides away still has a grain. No OpenGL here.
"""

import numpy as np

from framelens.gl.texture import mip_levels

# All chosen.
BRIGHTER = 1.04  # how much lighter the sward is than the ground that it takes its colour from
TINGE = np.array([0.90, 1.12, 0.55], np.float32)  # its colour where the ground is lush, times grey
GREENER = (0.02, 0.30)  # how much of that colour it has, on dry ground and on lush
KEPT = 0.80  # contrast of a mip level, times that of the one before, at least
MOST = 4.0  # times the contrast of the mean: more would show that it is rounded
GRAINED = 7  # mip levels that keep it; in the others the repetition would show


def verdant(colours: np.ndarray, turf: np.ndarray, strength: float) -> np.ndarray:
    """Return colours, uint8 (n, n, 3), in the sward's where there is ``turf``, uint8 (n, n, 1)."""
    out = colours.copy()
    rows = max((1 << 20) // max(colours.shape[1], 1), 1)  # a few megabytes in memory at a time
    for first in range(0, len(colours), rows):
        part = slice(first, first + rows)
        colour = colours[part].astype(np.float32)
        light = (colour @ np.array([0.30, 0.59, 0.11], np.float32))[..., None]
        lush = colour[..., 1:2] / np.maximum(colour[..., :1], 1.0)
        lush = np.clip((lush - 0.94) / 0.22, 0.0, 1.0)
        mixed = GREENER[0] + (GREENER[1] - GREENER[0]) * lush
        grass = BRIGHTER * (colour + mixed * (light * TINGE - colour))
        colour += strength / np.float32(255.0) * turf[part] * (grass - colour)
        out[part] = np.clip(colour + 0.5, 0, 255)
    return out


def grained(image: np.ndarray) -> list[np.ndarray]:
    """Return the mip levels of a detail, uint8 (h, w, c), whose contrast fades more slowly.

    Its sides are powers of two.
    """
    levels = [level.astype(np.float32) for level in mip_levels(image)]
    means = levels[0].mean(axis=(0, 1))
    wanted, found = float(levels[0].std()), []
    for number, level in enumerate(levels):
        have = float(level.std())
        gain = 1.0
        if 0 < number < GRAINED and have > 1e-3:
            wanted = max(wanted * KEPT, have)
            gain = min(wanted / have, MOST)
        apart = level - level.mean(axis=(0, 1))  # its mean was rounded up at each level before
        found.append(np.clip(means + gain * apart + 0.5, 0, 255).astype(np.uint8))
    return found
