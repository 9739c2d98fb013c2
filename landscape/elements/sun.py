"""The sun: one directional light.

Not a class in the 2006 report, whose water and animals are lit nevertheless. A light's position is
transformed by the modelview matrix that is current when it is set, so it is set again under the
mirror matrix; otherwise the reflection would be lit from below (see reflection.py).
With ``sun.fill`` a second, weak light of the sky's colour comes from the opposite side.
What has noon's light painted into its texture is not lit by OpenGL but multiplied by a colour,
``sun.tint``; with ``sun.relit`` only on its sunny side, and by ``sun.shade`` elsewhere.
State used: GL_LIGHT0, GL_LIGHT1; an element that is lit calls :func:`lit`, which enables
GL_LIGHTING and GL_COLOR_MATERIAL. The switches ``shading.lighting`` and ``shading.smooth`` show a
frame without lighting, or with flat shading (glShadeModel).
"""

import math

import numpy as np

from framelens.gl.seam import drawing, gl
from landscape.elements.settings import Shading, Sun

SPECULAR = (1.0, 0.95, 0.85)  # chosen: RGB of the sun's highlights
# Chosen: how sunny a surface is that the sun grazes, and how much sunnier one that faces it. Leaves
# and grass let light through, so the change is gradual.
GRAZED, FACED = 0.62, 1.1


def direction(sun: Sun) -> np.ndarray:
    """Return the unit vector (3,) towards the sun; x east, y up, z south."""
    azimuth, elevation = math.radians(sun.azimuth), math.radians(sun.elevation)
    level = math.cos(elevation)
    return np.array(
        [level * math.sin(azimuth), math.sin(elevation), -level * math.cos(azimuth)], np.float32
    )


def painted(sun: Sun, facing: np.ndarray | float) -> np.ndarray:
    """Return the colours (..., 3) that multiply what has its light painted in.

    ``facing`` (...) is the cosine of the angle between a surface's normal and the sun.
    """
    tint, shade = np.array(sun.tint), np.array(sun.shade)
    sunny = np.clip(GRAZED + FACED * np.asarray(facing)[..., None], 0.0, 1.0)
    return shade + (tint - shade) * sunny if sun.relit else tint + 0.0 * sunny


def shine(sun: Sun) -> None:
    """Give the lights their colours and place them."""
    gl.glLightfv(gl.GL_LIGHT0, gl.GL_DIFFUSE, np.array([*sun.diffuse, 1.0], np.float32))
    gl.glLightfv(gl.GL_LIGHT0, gl.GL_AMBIENT, np.array([*sun.ambient, 1.0], np.float32))
    gl.glLightfv(gl.GL_LIGHT0, gl.GL_SPECULAR, np.array([*SPECULAR, 1.0], np.float32))
    gl.glLightModelfv(gl.GL_LIGHT_MODEL_AMBIENT, np.zeros(4, np.float32))
    gl.glEnable(gl.GL_LIGHT0)

    if sun.fill > 0.0:
        colour = np.array([*(sun.fill * np.array(sun.ambient)), 1.0], np.float32)
        gl.glLightfv(gl.GL_LIGHT1, gl.GL_DIFFUSE, colour)
        gl.glEnable(gl.GL_LIGHT1)
    else:
        gl.glDisable(gl.GL_LIGHT1)

    gl.glColorMaterial(gl.GL_FRONT_AND_BACK, gl.GL_AMBIENT_AND_DIFFUSE)
    place(sun)


def lit(shading: Shading) -> None:
    """Light what the rest of the block draws; its material is the current colour.

    With ``shading.lighting`` off it has just this colour; with ``shading.smooth`` off each triangle
    has the light of its last vertex.

    Only inside attrib(GL_ENABLE_BIT | GL_CURRENT_BIT | GL_LIGHTING_BIT). Where nothing is lit,
    GL_COLOR_MATERIAL is off, so that the colour of an unlit element never becomes the material of
    a lit one: glPopAttrib does not bring the material back everywhere, and setting a colour again
    that is current already need not set the material.
    """
    if shading.lighting:
        gl.glEnable(gl.GL_LIGHTING)
        gl.glEnable(gl.GL_COLOR_MATERIAL)
    if not shading.smooth:
        gl.glShadeModel(gl.GL_FLAT)


@drawing("frame")
def place(sun: Sun) -> None:
    """Place the lights under the current modelview matrix."""
    towards = np.append(direction(sun), 0.0).astype(np.float32)
    gl.glLightfv(gl.GL_LIGHT0, gl.GL_POSITION, towards)
    if sun.fill > 0.0:
        # Opposite the sun, so that the shaded sides do not all have the same tone.
        across = np.array([-towards[0], 0.5, -towards[2], 0.0], np.float32)
        gl.glLightfv(gl.GL_LIGHT1, gl.GL_POSITION, across)
