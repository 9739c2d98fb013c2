"""Comparing pictures: how far apart two renderings may be, and showing where they differ."""

import numpy as np

SAME_RENDERER = 1  # levels; llvmpipe is byte-identical on one machine, rounding may differ by one
OTHER_RENDERER = 4  # levels; another processor's generated code rounds differently
OTHER_PART = 0.001  # of the pixels may differ by more on another renderer
AMPLIFICATION = 16  # chosen: a difference of one level becomes visible


def difference(expected: np.ndarray, actual: np.ndarray) -> np.ndarray:
    """Return the largest difference of each pixel's channels, int32 (h, w), of uint8 pictures."""
    return np.asarray(np.abs(expected.astype(np.int32) - actual.astype(np.int32)).max(axis=2))


def agree(expected: np.ndarray, actual: np.ndarray, same_renderer: bool) -> bool:
    """Tell whether two uint8 pictures (h, w, 3) are the same but for what renderers may differ."""
    if expected.shape != actual.shape:
        return False
    levels = difference(expected, actual)
    if same_renderer:
        return bool(levels.max(initial=0) <= SAME_RENDERER)
    return bool((levels > OTHER_RENDERER).mean() <= OTHER_PART)


def amplified(expected: np.ndarray, actual: np.ndarray) -> np.ndarray:
    """Return the difference made visible, uint8 (h, w, 3); all white where the sizes differ."""
    if expected.shape != actual.shape:
        return np.full_like(actual, 255)
    levels = np.abs(expected.astype(np.int32) - actual.astype(np.int32)) * AMPLIFICATION
    return np.minimum(levels, 255).astype(np.uint8)
