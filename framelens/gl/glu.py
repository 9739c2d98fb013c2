"""GLU's functions in Python, so that the OpenGL calls they make are seen, and may be changed.

libGLU calls the system's libGL from C: nobody sees these calls, and under OSMesa they draw nothing.
The functions here take and return what those of OpenGL.GLU do, angles in degrees, and make the same
calls as the sample implementation of GLU 1.3, by what OpenGL.GL holds at the time.
"""

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import OpenGL.GL as GL

from framelens.gl.glu_images import gluBuild1DMipmaps, gluBuild2DMipmaps, gluScaleImage
from framelens.gl.glu_quadrics import QUADRICS


def gluPerspective(fovy: float, aspect: float, near: float, far: float) -> None:
    """Multiply the current matrix by a perspective projection; ``fovy`` in degrees, full angle."""
    half = math.radians(fovy) / 2
    if far == near or math.sin(half) == 0.0 or aspect == 0.0:
        return
    cotangent = math.cos(half) / math.sin(half)
    matrix = np.zeros((4, 4))
    matrix[0, 0] = cotangent / aspect
    matrix[1, 1] = cotangent
    matrix[2, 2] = -(far + near) / (far - near)
    matrix[2, 3] = -1.0
    matrix[3, 2] = -2.0 * near * far / (far - near)
    GL.glMultMatrixd(matrix)


def gluLookAt(*place: float) -> None:
    """Multiply the current matrix by a view: eye, point looked at, up, of three numbers each."""
    if len(place) != 9:
        raise TypeError(f"gluLookAt takes 9 numbers, not {len(place)}")
    eye, centre, up = np.reshape(np.array(place, np.float64), (3, 3))
    # Single precision, as in GLU, so that the picture is the same.
    forward = _unit((centre - eye).astype(np.float32))
    side = _unit(np.cross(forward, up.astype(np.float32)))
    matrix = np.eye(4, dtype=np.float32)
    matrix[:3, 0] = side
    matrix[:3, 1] = np.cross(side, forward)
    matrix[:3, 2] = -forward
    GL.glMultMatrixf(matrix + np.float32(0.0))  # 0, not -0, where a trace shows it
    GL.glTranslated(*(0.0 - eye).tolist())


def _unit(vector: np.ndarray) -> np.ndarray:
    length = np.sqrt(np.sum(vector * vector, dtype=np.float32))
    return vector / length if length else vector


def gluOrtho2D(left: float, right: float, bottom: float, top: float) -> None:
    """Multiply the current matrix by a parallel projection of depths from -1 to 1."""
    GL.glOrtho(left, right, bottom, top, -1.0, 1.0)


def gluPickMatrix(x: float, y: float, width: float, height: float, viewport: object = None) -> None:
    """Restrict drawing to a rectangle of the viewport around (x, y), in pixels from below left."""
    if width <= 0 or height <= 0:
        return
    left, bottom, wide, high = _viewport(viewport)
    GL.glTranslatef((wide - 2.0 * (x - left)) / width, (high - 2.0 * (y - bottom)) / height, 0.0)
    GL.glScalef(wide / width, high / height, 1.0)


def gluProject(
    x: float,
    y: float,
    z: float,
    model: object = None,
    projection: object = None,
    view: object = None,
) -> tuple[float, float, float]:
    """Return where a point is in the window: x, y in pixels from below left, depth in 0..1."""
    clip = np.array((x, y, z, 1.0)) @ _modelview(model) @ _projection(projection)
    if clip[3] == 0.0:
        raise ValueError("Projection failed!")
    left, bottom, wide, high = _viewport(view)
    x, y, z = ((clip[:3] / clip[3]) * 0.5 + 0.5).tolist()
    return x * wide + left, y * high + bottom, z


def gluUnProject(
    x: float,
    y: float,
    z: float,
    model: object = None,
    projection: object = None,
    view: object = None,
) -> tuple[float, float, float]:
    """Return the point that gluProject takes to x, y, z."""
    result = _unprojected((x, y, z, 1.0), model, projection, view, 0.0, 1.0)
    if result[3] == 0.0:
        raise ValueError("Projection failed!")
    x, y, z = (result[:3] / result[3]).tolist()
    return x, y, z


def gluUnProject4(
    x: float,
    y: float,
    z: float,
    w: float,
    model: object = None,
    projection: object = None,
    view: object = None,
    near: float = 0.0,
    far: float = 1.0,
) -> tuple[float, ...]:
    """Return the homogeneous point of a window position and its clip w; depths from near to far."""
    return tuple(_unprojected((x, y, z, w), model, projection, view, near, far).tolist())


def _unprojected(
    window: Sequence[float],
    model: object,
    projection: object,
    view: object,
    near: float,
    far: float,
) -> np.ndarray:
    try:
        inverse = np.linalg.inv(_modelview(model) @ _projection(projection))
    except np.linalg.LinAlgError:
        raise ValueError("Projection failed!") from None
    left, bottom, wide, high = _viewport(view)
    x, y, z, w = window
    unit = ((x - left) / wide, (y - bottom) / high, (z - near) / (far - near))
    return np.array([*(2.0 * value - 1.0 for value in unit), w]) @ inverse


def _modelview(given: object) -> np.ndarray:
    matrix = GL.glGetDoublev(GL.GL_MODELVIEW_MATRIX) if given is None else given
    return np.reshape(np.array(matrix, np.float64), (4, 4))


def _projection(given: object) -> np.ndarray:
    matrix = GL.glGetDoublev(GL.GL_PROJECTION_MATRIX) if given is None else given
    return np.reshape(np.array(matrix, np.float64), (4, 4))


def _viewport(given: Any) -> tuple[float, ...]:
    view = GL.glGetIntegerv(GL.GL_VIEWPORT) if given is None else given
    return tuple(float(value) for value in view)


FUNCTIONS: dict[str, Callable[..., object]] = QUADRICS | {
    function.__name__: function
    for function in (
        *(gluPerspective, gluLookAt, gluOrtho2D, gluPickMatrix),
        *(gluProject, gluUnProject, gluUnProject4),
        *(gluBuild1DMipmaps, gluBuild2DMipmaps, gluScaleImage),
    )
}
