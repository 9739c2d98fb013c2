"""Sheltered water: near land the sea is calm, and mirrors clearly (``water.sheltered``).

Waves grow with the fetch, the way that the wind has blown over open water. Technique: a map made
once. From each of its points, lines run out in all directions until they meet land; the mean of
their lengths says how open the sea is there, and by how much the waves are lower.
No OpenGL here.
"""

import numpy as np
from PIL import Image

TEXELS = 128  # chosen: points per side on which the lines are followed
DIRECTIONS = 24  # chosen: lines from each point
FETCH = 3.0  # chosen: units of open water in which the waves become as high as they get
COVE, OPEN = (
    0.62,
    0.92,
)  # chosen: openness below which it is calmest, and above which it is open sea
CALMEST = 0.12  # chosen: fraction of the waves that is left in a cove


def openness(land: np.ndarray, spacing: float) -> np.ndarray:
    """Return how open the sea is: mean fetch as a fraction of FETCH, float32 (n, n); 0 on land.

    ``land`` (n, n) says where land is, on points ``spacing`` units apart. What lies beyond the map
    is open sea.
    """
    steps = round(FETCH / spacing)
    around = np.pad(land, steps)
    rows, columns = land.shape
    total = np.zeros(land.shape, np.float32)

    for angle in 2 * np.pi * np.arange(DIRECTIONS) / DIRECTIONS:
        afloat = ~land
        for step in range(1, steps + 1):
            row = steps + round(step * np.sin(angle))
            column = steps + round(step * np.cos(angle))
            total += afloat
            afloat = afloat & ~around[row : row + rows, column : column + columns]

    return np.asarray(total / np.float32(DIRECTIONS * steps))


def wave_heights(depths: np.ndarray, size: float) -> np.ndarray:
    """Return what is left of the waves, CALMEST to 1, float32 (n, n) like ``depths``.

    ``depths`` (n, n) are those of the sea on a map of ``size`` units, negative on land.
    """
    land = Image.fromarray(depths < 0).resize((TEXELS, TEXELS), Image.Resampling.NEAREST)
    coarse = Image.fromarray(openness(np.asarray(land), size / TEXELS))
    smooth = np.asarray(coarse.resize(depths.shape[::-1], Image.Resampling.BICUBIC))

    t = np.clip((smooth - COVE) / (OPEN - COVE), 0.0, 1.0)
    heights = CALMEST + (1.0 - CALMEST) * t * t * (3.0 - 2.0 * t)
    # The border is open sea: what lies beyond the map takes its value from there.
    heights[[0, -1], :] = heights[:, [0, -1]] = 1.0
    return heights.astype(np.float32)
