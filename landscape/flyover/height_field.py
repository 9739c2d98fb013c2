"""The terrain: heights from an image, mirrored without end, and the same at half the resolution.

A pixel's position gives x and y, its colour gives z (section 2.3). At each border of the image
stands a mirror image of it (figure 7). So that the mirror images match at every power of two, the
vertices are counted from 0 to N, and the last repeats pixel N - 1: vertex i, anywhere on the plane,
is vertex ``abs((i + N) mod 2N - N)``. An image that is not square is kept with its mirror images,
as many as make a square of it: the plane is the same.

Level of detail l has every 2^l-th vertex in each direction. Its heights are averages of those of
the level below it, with weights 1, 2, 1: distant terrain drawn from single pixels would flicker.
The average of a mirrored terrain is mirrored, too. Levels coarser than the image are flat.
"""

import hashlib
import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from PIL import Image

from framelens.base.errors import InputError, short
from landscape.files.cache import recall
from landscape.flyover.settings import Flyover

MOST_SIDE = 4096  # pixels, chosen
WHITE = 255.0
AROUND = 32  # vertices, chosen


@dataclass(frozen=True, eq=False)
class HeightField:
    """Heights in units at all levels of detail, level l (M + 1, M + 1) where M = N / 2^l.

    ``values`` float32 (n,) are all levels, one after the other, each row by row along y. ``side``
    is N, and ``unit`` the distance between vertices at level 0. The last level is flat; it stands
    for all that are coarser. ``name`` is a hash of the heights.
    """

    values: np.ndarray
    side: int
    unit: float = 1.0
    name: str = ""

    @cached_property
    def sides(self) -> np.ndarray:
        """M of each level, int64."""
        # The last level, whose vertices are 2N apart, has M = 1 for want of a smaller number.
        return np.maximum(self.side >> np.arange(self.side.bit_length() + 1), 1)

    @cached_property
    def offsets(self) -> np.ndarray:
        """Where each level begins in ``values``, int64."""
        return np.cumsum((self.sides + 1) ** 2) - (self.sides + 1) ** 2

    @cached_property
    def levels(self) -> list[np.ndarray]:
        """The heights of each level, (M + 1, M + 1), row along y and column along x."""
        pairs = zip(self.offsets.tolist(), (self.sides + 1).tolist(), strict=True)
        return [self.values[at : at + n * n].reshape(n, n) for at, n in pairs]

    def at(self, level: np.ndarray, row: np.ndarray, column: np.ndarray) -> np.ndarray:
        """Return the heights of vertices, float32 (n, rows, columns).

        They are the ``row`` (n, rows) and ``column`` (n, columns) at ``level`` (n,), whole numbers
        counted from the map's corner, on the endless plane.
        """
        which = np.minimum(level, len(self.sides) - 1)[:, None]
        side = self.sides[which]
        begin = self.offsets[which] + mirrored(row, side) * (side + 1)
        places = begin[:, :, None] + mirrored(column, side)[:, None, :]
        return np.asarray(self.values.take(places))

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

    @cached_property
    def _tops(self) -> np.ndarray:
        """The greatest height around the corners of squares of AROUND vertices, (T + 1, T + 1)."""
        count = max(self.side // AROUND, 1)
        inside = self.levels[0][:-1, :-1].reshape(count, self.side // count, count, -1)
        squares = np.pad(inside.max(axis=(1, 3)), 1, "edge")
        return np.maximum(
            np.maximum(squares[:-1, :-1], squares[1:, :-1]),
            np.maximum(squares[:-1, 1:], squares[1:, 1:]),
        )

    def top(self, x: float, y: float) -> float:
        """Return a height that no terrain near a point exceeds, and that changes gradually.

        Near means on the square of AROUND vertices where the point is.
        """
        squares = HeightField(self._tops.ravel(), len(self._tops) - 1)
        side = self.size / squares.side
        return float(squares.height(x / side, y / side))

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
        near, far = (mirrored(each, self.side) * (self.side + 1) for each in (row, row + 1))
        corners = np.stack([near + left, near + right, far + left, far + right])
        a, b, c, d = self.values[corners].astype(np.float64)
        first, second = a + s * (b - a), c + s * (d - c)
        along_x = ((b - a) * (1 - t) + (d - c) * t) / self.unit
        return first + t * (second - first), along_x, (second - first) / self.unit


def mirrored(index: np.ndarray, side: np.ndarray | int) -> np.ndarray:
    """Return the vertex from 0 to ``side`` that a vertex of the mirrored plane repeats.

    ``side`` is a power of two.
    """
    return np.abs(((index + side) & (2 * side - 1)) - side)


def height_field(
    image: np.ndarray, settings: Flyover | None = None, name: str = "height image"
) -> HeightField:
    """Return the terrain of a height image (h, w) of values from 0 (black) to 255 (white).

    Its sides are powers of two from 2 to 4096; with ``flyover.resolution`` the image is sampled
    again, and may have any. Slow results are cached. InputError begins with ``name``.
    """
    settings = settings or Flyover()
    unit = settings.unit
    if settings.resolution:
        check_image(image, name, any_size=True)
        longest = max(np.shape(image))
        image = sampled(image, settings.resolution)
        unit *= longest / settings.resolution

    check_image(image, name)
    values = np.asarray(image, np.float32)
    heights = WHITE - values if settings.black_high else values.copy()
    heights *= np.float32(settings.relief / WHITE)
    digest = hashlib.blake2b(np.ascontiguousarray(heights).data, digest_size=20)
    if heights.shape[0] != heights.shape[1]:
        digest.update(repr(heights.shape).encode())
    key = digest.hexdigest()
    (values,) = recall(("fly-over levels", key), lambda: (averages(heights),))
    return HeightField(values, max(heights.shape), unit, key)


def sampled(image: np.ndarray, resolution: int) -> np.ndarray:
    """Return an image (h, w) sampled again, so that its longer side is ``resolution``, float32.

    The other side becomes the nearest power of two. Fewer pixels are means of those that they
    cover, more are interpolated by cubics.
    """
    rows, columns = np.shape(image)
    part = min(rows, columns) / max(rows, columns)
    shorter = max(1 << round(math.log2(max(resolution * part, 2.0))), 2)
    size = (shorter, resolution) if columns < rows else (resolution, shorter)
    # Pillow widens its cubic where pixels become fewer, so that none is left out.
    found = Image.fromarray(np.asarray(image, np.float32)).resize(size, Image.Resampling.BICUBIC)
    return np.clip(np.asarray(found), 0.0, WHITE)


def check_image(image: np.ndarray, name: str, any_size: bool = False) -> None:
    """Raise InputError unless an array is a height image; ``any_size``: not only powers of two."""
    found = np.asarray(image)
    if found.ndim != 2 or found.dtype.kind not in "uif":
        raise InputError(
            "{name}: expected one number for each pixel, not {shape}",
            name=name,
            shape=short(found.shape),
        )

    rows, columns = found.shape
    sides = (rows, columns)
    fits = all(2 <= side <= MOST_SIDE for side in sides)
    if not fits or not (any_size or all(side & (side - 1) == 0 for side in sides)):
        nearest = [n for n in nearest_sides(max(sides)) if 2 <= n <= MOST_SIDE]
        sizes = " or ".join(f"{n}x{n}" for n in nearest)
        raise InputError(
            "{name}: expected an image whose sides are powers of two, such as {sizes}, "
            "not {columns}x{rows}; flyover.resolution samples any other again",
            name=name,
            sizes=sizes,
            columns=columns,
            rows=rows,
        )
    if found.dtype.kind == "f" and not np.isfinite(found).all():
        raise InputError("{name}: expected finite heights", name=name)


def nearest_sides(side: int) -> tuple[int, ...]:
    """Return the powers of two from 2 to MOST_SIDE next to a number."""
    below = 1 << max(side, 1).bit_length() - 1
    found = {min(max(n, 2), MOST_SIDE) for n in (below, below if below == side else 2 * below)}
    return tuple(sorted(found))


def averages(heights: np.ndarray) -> np.ndarray:
    """Return the heights (h, w) at all levels of detail, see :class:`HeightField`."""
    levels = [vertices(heights)]
    while len(levels[-1]) > 2:
        levels.append(halved(halved(levels[-1]).T).T)
    flat = np.full((2, 2), levels[-1].mean(), np.float32)
    return np.concatenate([level.ravel() for level in (*levels, flat)])


def vertices(heights: np.ndarray) -> np.ndarray:
    """Return the heights (h, w) as vertices (N + 1, N + 1), where N is the longer side.

    Along the shorter one they go on as mirror images.
    """
    at = np.arange(max(heights.shape) + 1)
    row, column = (np.minimum(mirrored(at, side), side - 1) for side in heights.shape)
    return heights[np.ix_(row, column)]


def halved(heights: np.ndarray) -> np.ndarray:
    """Return every second row of heights (M + 1, ...), averaged with its neighbours, 1 : 2 : 1.

    Rows 0 and M are axes of symmetry: the rows beyond them are those before them.
    """
    padded = np.concatenate([heights[1:2], heights, heights[-2:-1]])
    return (padded[:-2:2] + padded[2::2] + 2 * padded[1:-1:2]) / 4
