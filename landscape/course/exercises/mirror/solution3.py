"""The sun's image placed by hand, before the mirror is moved to its level and back."""
# exercise: mirror
# the rest: start.py


def draw_image():
    """Draw the things once more, as the water mirrors them."""
    x, y, z, w = SUN
    glLightfv(GL_LIGHT0, GL_POSITION, (x, -y, z, w))  # the sun's own image
    glClipPlane(GL_CLIP_PLANE0, (0, -1, 0, LEVEL))
    glEnable(GL_CLIP_PLANE0)
    glFrontFace(GL_CW)
    glPushMatrix()
    glTranslatef(0, LEVEL, 0)
    glScalef(1, -1, 1)
    glTranslatef(0, -LEVEL, 0)
    draw_things()
    glPopMatrix()
    glFrontFace(GL_CCW)
    glDisable(GL_CLIP_PLANE0)
    set_sun()
