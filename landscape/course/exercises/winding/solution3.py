"""The two faces turned, and all of them in vertex arrays."""
# exercise: winding
# the rest: start.py

import numpy as np

FACES = (
    (RED, TOP, 0, 1),
    (ORANGE, TOP, 1, 2),
    (CREAM, TOP, 2, 3),
    (GREEN, TOP, 3, 4),
    (BLUE, TOP, 4, 5),
    (VIOLET, TOP, 5, 0),
    (RED, BOTTOM, 1, 0),
    (ORANGE, BOTTOM, 2, 1),
    (CREAM, BOTTOM, 3, 2),
    (GREEN, BOTTOM, 4, 3),
    (BLUE, BOTTOM, 5, 4),
    (VIOLET, BOTTOM, 0, 5),
)


def make_arrays():
    """Return the corners of all faces, (n, 3), and their colors."""
    corners = [point(number) for _color, *face in FACES for number in face]
    colors = [
        [(0.62 if BOTTOM in face else 1) * channel for channel in color]
        for color, *face in FACES
        for _number in face
    ]
    return np.array(corners, "f"), np.array(colors, "f")


CORNERS, COLORS = make_arrays()


def draw_gem():
    glEnableClientState(GL_VERTEX_ARRAY)
    glEnableClientState(GL_COLOR_ARRAY)
    glVertexPointerf(CORNERS)
    glColorPointerf(COLORS)
    glDrawArrays(GL_TRIANGLES, 0, len(CORNERS))
    glDisableClientState(GL_COLOR_ARRAY)
    glDisableClientState(GL_VERTEX_ARRAY)
