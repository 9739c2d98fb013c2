"""Contrast and brightness of one texture, without loading it again (glSkel, scale and bias).

Technique: the texture is drawn once into a framebuffer object of its own size, which keeps it as it
was. From there glCopyTexSubImage2D copies it back into the texture, through the pixel transfer:
GL_RED_SCALE and the like multiply, GL_RED_BIAS and the like add, and glGenerateMipmap makes its
smaller levels. So nothing comes from the program's memory, display lists that bind the texture stay
as they are, and what one frame paid for, all later frames have for nothing. Rounding happens once:
each change starts from what was kept.
State used: a framebuffer object, pixel transfer, GL_TEXTURE_2D; all restored.
"""

from typing import NamedTuple

import numpy as np

from framelens.gl.named import gl_constant
from framelens.gl.seam import gl
from framelens.gl.state import attrib, flat_projection
from framelens.gl.texture import Texture
from landscape.gl.texture_target import TextureTarget

CORNERS = ((-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0))
COLOURS = "RED", "GREEN", "BLUE"


class Change(NamedTuple):
    """The factor for each colour of a texture, and the offset that is then added, in -1..1."""

    scale: float = 1.0
    bias: float = 0.0


class TonedTexture:
    """A texture of the caller's, whose contrast and brightness can be changed."""

    def __init__(self, texture: Texture) -> None:
        """Keep the texture as it is now; OpenGL must be able to draw into textures."""
        self._texture = texture
        self._kept = TextureTarget(size(texture))
        groups = gl.GL_ENABLE_BIT | gl.GL_TEXTURE_BIT | gl.GL_CURRENT_BIT | gl.GL_POLYGON_BIT
        with self._kept.drawing(), attrib(groups), flat_projection():
            for name in ("DEPTH_TEST", "LIGHTING", "CULL_FACE", "BLEND", "FOG"):
                gl.glDisable(gl_constant(f"GL_{name}"))
            gl.glPolygonMode(gl.GL_FRONT_AND_BACK, gl.GL_FILL)
            gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_REPLACE)
            gl.glEnable(gl.GL_TEXTURE_2D)
            texture.bind()
            gl.glBegin(gl.GL_QUADS)
            for x, y in CORNERS:
                gl.glTexCoord2f((x + 1) / 2, (y + 1) / 2)
                gl.glVertex2f(x, y)
            gl.glEnd()

    def change(self, change: Change) -> None:
        """Give the texture another contrast and brightness than it was kept with."""
        with (
            self._kept.drawing(clear=False),
            attrib(gl.GL_PIXEL_MODE_BIT | gl.GL_TEXTURE_BIT),
        ):
            for name in COLOURS:
                gl.glPixelTransferf(gl_constant(f"GL_{name}_SCALE"), change.scale)
                gl.glPixelTransferf(gl_constant(f"GL_{name}_BIAS"), change.bias)
            self._texture.bind()
            gl.glCopyTexSubImage2D(gl.GL_TEXTURE_2D, 0, 0, 0, 0, 0, *self._kept.size)
            gl.glGenerateMipmap(gl.GL_TEXTURE_2D)

    def release(self) -> None:
        """Delete what was kept; the texture is the caller's. May be called twice."""
        self._kept.release()


def size(texture: Texture) -> tuple[int, int]:
    """Return the width and height of a texture in texels."""
    bound = int(gl.glGetIntegerv(gl.GL_TEXTURE_BINDING_2D))
    texture.bind()
    sides = [
        int(np.ravel(gl.glGetTexLevelParameteriv(gl.GL_TEXTURE_2D, 0, name))[0])
        for name in (gl.GL_TEXTURE_WIDTH, gl.GL_TEXTURE_HEIGHT)
    ]
    gl.glBindTexture(gl.GL_TEXTURE_2D, bound)
    return sides[0], sides[1]
