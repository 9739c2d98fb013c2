"""Vertex arrays of places and colors; each part draws its range of them."""
# exercise: first_drawing
# the rest: start.py

import numpy as np

PLACES = [
    *((-0.6, -0.3), (0.6, -0.3), (-0.4, -0.6), (0.4, -0.6)),
    *((0.05, -0.25), (0.05, 0.75), (0.6, -0.25)),
    *((0.05, 0.78), (0.05, 0.92), (-0.25, 0.85)),
]
COLORS = np.array(
    [
        *([(0.55, 0.33, 0.2)] * 4),
        *((0.95, 0.9, 0.8), (0.85, 0.35, 0.2), (0.3, 0.5, 0.8)),
        *([(0.95, 0.62, 0.35)] * 3),
    ]
)


def draw_hull():
    glEnableClientState(GL_VERTEX_ARRAY)
    glEnableClientState(GL_COLOR_ARRAY)
    glVertexPointerf(PLACES)
    glColorPointerf(COLORS)
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4)


def draw_sail():
    glDrawArrays(GL_TRIANGLES, 4, 3)


def draw_pennant():
    glDrawArrays(GL_TRIANGLES, 7, 3)
