"""Smooth pictures stored as JPEG, such as a sky: read without the faint blocks of its coding.

JPEG rounds brightness and colour in squares of 8 x 8 texels. In a gradient that leaves steps of one
level, which the eye finds as edges. There the mean around each texel is taken instead, with noise
of less than a level; where there is detail, the picture stays as it is.
"""

from pathlib import Path

import numpy as np

from landscape.files.cache import content, recall
from landscape.files.images import read_image

REACH = 4  # texels, chosen: a mean over 9 x 9 is wider than a block
COARSE = 2.0  # levels, chosen: what differs more from the mean is detail
NOISE = 0.7  # levels, chosen: enough to hide the rounding to whole levels
SEED = 71  # chosen


def _sums_around(picture: np.ndarray) -> np.ndarray:
    """Return for each pixel the sum, int16, of those at most REACH away to each side."""
    sides = ((REACH, REACH), (REACH, REACH), (0, 0))
    # Odd: a gradient continues beyond the edge, so that the mean there is the edge's own colour.
    padded = np.pad(picture.astype(np.int16), sides, mode="reflect", reflect_type="odd")
    total = np.clip(padded, 0, 255)
    height, width = picture.shape[:2]
    rows = [total[k : k + height] for k in range(2 * REACH + 1)]
    total = np.sum(rows, axis=0, dtype=np.int16)
    columns = [total[:, k : k + width] for k in range(2 * REACH + 1)]
    return np.asarray(np.sum(columns, axis=0, dtype=np.int16))


def smoothed(picture: np.ndarray) -> np.ndarray:
    """Return a picture, uint8 (h, w, 3), whose gradients have no steps; both sides >= 5."""
    away = np.float32(1 / (2 * REACH + 1) ** 2) * _sums_around(picture) - picture
    flat = np.clip(COARSE - np.abs(away).max(axis=2, keepdims=True), 0.0, 1.0)
    noise = np.random.default_rng(SEED).random((*picture.shape[:2], 1), np.float32) - 0.5
    return np.clip(np.rint(picture + flat * (away + NOISE * noise)), 0, 255).astype(np.uint8)


def read_smooth(path: Path) -> np.ndarray:
    """Read a picture as uint8 (h, w, 3), smoothed if it is a JPEG; InputError as read_image."""
    if path.suffix.lower() not in (".jpg", ".jpeg"):
        return read_image(path, "RGB")
    return recall((content(path), "smooth"), lambda: (smoothed(read_image(path, "RGB")),))[0]
