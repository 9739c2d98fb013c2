"""How far each level of detail reaches (section 2.3, "level of detail").

Level 0 reaches ``density`` quads far from the camera, and each further level twice as far as the
one before it, because its quads are twice as large: so quads look equally large all over the
picture. A tile is divided while the level below it reaches to its nearest point.

Where a level changes, a row of fine quads would meet coarse ones, which have every second of its
vertices only: cracks, and whole tiles would pop from one level to the other. Instead, as in CDLOD
(Strugar, 2009), in the last part of its reach a level's vertices glide to where the next level has
them. At its end there is no difference any more. The next level must not have begun to glide there:
how far into it a tile can extend says when it may begin.
"""

import math
from dataclasses import dataclass

import numpy as np

from framelens.base.errors import InputError
from landscape.flyover.camera import Camera, Frustum
from landscape.flyover.height_field import HeightField
from landscape.flyover.settings import Flyover

MOST_TILES = 1 << 16  # without detail, chosen: 4 million quads of 8 x 8 a tile take some 5 seconds


@dataclass(frozen=True)
class Levels:
    """Levels of detail around a camera.

    ``patch``: quads on a side of a tile. ``first``: how far level 0 reaches, in units; 0 if
    everything is drawn at level 0. ``glide``: at which part of a level's reach its vertices begin
    to glide; 1 for never. ``reach``: how far one can see, in units. ``coarsest``: the level that
    reaches there. ``above``: the camera's height in units above all terrain near it; it counts as
    distance, so that detail decreases as the camera rises.
    """

    patch: int
    first: float
    glide: float
    reach: float
    coarsest: int
    above: float

    def distance(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Return how far points are from the camera, whose level of detail depends on it alone.

        ``x`` and ``y`` are relative to the camera. The heights of the points do not count: they
        differ between levels.
        """
        return np.asarray(np.sqrt(x * x + y * y + self.above * self.above))

    def splits(self, level: int, x: np.ndarray, y: np.ndarray, side: np.ndarray) -> np.ndarray:
        """Return whether tiles of a level are divided, bool (n,).

        ``x`` and ``y`` of their first corners are relative to the camera.
        """
        if level == 0 or not self.first:
            return np.full(len(x), level > 0)
        away_x = np.maximum(np.maximum(x, -x - side), 0.0)
        away_y = np.maximum(np.maximum(y, -y - side), 0.0)
        return self.distance(away_x, away_y) < self.first * 2.0 ** (level - 1)

    def gliding(self, level: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Return how far vertices have glided to the next level's, from 0 to 1.

        ``level`` must have a shape that fits those of ``x`` and ``y``, relative to the camera.
        """
        end = self.first * 2.0**level
        begin = self.glide * end
        return np.clip((self.distance(x, y) - begin) / (end - begin), 0.0, 1.0)


def _check_tiles(field: HeightField, settings: Flyover, reach: float, far: float) -> None:
    """Raise InputError if too many tiles without detail lie within ``reach``."""
    patch = int(settings.patch)
    tile = patch * field.unit
    across = 2 * reach / tile
    if not settings.mirror:
        across = min(across, field.side / patch)
    if across > math.sqrt(MOST_TILES):
        most = math.sqrt(MOST_TILES) * tile / 2 * far / reach
        raise InputError(
            "setting flyover.far_undetailed: expected at most {most:.0f} with this "
            "frustum and flyover.unit={unit:g}, not {far:g}",
            most=most,
            unit=field.unit,
            far=far,
        )


def levels(field: HeightField, camera: Camera, volume: Frustum, settings: Flyover) -> Levels:
    """Return the levels of detail for a camera's view.

    InputError where too much would be drawn without detail.
    """
    far = settings.far
    patch = int(settings.patch)
    if not settings.detail:
        far = min(far, settings.far_undetailed)

    # The corners of the far plane are farther than the plane.
    aside = max(abs(volume.left), abs(volume.right), 1e-9) / volume.near
    along = max(abs(volume.top), abs(volume.bottom)) / volume.near
    reach = far * math.sqrt(1.0 + aside * aside + along * along)
    first = settings.density * field.unit
    coarsest = max(math.ceil(math.log2(reach / first)), 0)
    if not settings.detail:
        _check_tiles(field, settings, reach, far)
        return Levels(patch, 0.0, 1.0, reach, coarsest, 0.0)

    above = max(camera.z - field.top(camera.x, camera.y), 0.0)
    overlap = (settings.density + 2 * math.sqrt(2) * patch) / (2 * settings.density)
    glide = max(1.0 - settings.morph_part, overlap) if settings.morph else 1.0
    return Levels(patch, first, glide, reach, coarsest, above)
