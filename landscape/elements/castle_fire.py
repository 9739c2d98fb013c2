"""The fire of the castle's torches: an animated sprite sheet (Castle, section 6.1).

Technique: one texture holds 4 x 4 pictures of a flame; the texture coordinates of a quad show one
of them, the next every two kt. Blended, without depth writes. Own frame: that of the castle.
What is wrong with it: the quad is parallel to the wall, so a flame vanishes when seen from the side
(switch ``castle.flame_faces``, R2).
State used: GL_BLEND and the depth mask, which the castle restores.
"""

import math

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.texture import Texture

TORCHES = (0.27, 0.75)  # section 6.1: 0.27, and 0.48 farther
FLAME_Z = -0.07  # section 6.1


def flame_frame(kt: float) -> tuple[int, int]:
    """Return column and row of the sprite sheet's frame: int(kt * 0.5) mod 16 (section 6.1)."""
    number = int(kt * 0.5)
    return number % 4, (number // 4) % 4


def flame_across(eye: tuple[float, float], x: float, faces: bool) -> tuple[float, float]:
    """Return the unit vector (x, z), in the castle's frame, of the width of a flame at ``x``.

    Along the wall; or perpendicular to the line to the ``eye`` (x, z), if the flame ``faces`` it.
    """
    away_x, away_z = x - eye[0], FLAME_Z - eye[1]
    far = math.hypot(away_x, away_z)
    if not faces or far < 1e-6:
        return 1.0, 0.0
    return away_z / far, -away_x / far


def draw_fire(sheet: Texture, kt: float, eye: tuple[float, float], faces: bool) -> None:
    """Blend a quad at each torch with the picture of ``kt``; ``eye`` is x, z in the own frame.

    With ``faces`` the quads turn about y to face the eye.
    """
    column, row = flame_frame(kt)
    s, t = 0.25 * column, 0.25 * row
    corners = []
    for x in TORCHES:
        across_x, across_z = flame_across(eye, x, faces)
        for ds, dt, along, y in (
            (0.0, 0.25, -0.03, 0.21),
            (0.0, 0.0, -0.03, 0.31),
            (0.25, 0.0, 0.03, 0.31),
            (0.25, 0.25, 0.03, 0.21),
        ):
            place = (x + along * across_x, y, FLAME_Z + along * across_z)
            corners.append((s + ds, t + dt, *place))

    gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
    gl.glDepthMask(gl.GL_FALSE)
    sheet.bind()
    gl.glPushClientAttrib(gl.GL_CLIENT_VERTEX_ARRAY_BIT)
    gl.glInterleavedArrays(gl.GL_T2F_V3F, 0, np.array(corners, np.float32))
    gl.glDrawArrays(gl.GL_QUADS, 0, len(corners))
    gl.glPopClientAttrib()
    gl.glBindTexture(gl.GL_TEXTURE_2D, 0)
