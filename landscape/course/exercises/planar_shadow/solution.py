"""The projection's matrix as one expression; the stencil buffer lets each pixel darken once."""
# exercise: planar_shadow
# the rest: start.py


def draw_shadow():
    glPushMatrix()
    glEnable(GL_BLEND)
    glEnable(GL_POLYGON_OFFSET_FILL)  # the shadow is a little nearer than the floor
    glColor4f(0, 0, 0, 0.5)
    dot = sum(a * b for a, b in zip(FLOOR, lamp))
    glMultMatrixf([[(i == j) * dot - lamp[i] * FLOOR[j] for i in range(4)] for j in range(4)])
    glEnable(GL_STENCIL_TEST)
    glStencilFunc(GL_EQUAL, 1, 1)
    glStencilOp(GL_KEEP, GL_KEEP, GL_ZERO)
    draw_table(False)
    glDisable(GL_STENCIL_TEST)
    glDisable(GL_POLYGON_OFFSET_FILL)
    glDisable(GL_BLEND)
    glPopMatrix()
