"""Mip levels of the sky's faces that still match along their edges (``sky.refined``).

Neighbouring faces have the same border texels, so the box shows no seam. A mip level mixes them
with texels farther inside, which are not the same: where the sky is blurred, as rippled water
mirrors it, the corners of the box would show as steps. So the border of a level is the mean along
the border alone. The levels end at the one that such water asks for: if it were followed by
coarser ones, the change from one to the next would show as a step, too. No OpenGL here.
"""

from itertools import pairwise

import numpy as np

from framelens.gl.texture import halves_evenly, mean, mip_levels

COARSEST = 5  # chosen: the last mip level


def seamless_levels(image: np.ndarray) -> list[np.ndarray]:
    """Return a face, uint8 (h, w, 3), and its mip levels; it alone if it cannot be halved."""
    if not halves_evenly(image):
        return [image]
    levels = mip_levels(image)[: COARSEST + 1]
    for finer, level in pairwise(levels):
        if min(level.shape[:2]) < 2:
            break
        for edge in (0, -1):
            level[edge] = mean(finer[edge, ::2], finer[edge, 1::2])
            level[:, edge] = mean(finer[::2, edge], finer[1::2, edge])
        for corner in ((0, 0), (0, -1), (-1, 0), (-1, -1)):
            level[corner] = finer[corner]
    return levels
