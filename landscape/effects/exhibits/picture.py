"""Where in the picture a box lies, and what of the view it takes to draw only that part."""

from itertools import product
from typing import NamedTuple

import numpy as np

from landscape.frame import Frame
from landscape.gl.calls import gl


class Part(NamedTuple):
    """A rectangle of the picture in pixels from the bottom left, and its nearest depth, -1..1."""

    x: int
    y: int
    width: int
    height: int
    depth: float


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
    places = corners[:, :3] / corners[:, 3:]
    pixels = (places[:, :2] + 1.0) / 2.0 * size
    left, bottom = np.clip(np.floor(pixels.min(axis=0)), 0, size).astype(int).tolist()
    right, top = np.clip(np.ceil(pixels.max(axis=0)), 0, size).astype(int).tolist()
    if right <= left or top <= bottom:
        return None
    return Part(left, bottom, right - left, top - bottom, max(float(places[:, 2].min()), -1.0))


def part_of(frame: Frame, low: tuple[float, ...], high: tuple[float, ...]) -> Part | None:
    """Return the part of a frame that holds a box in the hall; see :func:`part`."""
    camera = frame.modelview.reshape(4, 4).T
    return part(projection() @ camera, low, high, frame.viewport)
