"""A frame of the fly-over, from the terrain to the pixels, on one screen of code."""

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from landscape import arguments
from landscape.flyover import bresenham, clipping, detail, edges, quad_tree
from landscape.flyover.camera import Camera, camera_transform, frustum
from landscape.flyover.height_field import HeightField
from landscape.flyover.quad_tree import Tiles
from landscape.flyover.settings import Settings, check

BATCH = 2048  # tiles whose vertices are computed at once, chosen: they take 50 MB
PAPER, INK = 0xFFFFFFFF, 0xFF000000  # white and black as 0xAABBGGRR (section 2.2)


@dataclass(frozen=True)
class Frame:
    """A picture, and how much work it was.

    ``rgba`` is uint8 (height, width, 4), opaque, its top row first. ``counts`` are numbers by name,
    in the order of the steps: tiles, vertices, lines considered, lines drawn, pixels.
    """

    rgba: np.ndarray
    counts: dict[str, int] = field(default_factory=dict)

    @property
    def picture(self) -> np.ndarray:
        """The picture without alpha, uint8 (height, width, 3); it shares the memory of ``rgba``."""
        return self.rgba[..., :3]


def draw(terrain: HeightField, camera: Camera, settings: Settings, size: tuple[int, int]) -> Frame:
    """Draw the terrain as a camera sees it, in a picture of ``size`` (width, height) in pixels.

    InputError if settings contradict each other, or the size is not one.
    """
    check(settings)
    width, height = arguments.size(size)
    ours = settings.flyover
    volume = frustum(ours, (width, height))
    counts = dict.fromkeys(("tiles", "vertices", "considered", "lines", "pixels"), 0)
    picture = np.full(width * height, PAPER, np.uint32)
    tiles = quad_tree.whole(terrain, camera, ours)
    counts["tiles"] = len(tiles)
    for part in batches(tiles):
        points = detail.vertices(terrain, part, camera, ours.mirror)
        seen = camera_transform(*points, camera)
        code = clipping.codes(seen, volume, (width, height))
        a, b = edges.of_triangles(code)
        x, y, z = (each.ravel() for each in seen)
        lines = clipping.projected((x, y, z), a, b, volume, (width, height))
        at, _owner = bresenham.pixels(lines.x0, lines.y0, lines.x1, lines.y1, (width, height))
        picture[at] = INK
        counts["vertices"] += code.size
        counts["considered"] += len(part) * 6 * quad_tree.PATCH**2
        counts["lines"] += len(a)
        counts["pixels"] += len(at)
    return Frame(picture.view(np.uint8).reshape(height, width, 4), counts)


def batches(tiles: Tiles) -> Iterator[Tiles]:
    """Yield tiles, BATCH at a time, so that memory is bounded however many there are."""
    for first in range(0, len(tiles), BATCH):
        part = slice(first, first + BATCH)
        yield Tiles(tiles.level[part], tiles.column[part], tiles.row[part])
