"""The matrix written out, row by row; the stencil buffer counts down from 1."""
# exercise: planar_shadow
# the rest: start.py


def draw_shadow():
    glPushMatrix()
    glEnable(GL_BLEND)
    glEnable(GL_POLYGON_OFFSET_FILL)  # the shadow is a little nearer than the floor
    glColor4f(0, 0, 0, 0.5)
    glPushAttrib(GL_STENCIL_BUFFER_BIT)
    glEnable(GL_STENCIL_TEST)
    glStencilFunc(GL_LEQUAL, 1, 255)  # 1 <= what is there
    glStencilOp(GL_KEEP, GL_KEEP, GL_DECR)
    a, b, c, d = FLOOR
    x, y, z, w = lamp
    dot = a * x + b * y + c * z + d * w
    rows = (
        (dot - a * x, -b * x, -c * x, -d * x),
        (-a * y, dot - b * y, -c * y, -d * y),
        (-a * z, -b * z, dot - c * z, -d * z),
        (-a * w, -b * w, -c * w, dot - d * w),
    )
    glMultTransposeMatrixf(rows)
    draw_table(False)
    glPopAttrib()
    glDisable(GL_POLYGON_OFFSET_FILL)
    glDisable(GL_BLEND)
    glPopMatrix()
