"""The properties from a table, for both sides; the light's vectors as arrays."""
# exercise: materials
# the rest: start.py

import numpy as np


def set_material(color, highlight, shininess, glow):
    """Set the material of what is drawn next."""
    values = {
        GL_AMBIENT: (*np.multiply(color, 0.4), 1),
        GL_DIFFUSE: (*color, 1),
        GL_SPECULAR: (*highlight, 1),
        GL_EMISSION: (*glow, 1),
    }
    for name, value in values.items():
        glMaterialfv(GL_FRONT_AND_BACK, name, value)
    glMateriali(GL_FRONT_AND_BACK, GL_SHININESS, shininess)


def set_sky():
    """Turn on the light of the sky."""
    glLightfv(GL_LIGHT0 + 1, GL_DIFFUSE, np.array((*SKY, 1), np.float32))
    glLightfv(GL_LIGHT0 + 1, GL_POSITION, np.array((0, 2.5, 0, 0), np.float32))
    glEnable(GL_LIGHT0 + 1)
