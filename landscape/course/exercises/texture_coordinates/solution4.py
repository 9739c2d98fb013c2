"""Coordinates computed from the corners, in vertex arrays."""
# exercise: texture_coordinates
# the rest: start.py

import numpy as np

# The corners of the wall: lower left, lower right, upper right, upper left.
CORNERS = np.array(((-3, -1, 0), (3, -1, 0), (3, 1, 0), (-3, 1, 0)), "f")
# A picture is two units wide and high; its first row is at the top.
COORDINATES = np.stack(((CORNERS[:, 0] + 3) / 2, (1 - CORNERS[:, 1]) / 2), axis=1)


def make_texture():
    texture = glGenTextures(1)
    glBindTexture(GL_TEXTURE_2D, texture)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP)
    data = bytes(channel for row in IMAGE for letter in row for channel in COLORS[letter])
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 16, 16, 0, GL_RGB, GL_UNSIGNED_BYTE, data)


def draw_wall():
    glEnable(GL_TEXTURE_2D)
    glColor3f(1, 1, 1)
    glEnableClientState(GL_VERTEX_ARRAY)
    glEnableClientState(GL_TEXTURE_COORD_ARRAY)
    glVertexPointerf(CORNERS)
    glTexCoordPointerf(COORDINATES)
    glDrawArrays(GL_QUADS, 0, 4)
    glDisableClientState(GL_TEXTURE_COORD_ARRAY)
    glDisableClientState(GL_VERTEX_ARRAY)
    glDisable(GL_TEXTURE_2D)
    glColor3f(0.95, 0.62, 0.35)
    for y in (-1.15, 1):
        glRectf(-3.15, y, 3.15, y + 0.15)
