"""The matrices made from the identity, by its elements."""
# exercise: homogeneous
# the rest: start.py

import math


def point(x, y, z):
    """Return the homogeneous coordinates of a point."""
    return np.append((x, y, z), 1)


def translation(x, y, z):
    """Return the matrix of a translation."""
    matrix = np.identity(4)
    matrix[:3, 3] = x, y, z
    return matrix


def rotation(angle):
    """Return the matrix of a rotation around the y axis by an angle in degrees."""
    turn = math.radians(angle)
    matrix = np.identity(4)
    matrix[0, 0] = matrix[2, 2] = math.cos(turn)
    matrix[0, 2] = math.sin(turn)
    matrix[2, 0] = -matrix[0, 2]
    return matrix


def cartesian(place):
    """Return the coordinates x, y, z of a point that is given by four numbers."""
    return place[:3] / place[3]
