"""The matrix by an outer product; the stencil buffer counts up."""
# exercise: planar_shadow
# the rest: start.py

import numpy as np


def draw_shadow():
    glPushMatrix()
    glEnable(GL_BLEND)
    glEnable(GL_POLYGON_OFFSET_FILL)  # the shadow is a little nearer than the floor
    glColor4f(0, 0, 0, 0.5)
    plane = np.array(FLOOR, float)
    light = np.array(lamp, float)
    glMultTransposeMatrixd(plane @ light * np.identity(4) - np.outer(light, plane))
    glEnable(GL_STENCIL_TEST)
    glStencilFunc(GL_EQUAL, 1, 1)
    glStencilOp(GL_KEEP, GL_KEEP, GL_INCR)  # 2 is no longer 1
    draw_table(False)
    glDisable(GL_STENCIL_TEST)
    glDisable(GL_POLYGON_OFFSET_FILL)
    glDisable(GL_BLEND)
    glPopMatrix()
