"""What the mean of many pictures needs: points to take them from, clearing, and adding a quad.

Haeberli and Akeley (The Accumulation Buffer, SIGGRAPH 1990) draw soft shadows, motion blur and
depth of field as the mean of sharp pictures, each from another point of a lamp, a time or a lens.
"""

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib

GOLDEN = np.pi * (3.0 - np.sqrt(5.0))  # radians: the golden angle


def disc(count: int) -> np.ndarray:
    """Return points spread evenly over the unit disc, (count, 2): Vogel's spiral (1979)."""
    k = np.arange(count)
    radius = np.sqrt((k + 0.5) / count)
    return np.stack([radius * np.cos(GOLDEN * k), radius * np.sin(GOLDEN * k)], axis=1)


def shifts(count: int) -> np.ndarray:
    """Return offsets within a pixel, -0.5..0.5 (count, 2), none alike (Roberts 2018)."""
    k = np.arange(count)[:, None]
    return np.asarray((0.5 + k * (0.7548776662, 0.5698402910)) % 1.0 - 0.5)


def clear(size: tuple[int, int], color: tuple[float, ...]) -> None:
    """Clear the colour (to RGBA) and the depth of ``size`` pixels at the bottom left."""
    groups = gl.GL_SCISSOR_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT
    with attrib(groups):
        gl.glEnable(gl.GL_SCISSOR_TEST)
        gl.glScissor(0, 0, *size)
        gl.glClearColor(*color)
        gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)


def quad(texture: tuple[float, ...], place: tuple[float, ...], z: float) -> None:
    """Draw a rectangle (left, bottom, right, top) with one of the texture, at depth ``z``.

    It is filled in a wireframe, too: the texture is the picture, of wires perhaps.
    """
    with attrib(gl.GL_POLYGON_BIT):
        gl.glPolygonMode(gl.GL_FRONT_AND_BACK, gl.GL_FILL)
        gl.glBegin(gl.GL_QUADS)
        for i, j in ((0, 1), (2, 1), (2, 3), (0, 3)):
            gl.glTexCoord2f(texture[i], texture[j])
            gl.glVertex3f(place[i], place[j], z)
        gl.glEnd()
