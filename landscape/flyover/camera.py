"""From the terrain to the screen: the camera transform and the projection (section 2.1).

The axes are those of the height image: x along its rows, y down its columns, z up. A camera whose
angles are all 0 looks along +x, and +y is on its right. After the camera transform x is the
distance along the line of sight, y goes to the right and z up. The near rectangle is stretched over
the whole picture, whose pixel (0, 0) is at its top left.
"""

import math
from dataclasses import dataclass

import numpy as np

from framelens.base import arguments
from landscape.flyover.settings import Flyover

FARTHEST_PIXEL = float(1 << 30)  # chosen: coordinates beyond it are not told apart
Points = tuple[np.ndarray, np.ndarray, np.ndarray]


@dataclass(frozen=True)
class Camera:
    """A point of view: x, y, z in units, angles in radians.

    ``theta_z`` turns from +x to +y, which is to the right; positive ``theta_y`` looks down;
    ``theta_x`` rolls. InputError if one is not a finite number.
    """

    x: float
    y: float
    z: float
    theta_x: float = 0.0
    theta_y: float = 0.0
    theta_z: float = 0.0

    def __post_init__(self) -> None:
        for name in ("x", "y", "z", "theta_x", "theta_y", "theta_z"):
            value = arguments.number(getattr(self, name), f"camera's {name}")
            object.__setattr__(self, name, value)


@dataclass(frozen=True)
class Frustum:
    """The view volume: the near rectangle, and the distances of the near and far planes."""

    left: float = -1.0
    right: float = 1.0
    top: float = 1.0
    bottom: float = -1.0
    near: float = 1.5
    far: float = 4096.0


def frustum(settings: Flyover, size: tuple[int, int]) -> Frustum:
    """Return the view volume for a picture of ``size`` (width, height) in pixels.

    With ``widen`` pixels are square if the near rectangle of the settings is.
    """
    aspect = size[0] / size[1] if settings.widen else 1.0
    return Frustum(
        settings.left * aspect,
        settings.right * aspect,
        settings.top,
        settings.bottom,
        settings.near,
        settings.far,
    )


def camera_transform(x: np.ndarray, y: np.ndarray, z: np.ndarray, camera: Camera) -> Points:
    """Return points in the camera's frame of reference; x, y, z are relative to the camera.

    These are the document's equations term by term, so that the same numbers come out.
    """
    sin_x, cos_x = math.sin(camera.theta_x), math.cos(camera.theta_x)
    sin_y, cos_y = math.sin(camera.theta_y), math.cos(camera.theta_y)
    sin_z, cos_z = math.sin(camera.theta_z), math.cos(camera.theta_z)
    forward = sin_z * y + cos_z * x
    right = cos_z * y - sin_z * x
    up = cos_y * z + sin_y * forward
    return cos_y * forward - sin_y * z, sin_x * up + cos_x * right, cos_x * up - sin_x * right


def project(
    x: np.ndarray, y: np.ndarray, z: np.ndarray, volume: Frustum, size: tuple[int, int]
) -> tuple[np.ndarray, np.ndarray]:
    """Return the pixels (column, row), int64, of points in the camera's frame of reference.

    ``x`` must be positive. Pixels may be off the screen. ``size`` is (width, height).
    """
    width, height = size
    across = width * ((y * volume.near / x) - volume.left) / (volume.right - volume.left)
    down = height * (1 - (((z * volume.near / x) - volume.bottom) / (volume.top - volume.bottom)))
    return _ceil(across), _ceil(down)


def _ceil(values: np.ndarray) -> np.ndarray:
    return np.ceil(np.clip(values, -FARTHEST_PIXEL, FARTHEST_PIXEL)).astype(np.int64)
