"""What framebuffer objects with a texture have in common."""

from collections.abc import Iterator
from contextlib import contextmanager

from framelens.gl.seam import gl


@contextmanager
def new_texture() -> Iterator[int]:
    """Let the block set up a new 2D texture, whose name it gets; then restore what was bound."""
    bound = int(gl.glGetIntegerv(gl.GL_TEXTURE_BINDING_2D))
    name = int(gl.glGenTextures(1))
    gl.glBindTexture(gl.GL_TEXTURE_2D, name)
    try:
        yield name
    finally:
        gl.glBindTexture(gl.GL_TEXTURE_2D, bound)


@contextmanager
def drawing_into(framebuffer: int, size: tuple[int, int]) -> Iterator[None]:
    """Let the block draw into a framebuffer of a size in pixels; then restore what was bound."""
    previous = int(gl.glGetIntegerv(gl.GL_FRAMEBUFFER_BINDING))
    # Not by glPushAttrib: in Mesa, what the block changes of other groups would then not be
    # restored by a glPopAttrib around it.
    viewport = gl.glGetIntegerv(gl.GL_VIEWPORT).tolist()
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, framebuffer)
    try:
        gl.glViewport(0, 0, *size)
        yield
    finally:
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, previous)
        gl.glViewport(*viewport)
