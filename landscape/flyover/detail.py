"""The vertices of tiles at their levels of detail, on their way to the next level.

See :mod:`.levels`. A vertex whose row or column is odd glides to the even one before it, so that at
the end of the way each quad of the next level is covered by one quad of this one, and the edges
of the other three lie on its edges. Heights go from those of one level to those of the next.
"""

import numpy as np

from landscape.flyover.camera import Camera, Points
from landscape.flyover.height_field import HeightField
from landscape.flyover.levels import Levels
from landscape.flyover.quad_tree import Tiles


def vertices(
    field: HeightField,
    tiles: Tiles,
    camera: Camera,
    levels: Levels,
    mirror: bool = True,
    before: int = 0,
) -> tuple[Points, np.ndarray | None]:
    """Return x, y, z of the tiles' vertices relative to the camera, and how far each has glided.

    Float64 (n, s, s) each, rows along y. s is ``levels.patch`` + 1, and ``before`` more if so many
    rows and columns before the tiles' own are wanted. The second result is from 0 to 1, or None if
    no vertex glides. Without ``mirror`` the plane ends where the image does.
    """
    along = np.arange(-before, levels.patch + 1)
    column = tiles.column[:, None] * levels.patch + along
    row = tiles.row[:, None] * levels.patch + along
    if not mirror:
        last = np.maximum(field.side >> tiles.level, 1)[:, None]
        column, row = np.clip(column, 0, last), np.clip(row, 0, last)
    unit = field.unit * 2.0 ** tiles.level[:, None]
    shape = (len(tiles), len(along), len(along))
    x = (column * unit - camera.x)[:, None, :]
    y = (row * unit - camera.y)[:, :, None]
    z = field.at(tiles.level, row, column).astype(np.float64)
    part = None
    if levels.first and levels.glide < 1.0:
        part = levels.gliding(tiles.level[:, None, None], x, y)
        # At 0 and at 1 these are exactly the positions in the one level and in the other.
        x = (column[:, None, :] - part * (column & 1)[:, None, :]) * unit[:, None] - camera.x
        y = (row[:, :, None] - part * (row & 1)[:, :, None]) * unit[:, None] - camera.y
        z *= 1.0 - part
        z += part * field.at(tiles.level + 1, row >> 1, column >> 1)

    z -= camera.z
    return (np.broadcast_to(x, shape), np.broadcast_to(y, shape), z), part
