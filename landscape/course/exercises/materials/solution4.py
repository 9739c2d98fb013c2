"""glColorMaterial for the diffuse color; the light's direction in the eye's coordinates."""
# exercise: materials
# the rest: start.py


def set_material(color, highlight, shininess, glow):
    """Set the material of what is drawn next."""
    glColorMaterial(GL_FRONT, GL_DIFFUSE)
    glEnable(GL_COLOR_MATERIAL)
    glColor3fv(color)
    glMaterialfv(GL_FRONT, GL_AMBIENT, [*(channel * 0.4 for channel in color), 1.0])
    glMaterialfv(GL_FRONT, GL_SPECULAR, [*highlight, 1.0])
    glMaterialfv(GL_FRONT, GL_EMISSION, [*glow, 1.0])
    glMaterialf(GL_FRONT, GL_SHININESS, shininess)


def set_sky():
    """Turn on the light of the sky."""
    light = GL_LIGHT1
    up = glGetFloatv(GL_MODELVIEW_MATRIX)[1]  # the second column: where y points to
    glPushMatrix()
    glLoadIdentity()
    glLightfv(light, GL_POSITION, up)
    glPopMatrix()
    glLightfv(light, GL_DIFFUSE, [*SKY, 1.0])
    glEnable(light)
