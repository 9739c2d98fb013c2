"""Comparing pictures: how far two renderings may differ, and where they do.

On the renderer that drew the expected picture nothing may differ, except some roundings. Another
one may filter textures with fewer or more bits, and choose another mipmap level between two: both
change many pixels a little, all in the same direction. Measured between llvmpipe's two ways to
sample textures: no picture by more than 3 levels on average, 0.005 % of the pixels by more than
12. A wrong blend or a lost element changes more of them by more.

A picture of cubes is all hard edges, and a renderer whose arithmetic rounds otherwise gives a few
of the pixels on them to the face on the other side. Such a picture may differ in more pixels, if
these are like those around them and the mean is closer. Measured between Mesa 22.3 and 26.2, of the
island in cubes: 0.58 % of the pixels by more than 12 levels, 0.03 % by more than that from all
colours around them, 0.15 levels on average. Without its water, of which a view shows 150 pixels,
0.43 % are unlike those around them.
"""

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

SAME_RENDERER = 1  # levels, on the renderer that drew the expected picture
SAME_FRACTION = 0.01  # chosen: of the pixels may differ at all on that one
OTHER_RENDERER = 12  # levels, on another renderer
OTHER_FRACTION = 0.001  # of the pixels may differ by more than that on another one
OTHER_MEAN = 4.0  # levels, of all pixels on average on another one
# On another renderer, of a picture that is all hard edges. OTHER_FRACTION is then of those pixels
# that differ by more than OTHER_RENDERER from all colours around them.
EDGES_FRACTION = 0.01  # of the pixels may differ by more than OTHER_RENDERER
EDGES_MEAN = 0.5  # levels, of all pixels on average
# Of a picture that was compressed with a loss, beside a new one.
LOSSY_MEAN, LOSSY_BLOCK = 6.0, 5.0  # levels, of all pixels, and of any block of BLOCK x BLOCK
BLOCK = 20  # pixels, chosen
AMPLIFICATION = 16  # chosen: makes a difference of one level visible


def difference(expected: np.ndarray, actual: np.ndarray) -> np.ndarray:
    """Return each pixel's largest difference in any channel, int32 (h, w), of uint8 pictures."""
    # Signed: in uint8, 3 - 5 is 254.
    return np.asarray(np.abs(expected.astype(np.int32) - actual.astype(np.int32)).max(axis=2))


def beyond_edges(expected: np.ndarray, actual: np.ndarray) -> np.ndarray:
    """Return how far each pixel is outside the colours around it in the expected picture.

    Of each channel the least and the greatest value of the 3 x 3 pixels around it count. The
    result, int32 (h, w), is the largest of any channel, of uint8 pictures (h, w, 3).
    """
    padded = np.pad(expected.astype(np.int32), ((1, 1), (1, 1), (0, 0)), mode="edge")
    around = sliding_window_view(padded, (3, 3), axis=(0, 1))
    least, greatest = around.min(axis=(-2, -1)), around.max(axis=(-2, -1))
    return np.asarray(np.maximum(least - actual, actual - greatest).clip(0).max(axis=2))


def agree(
    expected: np.ndarray, actual: np.ndarray, same_renderer: bool, edges: bool = False
) -> bool:
    """Return whether two uint8 pictures (h, w, 3) differ no more than renderers may.

    ``edges`` says that they are all hard edges: then a few may be one pixel further on another one.
    """
    if expected.shape != actual.shape:
        return False
    levels = difference(expected, actual)
    if same_renderer:
        few = (levels > 0).mean() <= SAME_FRACTION
        return bool(few and levels.max(initial=0) <= SAME_RENDERER)
    off = (levels > OTHER_RENDERER).mean()
    if off <= OTHER_FRACTION and levels.mean() <= OTHER_MEAN:
        return True
    if not edges or off > EDGES_FRACTION or levels.mean() > EDGES_MEAN:
        return False
    return bool((beyond_edges(expected, actual) > OTHER_RENDERER).mean() <= OTHER_FRACTION)


def agree_lossy(expected: np.ndarray, actual: np.ndarray) -> bool:
    """Return whether two pictures agree, one of which was compressed with a loss.

    Compression changes many pixels, but the mean of a block hardly; a change of the picture does.
    """
    if expected.shape != actual.shape:
        return False
    rows, columns = (side // BLOCK * BLOCK for side in expected.shape[:2])
    signed = (expected.astype(np.float32) - actual)[:rows, :columns]
    blocks = signed.reshape(rows // BLOCK, BLOCK, columns // BLOCK, BLOCK, 3).mean(axis=(1, 3))
    mean = difference(expected, actual).mean()
    return bool(mean <= LOSSY_MEAN and np.abs(blocks).max(initial=0) <= LOSSY_BLOCK)


def amplified(expected: np.ndarray, actual: np.ndarray) -> np.ndarray:
    """Return the amplified difference, uint8 (h, w, 3); all white if the sizes differ."""
    if expected.shape != actual.shape:
        return np.full_like(actual, 255)
    levels = np.abs(expected.astype(np.int32) - actual.astype(np.int32)) * AMPLIFICATION
    return np.minimum(levels, 255).astype(np.uint8)
