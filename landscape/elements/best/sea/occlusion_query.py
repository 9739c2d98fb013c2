"""Whether any of the sea can be seen: an occlusion query (``water.query``).

In a wood the sea, its waves and the whole mirrored scene would be drawn for nothing: land hides
them. So a square at the height the sea may reach is tested against the depth buffer
(gl/surface_query.py).
"""

from collections.abc import Hashable
from typing import Self

from landscape.elements.element import Element, Site
from landscape.elements.settings import Settings
from landscape.elements.water_surface import water_square
from landscape.gl.surface_query import SurfaceQuery

ABOVE = 0.05  # chosen: units above the water level that no wave and no breaker reaches


class SeaQuery(SurfaceQuery, Element[Settings]):
    """The query for the sea."""

    @classmethod
    def serves(cls, settings: Settings) -> bool:
        """Return whether to ask: not for a mirror image in the framebuffer.

        That is drawn before the land, when there is nothing yet that could hide the sea.
        """
        return settings.water.query and settings.reflection.rippled

    @classmethod
    def build(cls, site: Site[Settings]) -> Self:
        """Build it; it needs no files."""
        return cls(site.settings)

    @classmethod
    def built_from(cls, settings: Settings) -> Hashable:
        """Return the values that the constructor uses."""
        return settings.water.level, water_square(settings.water)

    def __init__(self, settings: Settings) -> None:
        """Make the query, and compile the square that the sea may reach."""
        self.settings = settings
        square = water_square(settings.water)
        super().__init__(settings.water.level + ABOVE, *square, settings.camera.near)

    def take(self, settings: Settings) -> None:
        """Take other settings: the camera's near plane may be another."""
        self.settings, self._near = settings, settings.camera.near
