"""The image by glScale with -1: front faces turn over, and the sun and a plane go along."""
# exercise: mirror
# the rest: start.py


def draw_image():
    """Draw the things once more, as the water mirrors them."""
    glPushMatrix()
    glTranslatef(0, 2 * LEVEL, 0)
    glScalef(1, -1, 1)
    set_sun()
    glFrontFace(GL_CW)
    glClipPlane(GL_CLIP_PLANE0, (0, 1, 0, -LEVEL))
    glEnable(GL_CLIP_PLANE0)
    draw_things()
    glDisable(GL_CLIP_PLANE0)
    glFrontFace(GL_CCW)
    glPopMatrix()
    set_sun()
