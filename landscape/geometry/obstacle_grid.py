"""Many obstacles, found by place: trunks sorted into the cells of a grid. No OpenGL.

A walker tests what is near him, not each tree of the island: a scene's obstacles are a plain
sequence if they are few, and an :class:`ObstacleGrid` if they are many.
"""

import math
from collections.abc import Sequence

import numpy as np

from landscape.geometry.obstacles import Obstacle, Tower

CELL = 0.5  # chosen: units, side of a cell; about as far as a walker's frames reach


class ObstacleGrid:
    """A few obstacles of any shape, and many towers sorted by square cells of the map."""

    def __init__(self, few: Sequence[Obstacle], towers: np.ndarray) -> None:
        """Sort ``towers`` (n, 4) = x, z, radius, top in units."""
        self.few = tuple(few)
        places = np.floor(towers[:, :2] / CELL).astype(int)
        self._low = places.min(axis=0, initial=0).tolist()
        self._columns, self._rows = (places.max(axis=0, initial=0) - self._low + 1).tolist()
        numbers = (places - self._low) @ (self._rows, 1)
        order = np.argsort(numbers, kind="stable")
        self.towers = towers[order]
        cells = np.arange(self._columns * self._rows + 1)
        self._starts = np.searchsorted(numbers[order], cells).tolist()
        self._widest = float(towers[:, 2].max(initial=0.0))

    def near(self, x: float, z: float, within: float) -> list[Obstacle]:
        """Return the obstacles whose surfaces are less than ``within`` units from x, z."""
        found = [each for each in self.few if each.gap(x, z)[0] < within]
        reach = within + self._widest
        left, right = self._span(x, reach, self._low[0], self._columns)
        first, last = self._span(z, reach, self._low[1], self._rows)
        for column in range(left, right + 1) if first <= last else ():
            # The cells of a column follow each other.
            base = column * self._rows
            some = self.towers[self._starts[base + first] : self._starts[base + last + 1]]
            gaps = np.hypot(some[:, 0] - x, some[:, 1] - z) - some[:, 2]
            found += [Tower(*row) for row in some[gaps < within].tolist()]
        return found

    @staticmethod
    def _span(at: float, reach: float, low: int, count: int) -> tuple[int, int]:
        """Return the first and the last cell within ``reach`` of ``at``; none if out of order."""
        first, last = math.floor((at - reach) / CELL) - low, math.floor((at + reach) / CELL) - low
        return max(first, 0), min(last, count - 1)


Obstacles = Sequence[Obstacle] | ObstacleGrid
