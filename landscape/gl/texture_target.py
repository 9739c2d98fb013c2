"""A texture that can be drawn into: a framebuffer object whose colour is a texture.

It does what glCopyTexSubImage2D did in 2006, without the copy, and it also works beside a
multisampled framebuffer, from which OpenGL cannot copy to a texture. Needs ARB_framebuffer_object
(2008; core in OpenGL 3.0) and textures of any size (OpenGL 2.0).
"""

from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np

from framelens.gl.named import gl_constant
from framelens.gl.seam import gl
from framelens.gl.texture import filter_within_edges
from landscape.gl.drawing_into import drawing_into, new_texture


class TextureTarget:
    """Owner of a framebuffer, its colour texture and its depth-stencil buffer."""

    def __init__(self, size: tuple[int, int], form: str = "RGB8") -> None:
        """Create a target of ``size`` = (width, height) pixels; what is bound stays bound.

        ``form`` is the internal format without its GL_; "RGBA32F" needs ARB_texture_float.
        """
        self.size = size
        inner = gl_constant(f"GL_{form}")
        with new_texture() as self.name:
            pixels = gl.GL_RGB, gl.GL_UNSIGNED_BYTE, None
            gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, inner, *size, 0, *pixels)
            filter_within_edges()

        previous = int(gl.glGetIntegerv(gl.GL_FRAMEBUFFER_BINDING))
        self._frame = int(gl.glGenFramebuffers(1))
        self._depth = int(gl.glGenRenderbuffers(1))
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, self._frame)
        gl.glBindRenderbuffer(gl.GL_RENDERBUFFER, self._depth)
        gl.glRenderbufferStorage(gl.GL_RENDERBUFFER, gl.GL_DEPTH24_STENCIL8, *size)
        gl.glFramebufferRenderbuffer(
            gl.GL_FRAMEBUFFER, gl.GL_DEPTH_STENCIL_ATTACHMENT, gl.GL_RENDERBUFFER, self._depth
        )
        gl.glFramebufferTexture2D(
            gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_TEXTURE_2D, self.name, 0
        )
        # Whether this OpenGL can draw into it: not every one can into floating-point textures.
        status = gl.glCheckFramebufferStatus(gl.GL_FRAMEBUFFER)
        self.complete = bool(status == gl.GL_FRAMEBUFFER_COMPLETE)
        gl.glBindRenderbuffer(gl.GL_RENDERBUFFER, 0)
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, previous)

    @contextmanager
    def drawing(self, clear: bool = True) -> Iterator[None]:
        """Let the block draw into the texture, by default cleared; then restore the framebuffer."""
        with drawing_into(self._frame, self.size):
            if clear:
                buffers = gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT
                gl.glClear(buffers)
            yield

    def bind(self) -> None:
        """Make the colour the 2D texture of the active unit."""
        gl.glBindTexture(gl.GL_TEXTURE_2D, self.name)

    def release(self) -> None:
        """Delete framebuffer, texture and depth buffer; may be called twice."""
        if self.name:
            gl.glDeleteFramebuffers(1, np.array([self._frame], np.uint32))
            gl.glDeleteRenderbuffers(1, np.array([self._depth], np.uint32))
            gl.glDeleteTextures(np.array([self.name], np.uint32))
            self.name = 0
