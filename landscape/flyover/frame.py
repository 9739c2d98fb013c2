"""A frame of the fly-over, from the terrain to the pixels, on one screen of code."""

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from framelens.base import arguments
from landscape.flyover import (
    bresenham,
    clipping,
    colours,
    culling,
    detail,
    edges,
    filled,
    floating_horizon,
    quad_tree,
    shade,
)
from landscape.flyover.bounds import bounds
from landscape.flyover.camera import Camera, camera_transform, frustum
from landscape.flyover.height_field import HeightField
from landscape.flyover.levelled import Levelled
from landscape.flyover.levels import levels
from landscape.flyover.quad_tree import Tiles, View
from landscape.flyover.settings import Settings, check

BATCH = 1 << 14  # vertices computed at once, chosen
CUT = shade.BESIDE  # pixels that share something are not divided
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


class Canvas:
    """The memory that a frame is drawn in, which the next frame may use again."""

    def __init__(self, picture: np.ndarray) -> None:
        """Draw in ``picture``, uint32 (height, width), which may be memory that others share."""
        self.picture = picture
        self._marks: np.ndarray | None = None

    def marks(self, columns: range) -> np.ndarray:
        """Return a number for each pixel, uint32 (n,), which in some columns stands for no line."""
        if self._marks is None:
            self._marks = np.empty(self.picture.shape, np.uint32)
        self._marks[:, columns.start : columns.stop] = colours.NOTHING
        return self._marks.reshape(-1)


def draw(
    terrain: HeightField,
    camera: Camera,
    settings: Settings,
    size: tuple[int, int],
    columns: range | None = None,
    canvas: Canvas | None = None,
) -> Frame:
    """Draw the terrain as a camera sees it, in a picture of ``size`` (width, height) in pixels.

    With ``columns``, only these are drawn; their pixels are those of the whole picture, and the
    counts are those of what is drawn for them. They must begin and end at multiples of CUT, or at
    the picture's edges. The picture is that of the ``canvas``, if one is given, until it is drawn
    on again.
    InputError if settings contradict each other, or the size is not one.
    """
    check(settings)
    width, height = size = arguments.size(size)
    ours = settings.flyover
    volume = frustum(ours, size)
    columns = columns or range(width)
    canvas = canvas or Canvas(np.empty((height, width), np.uint32))
    rgba = canvas.picture.view(np.uint8).reshape(height, width, 4)
    if ours.mode == "filled":
        return Frame(rgba, filled.draw(terrain, camera, settings, canvas.picture, columns))
    around = levels(terrain, camera, volume, ours)
    boxes = bounds(terrain, around.patch)
    levelled = Levelled(camera, volume, size, floating_horizon.SLACK)
    walls = levelled.walls(columns)
    view = View(terrain, boxes, camera, volume, size, ours, around, walls)
    tiles, tested = quad_tree.select(view)
    counts = dict.fromkeys(COUNTS, 0)
    counts |= {"boxes": tested, "tiles": len(tiles)}
    before = int(ours.back_faces and ours.strips)

    # What is above the screen may hide what is on it; and what is beside it, where the camera looks
    # up or down: a vertical plane then leaves the screen at its side.
    hiders = clipping.TOP | clipping.LEFT | clipping.RIGHT
    watched = np.uint8(~hiders & 0xFF if ours.hidden_lines else 0xFF)
    ink = colours.Ink(colours.PALETTES[ours.colours], terrain, ours.visible, canvas.marks(columns))
    found = []
    for part in batches(tiles, BATCH // (around.patch + 1) ** 2):
        points, glided = detail.vertices(terrain, part, camera, around, ours.mirror, before)
        heights = points[2].ravel() + camera.z
        points = camera_transform(*points, camera)
        code = clipping.codes(points, volume, size, walls)
        area = (terrain.unit * 2.0**part.level) ** 2
        facing = culling.facing(points, area) if ours.back_faces else None
        if ours.strips:
            drawn = edges.of_strips(code & watched, facing, glided if ours.fade else None)
        else:
            drawn = edges.of_triangles(code & watched, facing)
        x, y, z = (each.ravel() for each in points)
        lines = clipping.projected((x, y, z), drawn, volume, size)
        found.append((lines, ink.of(lines, heights)))
        counts["vertices"] += code.size
        counts["considered"] += len(part) * (3 if ours.strips else 6) * around.patch**2
        counts["on screen"] += drawn.on_screen
        counts["lines"] += len(drawn.a)
        if not ours.hidden_lines:
            counts["pixels"] += draw_lines(*found.pop(), ink, None, size, columns)

    if found:
        lines, colour = clipping.joined([each for each, _ in found]), [each for _, each in found]
        horizon = floating_horizon.Horizon(lines, levelled, volume, columns)
        counts["pixels"] += draw_lines(lines, np.concatenate(colour), ink, horizon, size, columns)

    colours.background(canvas.picture, ink.palette, camera, volume, columns)
    ink.on(canvas.picture.reshape(-1))
    return Frame(rgba, counts)


def draw_lines(
    lines: clipping.Lines,
    colour: np.ndarray,
    ink: colours.Ink,
    horizon: floating_horizon.Horizon | None,
    size: tuple[int, int],
    columns: range,
) -> int:
    """Draw lines, without what is below a horizon if there is one; return the number of pixels."""
    count = 0
    kept = np.arange(len(lines.a))
    if horizon is not None:
        kept = horizon.kept
    x0, y0, x1, y1 = (each[kept] for each in (lines.x0, lines.y0, lines.x1, lines.y1))
    for x, y, owner, along_x in bresenham.chunks(x0, y0, x1, y1, size, columns):
        at, owner = y * size[0], kept.take(owner)
        at += x
        if horizon is not None:
            x, y = x.astype(np.float32), y.astype(np.float32)
            seen = np.flatnonzero(horizon.sees(x, y, x if along_x else y, owner))
            at, owner = at.take(seen), owner.take(seen)
        ink.draw(at, colour.take(owner))
        count += len(at)

    return count


def batches(tiles: Tiles, most: int) -> Iterator[Tiles]:
    """Yield tiles, at most ``most`` at a time, so that memory is bounded however many there are."""
    for first in range(0, len(tiles), most):
        yield tiles[first : first + most]
