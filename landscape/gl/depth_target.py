"""A depth texture that can be drawn into: a framebuffer object without colour.

Needs ARB_framebuffer_object (2008; core in OpenGL 3.0) and ARB_depth_texture (OpenGL 1.4).
"""

from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib
from landscape.gl.drawing_into import drawing_into, new_texture

LIT = np.ones(4, np.float32)  # the greatest depth: outside the texture nothing is nearer


class DepthTarget:
    """Owner of a framebuffer and its depth texture, which compares when it is looked up.

    A lookup at (s, t, r) gives 1 where r is at most the depth stored at s, t, and otherwise 0
    (ARB_shadow, OpenGL 1.4); the linear filter mixes the answers of four texels.
    """

    def __init__(self, side: int) -> None:
        """Create a square of ``side`` texels; what is bound stays bound."""
        self.side = side
        with new_texture() as self.name:
            kind = gl.GL_DEPTH_COMPONENT24, side, side, 0, gl.GL_DEPTH_COMPONENT, gl.GL_UNSIGNED_INT
            gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, *kind, None)
            parameters = {
                gl.GL_TEXTURE_WRAP_S: gl.GL_CLAMP_TO_BORDER,
                gl.GL_TEXTURE_WRAP_T: gl.GL_CLAMP_TO_BORDER,
                gl.GL_TEXTURE_MIN_FILTER: gl.GL_LINEAR,
                gl.GL_TEXTURE_MAG_FILTER: gl.GL_LINEAR,
                gl.GL_TEXTURE_COMPARE_MODE: gl.GL_COMPARE_R_TO_TEXTURE,
                gl.GL_TEXTURE_COMPARE_FUNC: gl.GL_LEQUAL,
                gl.GL_DEPTH_TEXTURE_MODE: gl.GL_LUMINANCE,
            }
            for name, value in parameters.items():
                gl.glTexParameteri(gl.GL_TEXTURE_2D, name, value)
            gl.glTexParameterfv(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_BORDER_COLOR, LIT)

        previous = int(gl.glGetIntegerv(gl.GL_FRAMEBUFFER_BINDING))
        self._frame = int(gl.glGenFramebuffers(1))
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, self._frame)
        gl.glFramebufferTexture2D(
            gl.GL_FRAMEBUFFER, gl.GL_DEPTH_ATTACHMENT, gl.GL_TEXTURE_2D, self.name, 0
        )
        gl.glDrawBuffer(gl.GL_NONE)
        gl.glReadBuffer(gl.GL_NONE)
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, previous)

    @contextmanager
    def drawing(
        self, part: tuple[int, int, int, int] | None = None, clear: bool = True
    ) -> Iterator[None]:
        """Let the block draw depths into the cleared texture; then restore the framebuffer.

        Only ``part`` of it is cleared and drawn, if given: x, y, width and height in texels.
        Without ``clear`` the block adds to what is there.
        """
        with drawing_into(self._frame, (self.side, self.side)), attrib(gl.GL_SCISSOR_BIT):
            if part is not None:
                gl.glEnable(gl.GL_SCISSOR_TEST)
                gl.glScissor(*part)
            if clear:
                gl.glClear(gl.GL_DEPTH_BUFFER_BIT)
            yield

    def bind(self) -> None:
        """Make the depths the 2D texture of the active unit."""
        gl.glBindTexture(gl.GL_TEXTURE_2D, self.name)

    def release(self) -> None:
        """Delete framebuffer and texture; may be called twice."""
        if self.name:
            gl.glDeleteFramebuffers(1, np.array([self._frame], np.uint32))
            gl.glDeleteTextures(np.array([self.name], np.uint32))
            self.name = 0
