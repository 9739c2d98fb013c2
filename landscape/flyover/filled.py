"""Filled mode: the terrain with its colours, in the manner of voxel space.

Voxel space, from Comanche (NovaLogic, 1992), draws a height field column by column, front to back,
without triangles, z buffer or OpenGL: :mod:`.march` finds which ground each pixel shows, and
:mod:`.shade` colours it. The switches of 1992 are all there: with ``smooth`` off the ground is
blocks, with ``levels`` off far ground glitters, with ``shadows`` off no hill shades another.

Columns must be vertical planes. So the columns are those of a camera that looks level, and each
pixel of the picture finds its own among them. That is exact for every pitch and roll, as long as
neither the point below the eye nor the one above it is close to the picture; steeper pitches than
:func:`steepest` are drawn as that.
"""

import math
from dataclasses import dataclass, replace
from functools import cache

import numpy as np

from landscape.flyover import march, shade
from landscape.flyover.blending import OPAQUE, blend
from landscape.flyover.camera import Camera, Frustum, frustum
from landscape.flyover.height_field import HeightField
from landscape.flyover.look import look
from landscape.flyover.reflection import ACROSS, Reflection, reflection
from landscape.flyover.settings import Settings

LEAST = 0.25  # how far the picture stays from the point below the eye, chosen; 0 touches it
BAND = 96  # rows coloured together, chosen
# Units, chosen. The eye stays so far above water, and is lifted smoothly from twice that height.
AFLOAT = 1.5
BEFORE = 1 / 64  # distance of the first step, pixels of the height image, chosen
RIDGE = 1.1  # what is behind a ridge is this many times as far away at least, chosen
LONGEST = 4.0  # steps in the middle distance, pixels of the height image, chosen
WAVY = 0.15  # how much steeper ripples make mirrored rays, chosen


@dataclass(frozen=True)
class View:
    """A picture's pixels as rays, and the columns and rows that are walked for it.

    ``across`` (w,) and ``up`` (h,) are the pixels' directions to the right and up, per unit of
    distance along the line of sight. ``lateral`` (c,) are the columns' directions to the right,
    per unit of distance along a level line of sight; ``slopes`` (r,) the rows' rise, per the same.
    ``pixel`` is how far apart columns are; ``row_of`` are the first row's place and the rows' step.
    ``before`` is how many columns there are, of the whole picture's, before ``lateral`` begins, and
    ``left`` the first one's direction; ``widest`` is the greatest direction of all, to either side.
    """

    across: np.ndarray
    up: np.ndarray
    lateral: np.ndarray
    slopes: np.ndarray
    pitch: float
    roll: float
    row_of: tuple[float, float]
    pixel: float
    left: np.float32
    widest: np.float32
    before: int = 0
    inside: int = 0

    @property
    def level(self) -> bool:
        """Whether the columns and rows walked are the picture's."""
        return self.pitch == 0 and self.roll == 0


def steepest(volume: Frustum, roll: float) -> float:
    """Return the steepest pitch in radians whose picture keeps clear of the point below the eye."""
    high = max(abs(volume.top), abs(volume.bottom))
    wide = max(abs(volume.left), abs(volume.right))
    reach = (high * abs(math.cos(roll)) + wide * abs(math.sin(roll))) / volume.near
    return math.atan2(1, reach) - math.atan2(LEAST, math.hypot(1, reach))


def view(camera: Camera, volume: Frustum, size: tuple[int, int]) -> View:
    """Return the rays of a picture of ``size`` (width, height)."""
    width, height = size

    # Pixel p holds what the projection rounds up to p: its centre is half a pixel before that.
    across = np.arange(width) - 0.5
    across = (volume.left + across / width * (volume.right - volume.left)) / volume.near
    step = (volume.top - volume.bottom) / volume.near / height
    up = volume.top / volume.near - (np.arange(height) - 0.5) * step
    pixel = (volume.right - volume.left) / volume.near / width
    roll = camera.theta_x
    most = steepest(volume, roll)
    pitch = min(max(camera.theta_y, -most), most)
    sin, cos = math.sin(pitch), math.cos(pitch)
    corners = [(y, z) for y in (across[0], across[-1]) for z in (up[0], up[-1])]
    turned = [unrolled(y, z, roll) for y, z in corners]
    if pitch == 0 and roll == 0:
        lateral, rows = across, up
    else:
        ends = [y / (cos + z * sin) for y, z in turned]
        lateral = np.arange(min(ends), max(ends) + pixel, pixel)
        highest, lowest = max(z for _, z in turned), min(z for _, z in turned)
        rows = up if roll == 0 else np.arange(highest, lowest - step, -step)

    slopes = (rows * cos - sin) / (cos + rows * sin)
    return View(
        across.astype(np.float32),
        up.astype(np.float32),
        lateral.astype(np.float32),
        slopes.astype(np.float32),
        pitch,
        roll,
        (float(rows[0]), step),
        pixel,
        np.float32(lateral[0]),
        np.abs(lateral.astype(np.float32)).max(),
    )


def part(rays: View, columns: range) -> View:
    """Return the rays of some columns of a picture, and what is walked for them."""
    first, end = columns.start, columns.stop
    across = rays.across[first:end]
    if not rays.level:
        corners = replace(rays, across=across[[0, -1]], up=rays.up[[0, -1]])
        place = pixels(corners, slice(None), (len(rays.slopes), len(rays.lateral)))[1]
        # One more on either side, as the corners may be rounded in another way.
        first, end = int(place.min()) - 1, int(place.max()) + 2
    # Each column of a mirror image is that of some columns: it must not be divided.
    first = max(first, 0) // ACROSS * ACROSS
    inside = columns.start - first
    return replace(
        rays, across=across, lateral=rays.lateral[first:end], before=first, inside=inside
    )


def unrolled(y: float, z: float, roll: float) -> tuple[float, float]:
    """Return what a direction of the picture, right and up, would be without the camera's roll.

    ``y`` and ``z`` are per unit of distance along the line of sight, ``roll`` is in radians.
    """
    sin, cos = math.sin(roll), math.cos(roll)
    return cos * y - sin * z, sin * y + cos * z


def afloat(z: float, sea: float) -> float:
    """Return the height of an eye that does not dive: ``z``, or more where it is close to water."""
    above = z - sea - AFLOAT
    if above >= AFLOAT:
        return z
    return sea + AFLOAT + max(above + AFLOAT, 0.0) ** 2 / (4 * AFLOAT)


def rows_of(heights: np.ndarray, away: np.ndarray, rays: View) -> np.ndarray:
    """Return the rows at which heights above the eye (s, c) at distances (s, c) are projected."""
    slope = heights / away
    sin, cos = np.float32(math.sin(rays.pitch)), np.float32(math.cos(rays.pitch))
    if rays.pitch:
        below = cos - slope * sin
        up = (slope * cos + sin) / np.maximum(below, np.float32(1e-6))
        if sin < 0:
            up[below <= 0] = -1e9
    else:
        up = slope
    first, step = rays.row_of
    up *= np.float32(-1 / step)
    up += np.float32(first / step + 0.5)
    return up


def draw(
    field: HeightField, camera: Camera, settings: Settings, picture: np.ndarray, columns: range
) -> dict[str, int]:
    """Draw some columns of a picture, uint32 (height, width), filled; return counts.

    InputError if the image of the ground cannot be read.
    """
    height, width = picture.shape
    ours, seen = settings.filled, look(field, settings)
    volume = frustum(settings.flyover, (width, height))
    rays = part(view(camera, volume, (width, height)), columns)
    camera = replace(camera, z=afloat(camera.z, seen.sea))
    # Ground nearer than the near plane is drawn, too: it would leave a hole.
    path = march.steps(
        BEFORE * field.unit,
        min(volume.far, settings.flyover.visible) if ours.fog else volume.far,
        ours.step,
        LONGEST * field.unit,
        len(field.levels) if ours.levels else 1,
        field.unit,
    )
    forward = np.array([[math.cos(camera.theta_z)], [math.sin(camera.theta_z)]], np.float32)
    right = np.stack([-forward[1], forward[0]])
    directions = forward + right * rays.lateral
    heights = np.empty((len(path.distances), len(rays.lateral)), np.float32)
    eye, mirror = (camera.x, camera.y, camera.z), settings.flyover.mirror
    march.walk(field, path, eye, directions, seen.sea, ours.smooth, mirror, heights)
    tops = np.empty(heights.shape, np.float32)
    for first, end, _ in path.runs:
        steps = slice(first, end)
        tops[steps] = rows_of(heights[steps], path.distances[steps, None], rays)
    filled = march.filled_by(tops, len(rays.slopes))

    @cache
    def mirrored() -> Reflection | None:
        steepest = max(-float(rays.slopes[-1]), 0.0) + WAVY
        return reflection(heights, path.distances, camera.z - seen.sea, steepest, rays.row_of[1])

    scene = shade.Scene(heights, filled, path.distances, forward[:, 0], right[:, 0], eye, mirrored)
    behind = np.searchsorted(path.distances, RIDGE * path.distances, "right")
    behind = np.append(behind, len(heights) + 1).astype(np.int16)
    colouring = shade.Colouring(scene, seen, settings, rays.lateral, rays.pixel, rays.widest)
    for first in range(0, height, BAND):
        # One row more: ridges are blended with what is above them.
        rows = slice(max(first - 1, 0), min(first + BAND, height))
        at, column, slope, lateral = pixels(rays, rows, filled.shape)
        step = filled.ravel().take(at)
        colours = colouring.band(step, column, slope, lateral)
        if ours.edges and ours.smooth:
            blend_edges(colours, at, step, behind, scene, rays)
        picture[first : rows.stop, columns.start : columns.stop] = colours[first - rows.start :]
    return {"columns": len(rays.lateral), "steps": len(heights), "pixels": height * len(columns)}


def blend_edges(
    colours: np.ndarray,
    at: np.ndarray,
    step: np.ndarray,
    behind: np.ndarray,
    scene: shade.Scene,
    rays: View,
) -> None:
    """Blend ridges with what is above them, in place, by how much of their pixel they cover.

    ``colours`` (n, w) are rows of the picture, ``at`` and ``step`` their places in the scene and
    what they show there. ``behind`` (s + 1,) is the first step that is behind a ridge at a step.
    """
    columns = scene.filled.shape[1]
    ridge = np.flatnonzero(step[:-1] >= behind.take(step[1:])) + at.shape[1]
    if not len(ridge):
        return
    row, column = np.divmod(at.ravel()[ridge], columns)
    its = step.ravel()[ridge].astype(np.int64)
    heights = scene.heights.ravel().take(its * columns + column)
    top = rows_of(heights[None, :], scene.distances[its], rays)[0]
    covered = (np.clip(row - top, 0, 1) * 256).astype(np.uint32)
    flat = colours.ravel()
    flat[ridge] = blend(flat[ridge - at.shape[1]], flat[ridge], covered) | OPAQUE
    colours[:] = flat.reshape(colours.shape)


def pixels(
    rays: View, part: slice, shape: tuple[int, ...]
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Return what is walked for the pixels of some rows: place, column, slope, lateral direction.

    All are (n, w). ``shape`` is (rows, columns) of what is walked; the place is ``row * columns +
    column``.
    """
    rows, columns = shape
    up = rays.up[part]
    if rays.level:
        inside = np.arange(rays.inside, columns, dtype=np.int32)
        column = np.broadcast_to(inside, (len(up), len(inside)))
        at = np.arange(part.start, part.stop, dtype=np.int32)[:, None] * columns + column
        slope = np.broadcast_to(rays.slopes[part, None], at.shape)
        return at, column, slope, np.broadcast_to(rays.lateral[rays.inside :], at.shape)

    # Without a roll these are the same all along a row of the picture.
    y, z = rays.across, up[:, None]
    if rays.roll:
        sin, cos = np.float32(math.sin(rays.roll)), np.float32(math.cos(rays.roll))
        y, z = cos * y - sin * z, sin * y + cos * z
    sin, cos = np.float32(math.sin(rays.pitch)), np.float32(math.cos(rays.pitch))
    flat = 1 / (cos + z * sin)
    slope = (z * cos - sin) * flat
    first, step = rays.row_of
    row = ((np.float32(first) - z) * np.float32(1 / step) + np.float32(0.5)).astype(np.int32)
    np.minimum(np.maximum(row, 0), rows - 1, out=row)
    row *= columns
    lateral = y * flat
    place = lateral * np.float32(1 / rays.pixel)
    place += np.float32(0.5 - rays.left / rays.pixel)
    place -= rays.before
    np.maximum(place, 0, out=place)
    np.minimum(place, columns - 1, out=place)
    column = place.astype(np.int32)
    return row + column, column, np.broadcast_to(slope, column.shape), lateral
