"""The matrices by numpy; the moon's contains its planet's."""
# exercise: transform_order
# the rest: start.py

import numpy as np


def rotated(angle):
    """Return the matrix that turns about the y axis by an angle in degrees."""
    cos = np.cos(np.radians(angle))
    sin = np.sin(np.radians(angle))
    return np.array(((cos, 0, sin, 0), (0, 1, 0, 0), (-sin, 0, cos, 0), (0, 0, 0, 1)))


def moved(distance):
    """Return the matrix that moves along the x axis."""
    matrix = np.identity(4)
    matrix[0, 3] = distance
    return matrix


def draw_system(year, month):
    """Draw sun, planet and moon; angles in degrees."""
    planet = rotated(year) @ moved(4.2)
    moon = planet @ rotated(month) @ moved(1.3)
    bodies = (
        (np.identity(4), 1.3, (0.95, 0.62, 0.35)),
        (planet, 0.6, (0.3, 0.5, 0.8)),
        (moon, 0.25, (0.95, 0.9, 0.8)),
    )
    for matrix, radius, color in bodies:
        glPushMatrix()
        glMultMatrixd(matrix.T)
        draw_ball(radius, color)
        glPopMatrix()
