"""The planes by the matrix stack itself; depths copied into a texture made before."""
# exercise: shadow_map
# the rest: start.py


def make_shadow_map():
    glPushAttrib(GL_VIEWPORT_BIT | GL_POLYGON_BIT | GL_ENABLE_BIT | GL_TRANSFORM_BIT)
    glEnable(GL_POLYGON_OFFSET_FILL)
    glPolygonOffset(3, 8)
    glViewport(0, 0, SIZE, SIZE)
    glMatrixMode(GL_PROJECTION)
    glPushMatrix()
    glLoadIdentity()
    glMatrixMode(GL_MODELVIEW)
    glPushMatrix()
    glLoadIdentity()
    look_from_lamp()
    draw_scene()
    glTexImage2D(
        GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, SIZE, SIZE, 0, GL_DEPTH_COMPONENT, GL_FLOAT, None
    )
    glCopyTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 0, 0, SIZE, SIZE)
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)

    # B P V, by the matrix stack itself.
    glLoadIdentity()
    glTranslatef(0.5, 0.5, 0.5)
    glScalef(0.5, 0.5, 0.5)
    look_from_lamp()
    rows = glGetDoublev(GL_MODELVIEW_MATRIX).T
    glPopMatrix()
    glMatrixMode(GL_PROJECTION)
    glPopMatrix()
    glPopAttrib()
    for number in range(4):
        glTexGendv(AXES[number], GL_EYE_PLANE, rows[number])
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_R_TO_TEXTURE)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL)
