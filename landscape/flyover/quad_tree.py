"""Which squares of the terrain are drawn, and at which level of detail.

The plane is divided into square tiles of PATCH x PATCH quads. A tile of level l has quads of 2^l
vertices on a side, so four tiles of one level cover one of the next.
"""

from dataclasses import dataclass

import numpy as np

from landscape.flyover.camera import Camera
from landscape.flyover.height_field import HeightField
from landscape.flyover.settings import Flyover

PATCH = 8  # quads on a side of a tile, chosen


@dataclass(frozen=True)
class Tiles:
    """Tiles of the plane, (n,) int64: their level of detail, and their place among its tiles."""

    level: np.ndarray
    column: np.ndarray
    row: np.ndarray

    def __len__(self) -> int:
        return len(self.level)


def whole(field: HeightField, camera: Camera, settings: Flyover) -> Tiles:
    """Return all tiles of level 0 within the far plane's distance of the camera, from far to near.

    Without ``mirror``, only those of the image.
    """
    reach = min(settings.far, settings.far_undetailed)
    side = PATCH * field.unit
    spans = []
    for at in (camera.x, camera.y):
        low, high = int((at - reach) // side), int((at + reach) // side)
        if not settings.mirror:
            low, high = max(low, 0), min(high, field.side // PATCH)
        spans.append(np.arange(low, high + 1))
    column, row = (each.ravel() for each in np.meshgrid(*spans))
    away_x, away_y = (column + 0.5) * side - camera.x, (row + 0.5) * side - camera.y
    order = np.argsort(-np.hypot(away_x, away_y), kind="stable")
    return Tiles(np.zeros(len(order), np.int64), column[order], row[order])
