"""A frame of the fly-over, from the terrain to the pixels, on one screen of code."""

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from landscape import arguments
from landscape.flyover import bresenham, clipping, culling, detail, edges, quad_tree
from landscape.flyover.bounds import bounds
from landscape.flyover.camera import Camera, camera_transform, frustum
from landscape.flyover.height_field import HeightField
from landscape.flyover.levels import levels
from landscape.flyover.quad_tree import Tiles, View
from landscape.flyover.settings import Settings, check

BATCH = 1 << 13  # vertices computed at once, chosen: as for bresenham.CHUNK
PAPER, INK = 0xFFFFFFFF, 0xFF000000  # white and black as 0xAABBGGRR (section 2.2)
COUNTS = ("boxes", "tiles", "vertices", "considered", "on screen", "lines", "pixels")


@dataclass(frozen=True)
class Frame:
    """A picture, and how much work it was.

    ``rgba`` is uint8 (height, width, 4), opaque, its top row first. ``counts`` are numbers by name,
    in the order of the steps: boxes tested, tiles and vertices drawn; lines considered, of these on
    the screen, of these drawn because they face the camera; pixels.
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
    picture = np.full(width * height, PAPER, np.uint32)
    around = levels(terrain, camera, volume, ours)
    boxes = bounds(terrain, around.patch)
    tiles, tested = quad_tree.select(
        View(terrain, boxes, camera, volume, (width, height), ours, around)
    )
    counts = dict.fromkeys(COUNTS, 0)
    counts |= {"boxes": tested, "tiles": len(tiles)}
    before = int(ours.back_faces and ours.strips)
    for part in batches(tiles, BATCH // (around.patch + 1) ** 2):
        points = detail.vertices(terrain, part, camera, around, ours.mirror, before)
        points = camera_transform(*points, camera)
        code = clipping.codes(points, volume, (width, height))
        area = (terrain.unit * 2.0**part.level) ** 2
        facing = culling.facing(points, area) if ours.back_faces else None
        edges_of = edges.of_strips if ours.strips else edges.of_triangles
        (a, b), on_screen = edges_of(code, facing)
        x, y, z = (each.ravel() for each in points)
        lines = clipping.projected((x, y, z), a, b, volume, (width, height))
        counts["vertices"] += code.size
        counts["considered"] += len(part) * (3 if ours.strips else 6) * around.patch**2
        counts["on screen"] += on_screen
        counts["lines"] += len(a)
        for at, _line in bresenham.chunks(lines.x0, lines.y0, lines.x1, lines.y1, (width, height)):
            picture[at] = INK
            counts["pixels"] += len(at)
    return Frame(picture.view(np.uint8).reshape(height, width, 4), counts)


def batches(tiles: Tiles, most: int) -> Iterator[Tiles]:
    """Yield tiles, at most ``most`` at a time, so that memory is bounded however many there are."""
    for first in range(0, len(tiles), most):
        yield tiles[first : first + most]
