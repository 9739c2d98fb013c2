"""A picture of a walk that serves for several frames: moved to where its things are seen now.

Technique (Mark, McMillan, Bishop, Post-rendering 3D warping, I3D 1997): a grid of vertices covers
the picture, which is its texture. The depth at each vertex says where in the world that is, and so
where in the next frame it is seen. What is farther than its neighbours, or was hidden, is stretched
at an edge; the less the eye has moved since, the less one sees of that. No OpenGL here.
"""

import math
from dataclasses import dataclass, replace

import numpy as np

from landscape.frame import Pose
from landscape.scene.scene import Moment

COLUMNS, ROWS = 32, 18  # chosen: cells of the grid; the depth is that in the middle of a cell
FARTHEST = 1.0  # chosen: units; an eye that moved farther between two frames was put elsewhere
WIDEST = 45.0  # chosen: degrees; likewise
BEHIND = 1e-3  # clip-space w: what is nearer, or behind the eye, is left where it is


@dataclass(frozen=True)
class Seen:
    """From where a picture was drawn, and how far away what is at the vertices of the grid is.

    ``distances`` (rows, columns) are along the line of sight, in units, from the bottom row up.
    """

    pose: Pose
    fov: float
    size: tuple[int, int]
    distances: np.ndarray


def turned(earlier: float, later: float) -> float:
    """Return by how many degrees an angle has changed, -180..180."""
    return (later - earlier + 180.0) % 360.0 - 180.0


def apart(earlier: Pose, later: Pose) -> bool:
    """Return whether an eye cannot have moved from one pose to the other between two frames."""
    moved = np.subtract(place(later), place(earlier))
    angles = abs(turned(earlier.yaw, later.yaw)), abs(later.pitch - earlier.pitch)
    return math.hypot(*moved) > FARTHEST or max(angles) > WIDEST


def place(pose: Pose) -> tuple[float, float, float]:
    """Return the eye's place."""
    assert pose.y is not None
    return pose.x, pose.y, pose.z


def ahead(earlier: Moment, now: Moment, times: float) -> Moment:
    """Return a moment after ``now``, if all goes on as since an ``earlier`` one.

    It is ``times`` times as long after ``now`` as that was before.
    """
    then, pose = earlier.pose, now.pose
    if apart(then, pose):
        return now
    x, y, z = (b + times * (b - a) for a, b in zip(place(then), place(pose), strict=True))
    moved = replace(
        pose,
        x=x,
        y=y,
        z=z,
        yaw=pose.yaw + times * turned(then.yaw, pose.yaw),
        pitch=min(max(pose.pitch + times * (pose.pitch - then.pitch), -90.0), 90.0),
        roll=pose.roll + times * turned(then.roll, pose.roll),
    )
    return replace(now, pose=moved, kt=now.kt + times * (now.kt - earlier.kt))


def axes(pose: Pose) -> np.ndarray:
    """Return the camera's axes in the world as rows (3, 3): right, up and back."""
    yaw, pitch, roll = (math.radians(angle) for angle in (pose.yaw, pose.pitch, pose.roll))

    def rotation(angle: float, first: int, second: int) -> np.ndarray:
        matrix = np.eye(3)
        matrix[first, first] = matrix[second, second] = math.cos(angle)
        matrix[first, second] = -math.sin(angle)
        matrix[second, first] = math.sin(angle)
        return matrix

    # As glRotatef(-roll, z), glRotatef(-pitch, x), glRotatef(yaw, y).
    return np.asarray(rotation(-roll, 0, 1) @ rotation(-pitch, 1, 2) @ rotation(-yaw, 0, 2))


def distances(depths: np.ndarray, projection: np.ndarray) -> np.ndarray:
    """Return how far away depths in 0..1 are, along the line of sight, in units.

    ``projection`` (16,) is that of glFrustum, as OpenGL returns it.
    """
    return np.asarray(projection[14] / (2.0 * depths - 1.0 + projection[10]))


def grid() -> np.ndarray:
    """Return the vertices in the picture, (ROWS + 2, COLUMNS + 2, 2) in 0..1: x, y from below.

    They are in the middles of the cells, and on the picture's edges.
    """
    x, y = (
        np.concatenate([[0.0], (np.arange(cells) + 0.5) / cells, [1.0]])
        for cells in (COLUMNS, ROWS)
    )
    return np.stack(np.meshgrid(x, y), axis=2)


def quads() -> np.ndarray:
    """Return the indices of the grid's quads, uint32 (n,)."""
    number = np.arange((ROWS + 2) * (COLUMNS + 2), dtype=np.uint32).reshape(ROWS + 2, COLUMNS + 2)
    corners = number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1]
    return np.ascontiguousarray(np.stack(corners, axis=2).ravel())


GRID = grid()
QUADS = quads()


def reprojected(seen: Seen, pose: Pose) -> np.ndarray:
    """Return where the grid's vertices are seen from a pose, float32 (ROWS + 2, COLUMNS + 2, 3).

    x and y are -1..1 in the window, z is 0. Those on the edges stay outside of it, so that the
    picture covers the window.
    """
    tall = math.tan(math.radians(seen.fov) / 2.0)
    wide = tall * seen.size[0] / seen.size[1]
    far = np.pad(seen.distances, 1, mode="edge")
    flat = 2.0 * GRID - 1.0
    rays = np.stack([flat[..., 0] * wide, flat[..., 1] * tall, np.full(far.shape, -1.0)], axis=2)
    points = (far[..., None] * rays) @ axes(seen.pose) + place(seen.pose)
    x, y, back = np.moveaxis((points - place(pose)) @ axes(pose).T, 2, 0)

    vertices = np.zeros((*far.shape, 3), np.float32)
    vertices[..., :2] = flat
    before = -back > BEHIND
    vertices[before, 0] = x[before] / (-back[before] * wide)
    vertices[before, 1] = y[before] / (-back[before] * tall)
    vertices[:, 0, 0] = np.minimum(vertices[:, 0, 0], -1.0)
    vertices[:, -1, 0] = np.maximum(vertices[:, -1, 0], 1.0)
    vertices[0, :, 1] = np.minimum(vertices[0, :, 1], -1.0)
    vertices[-1, :, 1] = np.maximum(vertices[-1, :, 1], 1.0)
    return vertices
