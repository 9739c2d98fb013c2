"""A map with what stands on it, as heights to fly over.

Where a path that was drawn elsewhere leads through a castle or a tree, its roof counts as the
ground.
"""

from typing import Any

from landscape.geometry.camera_path import NEAR, standing_near

ROOF = 4.0  # chosen: units above the ground; what is higher cannot be flown over


class Roofs:
    """A scene's map with what stands on it."""

    def __init__(self, opened: Any) -> None:
        """Take an open scene, whose obstacles may change.

        It may have none, or a ``roof(x, z)`` that is the height of what stands there.
        """
        self._opened, self.size = opened, opened.size
        self._height = getattr(opened, "roof", opened.height)

    def height(self, x: float, z: float) -> float:
        """Return the height in units of the ground at x, z, or of what stands there."""
        ground = float(self._height(x, z))
        near = standing_near(getattr(self._opened, "obstacles", ()), x, z, 2 * NEAR)
        return max((each.top for each in near if each.top < ground + ROOF), default=ground)
