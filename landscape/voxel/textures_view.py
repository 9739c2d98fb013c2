"""The textures of the passes shown along the lower edge ("k" in the TP).

From the left: what the water mirrors, what lies under it, the depths that the sun sees, and the
depths that the eye sees. A depth texture is shown as grey, near is dark; while it is, it must not
compare (GL_TEXTURE_COMPARE_MODE). Nearly all that the eye sees has depths close to 1, so those are
stretched, three times by a GL_SUBTRACT that is scaled by 4. ``debug.picture`` shows one of them
alone.
State used: GL_TEXTURE_2D on units 0 to 2, GL_COMBINE, the matrices, the texture's compare mode.
"""

from collections.abc import Callable, Mapping

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib, combine, flat_projection
from landscape.frame import Frame
from landscape.gl.depth_target import DepthTarget
from landscape.gl.texture_target import TextureTarget
from landscape.voxel.settings import PICTURES

MARGIN = 0.02  # chosen, of the window's width
ABOVE = 0.07  # chosen, of the window's width: below them is room for the bar of blocks
START = np.full(4, 0.75, np.float32)  # what is subtracted before each scaling by 4
BEHIND = (0.08, 0.10, 0.13)  # chosen: beside a picture that is shown alone
EYE_DEPTHS = 512  # texels, chosen: side of the picture of what the eye sees


def covered(size: tuple[int, int]) -> int:
    """Return how high the row of pictures reaches in a window of ``size`` pixels, in pixels."""
    width, height = size
    return round(ABOVE * width + ((1.0 - MARGIN) / len(PICTURES) - MARGIN) * height)


class TexturesView:
    """The pictures along the lower edge; owner of the depths that the eye sees."""

    def __init__(self) -> None:
        """Make no texture: most walks never show them."""
        self._depths: DepthTarget | None = None

    def draw(
        self,
        frame: Frame,
        images: Mapping[str, TextureTarget | DepthTarget | None],
        draw_depths: Callable[[], None],
        whole: str = "none",
    ) -> None:
        """Draw the pictures of PICTURES in a row, or ``whole``, one of them, in all of the window.

        ``draw_depths`` draws the land's shapes from the eye, for the last one.
        """
        if self._depths is None:
            self._depths = DepthTarget(EYE_DEPTHS)
        with self._depths.drawing():
            draw_depths()
        shown = {**images, PICTURES[-1]: self._depths}
        width, height = frame.viewport
        aspect = height / width
        step = (1.0 - MARGIN) / len(PICTURES)
        groups = gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT | gl.GL_TEXTURE_BIT | gl.GL_COLOR_BUFFER_BIT
        with attrib(groups), flat_projection(0, 1, 0, aspect, -1, 1):
            gl.glDisable(gl.GL_DEPTH_TEST)
            gl.glDisable(gl.GL_FOG)
            gl.glEnable(gl.GL_TEXTURE_2D)
            gl.glColor3f(1.0, 1.0, 1.0)
            if whole != "none":
                gl.glClearColor(*BEHIND, 1.0)
                gl.glClear(gl.GL_COLOR_BUFFER_BIT)
                # What the sun sees is square, all else as wide as the window.
                side = min(1.0, aspect) / 2 if whole == "shadow" else 0.5
                ends = 0.5 - side, 0.5 + side
                up = min(aspect, 2 * side) / 2
                self._show(shown[whole], *ends, aspect / 2 - up, aspect / 2 + up)
                return

            high = (step - MARGIN) * aspect
            for k, name in enumerate(PICTURES):
                left = MARGIN + k * step
                wide = min(high, step - MARGIN) if name == "shadow" else step - MARGIN
                self._show(shown[name], left, left + wide, ABOVE, ABOVE + high)

    def _show(
        self,
        image: TextureTarget | DepthTarget | None,
        left: float,
        right: float,
        low: float,
        high: float,
    ) -> None:
        """Draw one picture, if there is one, in fractions of the window's width."""
        if image is None:
            return
        image.bind()
        compares = isinstance(image, DepthTarget)
        mode = gl.GL_TEXTURE_2D, gl.GL_TEXTURE_COMPARE_MODE
        if compares:
            gl.glTexParameteri(*mode, gl.GL_NONE)
        if image is self._depths:
            units = gl.GL_TEXTURE2, gl.GL_TEXTURE1, gl.GL_TEXTURE0
            for unit, source in zip(units, ("PREVIOUS", "PREVIOUS", "TEXTURE"), strict=True):
                gl.glActiveTexture(unit)
                gl.glEnable(gl.GL_TEXTURE_2D)
                image.bind()
                combine({"COMBINE_RGB": "SUBTRACT", "SRC0_RGB": source, "SRC1_RGB": "CONSTANT"})
                gl.glTexEnvfv(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_COLOR, START)
                gl.glTexEnvf(gl.GL_TEXTURE_ENV, gl.GL_RGB_SCALE, 4.0)

        gl.glBegin(gl.GL_QUADS)
        for s, t, x, y in (
            (0, 0, left, low),
            (1, 0, right, low),
            (1, 1, right, high),
            (0, 1, left, high),
        ):
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
