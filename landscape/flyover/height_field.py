"""The terrain: heights from an image, mirrored without end, and the same at half the resolution.

A pixel's position gives x and y, its colour gives z (section 2.3). At each border of the image
stands a mirror image of it (figure 7). So that the mirror images match at every power of two, the
vertices are counted from 0 to N, and the last repeats pixel N - 1: vertex i, anywhere on the plane,
is vertex ``abs((i + N) mod 2N - N)``.

Level of detail l has every 2^l-th vertex in each direction. Its heights are averages of those of
the level below it, with weights 1, 2, 1: distant terrain drawn from single pixels would flicker.
The average of a mirrored terrain is mirrored, too. Levels coarser than the image are flat.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from landscape.errors import InputError, short
from landscape.files.cache import recall
from landscape.flyover.settings import Flyover

MOST_SIDE = 4096  # pixels, chosen
WHITE = 255.0


@dataclass(frozen=True)
class HeightField:
    """Heights in units at all levels of detail, level l float32 (M + 1, M + 1) where M = N / 2^l.

    Row along y and column along x. ``unit`` is the distance between vertices at level 0. The last
    level is flat; it stands for all that are coarser.
    """

    levels: Sequence[np.ndarray]
    unit: float = 1.0

    @property
    def side(self) -> int:
        """N, the number of pixels on a side of the image."""
        return len(self.levels[0]) - 1

    @property
    def size(self) -> float:
        """The length in units of a side of the image; it repeats every two of them."""
        return self.side * self.unit

    @cached_property
    def lowest(self) -> float:
        """The lowest height in units."""
        return float(self.levels[0].min())

    @cached_property
    def highest(self) -> float:
        """The greatest height in units."""
        return float(self.levels[0].max())

    def height(self, x: np.ndarray | float, y: np.ndarray | float) -> np.ndarray:
        """Return heights in units at points of the plane, linear between the vertices."""
        return self._corners(x, y)[0]

    def gradient(self, x: np.ndarray | float, y: np.ndarray | float) -> np.ndarray:
        """Return the slope along x and along y, rise over run, (..., 2) at points (...)."""
        return np.stack(self._corners(x, y)[1:], axis=-1)

    def _corners(self, x: np.ndarray | float, y: np.ndarray | float) -> Sequence[np.ndarray]:
        """Return the height at points, and the slopes along x and y."""
        u, v = np.asarray(x, np.float64) / self.unit, np.asarray(y, np.float64) / self.unit
        column, row = np.floor(u).astype(np.int64), np.floor(v).astype(np.int64)
        s, t = u - column, v - row
        left, right = mirrored(column, self.side), mirrored(column + 1, self.side)
        near, far = mirrored(row, self.side), mirrored(row + 1, self.side)
        h = self.levels[0]
        a, b = h[near, left].astype(np.float64), h[near, right].astype(np.float64)
        c, d = h[far, left].astype(np.float64), h[far, right].astype(np.float64)
        first, second = a + s * (b - a), c + s * (d - c)
        along_x = ((b - a) * (1 - t) + (d - c) * t) / self.unit
        return first + t * (second - first), along_x, (second - first) / self.unit


def mirrored(index: np.ndarray, side: int) -> np.ndarray:
    """Return the vertex from 0 to ``side`` that a vertex of the mirrored plane repeats.

    ``side`` is a power of two.
    """
    return np.abs(((index + side) & (2 * side - 1)) - side)


def height_field(
    image: np.ndarray, settings: Flyover | None = None, name: str = "height image"
) -> HeightField:
    """Return the terrain of a height image (N, N) of values from 0 (black) to 255 (white).

    N is a power of two from 2 to 4096. What takes time is cached. InputError begins with ``name``.
    """
    settings = settings or Flyover()
    check_image(image, name)
    values = np.ascontiguousarray(image, np.float32)
    above = WHITE - values if settings.black_high else values
    heights = above * np.float32(settings.relief / WHITE)
    levels = recall((str(heights.shape), heights.tobytes()), lambda: averages(heights))
    return HeightField(levels, settings.unit)


def check_image(image: np.ndarray, name: str) -> None:
    """Raise InputError unless an array is a height image."""
    found = np.asarray(image)
    if found.ndim != 2 or found.dtype.kind not in "uif":
        raise InputError(f"{name}: expected one number for each pixel, not {short(found.shape)}")
    rows, columns = found.shape
    if rows != columns or rows & (rows - 1) or not 2 <= rows <= MOST_SIDE:
        nearest = [n for n in nearest_sides(max(rows, columns)) if 2 <= n <= MOST_SIDE]
        sizes = " or ".join(f"{n}x{n}" for n in nearest)
        raise InputError(
            f"{name}: expected a square image whose side is a power of two, such as {sizes}, "
            f"not {columns}x{rows}"
        )
    if found.dtype.kind == "f" and not np.isfinite(found).all():
        raise InputError(f"{name}: expected finite heights")


def nearest_sides(side: int) -> tuple[int, ...]:
    """Return the powers of two from 2 to MOST_SIDE next to a number."""
    below = 1 << max(side, 1).bit_length() - 1
    found = {min(max(n, 2), MOST_SIDE) for n in (below, below if below == side else 2 * below)}
    return tuple(sorted(found))


def averages(heights: np.ndarray) -> tuple[np.ndarray, ...]:
    """Return the heights (N, N) at all levels of detail, see :class:`HeightField`."""
    levels = [np.pad(heights, (0, 1), "edge")]
    while len(levels[-1]) > 2:
        levels.append(halved(halved(levels[-1]).T).T)
    return *map(np.ascontiguousarray, levels), np.full((2, 2), levels[-1].mean(), np.float32)


def halved(heights: np.ndarray) -> np.ndarray:
    """Return every second row of heights (M + 1, ...), averaged with its neighbours, 1 : 2 : 1.

    Rows 0 and M are axes of symmetry: the rows beyond them are those before them.
    """
    padded = np.concatenate([heights[1:2], heights, heights[-2:-1]])
    return (padded[:-2:2] + padded[2::2] + 2 * padded[1:-1:2]) / 4
