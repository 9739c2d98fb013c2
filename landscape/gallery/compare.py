"""Comparing pictures: how far two renderings may differ, and where they do."""

import numpy as np

SAME_RENDERER = 1  # levels, on the renderer that drew the expected picture
OTHER_RENDERER = 4  # levels; llvmpipe generates code for the processor it runs on
OTHER_FRACTION = 0.001  # of the pixels may differ by more than that on another renderer
AMPLIFICATION = 16  # chosen: makes a difference of one level visible


def difference(expected: np.ndarray, actual: np.ndarray) -> np.ndarray:
    """Return each pixel's largest difference in any channel, int32 (h, w), of uint8 pictures."""
    # Signed: in uint8, 3 - 5 is 254.
    return np.asarray(np.abs(expected.astype(np.int32) - actual.astype(np.int32)).max(axis=2))


def agree(expected: np.ndarray, actual: np.ndarray, same_renderer: bool) -> bool:
    """Return whether two uint8 pictures (h, w, 3) differ no more than renderers may."""
    if expected.shape != actual.shape:
        return False
    levels = difference(expected, actual)
    if same_renderer:
        return bool(levels.max(initial=0) <= SAME_RENDERER)
    return bool((levels > OTHER_RENDERER).mean() <= OTHER_FRACTION)


def amplified(expected: np.ndarray, actual: np.ndarray) -> np.ndarray:
    """Return the amplified difference, uint8 (h, w, 3); all white if the sizes differ."""
    if expected.shape != actual.shape:
        return np.full_like(actual, 255)
    levels = np.abs(expected.astype(np.int32) - actual.astype(np.int32)) * AMPLIFICATION
    return np.minimum(levels, 255).astype(np.uint8)
