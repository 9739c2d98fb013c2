"""The mirrored scene as a texture, for waves to distort (R16, section 12; ``reflection.rippled``).

Technique: render to texture. The mirrored scene is drawn before the frame itself, into a
framebuffer object of half the window's size (``Detail.mirror``), with a slightly wider projection:
ripples look up places beyond the window's borders. The texture is then projected onto the water:
the texture matrix is bias x projection x camera, so a vertex whose texture coordinate is its own
position samples its own pixel, and one whose texture coordinate is moved by a ripple samples a
place beside it. Without framebuffer objects the image is drawn into the framebuffer and copied,
as it would have been in 2006 (gl/copied_target.py).
State used: a framebuffer object, viewport and projection; to draw with it, one texture unit with
GL_COMBINE (OpenGL 1.3) and crossbar (1.4), its texture matrix.
"""

import math
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace

import numpy as np

from framelens.gl.named import texture_unit
from framelens.gl.seam import gl
from framelens.gl.state import combine, matrix, use_unit
from framelens.gl.texture import at_most
from landscape.frame import Frame
from landscape.geometry.culling import is_near
from landscape.gl.copied_target import CopiedTarget
from landscape.gl.features import possible
from landscape.gl.texture_target import TextureTarget

ACROSS, DOWN = 0.6, 0.9  # chosen: texels of the mirror image per pixel of its size
MARGIN = 1.15  # chosen: times the window's width and height that the mirror image covers
# Chosen: units and radians by which the eye may move and turn until a kept image is drawn again.
KEPT_DISTANCE, KEPT_ANGLE = 0.12, math.radians(6.0)
# Clip coordinates -1..1 to texture coordinates 0..1.
BIAS = np.array([(0.5, 0, 0, 0.5), (0, 0.5, 0, 0.5), (0, 0, 0.5, 0.5), (0, 0, 0, 1.0)])

Target = TextureTarget | CopiedTarget
Taken = tuple[Target, np.ndarray]
"""The texture, and the matrix (4, 4) from positions to its coordinates."""


def widened(projection: np.ndarray, margin: float) -> np.ndarray:
    """Return a projection (4, 4) that sees ``margin`` times as far to each side."""
    return np.diag([1 / margin, 1 / margin, 1.0, 1.0]) @ projection


@contextmanager
def mirror_unit(mirror: Taken | None, unit: int, depths: int | None) -> Iterator[None]:
    """Let a unit mix the mirror image in, by the alpha of the unit before; None does nothing.

    The block sets the array of texture coordinates. The resulting alpha is 1; or, with the depths
    on unit ``depths``, how much of the bottom the water and the mirror image hide.
    """
    if mirror is None:
        yield
        return
    with projected(mirror, unit):
        combine({"COMBINE_RGB": "INTERPOLATE", "SRC0_RGB": "PREVIOUS", "SRC1_RGB": "TEXTURE"})
        combine({"SRC2_RGB": "PREVIOUS", "OPERAND2_RGB": "SRC_ALPHA"})
        gl.glTexEnvfv(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_COLOR, np.ones(4, np.float32))
        if depths is None:
            combine({"COMBINE_ALPHA": "REPLACE", "SRC0_ALPHA": "CONSTANT"})
        else:
            combine({"COMBINE_ALPHA": "INTERPOLATE", "SRC0_ALPHA": f"TEXTURE{depths}"})
            combine({"SRC1_ALPHA": "CONSTANT", "SRC2_ALPHA": "PREVIOUS"})

        name = texture_unit(unit)
        gl.glClientActiveTexture(name)
        gl.glEnableClientState(gl.GL_TEXTURE_COORD_ARRAY)
        try:
            yield
        finally:
            gl.glClientActiveTexture(name)
            gl.glDisableClientState(gl.GL_TEXTURE_COORD_ARRAY)


@contextmanager
def projected(mirror: Taken, unit: int) -> Iterator[None]:
    """Let the block use a unit whose texture is the image, projected onto the water.

    The unit is active, and its environment is the block's.
    """
    target, projection = mirror
    use_unit(unit)
    gl.glEnable(gl.GL_TEXTURE_2D)
    target.bind()
    gl.glMatrixMode(gl.GL_TEXTURE)
    with matrix():
        gl.glLoadMatrixf(np.ascontiguousarray(projection.T, np.float32))
        try:
            yield
        finally:
            use_unit(unit)
            gl.glMatrixMode(gl.GL_TEXTURE)
    gl.glMatrixMode(gl.GL_MODELVIEW)


class MirrorImage:
    """Owner of the texture; filled or kept once per frame, and taken by the sea once."""

    def __init__(self) -> None:
        """Create nothing yet: the size of the window is not known."""
        self._target: Target | None = None
        self._matrix: np.ndarray | None = None
        self._drawn: tuple[Frame, np.ndarray] | None = None
        self._served = 0

    @contextmanager
    def drawing(self, frame: Frame) -> Iterator[Frame]:
        """Let the block draw the mirrored scene into the texture; yield the frame to draw it by."""
        width, height = (max(1, round(side * frame.detail.mirror)) for side in frame.size)
        texels = max(1, round(width * ACROSS)), max(1, round(height * DOWN))
        if not possible("textures of any size"):
            texels = at_most(texels[0]), at_most(texels[1])
        if self._target is None or self._target.size != texels:
            self.release()
            drawn_into = possible("reflection.rippled without a copy")
            self._target = TextureTarget(texels) if drawn_into else CopiedTarget(texels)

        # OpenGL returns and takes matrices in column-major order.
        seen = np.array(gl.glGetFloatv(gl.GL_PROJECTION_MATRIX), np.float64).reshape(4, 4).T
        projection = widened(seen, MARGIN)
        fov = 2 * math.degrees(math.atan(MARGIN * math.tan(math.radians(frame.fov) / 2)))
        gl.glMatrixMode(gl.GL_PROJECTION)
        with matrix():
            gl.glLoadMatrixf(np.ascontiguousarray(projection.T, np.float32))
            gl.glMatrixMode(gl.GL_MODELVIEW)
            try:
                with self._target.drawing():
                    small = replace(frame.detail, scale=1.0)
                    yield replace(frame, size=(width, height), fov=fov, detail=small, tile=None)
            finally:
                gl.glMatrixMode(gl.GL_PROJECTION)

        gl.glMatrixMode(gl.GL_MODELVIEW)
        self._matrix = BIAS @ projection @ frame.modelview.reshape(4, 4).T
        self._drawn, self._served = (frame, self._matrix), 1

    def keep(self, frame: Frame) -> bool:
        """Use the last image for this frame as well; return False if it must be drawn again.

        It serves ``detail.mirror_frames`` frames while the eye stays near. It was projected from
        the place of the eye at that time, so it stays where it was on the water.
        """
        if self._drawn is None or self._served >= frame.detail.mirror_frames:
            return False
        then, matrix = self._drawn
        near = is_near(then, frame, KEPT_DISTANCE, KEPT_ANGLE)
        if then.detail.mirror != frame.detail.mirror or not near:
            return False
        self._matrix, self._served = matrix, self._served + 1
        return True

    def take(self) -> Taken | None:
        """Return texture and matrix; None if it was not redrawn since the last call."""
        taken, self._matrix = self._matrix, None
        return (self._target, taken) if self._target is not None and taken is not None else None

    def release(self) -> None:
        """Delete the texture; may be called twice."""
        if self._target is not None:
            self._target.release()
            self._target = self._drawn = None
