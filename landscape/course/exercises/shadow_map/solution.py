"""The lamp's view in the projection matrix, whose rows give the planes."""
# exercise: shadow_map
# the rest: start.py


def make_shadow_map():
    viewport = glGetIntegerv(GL_VIEWPORT)
    glPushMatrix()
    glLoadIdentity()
    glMatrixMode(GL_PROJECTION)
    glPushMatrix()
    glLoadIdentity()
    look_from_lamp()
    x, y, z, w = glGetFloatv(GL_PROJECTION_MATRIX).T  # its rows
    glViewport(0, 0, SIZE, SIZE)
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE)
    glPolygonOffset(3, 4)
    glEnable(GL_POLYGON_OFFSET_FILL)
    draw_scene()
    glDisable(GL_POLYGON_OFFSET_FILL)
    glCopyTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT, 0, 0, SIZE, SIZE, 0)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_R_TO_TEXTURE)
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE)
    glClear(GL_DEPTH_BUFFER_BIT)
    glViewport(*viewport)
    glPopMatrix()
    glMatrixMode(GL_MODELVIEW)
    glPopMatrix()
    for axis, plane in zip(AXES, ((x + w) / 2, (y + w) / 2, (z + w) / 2, w)):
        glTexGenfv(axis, GL_EYE_PLANE, plane)
