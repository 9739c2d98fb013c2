"""Fog: haze that grows with distance (section 10).

Technique: GL_FOG in mode GL_EXP2, f = exp(-(density * distance)^2), enabled once for all elements.
Because of the square, the near scene stays clear and the fog then thickens fast. The distance may
be the radial distance from the eye or the eye-space depth: OpenGL allows both, and most drivers
take the depth. With GL_NV_fog_distance (2001) a program can choose.
What is wrong with it: by the depth, the same tree is less fogged at the side of the picture than in
its middle, and the fog on it changes as you turn (switch ``fog.radial``); what is drawn in several
blended layers is fogged several times (``castle.multitexture``, R11), and the sky box most in its
corners (``sky.unfogged``, R10).
State used: GL_FOG and its parameters.
"""

import numpy as np

from framelens.gl.extensions import current_context
from framelens.gl.seam import Lists, drawing, gl, lists_now
from landscape.elements.settings import Fog
from landscape.gl.features import possible

# Of GL_NV_fog_distance; the last is GL_EYE_PLANE_ABSOLUTE_NV, which OpenGL begins with in Mesa.
FOG_DISTANCE_MODE = 0x855A
EYE_RADIAL = 0x855B
EYE_PLANE = 0x855C


def visibility(distance: np.ndarray, density: float) -> np.ndarray:
    """Return the fraction of its colour that GL_EXP2 fog leaves an object at ``distance`` units."""
    return np.exp(-np.square(density * distance))


@drawing("fog")
def enable(fog: Fog) -> None:
    """Enable the fog of the settings."""
    modes = {"exp2": gl.GL_EXP2, "exp": gl.GL_EXP, "linear": gl.GL_LINEAR}
    gl.glEnable(gl.GL_FOG)
    gl.glFogi(gl.GL_FOG_MODE, modes[fog.mode])
    gl.glFogfv(gl.GL_FOG_COLOR, np.array([*fog.color, 1.0], np.float32))
    gl.glFogf(gl.GL_FOG_DENSITY, fog.density)
    _choose_distance(fog.radial)
    if fog.mode == "linear":
        gl.glFogf(gl.GL_FOG_START, fog.start)
        gl.glFogf(gl.GL_FOG_END, fog.end)


# Contexts in which a distance was chosen, with their display lists: a later context may have the
# number of a former one, but not its lists.
_chosen: dict[int, Lists] = {}


def _choose_distance(radial: bool) -> None:
    """Compute fog by the radial distance, or again by the depth, where OpenGL offers the choice."""
    if radial and not possible("fog.radial"):
        return
    if radial:
        _chosen[current_context()] = lists_now()
    elif _chosen.get(current_context()) is not lists_now():
        return
    # By floats: in a display list Mesa's glFogi loses a value that it does not expect.
    mode = np.array([EYE_RADIAL if radial else EYE_PLANE], np.float32)
    gl.glFogfv(FOG_DISTANCE_MODE, mode)
