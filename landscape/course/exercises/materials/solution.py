"""Each property of the material by a call of its own; a second light from above."""
# exercise: materials
# the rest: start.py


def set_material(color, highlight, shininess, glow):
    """Set the material of what is drawn next."""
    glMaterialfv(GL_FRONT, GL_AMBIENT, [0.4 * channel for channel in color] + [1])
    glMaterialfv(GL_FRONT, GL_DIFFUSE, (*color, 1))
    glMaterialfv(GL_FRONT, GL_SPECULAR, (*highlight, 1))
    glMaterialf(GL_FRONT, GL_SHININESS, shininess)
    glMaterialfv(GL_FRONT, GL_EMISSION, (*glow, 1))


def set_sky():
    """Turn on the light of the sky."""
    glEnable(GL_LIGHT1)
    glLightfv(GL_LIGHT1, GL_POSITION, (0, 1, 0, 0))
    glLightfv(GL_LIGHT1, GL_DIFFUSE, (*SKY, 1))
