"""Planar shadow: a table on the floor

A lamp hangs above a table. For the shadow of the table, draw_shadow draws it once more, black and
half transparent; but as yet in its own place, so that the table is dark. Fill in what is missing.

- A matrix M flattens the table onto the floor, away from the lamp. For the plane p = FLOOR and the
  light l = lamp, M = (p.l) I - l p^T: p.l is the sum of the products of their numbers, I the
  identity, and l p^T has the product of l's number i and p's number j in row i, column j.

- Each pixel of the floor is darkened once, however many sides of the table lie over it, and
  nothing beside the floor is darkened. draw_floor has written a 1 into the stencil buffer wherever
  the floor is seen; everywhere else it is 0.

What is drawn after draw_shadow is drawn as before. The lamp moves, and so does the shadow.

Keys: Left and Right move the lamp.
"""
# exercise: planar_shadow
# lessons: planar_shadow, stencil_mirror, matrix_stack

import sys

import glfw
import numpy as np
from OpenGL.GL import *

FLOOR = (0, 1, 0, 1)  # the plane 0 x + 1 y + 0 z + 1 = 0, that is, y = -1
lamp = [-1.75, 3, 0.8, 1]
BOXES = (  # two corners and a colour
    ((-1.1, 0.2, -0.7), (1.1, 0.32, 0.7), (0.85, 0.45, 0.25)),
    ((-1.0, -1, -0.6), (-0.86, 0.2, -0.46), (0.6, 0.35, 0.22)),
    ((0.86, -1, -0.6), (1.0, 0.2, -0.46), (0.6, 0.35, 0.22)),
    ((-1.0, -1, 0.46), (-0.86, 0.2, 0.6), (0.6, 0.35, 0.22)),
    ((0.86, -1, 0.46), (1.0, 0.2, 0.6), (0.6, 0.35, 0.22)),
    ((0.2, 0.32, -0.3), (0.7, 0.85, 0.2), (0.25, 0.6, 0.6)),
)


def draw_table(colored):
    """Draw all boxes: in their colours, each side in another shade, or in the current colour."""
    for low, high, color in BOXES:
        glBegin(GL_QUADS)
        for axis in range(3):
            for side in (low, high):
                shade = (0.65, 0.9, 0.75)[axis] + (0.1 if side is high else -0.1)
                if colored:
                    glColor3f(*(shade * channel for channel in color))
                for first, second in ((low, low), (high, low), (high, high), (low, high)):
                    corner = [0, 0, 0]
                    corner[axis] = side[axis]
                    corner[(axis + 1) % 3] = first[(axis + 1) % 3]
                    corner[(axis + 2) % 3] = second[(axis + 2) % 3]
                    glVertex3f(*corner)
        glEnd()


def draw_floor():
    """Draw the floor, and write a 1 into the stencil buffer wherever it is seen."""
    glEnable(GL_STENCIL_TEST)
    glStencilFunc(GL_ALWAYS, 1, 1)
    glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE)
    glColor3f(0.62, 0.6, 0.55)
    glBegin(GL_POLYGON)
    for x, z in ((-2, -2), (-2.6, 0), (-2, 2), (2, 2), (2.6, 0), (2, -2)):
        glVertex3f(x, -1, z)
    glEnd()
    glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP)
    glDisable(GL_STENCIL_TEST)


def draw_lamp():
    glColor3f(1, 0.9, 0.6)
    glPointSize(12)
    glBegin(GL_POINTS)
    glVertex3f(*lamp[:3])
    glEnd()


def draw_shadow():
    glPushMatrix()
    glEnable(GL_BLEND)
    glEnable(GL_POLYGON_OFFSET_FILL)  # the shadow is a little nearer than the floor
    glColor4f(0, 0, 0, 0.5)
    plane = np.array(FLOOR, float)
    light = np.array(lamp, float)
    glMultTransposeMatrixd(plane @ light * np.identity(4) - np.outer(light, plane))
    glEnable(GL_STENCIL_TEST)
    glStencilFunc(GL_EQUAL, 1, 1)
    glStencilOp(GL_KEEP, GL_KEEP, GL_INCR)  # 2 is no longer 1
    draw_table(False)
    glDisable(GL_STENCIL_TEST)
    glDisable(GL_POLYGON_OFFSET_FILL)
    glDisable(GL_BLEND)
    glPopMatrix()


def on_key(window, key, scancode, action, mods):
    if key in (glfw.KEY_LEFT, glfw.KEY_RIGHT) and action != glfw.RELEASE:
        lamp[0] += 0.25 if key == glfw.KEY_RIGHT else -0.25
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(640, 480, "A table and its shadow", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    glEnable(GL_DEPTH_TEST)
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA)
    glPolygonOffset(-2, -4)

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 40)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glTranslatef(0, -0.35, -12)
        glRotatef(28, 1, 0, 0)
        glRotatef(-25, 0, 1, 0)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT)
        draw_floor()
        draw_shadow()
        draw_table(True)
        draw_lamp()
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
