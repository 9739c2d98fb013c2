"""A texture that is drawn as in 2006: into the framebuffer, and copied (glCopyTexSubImage2D).

It stands in for a TextureTarget where OpenGL has no framebuffer objects. What is in the framebuffer
is lost, so nothing of the frame may have been drawn before.
"""

from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.texture import filter_within_edges


class CopiedTarget:
    """Owner of the texture."""

    def __init__(self, size: tuple[int, int]) -> None:
        """Create a texture of ``size`` = (width, height) pixels, at most the framebuffer's."""
        self.size = size
        self.name = int(gl.glGenTextures(1))
        bound = int(gl.glGetIntegerv(gl.GL_TEXTURE_BINDING_2D))
        gl.glBindTexture(gl.GL_TEXTURE_2D, self.name)
        form = gl.GL_RGB, gl.GL_UNSIGNED_BYTE
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGB8, *self.size, 0, *form, None)
        filter_within_edges()
        gl.glBindTexture(gl.GL_TEXTURE_2D, bound)

    @contextmanager
    def drawing(self) -> Iterator[None]:
        """Let the block draw into the framebuffer, cleared; copy it, and clear it again."""
        viewport = gl.glGetIntegerv(gl.GL_VIEWPORT).tolist()
        buffers = gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT
        try:
            gl.glViewport(0, 0, *self.size)
            gl.glClear(buffers)
            yield
            bound = int(gl.glGetIntegerv(gl.GL_TEXTURE_BINDING_2D))
            self.bind()
            gl.glCopyTexSubImage2D(gl.GL_TEXTURE_2D, 0, 0, 0, 0, 0, *self.size)
            gl.glBindTexture(gl.GL_TEXTURE_2D, bound)
        finally:
            gl.glClear(buffers)
            gl.glViewport(*viewport)

    def bind(self) -> None:
        """Make it the 2D texture of the active unit."""
        gl.glBindTexture(gl.GL_TEXTURE_2D, self.name)

    def release(self) -> None:
        """Delete the texture; may be called twice."""
        if self.name:
            gl.glDeleteTextures(np.array([self.name], np.uint32))
            self.name = 0
