"""Shadows far from the eye: a second, coarser picture of what the sun sees, of the whole land.

The picture of shadow_map.py covers a square around the eye, so that its texels are small. A region
that does not lie wholly in that square is drawn with this picture instead, which covers all of the
land: a texel of it is a third of a block, and from so far away that is a pixel or two. No pixel is
looked up in both pictures, so that the second one costs nothing but a change of state; it is drawn
again only when the sun moves, and in part when a block changes.
What is wrong without: switch ``shadow.far``.
"""

import math
from typing import Self

import numpy as np

from landscape.elements import sun
from landscape.elements.element import Site
from landscape.voxel.land import Land
from landscape.voxel.settings import Settings
from landscape.voxel.shadow_map import ShadowMap
from landscape.voxel.sun_view import light_matrix

HIGHER = 10.0  # units, chosen: room towards the sun for what stands on the land


class FarShadowMap(ShadowMap):
    """The sun's picture of depths of a land with sides of ``size`` units."""

    @classmethod
    def serves(cls, settings: Settings) -> bool:
        """Return whether the sun casts shadows on far land, too."""
        return super().serves(settings) and settings.shadow.far

    @classmethod
    def build(cls, site: Site[Settings]) -> Self:
        """Build it for the land."""
        return cls(site.settings, site.elements[Land].world.size)

    def __init__(self, settings: Settings, size: float) -> None:
        """Make the depth texture."""
        super().__init__(settings)
        self._middle = np.array([size / 2, 0.0, size / 2])
        self._reach = math.hypot(size, size) / 2

    def _around(self, eye: np.ndarray) -> np.ndarray:
        """Return the sun's matrix (4, 4) for all of the land, wherever the eye is."""
        towards = sun.direction(self.settings.sun).astype(np.float64)
        depth = self._reach + HIGHER
        return light_matrix(towards, self._middle, self._reach, depth, 0.0)
