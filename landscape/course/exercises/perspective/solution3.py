"""The matrix itself, written column by column and loaded."""
# exercise: perspective
# the rest: start.py

import math


def set_projection(width, height):
    """Set the projection matrix for a window of width x height pixels."""
    focal = 1 / math.tan(math.radians(OPENING) / 2)
    depth = FAR - NEAR
    glMatrixMode(GL_PROJECTION)
    # Its columns, one after the other.
    glLoadMatrixf(
        [
            *(focal * height / width, 0, 0, 0),
            *(0, focal, 0, 0),
            *(0, 0, -(FAR + NEAR) / depth, -1),
            *(0, 0, -2 * FAR * NEAR / depth, 0),
        ]
    )
