"""The vertices of tiles."""

import numpy as np

from landscape.flyover.camera import Camera, Points
from landscape.flyover.height_field import HeightField, mirrored
from landscape.flyover.quad_tree import PATCH, Tiles


def vertices(field: HeightField, tiles: Tiles, camera: Camera, mirror: bool) -> Points:
    """Return x, y, z of the tiles' vertices relative to the camera, (n, PATCH + 1, PATCH + 1).

    Rows run along y. Without ``mirror`` the plane ends where the image does.
    """
    along = np.arange(PATCH + 1)
    column = tiles.column[:, None] * PATCH + along
    row = tiles.row[:, None] * PATCH + along
    if not mirror:
        column, row = np.clip(column, 0, field.side), np.clip(row, 0, field.side)
    heights = field.levels[0][
        mirrored(row, field.side)[:, :, None], mirrored(column, field.side)[:, None, :]
    ]
    shape = heights.shape
    x = np.broadcast_to((column * field.unit - camera.x)[:, None, :], shape)
    y = np.broadcast_to((row * field.unit - camera.y)[:, :, None], shape)
    return x, y, heights - camera.z
