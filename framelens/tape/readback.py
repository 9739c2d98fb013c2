"""Reading one buffer of any framebuffer, and depths as distances from the eye."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from framelens.gl.named import gl_constant
from framelens.gl.seam import gl

Box = tuple[int, int, int, int]

# State that a program may have set for its own pixel transfers, with neutral values.
STORED = {
    **dict.fromkeys(("SWAP_BYTES", "LSB_FIRST", "ROW_LENGTH", "SKIP_ROWS", "SKIP_PIXELS"), 0),
    "ALIGNMENT": 1,
}
TRANSFERS = {
    **dict.fromkeys(("MAP_COLOR", "MAP_STENCIL", "INDEX_SHIFT", "INDEX_OFFSET"), 0.0),
    **{f"{name}_SCALE": 1.0 for name in ("RED", "GREEN", "BLUE", "ALPHA", "DEPTH")},
    **{f"{name}_BIAS": 0.0 for name in ("RED", "GREEN", "BLUE", "ALPHA", "DEPTH")},
}


@dataclass(frozen=True)
class Lens:
    """How depths become distances: what the projection and glDepthRange do to z.

    The clip coordinates are z' = a z + b and w' = c z + d, for z in front of the eye negative.
    """

    a: float = -1.0
    b: float = 0.0
    c: float = 0.0
    d: float = 1.0
    range: tuple[float, float] = (0.0, 1.0)

    @property
    def perspective(self) -> bool:
        """Whether the projection is a perspective one."""
        return self.c != 0.0

    def distance(self, depth: ArrayLike) -> object:
        """Return the distance from the plane of the eye at depths from 0 to 1, in eye units."""
        near, far = self.range
        z = (2.0 * np.asarray(depth, np.float64) - near - far) / ((far - near) or 1.0)
        with np.errstate(divide="ignore", invalid="ignore"):
            return -(self.b - z * self.d) / (z * self.c - self.a)


def lens_now(otherwise: Lens) -> Lens:
    """Return the lens of the state in force; ``otherwise`` where its z depends on x or y."""
    matrix = np.array(gl.glGetFloatv(gl.GL_PROJECTION_MATRIX), np.float64).reshape(4, 4).T
    if matrix[2:, :2].any() or not matrix[2, 2]:
        return otherwise
    near, far = (float(value) for value in gl.glGetFloatv(gl.GL_DEPTH_RANGE))
    (a, b), (c, d) = matrix[2:, 2:].tolist()
    return Lens(a, b, c, d, (near, far))


def read_color(target: int, box: Box) -> np.ndarray | None:
    """Return the colours of a framebuffer, uint8 (h, w, 3), top row first; None if it has none."""
    with _readable(target):
        if not int(gl.glGetIntegerv(gl.GL_READ_BUFFER)):
            return None
        pixels = np.zeros((box[3], box[2], 3), np.uint8)
        gl.glReadPixels(*box, gl.GL_RGB, gl.GL_UNSIGNED_BYTE, pixels)
    return np.ascontiguousarray(pixels[::-1])


def read_depth(target: int, box: Box) -> np.ndarray | None:
    """Return the depths, float32 (h, w) from 0 to 1, top row first; None without depth buffer."""
    with _readable(target):
        if not int(gl.glGetIntegerv(gl.GL_DEPTH_BITS)):
            return None
        depths = np.zeros((box[3], box[2]), np.float32)
        gl.glReadPixels(*box, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT, depths)
    return np.ascontiguousarray(depths[::-1])


def read_stencil(target: int, box: Box) -> np.ndarray | None:
    """Return the stencil values, uint8 (h, w), top row first; None without stencil buffer."""
    with _readable(target):
        if not int(gl.glGetIntegerv(gl.GL_STENCIL_BITS)):
            return None
        values = np.zeros((box[3], box[2]), np.uint8)
        gl.glReadPixels(*box, gl.GL_STENCIL_INDEX, gl.GL_UNSIGNED_BYTE, values)
    return np.ascontiguousarray(values[::-1])


@contextmanager
def _readable(target: int) -> Iterator[None]:
    """Let the block read a framebuffer's pixels as they are; then all state is as before."""
    bound = [
        (kind, int(gl.glGetIntegerv(name)))
        for kind, name in (
            (gl.GL_READ_FRAMEBUFFER, gl.GL_READ_FRAMEBUFFER_BINDING),
            (gl.GL_DRAW_FRAMEBUFFER, gl.GL_DRAW_FRAMEBUFFER_BINDING),
        )
    ]
    packed = int(gl.glGetIntegerv(gl.GL_PIXEL_PACK_BUFFER_BINDING))
    gl.glPushClientAttrib(gl.GL_CLIENT_PIXEL_STORE_BIT)
    gl.glPushAttrib(gl.GL_PIXEL_MODE_BIT)

    try:
        for name, value in STORED.items():
            gl.glPixelStorei(gl_constant(f"GL_PACK_{name}"), value)
        for name, number in TRANSFERS.items():
            gl.glPixelTransferf(gl_constant(f"GL_{name}"), number)
        gl.glBindBuffer(gl.GL_PIXEL_PACK_BUFFER, 0)
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, target)
        yield
    finally:
        for kind, binding in bound:
            gl.glBindFramebuffer(kind, binding)
        gl.glBindBuffer(gl.GL_PIXEL_PACK_BUFFER, packed)
        gl.glPopAttrib()
        gl.glPopClientAttrib()
