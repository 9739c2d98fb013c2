"""The castle's gate wall: a door and a flickering light in layers over the bricks (section 6).

Technique: the door's texture has a transparent surround and is blended over the bricks. A light
texture is multiplied over both by glBlendFunc(GL_ZERO, GL_SRC_COLOR); its far texture coordinates
move with kt, so that the light flickers. Own frame: that of the castle.
What is wrong with it: three layers are fogged three times, so that in fog the gate wall is darker
than the others (switch ``castle.multitexture``, R11, best/castle/gate.py).
State used: GL_TEXTURE_2D, GL_LIGHTING, GL_BLEND, polygon offset, which the castle restores.
"""

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.texture import Texture


def light_shift(kt: float) -> tuple[float, float]:
    """Return how far the light's moving texture coordinates shift in s and t (section 6.1)."""
    return 0.01 * np.sin(kt / 10.8) ** 2, 0.01 * np.cos(kt / 7.2) ** 2


def draw_gate_in_layers(
    door: Texture, light: Texture, kt: float, brightening: bool = False
) -> None:
    """Blend door and light over the bricks: three layers, each fogged (section 11.2.4).

    With ``brightening`` the light multiplies by twice its colour, else by its colour.
    """
    gl.glEnable(gl.GL_TEXTURE_2D)
    gl.glEnable(gl.GL_BLEND)

    # From a distance the depth buffer cannot separate the layers from the wall.
    gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
    gl.glNormal3f(0.0, 0.0, -1.0)

    # The door covers the bricks where its picture is opaque.
    gl.glPolygonOffset(-1.0, -2.0)
    gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
    door.bind()
    gate_quad(-0.001, 0.0, 0.0)

    # The light multiplies both.
    gl.glDisable(gl.GL_LIGHTING)
    gl.glPolygonOffset(-2.0, -4.0)
    gl.glBlendFunc(gl.GL_DST_COLOR if brightening else gl.GL_ZERO, gl.GL_SRC_COLOR)
    light.bind()
    gate_quad(-0.002, *light_shift(kt))
    gl.glDisable(gl.GL_POLYGON_OFFSET_FILL)


def gate_quad(z: float, shift_s: float, shift_t: float) -> None:
    """Send a layer over the gate wall; s may shift at its far side, and t at its top."""
    corners = (
        (0.0, 1.0, 0.0, 0.0),
        (0.0, -shift_t, 0.0, 1.0),
        (1.0 - shift_s, -shift_t, 1.0, 1.0),
        (1.0 - shift_s, 1.0, 1.0, 0.0),
    )
    gl.glBegin(gl.GL_QUADS)
    for s, t, x, y in corners:
        gl.glTexCoord2f(s, t)
        gl.glVertex3f(x, y, z)
    gl.glEnd()
