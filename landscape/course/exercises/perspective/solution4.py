"""The matrix of glFrustum by numpy, multiplied transposed."""
# exercise: perspective
# the rest: start.py

import math

import numpy as np


def frustum(left, right, bottom, top, near, far):
    """Return the matrix of glFrustum, (4, 4)."""
    matrix = np.zeros((4, 4))
    matrix[0, 0] = 2 * near / (right - left)
    matrix[0, 2] = (right + left) / (right - left)
    matrix[1, 1] = 2 * near / (top - bottom)
    matrix[1, 2] = (top + bottom) / (top - bottom)
    matrix[2, 2:] = np.array((far + near, 2 * far * near)) / (near - far)
    matrix[3, 2] = -1
    return matrix


def set_projection(width, height):
    """Set the projection matrix for a window of width x height pixels."""
    top = NEAR * math.tan(math.radians(OPENING / 2))
    right = width * top / height
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glMultTransposeMatrixd(frustum(-right, right, -top, top, NEAR, FAR))
