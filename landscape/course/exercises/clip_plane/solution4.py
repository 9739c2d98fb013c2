"""The plane in the eye's coordinates: multiplied by the inverse of the matrix."""
# exercise: clip_plane
# the rest: start.py

import numpy as np


def draw_tower():
    glPushMatrix()
    glTranslatef(0.4, 0, -1)
    glRotatef(turn, 0, 1, 0)
    # The plane in the eye's coordinates: that of the tower times the inverse of the matrix.
    matrix = np.array(glGetDoublev(GL_MODELVIEW_MATRIX)).T
    plane = np.array((0, 0, -1, 0.3)) @ np.linalg.inv(matrix)
    glPushMatrix()
    glLoadIdentity()
    glClipPlane(GL_CLIP_PLANE0, plane)
    glPopMatrix()
    glEnable(GL_CLIP_PLANE0)
    draw_wall()
    glDisable(GL_CLIP_PLANE0)
    draw_stair()
    glPopMatrix()
