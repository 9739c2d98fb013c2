"""The order of vertices: two missing faces

A cut gem turns. Its faces are triangles, six above and six below a ring of points. Each must list
its vertices counter-clockwise as seen from outside: then OpenGL knows which side is the front, and
glEnable(GL_CULL_FACE) leaves out the faces that look away.

Two of the twelve triangles in FACES are listed clockwise, so that they are missing in front and
shine through from behind. Each entry names the colour of its face, then its vertices; the faces of
BOTTOM are darker. Find the two, and put their vertices into the right order. Keep the culling, and
change nothing but FACES.

Keys: Left and Right turn the gem.
"""
# exercise: winding

import math
import sys

import glfw
import numpy as np
from OpenGL.GL import *

RED = (0.85, 0.35, 0.2)
ORANGE = (0.95, 0.62, 0.35)
CREAM = (0.95, 0.9, 0.8)
GREEN = (0.45, 0.7, 0.35)
BLUE = (0.3, 0.5, 0.8)
VIOLET = (0.6, 0.4, 0.7)
TOP = 6  # the ring has the points 0 to 5, counter-clockwise as seen from above
BOTTOM = 7
FACES = (
    (RED, TOP, 0, 1),
    (ORANGE, TOP, 1, 2),
    (CREAM, TOP, 2, 3),
    (GREEN, TOP, 3, 4),
    (BLUE, TOP, 4, 5),
    (VIOLET, TOP, 5, 0),
    (RED, BOTTOM, 1, 0),
    (ORANGE, BOTTOM, 2, 1),
    (CREAM, BOTTOM, 3, 2),
    (GREEN, BOTTOM, 4, 3),
    (BLUE, BOTTOM, 5, 4),
    (VIOLET, BOTTOM, 0, 5),
)
turned = 0  # degrees, by the keys


def point(number):
    """Return the coordinates of a point of the gem."""
    if number == TOP:
        return 0, 1.1, 0
    if number == BOTTOM:
        return 0, -1.9, 0
    angle = math.radians(60 * number)
    return 1.7 * math.cos(angle), 0.15, -1.7 * math.sin(angle)


def make_arrays():
    """Return the corners of all faces, (n, 3), and their colors."""
    corners = [point(number) for _color, *face in FACES for number in face]
    colors = [
        [(0.62 if BOTTOM in face else 1) * channel for channel in color]
        for color, *face in FACES
        for _number in face
    ]
    return np.array(corners, "f"), np.array(colors, "f")


CORNERS, COLORS = make_arrays()


def draw_gem():
    glEnableClientState(GL_VERTEX_ARRAY)
    glEnableClientState(GL_COLOR_ARRAY)
    glVertexPointerf(CORNERS)
    glColorPointerf(COLORS)
    glDrawArrays(GL_TRIANGLES, 0, len(CORNERS))
    glDisableClientState(GL_COLOR_ARRAY)
    glDisableClientState(GL_VERTEX_ARRAY)


def on_key(window, key, scancode, action, mods):
    global turned
    if key in (glfw.KEY_LEFT, glfw.KEY_RIGHT) and action != glfw.RELEASE:
        turned += 20 if key == glfw.KEY_RIGHT else -20
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(640, 480, "The order of vertices", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    glEnable(GL_CULL_FACE)

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 50)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glTranslatef(0, 0.25, -7.5)
        glRotatef(18, 1, 0, 0)
        glRotatef(turned + 10 + 40 * glfw.get_time(), 0, 1, 0)
        glClear(GL_COLOR_BUFFER_BIT)
        draw_gem()
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
