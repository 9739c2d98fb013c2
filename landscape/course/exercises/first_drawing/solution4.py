"""A first drawing: a sailing boat

The sea and a mast are there, and the boat is missing. The window reaches from -1 to 1 in both
directions; x grows to the right, and y grows upwards.

The hull has four corners: (-0.6, -0.3), (0.6, -0.3), (0.4, -0.6), (-0.4, -0.6). Its colour is 0.55
red, 0.33 green, 0.2 blue. Draw it in draw_hull.

The sail is a triangle, and each of its corners has a colour of its own: (0.05, -0.25) with 0.95,
0.9, 0.8; (0.05, 0.75) with 0.85, 0.35, 0.2; (0.6, -0.25) with 0.3, 0.5, 0.8. In between, OpenGL
mixes them. Draw it in draw_sail.

The pennant at the top is a triangle, too: (0.05, 0.78), (0.05, 0.92), (-0.25, 0.85), all of it with
0.95, 0.62, 0.35. Draw it in draw_pennant. It does not matter in which way you draw these shapes.
"""
# exercise: first_drawing

import sys

import glfw
import numpy as np
from OpenGL.GL import *

# A row each: red, green, blue, x, y, z, in twentieths of half the window.
BOAT = np.array(
    [
        *((0.55, 0.33, 0.2, -12, -6, 0), (0.55, 0.33, 0.2, 12, -6, 0)),
        *((0.55, 0.33, 0.2, 8, -12, 0), (0.55, 0.33, 0.2, -8, -12, 0)),
        *((0.95, 0.9, 0.8, 1, -5, 0), (0.85, 0.35, 0.2, 1, 15, 0), (0.3, 0.5, 0.8, 12, -5, 0)),
        *((0.95, 0.62, 0.35, 1, 15.6, 0), (0.95, 0.62, 0.35, 1, 18.4, 0)),
        (0.95, 0.62, 0.35, -5, 17, 0),
    ],
    np.float32,
)
TRIANGLES = [0, 1, 2, 0, 2, 3, 4, 5, 6, 7, 8, 9]


def draw_hull():
    """Draw the whole boat."""
    glPushMatrix()
    glMultMatrixf(np.diag((0.05, 0.05, 1, 1)))
    glPushClientAttrib(GL_CLIENT_VERTEX_ARRAY_BIT)
    glInterleavedArrays(GL_C3F_V3F, 0, BOAT)
    glDrawElementsui(GL_TRIANGLES, TRIANGLES)
    glPopClientAttrib()
    glPopMatrix()


def draw_sail():
    pass


def draw_pennant():
    pass


def draw_sea():
    """Draw the mast and the sea."""
    glColor3f(0.4, 0.3, 0.25)
    glRectf(0.01, -0.35, 0.05, 0.94)
    glColor3f(0.2, 0.42, 0.5)
    glRectf(-1, -1, 1, -0.45)


def on_key(window, key, scancode, action, mods):
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(300, 300, "A sailing boat", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.62, 0.72, 0.78, 1)

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glClear(GL_COLOR_BUFFER_BIT)
        draw_sea()
        draw_hull()
        draw_sail()
        draw_pennant()
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
