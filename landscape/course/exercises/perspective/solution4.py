"""Perspective: a frustum for an opening angle

Columns stand on a board. The function set_projection is empty, so that nothing of them is in the
picture yet.

Call glFrustum in it so that the eye sees an angle of 40 degrees from the lower to the upper edge of
the window, whatever the window's size; that a square stays a square, also in a wide window; and
that what is between 0.5 and 60 units away is drawn. glFrustum takes the edges of the picture on the
near plane: left, right, bottom, top, and the distances of the near and the far plane.

Resize the window to see whether it is right: the picture grows, and nothing is stretched.
"""
# exercise: perspective

import math
import sys

import glfw
import numpy as np
from OpenGL.GL import *

OPENING = 40  # degrees, from the lower to the upper edge
NEAR = 0.5
FAR = 60


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


def draw_box(x, y, z, width, height, depth, color):
    """Draw a box that stands on the point x, y, z. Each direction has its shade."""
    glBegin(GL_QUADS)
    for axis, shade in ((1, 1), (0, 0.8), (2, 0.6)):
        glColor3f(*(shade * channel for channel in color))
        for side in (-1, 1):
            for u, v in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                a, b, c = ((side, u, v), (u, side, v), (u, v, side))[axis]
                glVertex3f(x + a * width / 2, y + (b + 1) * height / 2, z + c * depth / 2)
    glEnd()


def draw_scene():
    for i in range(-4, 5):
        for j in range(-4, 5):
            color = (0.3, 0.33, 0.38) if (i + j) % 2 else (0.6, 0.62, 0.64)
            draw_box(2 * i, -0.2, 2 * j, 2, 0.2, 2, color)
    for z in (-6, -2, 2, 6):
        for x in (-4, 4):
            draw_box(x, 0, z, 1, 4, 1, (0.95, 0.9, 0.8))
            draw_box(x, 4, z, 1.5, 0.4, 1.5, (0.95, 0.62, 0.35))
    draw_box(0, 0, 0, 2, 2, 2, (0.85, 0.35, 0.2))


def on_key(window, key, scancode, action, mods):
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(640, 480, "Perspective", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    glEnable(GL_DEPTH_TEST)

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        set_projection(width, height)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glTranslatef(0, -1.6, -16)
        glRotatef(15, 1, 0, 0)
        glRotatef(20 * glfw.get_time() - 12, 0, 1, 0)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        draw_scene()
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
