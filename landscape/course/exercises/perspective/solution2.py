"""gluPerspective."""
# exercise: perspective
# the rest: start.py

from OpenGL.GLU import *


def set_projection(width, height):
    """Set the projection matrix for a window of width x height pixels."""
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    gluPerspective(OPENING, width / height, NEAR, FAR)
