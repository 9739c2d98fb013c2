"""The edges of the quads that are drawn, in black: one sees what merging saves.

Technique: the same faces once more with glPolygonMode as lines, a little nearer to the eye by
glPolygonOffset. Their vertex colours do not matter, since GL_ZERO, GL_ZERO blends all to black.
State used: GL_BLEND, GL_POLYGON_OFFSET_LINE, the polygon mode; fog off.
Switches to see in it: ``voxel.merge``, ``voxel.occlusion`` (which keeps quads apart).
"""

from framelens.gl.seam import gl
from framelens.gl.state import attrib
from landscape.voxel.land import Choice, Land

OFFSET = -1.0  # of glPolygonOffset: towards the eye


def draw_edges(land: Land, choice: Choice) -> None:
    """Draw the edges of the faces of a choice, but for plants."""
    groups = gl.GL_ENABLE_BIT | gl.GL_POLYGON_BIT | gl.GL_COLOR_BUFFER_BIT
    with attrib(groups):
        gl.glDisable(gl.GL_FOG)
        gl.glEnable(gl.GL_BLEND)
        gl.glBlendFunc(gl.GL_ZERO, gl.GL_ZERO)
        gl.glPolygonMode(gl.GL_FRONT_AND_BACK, gl.GL_LINE)
        gl.glEnable(gl.GL_POLYGON_OFFSET_LINE)
        gl.glPolygonOffset(OFFSET, OFFSET)
        land.draw_shapes(choice)
