"""The reflection: the scene drawn a second time, mirrored at the water plane (section 3).

Technique: a mirror matrix diag(1, -1, 1, 1) on the modelview, moved to the water's height. It turns
every triangle's winding round, so the front face is swapped; and the light is placed again under
it. What stands above the water is kept by the clip plane, given in the mirrored frame. With
``reflection.stencil`` the water first marks its pixels in the stencil buffer, and the mirrored
scene is drawn only there: it cannot peep out where no water is. With ``reflection.rippled`` the
mirrored scene becomes a texture instead, which the sea then lays on its waves (see sea.py).
State used: modelview, GL_CLIP_PLANE0, front face, stencil test; for the texture a framebuffer
object, viewport and projection.
"""

import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from typing import Any

import numpy as np

from landscape.elements import sun
from landscape.elements.ground import clipped
from landscape.frame import Frame
from landscape.gl.calls import drawing, drawn_now, gl
from landscape.gl.state import attrib, matrix
from landscape.gl.texture_target import TextureTarget
from landscape.settings import Settings

ELEMENT = "reflection"

MIRROR = np.diag([1.0, -1.0, 1.0, 1.0]).astype(np.float32)  # section 3.1
DETAIL = 0.5  # chosen: pixels of the mirror image per pixel of the window; ripples blur it anyway
MARGIN = 1.15  # chosen: the mirror image reaches this much beyond the window's edges, for ripples
# Clip coordinates -1..1 to texture coordinates 0..1.
BIAS = np.array([(0.5, 0, 0, 0.5), (0, 0.5, 0, 0.5), (0, 0, 0.5, 0.5), (0, 0, 0, 1.0)])


@contextmanager
def reflected(frame: Frame, settings: Settings, water: Any) -> Iterator[Frame]:
    """Let the block draw the mirrored scene where it belongs; yield the frame to draw it by.

    Into the texture of ``water`` (a WaterSurface, or None), or else into the framebuffer.
    """
    if water is not None and settings.reflection.rippled:
        outside = drawn_now()
        with drawing("reflection"), water.mirror.drawing(frame) as smaller, drawing(*outside):
            yield smaller
    else:
        with inside_water(water.mark if water and settings.reflection.stencil else None):
            yield frame


def widened(projection: np.ndarray, margin: float) -> np.ndarray:
    """Return a projection (4, 4) that sees ``margin`` times as far to each side."""
    return np.diag([1 / margin, 1 / margin, 1.0, 1.0]) @ projection


@contextmanager
def mirrored(settings: Settings) -> Iterator[None]:
    """Draw the block's elements as the water mirrors them."""
    level, outside = settings.water.level, drawn_now()
    with drawing("reflection"), matrix(), attrib(gl.GL_POLYGON_BIT | gl.GL_LIGHTING_BIT):
        gl.glTranslatef(0.0, level, 0.0)
        gl.glMultMatrixf(MIRROR)
        gl.glTranslatef(0.0, -level, 0.0)
        gl.glFrontFace(gl.GL_CW)
        sun.place(settings.sun)
        with clipped(level), drawing(*outside):
            yield


@contextmanager
def inside_water(mark: Callable[[], None] | None) -> Iterator[None]:
    """Let the block draw only where ``mark`` draws the water's surface; anywhere if it is None."""
    if mark is None:
        yield
        return
    outside = drawn_now()
    groups = gl.GL_STENCIL_BUFFER_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT
    with drawing("reflection"), attrib(groups):
        gl.glEnable(gl.GL_STENCIL_TEST)
        gl.glStencilFunc(gl.GL_ALWAYS, 1, 1)
        gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_REPLACE)
        gl.glColorMask(gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE)
        gl.glDepthMask(gl.GL_FALSE)
        with drawing("water"):
            mark()
        gl.glColorMask(gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE)
        gl.glDepthMask(gl.GL_TRUE)
        gl.glStencilFunc(gl.GL_EQUAL, 1, 1)
        gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_KEEP)
        with drawing(*outside):
            yield


class MirrorImage:
    """The mirrored scene as a texture; the water takes it up once per frame."""

    def __init__(self) -> None:
        """Wait with the texture until its size is known."""
        self._target: TextureTarget | None = None
        self._matrix: np.ndarray | None = None

    @contextmanager
    def drawing(self, frame: Frame) -> Iterator[Frame]:
        """Let the block draw the mirrored scene into the texture; yield its frame."""
        width, height = (max(1, round(side * DETAIL)) for side in frame.size)
        if self._target is None or self._target.size != (width, height):
            self.release()
            self._target = TextureTarget((width, height))
        # OpenGL gives and takes matrices column after column.
        seen = np.array(gl.glGetFloatv(gl.GL_PROJECTION_MATRIX), np.float64).reshape(4, 4).T
        projection = widened(seen, MARGIN)
        fov = 2 * math.degrees(math.atan(MARGIN * math.tan(math.radians(frame.fov) / 2)))
        gl.glMatrixMode(gl.GL_PROJECTION)
        with matrix():
            gl.glLoadMatrixf(np.ascontiguousarray(projection.T, np.float32))
            gl.glMatrixMode(gl.GL_MODELVIEW)
            try:
                with self._target.drawing():
                    yield replace(frame, size=(width, height), fov=fov)
            finally:
                gl.glMatrixMode(gl.GL_PROJECTION)
        gl.glMatrixMode(gl.GL_MODELVIEW)
        self._matrix = BIAS @ projection @ frame.modelview.reshape(4, 4).T

    def take(self) -> tuple[TextureTarget, np.ndarray] | None:
        """Return texture and matrix (4, 4) from places to coordinates; None if not drawn anew."""
        taken, self._matrix = self._matrix, None
        return (self._target, taken) if self._target is not None and taken is not None else None

    def release(self) -> None:
        """Delete the texture; may be called twice."""
        if self._target is not None:
            self._target.release()
            self._target = None
