"""The frame that an element draws: its pose, size, time and camera. No element reads a clock."""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from framelens.base.arguments import finite, plain
from framelens.base.errors import InputError, short

SEED = 2006  # chosen: of everything random, unless another is asked for; the year of the report


@dataclass(frozen=True)
class Pose:
    """Where the eye is: x, y, z in units; yaw 0 looks north (-z), 90 east (+x); pitch up.

    Angles in degrees. ``y`` may be None in a pose to move to: eye height above the ground there.
    A walker's head has no ``roll``, which tips it to the right; a flying camera may.
    """

    x: float
    y: float | None
    z: float
    yaw: float = 0.0
    pitch: float = 0.0
    roll: float = 0.0

    @property
    def forward(self) -> tuple[float, float, float]:
        """The unit vector of the line of sight."""
        yaw, pitch = math.radians(self.yaw), math.radians(self.pitch)
        return (
            math.cos(pitch) * math.sin(yaw),
            math.sin(pitch),
            -math.cos(pitch) * math.cos(yaw),
        )


def checked_pose(value: object, given: str = "") -> Pose:
    """Return a pose from x, y, z and perhaps yaw and pitch; a y of "ground" becomes None.

    InputError names the value as ``given``, as the command line does.
    """
    numbers = value
    if isinstance(value, Pose):
        numbers = (value.x, value.y, value.z, value.yaw, value.pitch, value.roll)
    numbers = plain(numbers)
    if isinstance(numbers, (list, tuple)) and 3 <= len(numbers) <= 5 + isinstance(value, Pose):
        y = numbers[1]
        grounded = y is None or (isinstance(y, str) and y == "ground")
        # A y on the ground is no number: any number stands in for it while all are checked.
        checked = [finite(0.0 if grounded and k == 1 else v) for k, v in enumerate(numbers)]
        valid = [number for number in checked if number is not None]
        if len(valid) == len(numbers):
            x, height, *angles = valid
            return Pose(x, None if grounded else height, *angles)

    raise InputError(
        "{value}: expected the numbers x, y, z, yaw and pitch; y may be `ground`",
        value=given or f"pose {short(value)}",
    )


@dataclass(frozen=True)
class Detail:
    """How finely a frame is drawn; the default is all of it, as in every still.

    A walk on a slow machine draws less, to hold its frame rate (see walk/pace.py). ``scale`` is
    how many pixels are drawn per pixel of the window, along each side; ``shift`` moves what is
    drawn to the right and up, in pixels of the window. ``coarser`` is how many times larger an
    error in pixels may be, where meshes and sprites are chosen by their size in pixels. ``grass``
    is the fraction of the blades of a meadow. ``mirror`` is how many pixels of the mirror image are
    drawn per pixel of the window, and ``mirror_frames`` how many frames it serves.
    """

    scale: float = 1.0
    shift: tuple[float, float] = (0.0, 0.0)
    coarser: float = 1.0
    grass: float = 1.0
    mirror: float = 0.5  # chosen: ripples blur the mirror image anyway
    mirror_frames: int = 1


FULL = Detail()


def scaled(pixels: int, scale: float) -> int:
    """Return how many pixels are drawn for ``pixels`` of the window: rounded up, at least 1."""
    return max(math.ceil(pixels * scale - 1e-6), 1)


LARGEST = 16384  # pixels a side: the largest viewport of llvmpipe


@dataclass(frozen=True)
class Tile:
    """The part of a large picture that is drawn, in pixels from its lower left corner.

    ``x``, ``y`` is where the tile begins; ``block`` is x, y, width and height of the rectangle to
    which OpenGL projects, in which the tile is: the whole picture unless no viewport is as large.
    """

    x: int
    y: int
    block: tuple[int, int, int, int]

    def cuts(self, size: tuple[int, int]) -> bool:
        """Return whether the block is less than a picture of ``size`` pixels."""
        return self.block[2:] != size


@dataclass(frozen=True)
class Frame:
    """One frame: pose, window size in pixels, kt, and the walker's state.

    ``modelview`` is the camera's matrix as OpenGL returns it, 16 floats in column-major order.
    ``step`` counts the walker's steps (k_step); ``stroke`` is 0 at rest and 1 to 4 in a stroke.
    ``fov`` is the vertical field of view in degrees. Of a ``tile`` only that part is drawn.
    Billboards turn to the eye of the pose ``faced``; None is the frame's own.
    """

    pose: Pose
    size: tuple[int, int]
    kt: float
    modelview: np.ndarray
    fov: float
    step: float = 0.0
    stroke: int = 0
    mirrored: bool = False
    detail: Detail = FULL
    tile: Tile | None = None
    faced: Pose | None = None

    @property
    def corner(self) -> tuple[int, int]:
        """Where the viewport begins in the framebuffer, in pixels; before it if this is a tile."""
        if self.tile is None:
            return 0, 0
        x, y, _, _ = self.tile.block
        return x - self.tile.x, y - self.tile.y

    @property
    def viewport(self) -> tuple[int, int]:
        """The width and height in pixels to draw; smaller than ``size`` by ``detail.scale``."""
        if self.tile is not None:
            return self.tile.block[2:]
        width, height = self.size
        return scaled(width, self.detail.scale), scaled(height, self.detail.scale)

    @cached_property
    def eye_y(self) -> float:
        """The eye's height, the pose's y."""
        assert self.pose.y is not None
        return self.pose.y

    @cached_property
    def eye(self) -> np.ndarray:
        """The eye's place, float64 (3,)."""
        return np.array([self.pose.x, self.eye_y, self.pose.z])

    @property
    def faced_eye(self) -> np.ndarray:
        """The place that billboards turn to, float64 (3,)."""
        if self.faced is None:
            return self.eye
        assert self.faced.y is not None
        return np.array([self.faced.x, self.faced.y, self.faced.z])

    @cached_property
    def right(self) -> np.ndarray:
        """The camera's right, the first row of the modelview's 3x3 block (section 5.1.1)."""
        return self.modelview[[0, 4, 8]]

    @cached_property
    def up(self) -> np.ndarray:
        """The camera's up, the second row of the modelview's 3x3 block."""
        return self.modelview[[1, 5, 9]]

    @cached_property
    def back(self) -> np.ndarray:
        """The direction from what is seen to the camera, the third row of the 3x3 block."""
        return self.modelview[[2, 6, 10]]

    @cached_property
    def axes(self) -> np.ndarray:
        """The modelview's 3x3 block, (9,), which turns the world's axes to the camera's."""
        return self.modelview[[0, 1, 2, 4, 5, 6, 8, 9, 10]]

    @cached_property
    def to_world(self) -> np.ndarray:
        """The rotation (3, 3) from eye space to the world's axes, upside down if mirrored."""
        turn = np.stack([self.right, self.up, self.back], axis=1)
        return np.diag([1.0, -1.0, 1.0]) @ turn if self.mirrored else turn

    @cached_property
    def frustum_planes(self) -> np.ndarray:
        """Normals (3, 5) of the planes through the eye that bound the view, pointing into it.

        The last is the view direction, of length 1. The normals of the frustum's four sides are not
        unit vectors: a sphere's radius, or a box's half sides, must be multiplied by their length.
        """
        ahead = -self.back
        top = math.tan(math.radians(self.fov) / 2)
        side = top * self.size[0] / self.size[1]
        # A shifted picture shows less at its right and top, and more at its left and bottom.
        moved, raised = (2.0 * top / self.size[1] * each for each in self.detail.shift)
        across, rise = self.right, self.up
        planes = [
            ahead * (side - moved) - across,
            ahead * (side + moved) + across,
            ahead * (top - raised) - rise,
            ahead * (top + raised) + rise,
        ]
        return np.stack([*planes, ahead], axis=1)

    @cached_property
    def frustum_rows(self) -> list[list[float]]:
        """:attr:`frustum_planes` as plain numbers, one normal per row."""
        rows: list[list[float]] = self.frustum_planes.T.tolist()
        return rows

    @property
    def pixels(self) -> float:
        """The height in pixels of an object one unit high, one unit away.

        It decides what is too small to be drawn, so it counts the pixels that matter: fewer than
        the window has if the frame may be ``coarser``.
        """
        height = self.size[1] / self.detail.coarser
        return height / (2.0 * math.tan(math.radians(self.fov) / 2))

    def depth(self, points: np.ndarray) -> np.ndarray:
        """Return the eye-space z of points (n, 3), negative in front of the camera (5.1.1)."""
        axis = self.modelview[[2, 6, 10]].astype(points.dtype)
        return points @ axis + points.dtype.type(self.modelview[14])
