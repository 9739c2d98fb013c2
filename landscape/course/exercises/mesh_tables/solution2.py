"""A mesh in two tables: a gem

A gem has six corners. They are in the table VERTICES, each once. Between them lie eight triangles,
four above and four below; the table FACES is to hold, for each of them, the numbers of its three
corners in VERTICES, counted from 0. It has only one face yet.

Complete FACES, each face once. From outside, the corners of a face follow each other
counter-clockwise: faces that look clockwise are left out, as GL_CULL_FACE is on.

Then let draw_gem draw all faces of FACES, each in the colour that color_of returns for its corners.

Keys: Left and Right turn the gem, Up and Down tilt it.
"""
# exercise: mesh_tables

import sys

import glfw
import numpy as np
from OpenGL.GL import *

VERTICES = (
    (1, 0, 0),  # 0: right
    (0, 0, -1),  # 1: behind
    (-1, 0, 0),  # 2: left
    (0, 0, 1),  # 3: in front
    (0, 1.3, 0),  # 4: above
    (0, -1.3, 0),  # 5: below
)
ABOVE = [(number, (number + 1) % 4, 4) for number in range(4)]
BELOW = [((number + 1) % 4, number, 5) for number in range(4)]
FACES = ABOVE + BELOW
turned = 20  # degrees
tilted = 25


def color_of(corners):
    """Return the colour of a face, by where it lies."""
    x, y, z = (sum(coordinates) / 3 for coordinates in zip(*corners))
    return 0.62 + x, 0.62 + 0.6 * y, 0.62 + z


def draw_gem():
    glEnableClientState(GL_VERTEX_ARRAY)
    glVertexPointer(3, GL_FLOAT, 0, np.array(VERTICES, np.float32))
    for face in FACES:
        glColor3fv(color_of([VERTICES[number] for number in face]))
        glDrawElementsui(GL_TRIANGLES, face)
    glDisableClientState(GL_VERTEX_ARRAY)


def on_key(window, key, scancode, action, mods):
    global turned, tilted
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_LEFT:
        turned -= 30
    elif key == glfw.KEY_RIGHT:
        turned += 30
    elif key == glfw.KEY_UP:
        tilted -= 50
    elif key == glfw.KEY_DOWN:
        tilted += 50
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(320, 320, "A gem", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    glEnable(GL_DEPTH_TEST)
    glEnable(GL_CULL_FACE)

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glOrtho(-1.6 * width / height, 1.6 * width / height, -1.6, 1.6, -3, 3)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glRotatef(tilted, 1, 0, 0)
        glRotatef(turned, 0, 1, 0)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        draw_gem()
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
