"""The mirroring as one matrix; the plane set outside of it; the state kept on the stack."""
# exercise: mirror
# the rest: start.py


def draw_image():
    """Draw the things once more, as the water mirrors them."""
    glPushAttrib(GL_LIGHTING_BIT | GL_POLYGON_BIT | GL_TRANSFORM_BIT | GL_ENABLE_BIT)
    # Under the water, seen from outside the mirror.
    glClipPlane(GL_CLIP_PLANE1, (0, -1, 0, LEVEL))
    glEnable(GL_CLIP_PLANE1)
    glFrontFace(GL_CW)
    glPushMatrix()
    glMultMatrixf((1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 0, 0, 2 * LEVEL, 0, 1))
    glLightfv(GL_LIGHT0, GL_POSITION, SUN)
    draw_things()
    glPopMatrix()
    glPopAttrib()
