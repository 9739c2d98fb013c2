"""One interleaved array and one glDrawElements draw the whole boat, in twentieths."""
# exercise: first_drawing
# the rest: start.py

import numpy as np

# A row each: red, green, blue, x, y, z, in twentieths of half the window.
BOAT = np.array(
    [
        *((0.55, 0.33, 0.2, -12, -6, 0), (0.55, 0.33, 0.2, 12, -6, 0)),
        *((0.55, 0.33, 0.2, 8, -12, 0), (0.55, 0.33, 0.2, -8, -12, 0)),
        *((0.95, 0.9, 0.8, 1, -5, 0), (0.85, 0.35, 0.2, 1, 15, 0), (0.3, 0.5, 0.8, 12, -5, 0)),
        *((0.95, 0.62, 0.35, 1, 15.6, 0), (0.95, 0.62, 0.35, 1, 18.4, 0)),
        (0.95, 0.62, 0.35, -5, 17, 0),
    ],
    np.float32,
)
TRIANGLES = [0, 1, 2, 0, 2, 3, 4, 5, 6, 7, 8, 9]


def draw_hull():
    """Draw the whole boat."""
    glPushMatrix()
    glMultMatrixf(np.diag((0.05, 0.05, 1, 1)))
    glPushClientAttrib(GL_CLIENT_VERTEX_ARRAY_BIT)
    glInterleavedArrays(GL_C3F_V3F, 0, BOAT)
    glDrawElementsui(GL_TRIANGLES, TRIANGLES)
    glPopClientAttrib()
    glPopMatrix()


def draw_sail():
    pass


def draw_pennant():
    pass
