"""The sun's camera: matrices of a square around the eye, and of a part of it. No OpenGL."""

import math
from collections.abc import Sequence
from functools import lru_cache

import numpy as np

from landscape.voxel.visibility import CORNERS

AROUND = 2  # texels, chosen: drawn around what has changed


def light_axes(towards: np.ndarray) -> np.ndarray:
    """Return the rotation (3, 3) to the sun's eye space: rows right, up and towards the sun."""
    return _axes(*towards.tolist())


@lru_cache(maxsize=8)
def _axes(x: float, y: float, z: float) -> np.ndarray:
    """Return the same, computed once for each sun; not to be changed."""
    level = math.hypot(x, z)
    right = np.array([z, 0.0, -x]) / level if level > 1e-6 else np.array([1.0, 0.0, 0.0])
    towards = np.array([x, y, z])
    return np.stack([right, np.cross(towards, right), towards])


def light_matrix(
    towards: np.ndarray, eye: np.ndarray, reach: float, depth: float, step: float
) -> np.ndarray:
    """Return the sun's projection times view (4, 4), for column vectors.

    It covers a square of ``reach`` units to each side of the eye and ``depth`` units towards the
    sun and away. The middle of the square is a multiple of ``step`` units; 0 leaves it at the eye.
    """
    axes = light_axes(towards)
    middle = axes @ eye
    if step:
        middle[:2] = np.round(middle[:2] / step) * step
        middle[2] = np.round(middle[2])
    scale = np.array([1 / reach, 1 / reach, -1 / depth])
    found = np.eye(4)
    found[:3, :3] = scale[:, None] * axes
    found[:3, 3] = -scale * middle
    return found


def part_of(
    boxes: Sequence[tuple[np.ndarray, np.ndarray]], matrix: np.ndarray, side: int
) -> tuple[int, int, int, int]:
    """Return the part of the picture in which boxes, in units, are: x, y, width, height in texels.

    ``matrix`` (4, 4) is the sun's, ``side`` that of the picture.
    """
    ends = np.array(boxes)[:, CORNERS.astype(int), np.arange(3)].reshape(-1, 3)
    x, y, _ = matrix[:3, :3] @ ends.T + matrix[:3, 3:]
    low, high = (
        [int(np.clip((edge(at) * 0.5 + 0.5) * side + out, 0, side)) for at in (x, y)]
        for edge, out in ((np.min, -AROUND), (np.max, AROUND + 1))
    )
    return low[0], low[1], max(high[0] - low[0], 1), max(high[1] - low[1], 1)


def enlarged(matrix: np.ndarray, part: tuple[int, int, int, int], side: int) -> np.ndarray:
    """Return a matrix that lets only a part of the picture be seen, but in the whole of it."""
    found = matrix.copy()
    for axis in (0, 1):
        scale = side / part[2 + axis]
        middle = (part[axis] + part[2 + axis] / 2) / side * 2 - 1
        found[axis] = scale * (found[axis] - middle * found[3])
    return found
