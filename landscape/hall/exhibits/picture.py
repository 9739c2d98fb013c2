"""Where in the picture a box lies, and what it takes to draw only that part."""

import math
from itertools import product
from typing import NamedTuple

import numpy as np

from framelens.gl.seam import gl
from landscape.frame import Frame

BEFORE = 1e-3  # chosen: units in front of the eye at which polygons are cut off


class Part(NamedTuple):
    """A rectangle of the picture in pixels from the bottom left, and its nearest depth, -1..1."""

    x: int
    y: int
    width: int
    height: int
    depth: float


def draw_within(frame: Frame, x: int, y: int, width: int, height: int) -> None:
    """Let OpenGL draw only in a part of a frame's picture, in pixels from its bottom left.

    Of a tile the picture's corner lies outside the framebuffer.
    """
    left, bottom = frame.corner
    gl.glEnable(gl.GL_SCISSOR_TEST)
    gl.glScissor(left + x, bottom + y, width, height)


def projection() -> np.ndarray:
    """Return OpenGL's current projection matrix, float64 (4, 4), for column vectors."""
    return np.array(gl.glGetFloatv(gl.GL_PROJECTION_MATRIX), np.float64).reshape(4, 4).T


def part(
    clip: np.ndarray, low: tuple[float, ...], high: tuple[float, ...], size: tuple[int, int]
) -> Part | None:
    """Return the part of a picture of ``size`` pixels that holds a box, None if it shows nowhere.

    ``clip`` (4, 4) takes places to clip coordinates; the box reaches from ``low`` to ``high`` (3,).
    A box that reaches behind the eye may show anywhere, and has the nearest depth.
    """
    ends = zip(low, high, strict=True)
    corners = np.array([(*corner, 1.0) for corner in product(*ends)]) @ clip.T
    if (corners[:, 3] <= 1e-6).any():
        return Part(0, 0, *size, -1.0)
    return _around((corners[:, :3] / corners[:, 3:]).tolist(), size)


def _around(places: list[list[float]], size: tuple[int, int]) -> Part | None:
    """Return the part of a picture that holds places (x, y, z) from -1 to 1."""
    width, height = size
    across, up, away = zip(*places, strict=True)
    left = max(math.floor((min(across) + 1.0) / 2.0 * width), 0)
    bottom = max(math.floor((min(up) + 1.0) / 2.0 * height), 0)
    right = min(math.ceil((max(across) + 1.0) / 2.0 * width), width)
    top = min(math.ceil((max(up) + 1.0) / 2.0 * height), height)
    if right <= left or top <= bottom:
        return None
    return Part(left, bottom, right - left, top - bottom, max(min(away), -1.0))


def part_of(frame: Frame, low: tuple[float, ...], high: tuple[float, ...]) -> Part | None:
    """Return the part of a frame that holds a box in the hall; see :func:`part`."""
    camera = frame.modelview.reshape(4, 4).T
    return part(projection() @ camera, low, high, frame.viewport)


def polygon_part(clip: np.ndarray, corners: np.ndarray, size: tuple[int, int]) -> Part | None:
    """Return the part of a picture of ``size`` pixels that holds a convex polygon (n, 3).

    As :func:`part`, but what is behind the eye is cut off.
    """
    # For a few corners plain Python takes a fraction of numpy's time.
    rows = clip.tolist()
    places = [[a * x + b * y + c * z + d for a, b, c, d in rows] for x, y, z in corners.tolist()]
    kept = [place for place in places if place[3] >= BEFORE]
    for here, there in zip(places, places[1:] + places[:1], strict=True):
        if (here[3] >= BEFORE) != (there[3] >= BEFORE):
            share = (here[3] - BEFORE) / (here[3] - there[3])
            kept.append([a + share * (b - a) for a, b in zip(here, there, strict=True)])
    if not kept:
        return None
    return _around([[x / w, y / w, z / w] for x, y, z, w in kept], size)


def part_of_polygon(frame: Frame, corners: np.ndarray) -> Part | None:
    """Return the part of a frame that holds a convex polygon (n, 3) in the hall.

    In a mirrored frame, its image in the floor.
    """
    camera = frame.modelview.reshape(4, 4).T
    if frame.mirrored:
        corners = corners * (1.0, -1.0, 1.0)
    return polygon_part(projection() @ camera, corners, frame.viewport)
