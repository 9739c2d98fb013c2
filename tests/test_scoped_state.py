"""The checks of state themselves: a frame notices what is changed, and scoped state comes back."""

import numpy as np
import pytest
from gl_state import changes, snapshot
from stage import Stage

from framelens.gl.seam import gl
from framelens.gl.state import attrib, client_arrays, flat_projection, front_faces, matrix
from landscape.elements.settings import Settings
from landscape.frame import Pose

POSE = Pose(20.0, 3.5, 21.0, 10.0, -6.0)


def test_a_frame_would_notice_changed_state(stage: Stage) -> None:
    def change_fog() -> None:
        gl.glFogf(gl.GL_FOG_DENSITY, 0.5)

    def unbalanced() -> None:
        gl.glPushMatrix()

    def change_material() -> None:
        gl.glMaterialfv(gl.GL_FRONT, gl.GL_DIFFUSE, np.full(4, 0.5, np.float32))

    def change_sources() -> None:
        gl.glActiveTexture(gl.GL_TEXTURE1)
        gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_SRC0_RGB, gl.GL_PREVIOUS)
        gl.glActiveTexture(gl.GL_TEXTURE0)

    def texture_second() -> None:
        gl.glActiveTexture(gl.GL_TEXTURE1)
        gl.glEnable(gl.GL_TEXTURE_2D)

    def turn_texture() -> None:
        gl.glMatrixMode(gl.GL_TEXTURE)
        gl.glRotatef(5.0, 0.0, 0.0, 1.0)
        gl.glMatrixMode(gl.GL_MODELVIEW)

    mischief = {
        "GL_BLEND": lambda: gl.glEnable(gl.GL_BLEND),
        "GL_TEXTURE1.GL_TEXTURE_2D": lambda: (
            gl.glActiveTexture(gl.GL_TEXTURE1),
            gl.glEnable(gl.GL_TEXTURE_2D),
        ),
        "GL_ACTIVE_TEXTURE": lambda: gl.glActiveTexture(gl.GL_TEXTURE1),
        "GL_CURRENT_COLOR": lambda: gl.glColor4f(0.5, 0.5, 0.5, 1.0),
        "GL_DEPTH_WRITEMASK": lambda: gl.glDepthMask(gl.GL_FALSE),
        "GL_FOG_DENSITY": change_fog,
        "GL_MODELVIEW_STACK_DEPTH": unbalanced,
        "GL_CLIENT_ACTIVE_TEXTURE": lambda: gl.glClientActiveTexture(gl.GL_TEXTURE1),
        "GL_FRONT_FACE": lambda: gl.glFrontFace(gl.GL_CW),
        "GL_FRONT.GL_DIFFUSE": change_material,
        "GL_TEXTURE1.GL_TEXTURE_ENV.GL_SRC0_RGB": change_sources,
        "GL_TEXTURE0.GL_TEXTURE_MATRIX": turn_texture,
        "GL_LIGHT1.GL_AMBIENT": lambda: gl.glLightfv(
            gl.GL_LIGHT1, gl.GL_AMBIENT, np.full(4, 0.5, np.float32)
        ),
        "GL_BLEND_EQUATION_RGB": lambda: gl.glBlendEquation(gl.GL_FUNC_SUBTRACT),
    }
    for name, do in mischief.items():
        depth = int(gl.glGetIntegerv(gl.GL_MODELVIEW_STACK_DEPTH))
        with pytest.raises(AssertionError, match=name):
            with stage.borrowed():
                with stage.frame(Settings(), POSE):
                    do()
        gl.glClientActiveTexture(gl.GL_TEXTURE0)
        gl.glMatrixMode(gl.GL_MODELVIEW)
        while int(gl.glGetIntegerv(gl.GL_MODELVIEW_STACK_DEPTH)) > depth:
            gl.glPopMatrix()
        gl.glMatrixMode(gl.GL_TEXTURE)
        gl.glLoadIdentity()
        gl.glMatrixMode(gl.GL_MODELVIEW)


@pytest.mark.parametrize(
    "block",
    [
        lambda: attrib(gl.GL_ENABLE_BIT | gl.GL_FOG_BIT),
        matrix,
        lambda: flat_projection(-1, 1, -1, 1, 0.1, 2),
        flat_projection,
        lambda: client_arrays(
            np.zeros((3, 3), np.float32),
            np.zeros((3, 3), np.float32),
            np.zeros((3, 4), np.uint8),
            [np.zeros((3, 2), np.float32)] * 3,
        ),
        front_faces,
    ],
    ids=["attrib", "matrix", "ortho", "identity", "arrays", "front faces"],
)
def test_scoped_state_comes_back_even_after_an_exception(stage: Stage, block) -> None:
    with stage.frame(Settings(), POSE):
        before = snapshot()
        with pytest.raises(RuntimeError):
            with block():
                gl.glLoadIdentity() if block is matrix else None
                raise RuntimeError
        assert not changes(before, snapshot())
        with block():
            pass
