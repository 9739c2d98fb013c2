"""The reflection: the scene drawn a second time, mirrored at the water plane (section 3).

Technique: a mirror matrix diag(1, -1, 1, 1) on the modelview, translated to the water's height. It
reverses the winding of every triangle, so the front face is swapped; and the lights are placed
again under it, or the mirrored scene would be lit from below. The clip plane, given in the mirrored
frame, keeps what is above the water. Drawn before the water, which is blended over it.
What is wrong with it: where there is no water, the mirrored scene can show past the land's edge.
With ``reflection.stencil`` the water first marks its pixels in the stencil buffer, and the mirrored
scene is drawn only there. It is also a perfect mirror, whatever the waves do:
``reflection.rippled`` draws it into a texture instead (best/sea/mirror_image.py).
State used: modelview, GL_CLIP_PLANE0, front face, light positions, stencil test.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager

import numpy as np

from framelens.gl.seam import drawing, drawn_now, gl
from framelens.gl.state import attrib, matrix
from landscape.elements import sun
from landscape.elements.ground import clipped
from landscape.elements.settings import Settings

MIRROR = np.diag([1.0, -1.0, 1.0, 1.0]).astype(np.float32)  # section 3.1


@contextmanager
def mirrored(settings: Settings) -> Iterator[None]:
    """Draw the block's elements as the water mirrors them."""
    level = settings.water.level
    outside = drawn_now()  # in a recording, the block's calls belong to who draws them
    with drawing("reflection"), matrix(), attrib(gl.GL_POLYGON_BIT | gl.GL_LIGHTING_BIT):
        gl.glTranslatef(0.0, level, 0.0)
        gl.glMultMatrixf(MIRROR)
        gl.glTranslatef(0.0, -level, 0.0)
        gl.glFrontFace(gl.GL_CW)
        sun.place(settings.sun)
        with clipped(level), drawing(*outside):
            yield


@contextmanager
def inside_water(mark: Callable[[], None] | None) -> Iterator[None]:
    """Let the block draw only where ``mark`` draws the water's surface; anywhere if it is None."""
    if mark is None:
        yield
        return
    outside = drawn_now()
    groups = gl.GL_STENCIL_BUFFER_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT

    with drawing("reflection"), attrib(groups):
        gl.glEnable(gl.GL_STENCIL_TEST)
        gl.glStencilFunc(gl.GL_ALWAYS, 1, 1)
        gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_REPLACE)
        gl.glColorMask(gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE)
        gl.glDepthMask(gl.GL_FALSE)
        with drawing("water"):
            mark()
        gl.glColorMask(gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE)
        gl.glDepthMask(gl.GL_TRUE)
        gl.glStencilFunc(gl.GL_EQUAL, 1, 1)
        gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_KEEP)
        with drawing(*outside):
            yield
