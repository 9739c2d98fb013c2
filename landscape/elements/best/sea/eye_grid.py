"""The sea's grid: laid out around the eye, in equal steps of angle. No OpenGL here.

A grid of equal cells on the map is too coarse at the viewer's feet and too fine at the horizon. The
lines of this one are at equal steps of azimuth and of the angle below the horizon, as the eye sees
them: cells are about equally large on the screen, and almost nothing out of view is sent.
"""

from functools import lru_cache

import numpy as np

from landscape.frame import Frame
from landscape.geometry.mesh import grid_triangles

AZIMUTH_STEP = np.radians(1.2)  # chosen: angle between two lines of the grid, across
DEPRESSION_STEP = np.radians(0.45)  # chosen: and downwards
# Chosen: more lines between the horizon and the first one below it, as fractions of that angle:
# there a step of one line is most of the way to the horizon.
FAR_LINES = (0.12, 0.3, 0.6)
MAX_LINES = 160  # chosen: lines across, and downwards; wider views take steps twice as large
BELOW_WINDOW = 0.06  # chosen: radians that the grid extends below the window, for wave troughs
MIN_HEIGHT = 0.02  # chosen: units above the water of the lowest eye that a grid is made for


@lru_cache(maxsize=16)
def triangles_of(columns: int, rows: int) -> np.ndarray:
    """Return the triangles of a grid, uint32 (m, 3), row 0 first; cached, as few sizes occur."""
    return grid_triangles(columns, rows)


@lru_cache(maxsize=16)
def window_border(fov: float, aspect: float) -> tuple[np.ndarray, np.ndarray]:
    """Return x (right) and y (up), (68,) each, of points on the window's border, one unit ahead."""
    top = np.tan(np.radians(fov) / 2)
    along = np.linspace(-1.0, 1.0, 17)
    edge = np.ones_like(along)
    a = top * aspect * np.concatenate([along, along, edge, -edge])
    return a, top * np.concatenate([edge, -edge, along, along])


def view_angles(frame: Frame) -> tuple[float, float, float, float] | None:
    """Return the limits of azimuth and depression of what the window shows below the horizon.

    Lowest and highest azimuth, then depression, in radians; azimuth 0 is north and grows eastward,
    depression 0 is the horizon and pi/2 straight down. None where the window shows nothing below
    the horizon.
    """
    a, b = window_border(frame.fov, frame.size[0] / frame.size[1])
    yaw, pitch = np.radians(frame.pose.yaw), np.radians(frame.pose.pitch)
    ahead, up = np.cos(pitch) - b * np.sin(pitch), np.sin(pitch) + b * np.cos(pitch)
    depression = np.arctan2(-up, np.hypot(ahead, a))
    below = depression > 0
    if not below.any():
        return None
    first = max(float(depression.min()), 0.0)
    if pitch - np.radians(frame.fov) / 2 <= -np.pi / 2:  # the window shows the point below the eye
        return yaw - np.pi, yaw + np.pi, first, np.pi / 2
    around = np.arctan2(a, ahead)[depression > -0.05]
    last = float(depression.max())
    return yaw + float(around.min()), yaw + float(around.max()), first, last


def grid_lines(start: float, end: float, step: float) -> np.ndarray:
    """Return the multiples of ``step`` that enclose a range; ``step`` doubles as often as needed.

    As they are multiples, the grid's lines stay where they are when the viewer turns.
    """
    while (end - start) / step > MAX_LINES - 3:
        step *= 2
    return step * np.arange(np.floor(start / step), np.ceil(end / step) + 1)


def eye_grid(frame: Frame, level: float, reach: float) -> "EyeGrid | None":
    """Return the grid for the window's view of the water, out to ``reach`` units.

    None where no water is in view.
    """
    angles = view_angles(frame)
    height = max(frame.eye_y - level, MIN_HEIGHT)
    horizon = np.arctan(height / reach)
    if angles is None or angles[3] <= horizon:
        return None

    # A picture with half the pixels does with every second line.
    every = 2 if frame.detail.coarser >= 2.0 else 1
    azimuth = grid_lines(angles[0], angles[1], every * AZIMUTH_STEP)
    lowest = min(1.15 * angles[3] + BELOW_WINDOW, np.pi / 2)
    depression = grid_lines(angles[2], lowest, every * DEPRESSION_STEP)
    step = float(depression[1] - depression[0])
    depression = np.clip(depression, horizon, np.pi / 2 - 1e-3)
    if depression[0] == horizon:
        far = horizon + np.array(FAR_LINES) * (depression[1] - horizon)
        depression = np.concatenate([depression[:1], far, depression[1:]])
    return EyeGrid(frame, height, azimuth, depression, step)


class EyeGrid:
    """A grid on the water around the eye: rows are rings, far to near, columns are directions.

    ``height`` is the eye's above the water, ``eye`` (2,) its x and z. ``x`` and ``z``, float32
    (rows, columns), are the vertices' positions in units; ``ring`` (rows,) the rings' radii and
    ``cell`` (rows,) the distance to the next ring; ``east`` and ``south`` (columns,) the directions
    as unit vectors.
    """

    def __init__(
        self, frame: Frame, height: float, azimuth: np.ndarray, depression: np.ndarray, step: float
    ) -> None:
        """Lay out the grid; both angles in radians; ``step`` is that between two depressions."""
        self.height = height
        self.eye = np.array([frame.pose.x, frame.pose.z])
        self.east = np.sin(azimuth).astype(np.float32)
        self.south = -np.cos(azimuth).astype(np.float32)
        self.ring = (height / np.tan(depression)).astype(np.float32)
        self.cell = (np.square(self.ring) + height**2) / height * step
        self.x = np.float32(frame.pose.x) + self.ring[:, None] * self.east
        self.z = np.float32(frame.pose.z) + self.ring[:, None] * self.south

    def keep_within(self, low: float, high: float) -> None:
        """Move what is outside the square from ``low`` to ``high`` onto its border."""
        np.clip(self.x, low, high, out=self.x)
        np.clip(self.z, low, high, out=self.z)

    @property
    def sight(self) -> np.ndarray:
        """The distances (rows, 1) from the eye to the rings."""
        return np.hypot(self.ring, self.height)[:, None]

    @property
    def triangles(self) -> np.ndarray:
        """The grid's triangles, uint32 (m, 3), the far ones first."""
        return triangles_of(len(self.east), len(self.ring))
