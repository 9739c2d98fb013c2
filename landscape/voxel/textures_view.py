"""The textures of the passes shown along the lower edge ("k" in the TP).

From the left: what the water mirrors, what lies under it, the depths that the sun sees, and the
depths that the eye sees. A depth texture is shown as grey, near is dark; while it is, it must not
compare (GL_TEXTURE_COMPARE_MODE). Nearly all that the eye sees has depths close to 1, so those are
stretched, twice by a GL_SUBTRACT that is scaled by 4.
State used: GL_TEXTURE_2D on units 0 and 1, GL_COMBINE, the matrices, the texture's compare mode.
"""

from collections.abc import Callable

import numpy as np

from landscape.frame import Frame
from landscape.gl import depth_target
from landscape.gl.calls import gl
from landscape.gl.depth_target import DepthTarget
from landscape.gl.extensions import COMBINE
from landscape.gl.state import attrib, combine, flat_projection
from landscape.gl.texture_target import TextureTarget

NEEDS = (*depth_target.NEEDS, COMBINE)
UNITS = 2
MARGIN = 0.02  # chosen, of the window's width
START = np.full(4, 0.75, np.float32)  # what is subtracted before each scaling by 4
EYE_DEPTHS = 512  # texels, chosen: side of the picture of what the eye sees


class TexturesView:
    """The pictures along the lower edge; owner of the depths that the eye sees."""

    def __init__(self) -> None:
        """Make no texture: most walks never show them."""
        self._depths: DepthTarget | None = None

    def draw(
        self,
        frame: Frame,
        images: list[TextureTarget | DepthTarget | None],
        draw_depths: Callable[[], None],
    ) -> None:
        """Draw the pictures; ``draw_depths`` draws the land's shapes from the eye."""
        if self._depths is None:
            self._depths = DepthTarget(EYE_DEPTHS)
        with self._depths.drawing():
            draw_depths()
        shown = [image for image in (*images, self._depths) if image is not None]
        width, height = frame.viewport
        aspect = height / width
        step = (1.0 - MARGIN) / 4
        groups = gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT | gl.GL_TEXTURE_BIT
        with attrib(groups), flat_projection(0, 1, 0, aspect, -1, 1):
            gl.glDisable(gl.GL_DEPTH_TEST)
            gl.glDisable(gl.GL_FOG)
            gl.glEnable(gl.GL_TEXTURE_2D)
            gl.glColor3f(1.0, 1.0, 1.0)
            for k, image in enumerate(shown):
                left = MARGIN + k * step
                ends = left, left + step - MARGIN
                self._show(image, *ends, aspect, stretched=image is self._depths)

    @staticmethod
    def _show(
        image: TextureTarget | DepthTarget,
        left: float,
        right: float,
        aspect: float,
        stretched: bool,
    ) -> None:
        """Draw one picture between ``left`` and ``right``, in fractions of the window's width."""
        image.bind()
        compares = isinstance(image, DepthTarget)
        mode = gl.GL_TEXTURE_2D, gl.GL_TEXTURE_COMPARE_MODE
        if compares:
            gl.glTexParameteri(*mode, gl.GL_NONE)
        if stretched:
            for unit, source in ((gl.GL_TEXTURE1, "PREVIOUS"), (gl.GL_TEXTURE0, "TEXTURE")):
                gl.glActiveTexture(unit)
                gl.glEnable(gl.GL_TEXTURE_2D)
                image.bind()
                combine({"COMBINE_RGB": "SUBTRACT", "SRC0_RGB": source, "SRC1_RGB": "CONSTANT"})
                gl.glTexEnvfv(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_COLOR, START)
                gl.glTexEnvf(gl.GL_TEXTURE_ENV, gl.GL_RGB_SCALE, 4.0)
        low, high = MARGIN, MARGIN + (right - left) * aspect
        gl.glBegin(gl.GL_QUADS)
        for s, t, x, y in ((0, 0, left, low), (1, 0, right, low), (1, 1, right, high),
                           (0, 1, left, high)):  # fmt: skip
            gl.glTexCoord2f(float(s), float(t))
            gl.glVertex2f(x, y)
        gl.glEnd()
        if compares:
            gl.glTexParameteri(*mode, gl.GL_COMPARE_R_TO_TEXTURE)

    def release(self) -> None:
        """Delete the texture; may be called twice."""
        if self._depths is not None:
            self._depths.release()
            self._depths = None
