"""One function for both orbits, and balls from vertex arrays."""
# exercise: transform_order
# the rest: start.py

import numpy as np


def make_ball():
    """Return the points of a ball of radius 1, (n, 3), four a face, and how light each is."""
    points = []
    for row in range(10):
        for column in range(20):
            for i, j in ((0, 0), (0, 1), (1, 1), (1, 0)):
                polar = math.pi * (row + i) / 10
                around = math.pi * (column + j) / 10
                x = math.sin(polar) * math.cos(around)
                z = -math.sin(polar) * math.sin(around)
                points.append((x, math.cos(polar), z))
    points = np.array(points, "f")
    return points, 0.7 + 0.3 * points[:, 1:2]


POINTS, SHADES = make_ball()


def draw_ball(radius, color):
    """Draw a ball around the origin, lighter above than below."""
    glEnableClientState(GL_VERTEX_ARRAY)
    glEnableClientState(GL_COLOR_ARRAY)
    glVertexPointerf(radius * POINTS)
    glColorPointerf(SHADES * np.array(color, "f"))
    glDrawArrays(GL_QUADS, 0, len(POINTS))
    glDisableClientState(GL_COLOR_ARRAY)
    glDisableClientState(GL_VERTEX_ARRAY)


def draw_system(year, month):
    """Draw sun, planet and moon; angles in degrees."""
    draw_ball(1.3, (0.95, 0.62, 0.35))
    glPushMatrix()
    orbit(4.2, year)
    draw_ball(0.6, (0.3, 0.5, 0.8))
    orbit(1.3, month)
    draw_ball(0.25, (0.95, 0.9, 0.8))
    glPopMatrix()


def orbit(distance, angle):
    """Go to a body's place on its orbit around the origin."""
    glRotatef(angle, 0, 1, 0)
    glTranslatef(distance, 0, 0)
