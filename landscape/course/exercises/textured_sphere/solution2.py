"""The whole sphere as arrays, with indices of its quads."""
# exercise: textured_sphere
# the rest: start.py
# without: import math

import numpy as np


def draw_planet():
    t, s = np.mgrid[0 : ROWS + 1, 0 : COLUMNS + 1] / np.reshape((ROWS, COLUMNS), (2, 1, 1))
    longitude = 2 * np.pi * s
    polar = np.pi * t
    ring = np.sin(polar)
    points = np.stack((ring * np.cos(longitude), np.cos(polar), -ring * np.sin(longitude)), -1)
    first = np.arange(ROWS * (COLUMNS + 1)).reshape(ROWS, COLUMNS + 1)[:, :-1]
    quads = np.stack((first, first + COLUMNS + 1, first + COLUMNS + 2, first + 1), -1)
    arrays = (GL_VERTEX_ARRAY, GL_NORMAL_ARRAY, GL_TEXTURE_COORD_ARRAY)
    for array in arrays:
        glEnableClientState(array)
    glVertexPointerf(points.reshape(-1, 3))
    glNormalPointerf(points.reshape(-1, 3))
    glTexCoordPointerf(np.stack((s, t), -1).reshape(-1, 2))
    glDrawElementsui(GL_QUADS, quads.ravel())
    for array in arrays:
        glDisableClientState(array)
