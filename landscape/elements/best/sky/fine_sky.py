"""The sky of the preset best: seamless mip levels, and clouds that move (R1).

Technique: the box of 2006 with pictures of more texels, whose mip levels match along their edges
(``sky.refined``), and a layer of clouds in front of it (``sky.moving``).
State used: that of the box; see clouds.py for the clouds'.
"""

from collections.abc import Hashable

import numpy as np

from landscape.elements.best.sky.clouds import Clouds
from landscape.elements.best.sky.seamless import seamless_levels
from landscape.elements.settings import Settings
from landscape.elements.sky_box import SkyBox
from landscape.files.assets import Assets
from landscape.frame import Frame


class FineSky(SkyBox):
    """The box with its clouds."""

    asked_by = ("sky.refined", "sky.moving")

    @classmethod
    def built_from(cls, settings: Settings) -> Hashable:
        """Return the values that the constructor uses."""
        sky = settings.sky
        clouds = settings.sun if sky.moving else None
        return super().built_from(settings), sky.refined, sky.moving, clouds

    def __init__(self, settings: Settings, assets: Assets) -> None:
        """Read the five faces, compile the display list, and make the clouds if they are on."""
        super().__init__(settings, assets)
        self._clouds = Clouds(settings, assets) if settings.sky.moving else None

    def _levels(self, image: np.ndarray) -> list[np.ndarray]:
        """Return a face's mip levels."""
        return seamless_levels(image) if self.settings.sky.refined else super()._levels(image)

    def _draw_clouds(self, frame: Frame) -> None:
        """Draw the clouds in front of the walls, if they are on."""
        if self._clouds is not None:
            self._clouds.draw(frame)

    def release(self) -> None:
        """Delete the box and the clouds; may be called twice."""
        super().release()
        if self._clouds is not None:
            self._clouds.release()
