"""Hidden lines, removed with a floating horizon: one height per column of the screen, no z buffer.

Lines of a height field are drawn from front to back. Each column remembers the highest row that was
drawn in it, the horizon; what is farther away and lower is hidden by the terrain in between. Then
the horizon is raised by what was drawn (Wright, 1973). Wright's surfaces have an underside, which
needs a second horizon below; a terrain is solid down to the bottom of the picture.

The horizon is raised by surfaces, though only lines are known: a triangle's highest point in a
column is always on one of its edges. So each edge raises every column that it crosses, also where
it is above the screen, else far lines would shine through a mountain close by.

In arrays: the distances are divided into rings, and one table has a row for each ring and a column
for each column of the screen. Edges are entered where they are; a running minimum from ring to ring
makes each row of the table the horizon of all that is nearer. A pixel is seen if it is not below
the horizon at its own ring. :func:`above_one_by_one` is the loop; tests compare the two.

Columns must be vertical planes. Those of a camera that looks up or down, or rolls, are not. So all
is projected as if the camera looked level, where columns are vertical planes again. Pixels too
close to the point below the eye, or above it, have no place there, and count as seen: next to
nothing is hidden where one looks straight down.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from landscape.flyover.camera import Camera, Frustum
from landscape.flyover.clipping import Lines

RINGS = 1024  # chosen: each is 0.8 % of its distance thick at most, thinner than a triangle
# Chosen. A pixel is compared with what is nearer by this many rings, else a line that leads away
# from the eye would hide its own next pixels; and it may be this many rows below the horizon, else
# lines that are rounded to pixels would hide each other.
BEFORE, SLACK = 2, 1.0
# How far level a ray must go for each unit along the line of sight, chosen. It is 0 for one that
# goes straight down.
LEAST = 0.25
NOWHERE = 1e9  # a row below all screens
Marks = tuple[np.ndarray, np.ndarray, np.ndarray]


@dataclass(frozen=True)
class Levelled:
    """Pixels of a picture as pixels of a camera at the same place that looks level."""

    camera: Camera
    volume: Frustum
    size: tuple[int, int]

    def pixels(
        self, column: np.ndarray, row: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray | float]:
        """Return the level column and row, and the level distance per unit along the line of sight.

        Rows may be off the level screen, and columns beside it. Where the distance would be less
        than LEAST the result has no meaning.
        """
        if self.camera.theta_x == 0 and self.camera.theta_y == 0:
            return column, row, 1.0
        volume, line, pixel = self.volume, self.line, self.pixel
        # A pixel holds what the projection rounds up to it: its centre is half a pixel before.
        y = (column - 0.5) * pixel + volume.left / volume.near
        z = volume.top / volume.near - (row - 0.5) * line
        sin, cos = math.sin(self.camera.theta_x), math.cos(self.camera.theta_x)
        y, z = cos * y - sin * z, sin * y + cos * z
        sin, cos = math.sin(self.camera.theta_y), math.cos(self.camera.theta_y)
        level = cos + z * sin
        y, z = (each / np.maximum(level, LEAST) for each in (y, z * cos - sin))
        across = (y - volume.left / volume.near) / pixel + 0.5
        return across, (volume.top / volume.near - z) / line + 0.5, level

    @property
    def pixel(self) -> float:
        """How far apart columns are, at a distance of 1."""
        return (self.volume.right - self.volume.left) / self.volume.near / self.size[0]

    @property
    def line(self) -> float:
        """How far apart rows are, at a distance of 1."""
        return (self.volume.top - self.volume.bottom) / self.volume.near / self.size[1]

    @cached_property
    def columns(self) -> tuple[int, int]:
        """The first level column that the picture shows, and the last."""
        width, height = self.size
        corners = np.array([0, width - 1, 0, width - 1]), np.array([0, 0, height - 1, height - 1])
        columns = self.pixels(*corners)[0]
        return math.floor(columns.min()), math.ceil(columns.max())


class Horizon:
    """The horizon of a frame at all distances, and which pixels are seen above it."""

    def __init__(
        self, lines: Lines, camera: Camera, volume: Frustum, size: tuple[int, int]
    ) -> None:
        """Enter all lines of a frame; they must include those above the screen."""
        self.levelled = Levelled(camera, volume, size)
        self.first, self.last = self.levelled.columns
        column, row, near = crossings(lines, self.levelled)
        # Corners of the far plane are farther than the plane.
        self.per_octave = (RINGS - 1) / math.log2(4 * volume.far / volume.near)
        self.nearest = math.log2(1 / (volume.near * LEAST))
        marks = column - self.first, row, self.ring(near)
        self.table = rows_by_ring(marks, self.last - self.first + 1)
        self.nearness = Nearness(lines)

    def shows(self, at: np.ndarray, owner: np.ndarray) -> np.ndarray:
        """Return which pixels of the lines are seen, bool (n,).

        ``at`` (n,) is each pixel's place in the picture and ``owner`` its line, as they come from
        :mod:`.bresenham`.
        """
        y, x = np.divmod(at, self.levelled.size[0])
        column, row, level = self.levelled.pixels(x, y)
        near = self.nearness(owner, x, y)
        if isinstance(level, np.ndarray):
            far_enough = np.maximum(level, LEAST)
            near /= far_enough
            # A row of the picture is more than one level row where the camera looks down.
            row -= SLACK / far_enough**2
            column = np.clip(np.rint(column), self.first, self.last).astype(np.int64)
            return above((column - self.first, row, self.ring(near) - BEFORE), self.table) | (
                level < LEAST
            )
        return above((column - self.first, row - SLACK, self.ring(near) - BEFORE), self.table)

    def ring(self, near: np.ndarray) -> np.ndarray:
        """Return the rings, int64 (n,), of points by their inverse distances; 0 is the nearest."""
        ring = (np.float32(self.nearest) - np.log2(near.astype(np.float32))) * self.per_octave
        return np.clip(ring, 0, RINGS - 1).astype(np.int64)


def rows_by_ring(edges: Marks, columns: int) -> np.ndarray:
    """Return the horizon at each ring, float32 (RINGS, columns), of edges up to that ring.

    Edges are columns from 0 to ``columns`` - 1, rows, and rings.
    """
    column, row, ring = edges
    table = np.full(RINGS * columns, NOWHERE, np.float32)
    np.minimum.at(table, ring * columns + column, row)
    return np.minimum.accumulate(table.reshape(RINGS, columns), axis=0)


def above(pixels: Marks, table: np.ndarray) -> np.ndarray:
    """Return which pixels are not below the horizon at their ring; nothing is before ring 0."""
    column, row, ring = pixels
    horizon = table.ravel().take(np.maximum(ring, 0) * table.shape[1] + column)
    return np.asarray((row <= horizon) | (ring < 0))


def above_one_by_one(pixels: Marks, edges: Marks, columns: int) -> np.ndarray:
    """Return the same as :func:`above` by a loop from front to back, with a single horizon."""
    horizon = [NOWHERE] * columns
    seen = pixels[2] < 0
    for ring in range(RINGS):
        for column, row, _ in zip(*(each[edges[2] == ring] for each in edges), strict=True):
            horizon[column] = min(horizon[column], row)
        for pixel in np.flatnonzero(pixels[2] == ring):
            seen[pixel] = pixels[1][pixel] <= horizon[pixels[0][pixel]]
    return seen


class Nearness:
    """The inverse distance along the line of sight of pixels of lines, which is linear on screen.

    It is followed along the longer side of each line.
    """

    def __init__(self, lines: Lines) -> None:
        dx, dy = lines.x1 - lines.x0, lines.y1 - lines.y0
        steep = np.abs(dy) > np.abs(dx)
        longer = np.where(steep, dy, dx)
        start, end = 1 / lines.depth0, 1 / lines.depth1
        slope = (end - start) / np.where(longer == 0, 1, longer)
        self.along_x, self.along_y = np.where(steep, 0, slope), np.where(steep, slope, 0)
        self.base = start - self.along_x * lines.x0 - self.along_y * lines.y0

    def __call__(self, owner: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Return the inverse distances of pixels (n,) at column x and row y of lines ``owner``."""
        return np.asarray(
            self.base.take(owner) + self.along_x.take(owner) * x + self.along_y.take(owner) * y
        )


def crossings(lines: Lines, levelled: Levelled) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return each level column that each line crosses: column, row there, and inverse distance."""
    ends = []
    for x, y, depth in ((lines.x0, lines.y0, lines.depth0), (lines.x1, lines.y1, lines.depth1)):
        column, row, level = levelled.pixels(x, y)
        ends.append((column, row, 1 / (depth * np.maximum(level, LEAST)), level))
    (x0, y0, near0, level0), (x1, y1, near1, level1) = ends
    low, high = levelled.columns
    begin = np.ceil(np.maximum(np.minimum(x0, x1), low)).astype(np.int64)
    end = np.floor(np.minimum(np.maximum(x0, x1), high)).astype(np.int64)
    count = np.maximum(end - begin + 1, 0)
    # A line within one column raises nothing that the other edges at its ends do not raise, too.
    count = np.where((level0 < LEAST) | (level1 < LEAST) | (x0 == x1), 0, count)
    kept = np.flatnonzero(count)
    count = count[kept]
    x0, y0, x1, y1, near0, near1, begin = (
        each[kept] for each in (x0, y0, x1, y1, near0, near1, begin)
    )
    rise, approach = (y1 - y0) / (x1 - x0), (near1 - near0) / (x1 - x0)
    start = begin - np.cumsum(count) + count
    column = np.arange(count.sum()) + np.repeat(start, count)
    rows = np.repeat(y0 - rise * x0, count) + np.repeat(rise, count) * column
    near = np.repeat(near0 - approach * x0, count) + np.repeat(approach, count) * column
    return column, rows.astype(np.float32), near
