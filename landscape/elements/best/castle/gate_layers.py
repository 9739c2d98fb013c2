"""The ornate castle's gate in layers, where there are too few texture units for one (gate.py).

Door and light are blended over the bricks as in 2006 (castle_gate.py), but the light may brighten:
glBlendFunc(GL_DST_COLOR, GL_SRC_COLOR) multiplies by twice its colour.
What is wrong with it: three layers are fogged three times.
State used: GL_TEXTURE_2D, GL_BLEND, polygon offset, depth mask.
"""

from framelens.gl.seam import gl
from framelens.gl.state import attrib
from framelens.gl.texture import Texture
from landscape.elements.castle_gate import draw_gate_in_layers


def draw_layers(door: Texture, halo: Texture, kt: float) -> None:
    """Blend the door over the gate wall's bricks, and multiply both by twice the halo."""
    blending = gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_POLYGON_BIT
    with attrib(blending | gl.GL_DEPTH_BUFFER_BIT):
        # The layers write no depth: they would hide the opening of an open door.
        gl.glDepthMask(gl.GL_FALSE)
        draw_gate_in_layers(door, halo, kt, brightening=True)
