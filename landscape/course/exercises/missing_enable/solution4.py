"""One missing line: boxes that hide each other

Five towers stand on a board that turns. They are drawn one after the other, in the order of the
list, wherever they stand. Each pixel should show what is nearest to the eye; but the towers that
are drawn last cover those in front of them.

OpenGL can keep the distance of what each pixel shows, and leave out what lies farther away: this is
the depth test. The window has the buffer for it, and glClear empties it in each frame; only one
line is missing, which turns the test on. Write it in place of the comment. Change nothing else.
"""
# exercise: missing_enable

import sys

import glfw
import numpy as np
from OpenGL.GL import *

TOWERS = (  # x, z, height, colour
    (-1.6, -1.6, 2.4, (0.85, 0.35, 0.2)),
    (1.6, 1.6, 1.6, (0.95, 0.62, 0.35)),
    (1.6, -1.6, 2.0, (0.25, 0.6, 0.6)),
    (-1.6, 1.6, 1.2, (0.3, 0.5, 0.8)),
    (0, 0, 3.2, (0.95, 0.9, 0.8)),
)


def box(x, y, z, width, height, depth, color):
    """Return the corners of a box that stands on the point x, y, z, and their colors."""
    corners = []
    colors = []
    for axis, shade in ((1, 1), (0, 0.8), (2, 0.6)):
        for side in (-1, 1):
            for u, v in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                a, b, c = ((side, u, v), (u, side, v), (u, v, side))[axis]
                corners.append((x + a * width / 2, y + (b + 1) * height / 2, z + c * depth / 2))
                colors.append([shade * channel for channel in color])
    return corners, colors


def make_arrays():
    """Set the arrays of the whole scene; return how many corners it has."""
    boxes = [box(0, -0.3, 0, 5.4, 0.3, 5.4, (0.45, 0.47, 0.5))]
    boxes += [box(x, 0, z, 1.2, height, 1.2, color) for x, z, height, color in TOWERS]
    corners = np.concatenate([np.array(each[0], "f") for each in boxes])
    glEnableClientState(GL_VERTEX_ARRAY)
    glEnableClientState(GL_COLOR_ARRAY)
    glVertexPointerf(corners)
    glColorPointerf(np.concatenate([np.array(each[1], "f") for each in boxes]))
    return len(corners)


def on_key(window, key, scancode, action, mods):
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(640, 480, "One missing line", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    glEnable(GL_DEPTH_TEST)
    count = make_arrays()

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 50)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glTranslatef(0, -0.6, -13.5)
        glRotatef(28, 1, 0, 0)
        glRotatef(25 + 60 * glfw.get_time(), 0, 1, 0)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        glDrawArrays(GL_QUADS, 0, count)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
