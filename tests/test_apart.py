"""Drawing over a program's picture, and a context made as new, whatever the program has left."""

import numpy as np

from framelens.gl.apart import apart
from framelens.gl.objects import forget_objects
from framelens.gl.seam import gl
from framelens.state import state


def _spoil() -> None:
    """Leave state behind that would spoil the drawing of a flat quad."""
    for name in (
        "LIGHTING",
        "FOG",
        "DEPTH_TEST",
        "STENCIL_TEST",
        "SCISSOR_TEST",
        "ALPHA_TEST",
        "CULL_FACE",
        "COLOR_LOGIC_OP",
        "POLYGON_STIPPLE",
        "CLIP_PLANE3",
    ):
        gl.glEnable(getattr(gl, f"GL_{name}"))

    gl.glScissor(0, 0, 1, 1)
    gl.glAlphaFunc(gl.GL_NEVER, 0.0)
    gl.glDepthFunc(gl.GL_NEVER)
    gl.glStencilFunc(gl.GL_NEVER, 0, 0)
    gl.glLogicOp(gl.GL_CLEAR)
    gl.glCullFace(gl.GL_FRONT_AND_BACK)
    gl.glColorMask(False, True, False, True)
    gl.glPolygonMode(gl.GL_FRONT_AND_BACK, gl.GL_POINT)
    gl.glViewport(3, 3, 2, 2)
    gl.glActiveTexture(gl.GL_TEXTURE1)
    gl.glEnable(gl.GL_TEXTURE_2D)
    gl.glEnable(gl.GL_TEXTURE_GEN_S)
    gl.glPixelStorei(gl.GL_UNPACK_SKIP_ROWS, 5)
    for mode in (gl.GL_MODELVIEW, gl.GL_TEXTURE, gl.GL_PROJECTION):
        gl.glMatrixMode(mode)
        gl.glTranslatef(7.0, 8.0, 9.0)


def test_a_flat_quad_is_drawn_over_anything_and_the_state_is_as_before(fresh) -> None:
    fresh()
    size = 16, 16
    gl.glClear(gl.GL_COLOR_BUFFER_BIT)
    _spoil()
    before = state.read()
    with apart(size):
        gl.glDisable(gl.GL_TEXTURE_2D)
        gl.glColor4f(1.0, 0.5, 0.25, 1.0)
        gl.glRectf(2.0, 3.0, 10.0, 12.0)
    assert state.difference(before, state.read()) == {}
    gl.glDisable(gl.GL_SCISSOR_TEST)
    pixels = gl.glReadPixels(0, 0, *size, gl.GL_RGB, gl.GL_UNSIGNED_BYTE)
    shown = np.frombuffer(pixels, np.uint8).reshape(16, 16, 3)
    assert np.abs(shown[3:12, 2:10].astype(int) - (255, 128, 64)).max() <= 1
    shown = shown.copy()
    shown[3:12, 2:10] = 0
    assert not shown.any()


def test_objects_that_a_program_has_left_are_gone(fresh) -> None:
    fresh()
    new = state.read()
    texture = gl.glGenTextures(1)
    listed = gl.glGenLists(2)
    buffer = gl.glGenBuffers(1)
    image = np.zeros((4, 4, 3), np.uint8)
    for name in (texture, 0, 77):
        gl.glBindTexture(gl.GL_TEXTURE_2D, name)
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST)
        args = gl.GL_RGB, 4, 4, 0, gl.GL_RGB, gl.GL_UNSIGNED_BYTE, image
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, *args)

    gl.glNewList(listed + 1, gl.GL_COMPILE)
    gl.glEndList()
    gl.glBindBuffer(gl.GL_ARRAY_BUFFER, buffer)
    state.restore(new)
    forget_objects()
    assert not (gl.glIsTexture(texture) or gl.glIsTexture(77) or gl.glIsBuffer(buffer))
    assert not (gl.glIsList(listed) or gl.glIsList(listed + 1))
    width = gl.glGetTexLevelParameteriv(gl.GL_TEXTURE_2D, 0, gl.GL_TEXTURE_WIDTH)
    kind = gl.glGetTexParameteriv(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER)
    assert (width, kind) == (0, gl.GL_NEAREST_MIPMAP_LINEAR)
    assert gl.glGetError() == gl.GL_NO_ERROR
