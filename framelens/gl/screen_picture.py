"""A picture that Python computed, shown as one textured quad over the whole window.

Technique: the picture is copied into a texture that stays (glTexSubImage2D, OpenGL 1.1), and the
quad covers the window, a texel a pixel. OpenGL 1.x wants powers of two for a texture's sides, so
the picture fills a corner of a larger one.
State used: GL_TEXTURE_2D.
"""

import numpy as np

from framelens.gl.seam import begin_pass, drawing, gl
from framelens.gl.state import attrib, flat_projection
from framelens.gl.texture import Texture


class ScreenPicture:
    """The texture, which is made anew when the pictures' size changes."""

    def __init__(self) -> None:
        """Make nothing yet."""
        self._size = (0, 0)
        self._texture: Texture | None = None

    @drawing("picture")
    def _roomy(self, width: int, height: int) -> Texture:
        """Return the texture, whose sides are powers of two that have room for a picture."""
        wide, high = (1 << max(side - 1, 0).bit_length() for side in (width, height))
        if self._texture is None or self._size != (wide, high):
            self.release()
            empty = np.zeros((high, wide, 4), np.uint8)
            self._texture = Texture(empty, repeat=False, mipmaps=False)
            self._size = wide, high
        return self._texture

    def draw(self, rgba: np.ndarray) -> None:
        """Draw a picture, uint8 (h, w, 4), its top row first, over the whole viewport."""
        begin_pass("main")
        height, width = rgba.shape[:2]
        texture = self._roomy(width, height)
        wide, high = self._size

        with attrib(gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT), flat_projection(0, 1, 0, 1, -1, 1):
            gl.glDisable(gl.GL_DEPTH_TEST)
            gl.glEnable(gl.GL_TEXTURE_2D)
            texture.bind()
            gl.glTexSubImage2D(
                gl.GL_TEXTURE_2D,
                0,
                0,
                0,
                width,
                height,
                gl.GL_RGBA,
                gl.GL_UNSIGNED_BYTE,
                np.ascontiguousarray(rgba),
            )
            gl.glColor3f(1.0, 1.0, 1.0)
            s, t = width / wide, height / high
            gl.glBegin(gl.GL_QUADS)
            for x, y in ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)):
                gl.glTexCoord2f(s * x, t * (1.0 - y))  # the picture's top row is first
                gl.glVertex2f(x, y)
            gl.glEnd()
            gl.glBindTexture(gl.GL_TEXTURE_2D, 0)

    def release(self) -> None:
        """Delete the texture; may be called twice."""
        if self._texture is not None:
            self._texture.release()
            self._texture = None
