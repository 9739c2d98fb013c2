"""Pixels of a picture as pixels of a camera at the same place that looks level.

Columns of the screen are vertical planes only if the camera looks level: it neither looks up or
down nor rolls. What needs vertical planes, as a floating horizon does, takes the columns of such a
camera, on which each pixel of the picture has its place.
"""

import math

import numpy as np

from landscape.flyover.camera import Camera, Frustum
from landscape.flyover.clipping import MARGIN

# How far level a ray must go for each unit along the line of sight, chosen. It is 0 for one that
# goes straight down.
LEAST = 0.25
BESIDE = MARGIN / LEAST  # columns: as far as MARGIN pixels may be apart on the level picture


class Levelled:
    """Pixels of a picture as pixels of a camera at the same place that looks level."""

    def __init__(
        self, camera: Camera, volume: Frustum, size: tuple[int, int], slack: float = 0.0
    ) -> None:
        """Prepare the projection of a picture of ``size`` (width, height).

        Rows that are looked up by row are ``slack`` rows above their places.
        """
        self.size, self.slack = size, slack
        width, height = size
        self.unchanged = camera.theta_x == 0 and camera.theta_y == 0
        pixel = (volume.right - volume.left) / volume.near / width
        line = (volume.top - volume.bottom) / volume.near / height

        # A pixel holds what the projection rounds up to it: its centre is half a pixel before.
        # Offsets to the right and up, as a + b column + c row.
        y = np.array([volume.left / volume.near - pixel / 2, pixel, 0])
        z = np.array([volume.top / volume.near + line / 2, 0, -line])
        sin, cos = math.sin(camera.theta_x), math.cos(camera.theta_x)
        y, z = cos * y - sin * z, sin * y + cos * z
        sin, cos = math.sin(camera.theta_y), math.cos(camera.theta_y)
        ahead = np.array([1, 0, 0])
        self.level = (cos * ahead + sin * z).tolist()
        self.across = (y / pixel).tolist()
        self.up = ((sin * ahead - cos * z) / line).tolist()
        self.offsets = (
            0.5 - volume.left / volume.near / pixel,
            0.5 + volume.top / volume.near / line,
        )
        self.rows: np.ndarray | None = None
        if not self.unchanged and camera.theta_x == 0:
            self.rows = self.by_row(np.arange(height))
        columns, levels = self.corners(range(width))
        self.least = 1.0 if levels is None else float(levels.min())
        self.first, self.last = math.floor(columns.min()), math.ceil(columns.max())

        # Of points in the camera's frame: distances along the level line of sight, and to the right
        # in columns per unit of them.
        turned = math.sin(camera.theta_x), math.cos(camera.theta_x)
        self.ahead = np.array([cos, sin * turned[0], sin * turned[1]])
        self.aside = np.array([0.0, turned[1], -turned[0]]) / pixel

    def corners(self, columns: range) -> tuple[np.ndarray, np.ndarray | None]:
        """Return the level columns, and the level distances, of some columns' corners."""
        height = self.size[1]
        column = np.array([columns[0], columns[-1]] * 2)
        found = self.pixels(column, np.repeat([0, height - 1], 2))
        return found[0], found[2]

    def span(self, columns: range) -> tuple[int, int]:
        """Return the first and the last level column that pixels of some columns are in."""
        if self.least <= LEAST:  # of some pixels the level columns have no meaning
            return self.first, self.last
        found, _ = self.corners(columns)
        return math.floor(found.min()), math.ceil(found.max())

    def walls(self, columns: range) -> np.ndarray:
        """Return vertical planes through the eye beside some columns, (n, 3), n up to 2.

        A point p in the camera's frame of reference with ``row @ p < 0`` is beside all level
        columns that pixels of these columns are in, farther than rounding to pixels may move it.
        There is no plane on a side where the picture ends.
        """
        first, last = self.span(columns)
        found = []
        if first > self.first:
            found.append(self.aside + (self.offsets[0] - first + BESIDE) * self.ahead)
        if last < self.last:
            found.append(-self.aside - (self.offsets[0] - last - BESIDE) * self.ahead)
        return np.array(found).reshape(-1, 3)

    def pixels(
        self, column: np.ndarray, row: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray | None]:
        """Return the level column and row, and the level distance per unit along the line of sight.

        The distance is None if it is 1 everywhere, because the camera looks level. Where it would
        be less than LEAST, it is LEAST, and the column and the row have no meaning. Rows may be off
        the level screen, and columns beside it.
        """
        if self.unchanged:
            return column, row, None

        def linear(by: list[float]) -> np.ndarray:
            found = row * by[2]
            found += by[0]
            if by[1]:
                found += column * by[1]
            return np.asarray(found)

        level = np.maximum(linear(self.level), LEAST)
        across, down = linear(self.across), linear(self.up)
        across /= level
        down /= level
        across += self.offsets[0]
        down += self.offsets[1]
        return across, down, level

    def by_row(self, row: np.ndarray) -> np.ndarray:
        """Return what rows of a picture without roll have in common, float32 (3, n).

        These are 1 over the level distance, the level column's share that does not depend on the
        column, and the level row, ``slack`` above it.
        """
        column, down, level = self.pixels(np.zeros(len(row)), row)
        assert level is not None
        return np.stack([1 / level, column, down - self.slack / (level * level)]).astype(np.float32)
