"""Camera rigs: how one moment becomes one picture, by one camera, two or six.

``stereo``: two eyes side by side, each half as wide; their lines of sight are parallel. ``360``:
all that is seen around, as an equirectangular picture, twice as wide as high: six cameras look at
the faces of a cube, and each pixel is looked up in the face that it is in. Its middle is where the
camera looks; up is up, whatever the camera's pitch.
"""

import math
from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache

import numpy as np

from landscape.frame import Pose
from landscape.scene.scene import Moment

ONE, STEREO, AROUND = "one", "stereo", "360"
RIGS = (ONE, STEREO, AROUND)
EYES = 0.038  # between two eyes, times the height of an eye above the ground: 0.064 of 1.7 metres
FACE = 1.02  # chosen: half a face, times what it covers: neighbours overlap, and no edge is seen
FOV = math.degrees(2 * math.atan(FACE))  # of a face
ROWS = 64  # looked up at a time
SIDES = ((0, 0), (90, 0), (180, 0), (270, 0), (0, 90), (0, -90))  # yaw and pitch of the faces

Draw = Callable[[Moment], np.ndarray]
"""From a moment to its picture, uint8 (h, w, 3)."""


def drawn_size(rig: str, size: tuple[int, int]) -> tuple[int, int]:
    """Return the size in pixels of what each camera of a rig draws for pictures of a size."""
    if rig == STEREO:
        return size[0] // 2, size[1]
    if rig == AROUND:
        # As many pixels a degree in the middle of a face as the picture has.
        side = math.ceil(size[0] / math.pi * FACE)
        return side, side
    return size


def picture(rig: str, size: tuple[int, int], moment: Moment, eye: float, draw: Draw) -> np.ndarray:
    """Return the picture of a moment, uint8 (h, w, 3); ``eye`` is an eye's height in units."""
    if rig == STEREO:
        half = 0.5 * EYES * eye
        return np.concatenate([draw(_aside(moment, sign * half)) for sign in (-1, 1)], axis=1)
    if rig == AROUND:
        faces = [draw(replace(moment, pose=_turned(moment.pose, *side))) for side in SIDES]
        return around(np.stack(faces), size)
    return draw(moment)


def _aside(moment: Moment, units: float) -> Moment:
    """Return a moment seen from so far to the right."""
    pose = moment.pose
    yaw = math.radians(pose.yaw)
    x, z = pose.x + units * math.cos(yaw), pose.z + units * math.sin(yaw)
    return replace(moment, pose=replace(pose, x=x, z=z))


def _turned(pose: Pose, yaw: float, pitch: float) -> Pose:
    return Pose(pose.x, pose.y, pose.z, pose.yaw + yaw, pitch)


def around(faces: np.ndarray, size: tuple[int, int]) -> np.ndarray:
    """Return the equirectangular picture, uint8 (h, w, 3), of faces, uint8 (6, n, n, 3)."""
    side = faces.shape[1]
    flat = faces.reshape(-1, 3).astype(np.float32)
    found = np.empty((size[1], size[0], 3), np.uint8)
    for top in range(0, size[1], ROWS):
        where, right, down = _looked_up(size, side, top)
        right, down = right[..., None], down[..., None]
        upper = flat[where] * (1 - right) + flat[where + 1] * right
        lower = flat[where + side] * (1 - right) + flat[where + side + 1] * right
        found[top : top + ROWS] = np.rint(upper * (1 - down) + lower * down).astype(np.uint8)
    return found


@lru_cache(maxsize=128)
def _rays(size: tuple[int, int], top: int) -> np.ndarray:
    """Return the directions (rows, w, 3) of the pixels of ROWS rows from ``top``."""
    width, height = size
    rows = np.arange(top, min(top + ROWS, height))
    up = (math.pi * (0.5 - (rows + 0.5) / height))[:, None]
    turn = (2 * math.pi * ((np.arange(width) + 0.5) / width - 0.5))[None]
    return np.stack(
        [np.cos(up) * np.sin(turn), np.sin(up) + 0 * turn, -np.cos(up) * np.cos(turn)], axis=-1
    )


def _looked_up(size: tuple[int, int], side: int, top: int) -> tuple[np.ndarray, ...]:
    """Return of ROWS rows from ``top`` which pixel (rows, w) of the faces, and the way to the next.

    The way is 0..1 to the right, and down.
    """
    ray = _rays(size, top)
    ahead = np.stack([_axes(*each)[2] for each in SIDES])
    face = (ray @ ahead.T).argmax(axis=-1)
    axes = np.stack([_axes(*each) for each in SIDES])[face]
    x, y, z = np.moveaxis((axes @ ray[..., None])[..., 0], -1, 0)
    column = (x / z / FACE + 1) / 2 * side - 0.5
    row = (1 - y / z / FACE) / 2 * side - 0.5
    left, over = (np.clip(np.floor(each).astype(int), 0, side - 2) for each in (column, row))
    where = (face * side + over) * side + left
    return where, (column - left).astype(np.float32), (row - over).astype(np.float32)


def _axes(yaw: float, pitch: float) -> np.ndarray:
    """Return the camera's right, up and line of sight as rows (3, 3)."""
    yaw, pitch = math.radians(yaw), math.radians(pitch)
    right = (math.cos(yaw), 0.0, math.sin(yaw))
    ahead = (math.cos(pitch) * math.sin(yaw), math.sin(pitch), -math.cos(pitch) * math.cos(yaw))
    return np.array([right, np.cross(right, ahead), ahead])
