"""The colours of the shore, moved to where the land is drawn.

Vertex k of N samples the height image at k/N, although it is drawn at k/(N-1), as in the report
(geometry/height_field.py). The large texture is painted as the image is, so coasts that face east
and south are drawn up to size/N farther out than they are painted; others are a little farther out
because the mesh is smoother. They would show the colours of the sea floor on land: a green-blue
belt that a swimmer sees. There the colours are taken from where the texture has this shore, or
uphill from there. Elsewhere such a shift of colours cannot be seen. No OpenGL here.
"""

import numpy as np

from landscape.geometry.height_field import HeightField, lookup

EDGE = 0.03  # chosen: units of height over which the moved colours blend with the others
ROWS = 256  # rows of texels computed at a time
COARSE = 512  # blocks a side, by which the neighbourhood of the shore is found
UPHILL = 12  # chosen: texels, how far uphill land is looked for


def moved_shore(
    large: np.ndarray, painted: np.ndarray, field: HeightField, knots: int
) -> tuple[np.ndarray, np.ndarray]:
    """Return the texels to change, int64 (m,) in row order, and their colours, uint8 (m, 3).

    ``large`` is the texture (n, n, 3), ``painted`` the heights of the image in units, (h, w);
    ``knots`` is N, the number of vertices a side that sample it.
    """
    side = len(large)
    size = field.size
    level = field.water_level

    def heights(x: np.ndarray, z: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return how high above the water x, z is drawn, and how far below it is painted."""
        below = level - centred(painted, x / size, z / size)
        return field.terrain_height(x, z) - level, below

    at = (np.arange(side) + 0.5) / side * size
    blocks = (np.arange(COARSE) + 0.5) / COARSE * size
    drawn, below = heights(*np.meshgrid(blocks, blocks))
    near = around(drawn > -EDGE) & around(below > 0.0)
    block = np.minimum(np.arange(side) * COARSE // side, COARSE - 1)
    texels, colours = [], []
    for first in range(0, side, ROWS):
        rows, columns = np.nonzero(near[block[first : first + ROWS]][:, block])
        rows += first
        x, z = at[columns], at[rows]
        drawn, below = heights(x, z)
        weight = np.clip(1.0 + drawn / EDGE, 0.0, 1.0) * np.clip(below / EDGE, 0.0, 1.0)
        # On beaches, where this is little, the shift is not seen.
        weight *= np.clip((drawn + below) / EDGE - 1.0, 0.0, 1.0)
        kept = weight > 0.0
        x = x[kept]
        z = z[kept]
        rows = rows[kept]
        columns = columns[kept]
        own = large[rows, columns]
        there = centred(large, *painted_at(x, z, painted, field, knots, side))
        texels.append(rows * side + columns)
        colours.append((own + (there - own) * weight[kept, None] + 0.5).astype(np.uint8))
    return np.concatenate(texels), np.concatenate(colours)


def centred(image: np.ndarray, u: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Return what :func:`lookup` does, of an image whose values are at the middles of pixels."""
    height, width = image.shape[:2]
    return lookup(image, u - 0.5 / width, v - 0.5 / height)


def around(mask: np.ndarray) -> np.ndarray:
    """Return the mask (n, n) and all neighbours of what is in it."""
    for _ in range(2):
        wide = np.pad(mask, ((1, 1), (0, 0)))
        mask = (wide[:-2] | wide[1:-1] | wide[2:]).T
    return mask


def painted_at(
    x: np.ndarray, z: np.ndarray, painted: np.ndarray, field: HeightField, knots: int, side: int
) -> tuple[np.ndarray, np.ndarray]:
    """Return u, v (n,), 0..1: where a texture of ``side`` texels has what is drawn at x, z (n,).

    Where that is under water, the nearest land uphill of it, if there is any within UPHILL texels.
    """
    # A vertex samples the corner of a pixel, whose colour is painted at its middle.
    u, v = (
        a * (knots - 1) / knots / field.size + 0.5 / pixels
        for a, pixels in zip((x, z), painted.shape[::-1], strict=True)
    )
    cell = field.size / (len(field.heights) - 1)
    rise_x = field.terrain_height(x + cell, z) - field.terrain_height(x - cell, z)
    rise_z = field.terrain_height(x, z + cell) - field.terrain_height(x, z - cell)
    steep = np.maximum(np.hypot(rise_x, rise_z), 1e-9) * side
    for _ in range(UPHILL):
        wet = centred(painted, u, v) < field.water_level
        u, v = u + wet * rise_x / steep, v + wet * rise_z / steep
    return u, v
