"""glFrustum, with the window's edge from the opening angle."""
# exercise: perspective
# the rest: start.py

import math


def set_projection(width, height):
    """Set the projection matrix for a window of width x height pixels."""
    top = NEAR * math.tan(math.radians(OPENING / 2))
    right = top * width / height
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glFrustum(-right, right, -top, top, NEAR, FAR)
