"""Whether any of the sea can be seen: an occlusion query (``water.query``).

In a wood the sea, its waves and the whole mirrored scene would be drawn for nothing: land hides
them. So a square at the height the sea may reach is tested against the depth buffer
(gl/surface_query.py).
"""

from landscape.elements.settings import Settings
from landscape.elements.water_surface import water_square
from landscape.gl.surface_query import SurfaceQuery

ABOVE = 0.05  # chosen: units above the water level that no wave and no breaker reaches


def built_from(settings: Settings) -> tuple[object, ...]:
    """Return the values that the constructor uses."""
    return settings.water.level, water_square(settings.water)


class SeaQuery(SurfaceQuery):
    """The query for the sea."""

    def __init__(self, settings: Settings) -> None:
        """Make the query, and compile the square that the sea may reach."""
        self._built_from = built_from(settings)
        square = water_square(settings.water)
        super().__init__(settings.water.level + ABOVE, *square, settings.camera.near)

    def apply(self, settings: Settings) -> bool:
        """Return whether the query is also valid for new settings: for the same surface."""
        if built_from(settings) != self._built_from:
            return False
        self._near = settings.camera.near
        return True
