"""The lamp's matrix by numpy, in functions of their own."""
# exercise: shadow_map
# the rest: start.py

import numpy as np

# From -1 ... 1 to 0 ... 1.
BIAS = np.array(((0.5, 0, 0, 0.5), (0, 0.5, 0, 0.5), (0, 0, 0.5, 0.5), (0, 0, 0, 1)))


def lamp_matrix():
    """Return the lamp's projection and viewing matrices, P V, (4, 4)."""
    glPushMatrix()
    glLoadIdentity()
    look_from_lamp()
    matrix = np.array(glGetDoublev(GL_MODELVIEW_MATRIX)).T
    glPopMatrix()
    return matrix


def draw_depths(matrix):
    """Draw what a matrix shows into the lower left of the window: depths, and no colors."""
    glPushAttrib(GL_ALL_ATTRIB_BITS)
    glViewport(0, 0, SIZE, SIZE)
    glColorMask(False, False, False, False)
    glEnable(GL_POLYGON_OFFSET_FILL)
    glPolygonOffset(3, 4)
    glMatrixMode(GL_PROJECTION)
    glPushMatrix()
    glLoadMatrixd(matrix.T)
    glMatrixMode(GL_MODELVIEW)
    glPushMatrix()
    glLoadIdentity()
    draw_scene()
    glPopMatrix()
    glMatrixMode(GL_PROJECTION)
    glPopMatrix()
    glPopAttrib()


def make_shadow_map():
    matrix = lamp_matrix()
    draw_depths(matrix)
    glCopyTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT, 0, 0, SIZE, SIZE, 0)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_R_TO_TEXTURE)
    glClear(GL_DEPTH_BUFFER_BIT)
    for axis, plane in zip(AXES, BIAS @ matrix):
        glTexGenfv(axis, GL_EYE_PLANE, plane)
