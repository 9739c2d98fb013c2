"""A map with what stands on it, as heights to fly over.

Where a path that was drawn elsewhere leads through a castle or a tree, its roof counts as the
ground.
"""

from collections.abc import Callable
from typing import Protocol, SupportsFloat

from landscape.geometry.camera_path import NEAR, standing_near

ROOF = 4.0  # chosen: units above the ground; what is higher cannot be flown over


class Map(Protocol):
    """A square of land, ``size`` units wide."""

    @property
    def size(self) -> float:
        """The side of the square in units."""

    def height(self, x: float, z: float) -> SupportsFloat:
        """Return the height in units of the ground at x, z."""


class Roofs:
    """A scene's map with what stands on it."""

    def __init__(self, opened: Map) -> None:
        """Take an open scene, whose obstacles may change.

        It may have none, or a ``roof(x, z)`` that is the height of what stands there.
        """
        self._opened, self.size = opened, opened.size
        self._height: Callable[[float, float], SupportsFloat] = getattr(
            opened, "roof", opened.height
        )

    def height(self, x: float, z: float) -> float:
        """Return the height in units of the ground at x, z, or of what stands there."""
        ground = float(self._height(x, z))
        near = standing_near(getattr(self._opened, "obstacles", ()), x, z, 2 * NEAR)
        return max((each.top for each in near if each.top < ground + ROOF), default=ground)
