"""Normals: a ring that is lit as it is curved

A lamp shines on a ring (a torus). OpenGL computes the light of each vertex from its normal: the
vector of length 1 that points straight out of the surface. Here every normal is the same, so the
ring looks flat and is equally bright everywhere.

The point at the angles u and v is computed in `point`: u goes round the ring, v round its tube. The
middle of the tube is at u, and the normal points from there to the surface. Compute it in `normal`,
with length 1. Change nothing else.

Keys: Space draws the normals as lines, which helps to see what is wrong.
"""
# exercise: normals

import math
import sys

import glfw
import numpy as np
from OpenGL.GL import *

RING = 1.5  # radii: of the ring's middle line, and of the tube around it
TUBE = 0.6
STEPS = 24
lines = False


def point(u, v):
    """Return the point of the ring at two angles in radians."""
    distance = RING + TUBE * math.cos(v)
    return distance * math.cos(u), distance * math.sin(u), TUBE * math.sin(v)


def normal(u, v):
    """Return the normal of the ring at two angles in radians: at right angles to both tangents."""
    step = 1e-4
    along = np.subtract(point(u + step, v), point(u - step, v))
    around = np.subtract(point(u, v + step), point(u, v - step))
    found = np.cross(along, around)
    return found / np.linalg.norm(found)


def draw_ring():
    for i in range(STEPS):
        glBegin(GL_QUAD_STRIP)
        for j in range(STEPS + 1):
            for k in (1, 0):
                u = 2 * math.pi * (i + k) / STEPS
                v = 2 * math.pi * j / STEPS
                glNormal3f(*normal(u, v))
                glVertex3f(*point(u, v))
        glEnd()


def draw_normals():
    glDisable(GL_LIGHTING)
    glColor3f(0.25, 0.6, 0.6)
    glBegin(GL_LINES)
    for i in range(0, STEPS, 2):
        for j in range(0, STEPS, 2):
            u = 2 * math.pi * i / STEPS
            v = 2 * math.pi * j / STEPS
            start = point(u, v)
            direction = normal(u, v)
            glVertex3f(*start)
            glVertex3f(*(a + 0.35 * b for a, b in zip(start, direction)))
    glEnd()
    glEnable(GL_LIGHTING)


def on_key(window, key, scancode, action, mods):
    global lines
    if key == glfw.KEY_SPACE and action == glfw.PRESS:
        lines = not lines
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(640, 480, "Normals", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    glEnable(GL_DEPTH_TEST)
    glEnable(GL_LIGHTING)
    glEnable(GL_LIGHT0)
    glLightfv(GL_LIGHT0, GL_POSITION, (2, 3, 4, 0))
    glMaterialfv(GL_FRONT_AND_BACK, GL_AMBIENT_AND_DIFFUSE, (0.95, 0.55, 0.3, 1))
    glMaterialfv(GL_FRONT_AND_BACK, GL_SPECULAR, (0.5, 0.5, 0.5, 1))
    glMaterialf(GL_FRONT_AND_BACK, GL_SHININESS, 40)

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 50)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glTranslatef(0, 0, -9.5)
        glRotatef(-50 + 60 * glfw.get_time(), 1, 0, 0)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        draw_ring()
        if lines:
            draw_normals()
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
