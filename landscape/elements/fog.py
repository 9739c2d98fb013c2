"""Fog: haze that grows with distance (section 10).

Technique: GL_FOG in mode GL_EXP2, f = exp(-(density * distance)^2), enabled once for all elements.
Because of the square, the near scene stays clear and the fog then thickens fast. The distance may
be the radial distance from the eye or the eye-space depth: OpenGL allows both, and most take the
depth. GL_NV_fog_distance (2001) lets one choose.
What is wrong with it: by the depth, the same tree is less fogged at the side of the picture than in
its middle, and the fog on it changes as one turns (switch ``fog.radial``); what is drawn in several
blended layers is fogged several times (``castle.multitexture``, R11), and the sky box most in its
corners (``sky.unfogged``, R10).
State used: GL_FOG and its parameters.
"""

import numpy as np

from landscape.gl.calls import drawing, gl
from landscape.gl.extensions import Need, has, tell_off
from landscape.settings import Fog

CHOICE_OF_DISTANCE = Need(None, ("GL_NV_fog_distance",))
FOG_DISTANCE_MODE, EYE_RADIAL, EYE_PLANE = 0x855A, 0x855B, 0x855C


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
    if has(CHOICE_OF_DISTANCE):
        # As a float: in a display list Mesa's glFogi loses a value that it does not expect.
        gl.glFogf(FOG_DISTANCE_MODE, float(EYE_RADIAL if fog.radial else EYE_PLANE))
    elif fog.radial:
        tell_off("fog.radial", CHOICE_OF_DISTANCE)
    if fog.mode == "linear":
        gl.glFogf(gl.GL_FOG_START, fog.start)
        gl.glFogf(gl.GL_FOG_END, fog.end)
