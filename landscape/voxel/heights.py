"""A source of heights: an image as a field of which height, slope and normal are known anywhere.

In the document the class "Terrain" began as this, without OpenGL. All is in blocks; x is east, z
south, y up, and column (i, k) covers i..i+1, k..k+1.
"""

from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from landscape.geometry.height_field import lookup

Number: TypeAlias = np.ndarray | float
COLUMNS, LEVELS = 500, 96  # of the land for which materials and relief were chosen


@dataclass(frozen=True)
class Heights:
    """Heights in blocks, float32 (n, n), [x, z], at the centres of the columns.

    ``tall`` is how many times as high the land is, and ``grade`` how many times as steep, as the
    same land of COLUMNS columns and LEVELS levels. Multiplied by them, a height or a rise over run
    chosen there means the same place here: the materials do not depend on the land's size.
    """

    field: np.ndarray
    tall: float = 1.0
    grade: float = 1.0

    def height(self, x: Number, z: Number) -> np.ndarray:
        """Return the height at x, z, bilinear between the centres, clamped beyond the border."""
        n = len(self.field)
        return lookup(self.field, (np.asarray(z) - 0.5) / n, (np.asarray(x) - 0.5) / n)

    def gradient(self, x: Number, z: Number) -> tuple[np.ndarray, np.ndarray]:
        """Return the slopes along x and z, by central differences over two blocks."""
        x, z = np.asarray(x, np.float64), np.asarray(z, np.float64)
        along_x = self.height(x + 1, z) - self.height(x - 1, z)
        along_z = self.height(x, z + 1) - self.height(x, z - 1)
        return along_x / 2, along_z / 2

    def normal(self, x: Number, z: Number) -> np.ndarray:
        """Return the unit normal (..., 3) at x, z."""
        along_x, along_z = self.gradient(x, z)
        found = np.stack([-along_x, np.ones_like(along_x), -along_z], axis=-1)
        return np.asarray(found / np.linalg.norm(found, axis=-1, keepdims=True))

    def position(self, x: Number, z: Number) -> np.ndarray:
        """Return the point (..., 3) of the ground at x, z."""
        x, z = np.broadcast_arrays(np.asarray(x, np.float64), np.asarray(z, np.float64))
        return np.stack([x, self.height(x, z), z], axis=-1)

    @property
    def steepness(self) -> np.ndarray:
        """Rise over run (n, n) at the centres of the columns."""
        if len(self.field) < 2:  # a single column has no slope
            return np.zeros_like(self.field)
        along_x, along_z = (np.gradient(self.field, axis=axis) for axis in (0, 1))
        return np.hypot(along_x, along_z)

    @property
    def tops(self) -> np.ndarray:
        """The number of blocks in each column, int16 (n, n), at least 1."""
        return np.maximum(np.rint(self.field), 1).astype(np.int16)

    def top(self, i: int, k: int) -> int:
        """Return the number of blocks in one column, as ``tops`` has it."""
        return max(int(np.rint(self.field[i, k])), 1)


def heights(image: np.ndarray, columns: int, levels: int) -> Heights:
    """Resample an image (h, w) of values 0..255 to ``columns`` x ``columns`` heights in blocks."""
    at = (np.arange(columns) + 0.5) / columns
    h, w = image.shape
    # The centre of a texel is half a texel from its border.
    found = lookup(image, at[None, :] - 0.5 / w, at[:, None] - 0.5 / h) * (levels / 256.0)
    return Heights(
        np.ascontiguousarray(found.T, np.float32),
        tall=levels / LEVELS,
        grade=levels * COLUMNS / (LEVELS * columns),
    )
