"""The lamp's view in the modelview matrix; the camera's is kept and loaded again."""
# exercise: shadow_map
# the rest: start.py


def make_shadow_map():
    width, height = glGetIntegerv(GL_VIEWPORT)[2:]
    camera = glGetFloatv(GL_MODELVIEW_MATRIX)
    lens = glGetFloatv(GL_PROJECTION_MATRIX)

    # What the lamp sees: all in the modelview matrix, as nothing is lit.
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    look_from_lamp()
    glViewport(0, 0, SIZE, SIZE)
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE)
    glEnable(GL_POLYGON_OFFSET_FILL)
    glPolygonOffset(3, 4)
    draw_scene()
    glDisable(GL_POLYGON_OFFSET_FILL)
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE)
    glCopyTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT, 0, 0, SIZE, SIZE, 0)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_R_TO_TEXTURE)
    glClear(GL_DEPTH_BUFFER_BIT)
    glViewport(0, 0, width, height)

    # B P V, and its rows.
    glLoadIdentity()
    glTranslatef(0.5, 0.5, 0.5)
    glScalef(0.5, 0.5, 0.5)
    look_from_lamp()
    columns = glGetFloatv(GL_MODELVIEW_MATRIX)

    # The camera as it was: OpenGL multiplies the planes by the inverse of its matrix.
    glMatrixMode(GL_PROJECTION)
    glLoadMatrixf(lens)
    glMatrixMode(GL_MODELVIEW)
    glLoadMatrixf(camera)
    for row, axis in enumerate(AXES):
        glTexGenfv(axis, GL_EYE_PLANE, [column[row] for column in columns])
