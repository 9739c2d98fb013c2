"""The walker's aim: the edges of the block under the cross-hair, and the cross-hair itself.

Technique: the block's faces are drawn again with glPolygonMode as lines. These would lie exactly in
the faces, where rounding decides which of the two is nearer; glPolygonOffset moves them a little
towards the eye. The cross-hair is two lines under a glOrtho projection of the window's size.
State used: GL_BLEND, GL_POLYGON_OFFSET_LINE, the polygon mode, the line width; texture and fog off.
What is wrong without: without the offset the lines are broken, in another way in every frame.
"""

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib, flat_projection, line_width, matrix
from landscape.frame import Frame

# All chosen.
# The edges: RGBA, and width in pixels at a height of TALL. The light line within the dark one shows
# in a dark pit.
EDGES = ((0.05, 0.05, 0.06, 0.7), 3.0), ((1.0, 1.0, 0.95, 0.5), 1.0)
TALL = 720  # pixels
PLANT = 0.3  # blocks from the middle of the box around a plant
OFFSET = -2.0  # of glPolygonOffset: towards the eye
ARM, THICK = 0.014, 0.0028  # of the window's height: an arm of the cross-hair, and its width
LIGHT, DARK = (1.0, 1.0, 1.0, 0.85), (0.0, 0.0, 0.0, 0.45)  # RGBA: visible on snow and in shadow

# The corners of a cube's faces, x, y, z.
FACES = np.array(
    [
        [(0, 0, 0), (1, 0, 0), (1, 0, 1), (0, 0, 1)],
        [(0, 1, 0), (0, 1, 1), (1, 1, 1), (1, 1, 0)],
        [(0, 0, 0), (0, 1, 0), (1, 1, 0), (1, 0, 0)],
        [(0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)],
        [(0, 0, 0), (0, 0, 1), (0, 1, 1), (0, 1, 0)],
        [(1, 0, 0), (1, 1, 0), (1, 1, 1), (1, 0, 1)],
    ],
    np.float64,
)


def draw_highlight(
    frame: Frame, cell: tuple[int, int, int], block: float, plant: bool = False
) -> None:
    """Draw the edges of a block [x, z, y] with sides of ``block`` units; a plant's are closer."""
    x, z, y = cell
    groups = gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_CURRENT_BIT | gl.GL_LINE_BIT
    with attrib(groups | gl.GL_POLYGON_BIT | gl.GL_DEPTH_BUFFER_BIT), matrix():
        gl.glScalef(block, block, block)
        gl.glTranslatef(float(x), float(y), float(z))
        if plant:
            gl.glTranslatef(0.5 - PLANT, 0.0, 0.5 - PLANT)
            gl.glScalef(2 * PLANT, 0.9, 2 * PLANT)

        for off in (gl.GL_TEXTURE_2D, gl.GL_FOG, gl.GL_LIGHTING, gl.GL_CULL_FACE):
            gl.glDisable(off)
        gl.glEnable(gl.GL_BLEND)
        gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
        gl.glDepthMask(gl.GL_FALSE)
        gl.glPolygonMode(gl.GL_FRONT_AND_BACK, gl.GL_LINE)
        gl.glEnable(gl.GL_POLYGON_OFFSET_LINE)
        gl.glPolygonOffset(OFFSET, OFFSET)

        for colour, width in EDGES:
            line_width(width * frame.viewport[1] / TALL)
            gl.glColor4f(*colour)
            gl.glBegin(gl.GL_QUADS)
            for corner in FACES.reshape(-1, 3).tolist():
                gl.glVertex3f(*corner)
            gl.glEnd()


def draw_crosshair(frame: Frame) -> None:
    """Draw the cross-hair in the middle of the window."""
    width, height = frame.size
    right, up = frame.detail.shift
    scale = frame.detail.scale
    low = [-right, -up]
    high = [edge + side / scale for edge, side in zip(low, frame.viewport, strict=True)]
    groups = gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_CURRENT_BIT | gl.GL_POLYGON_BIT

    with attrib(groups), flat_projection(low[0], high[0], low[1], high[1], -1, 1):
        for off in (gl.GL_DEPTH_TEST, gl.GL_FOG, gl.GL_LIGHTING, gl.GL_TEXTURE_2D, gl.GL_CULL_FACE):
            gl.glDisable(off)
        gl.glEnable(gl.GL_BLEND)
        gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
        gl.glPolygonMode(gl.GL_FRONT_AND_BACK, gl.GL_FILL)
        arm, half = max(round(ARM * height), 4), max(round(THICK * height), 1) / 2
        for colour, more in ((DARK, 1), (LIGHT, 0)):
            gl.glColor4f(*colour)
            for wide, tall in ((arm + more, half + more), (half + more, arm + more)):
                x, y = width // 2 + half % 1, height // 2 + half % 1
                gl.glRectf(x - wide, y - tall, x + wide, y + tall)
