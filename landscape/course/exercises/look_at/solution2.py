"""gluLookAt."""
# exercise: look_at
# the rest: start.py

from OpenGL.GLU import *


def look(eye, target, up):
    """Move the world into the frame of a camera; three arrays x, y, z."""
    gluLookAt(*eye, *target, *up)
