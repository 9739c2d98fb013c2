"""Drawing over a finished picture, whatever state the program that drew it has left.

Reading and restoring the whole state (framelens/state/state.py) takes some milliseconds, which are
too many in each frame. A flat quad needs less: what could spoil it is saved, turned off and put
back.
"""

from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np

from framelens.gl.named import gl_constant
from framelens.gl.seam import gl

SPOILERS = (
    *("LIGHTING", "FOG", "DEPTH_TEST", "STENCIL_TEST", "SCISSOR_TEST", "ALPHA_TEST", "CULL_FACE"),
    *("COLOR_LOGIC_OP", "POLYGON_STIPPLE", "POLYGON_SMOOTH", "COLOR_SUM", "COLOR_MATERIAL"),
    *(f"CLIP_PLANE{number}" for number in range(6)),
)
OF_A_UNIT = (
    *("TEXTURE_1D", "TEXTURE_2D", "TEXTURE_3D", "TEXTURE_CUBE_MAP"),
    *(f"TEXTURE_GEN_{coordinate}" for coordinate in "STRQ"),
)
MATRICES = ("PROJECTION", "MODELVIEW", "TEXTURE")


@contextmanager
def apart(size: tuple[int, int]) -> Iterator[None]:
    """Let the block draw blended, textured quads in pixels, in a window of ``size``.

    The state is put back. Nothing is drawn into a framebuffer object that the program has bound.
    """
    gl.glPushAttrib(gl.GL_ALL_ATTRIB_BITS)
    gl.glPushClientAttrib(gl.GL_CLIENT_ALL_ATTRIB_BITS)
    target = int(gl.glGetIntegerv(gl.GL_FRAMEBUFFER_BINDING))
    if target:
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)
    _plain_units()
    _let_textures_blend(size)

    # The stacks may be full.
    saved = {name: np.array(gl.glGetDoublev(gl_constant(f"GL_{name}_MATRIX"))) for name in MATRICES}
    for name in MATRICES:
        gl.glMatrixMode(gl_constant(f"GL_{name}"))
        gl.glLoadIdentity()
    gl.glMatrixMode(gl.GL_PROJECTION)
    gl.glOrtho(0, size[0], 0, size[1], -1, 1)
    try:
        yield
    finally:
        gl.glActiveTexture(gl.GL_TEXTURE0)
        for name, matrix in saved.items():
            gl.glMatrixMode(gl_constant(f"GL_{name}"))
            gl.glLoadMatrixd(matrix)
        if target:
            gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, target)
        gl.glPopClientAttrib()
        gl.glPopAttrib()


def _let_textures_blend(size: tuple[int, int]) -> None:
    """Let textures be blended over the whole of a window, and images lie in memory without gaps."""
    for name in SPOILERS:
        gl.glDisable(gl_constant(f"GL_{name}"))
    gl.glPolygonMode(gl.GL_FRONT_AND_BACK, gl.GL_FILL)
    gl.glColorMask(True, True, True, True)
    gl.glDrawBuffer(gl.GL_BACK if gl.glGetIntegerv(gl.GL_DOUBLEBUFFER) else gl.GL_FRONT)
    gl.glViewport(0, 0, *size)
    gl.glEnable(gl.GL_TEXTURE_2D)
    gl.glEnable(gl.GL_BLEND)
    gl.glBlendEquation(gl.GL_FUNC_ADD)
    gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
    gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_MODULATE)
    for kind in ("UNPACK", "PACK"):
        for name in ("ROW_LENGTH", "SKIP_ROWS", "SKIP_PIXELS", "SWAP_BYTES", "LSB_FIRST"):
            gl.glPixelStorei(gl_constant(f"GL_{kind}_{name}"), 0)


def _plain_units() -> None:
    """Turn off what the texture units do; leave the first one active."""
    for unit in reversed(range(int(gl.glGetIntegerv(gl.GL_MAX_TEXTURE_UNITS)))):
        gl.glActiveTexture(gl.GL_TEXTURE0 + unit)
        for name in OF_A_UNIT:
            gl.glDisable(gl_constant(f"GL_{name}"))
