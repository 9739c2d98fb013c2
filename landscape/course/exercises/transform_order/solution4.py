"""The order of transformations: sun, planet and moon

A planet goes round the sun at a distance of 4.2, and a moon goes round the planet at a distance of
1.3. All three are drawn in one place, because the transformations are missing.

Write them in draw_system: the planet goes round the y axis by the angle `year`, and the moon round
the planet by the angle `month`, both counter-clockwise as seen from above; at angle 0 the planet
is at the right of the sun (+x), and the moon at the right of the planet. The moon's angle counts
from the line on which the sun and the planet lie, so that it goes round with the planet.

OpenGL multiplies each transformation at the right: the one called last is applied to the vertices
first. Change nothing but draw_system.
"""
# exercise: transform_order

import math
import sys

import glfw
import numpy as np
from OpenGL.GL import *


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


def draw_orbit():
    """Draw the planet's orbit."""
    glColor3f(0.35, 0.4, 0.46)
    glBegin(GL_LINE_LOOP)
    for step in range(60):
        angle = math.radians(step * 360 / 60)
        glVertex3f(4.2 * math.cos(angle), 0, 4.2 * math.sin(angle))
    glEnd()


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


def on_key(window, key, scancode, action, mods):
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(640, 480, "Sun, planet and moon", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    glEnable(GL_DEPTH_TEST)

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 50)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glTranslatef(0, 0, -17)
        glRotatef(35, 1, 0, 0)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        draw_orbit()
        time = glfw.get_time()
        draw_system(200 + 90 * time, 50 + 300 * time)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
