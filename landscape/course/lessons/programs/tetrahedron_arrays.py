"""The same tetrahedron by vertex arrays and one call, with GLFW."""

import sys

import glfw
import numpy as np
from OpenGL.GL import *
from OpenGL.GLU import gluPerspective

VERTICES = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], np.float32)
COLORS = np.array([[0, 0, 0], [0.7, 0.5, 0.2], [0.5, 0.7, 0.9], [0.6, 1, 0.6]], np.float32)
FACES = np.array([0, 1, 2, 0, 1, 3, 0, 2, 3, 1, 2, 3], np.uint32)


def set_arrays():
    """Tell OpenGL where colours and vertices are: 3 floats each, one after the other."""
    glEnableClientState(GL_COLOR_ARRAY)
    glEnableClientState(GL_VERTEX_ARRAY)
    glColorPointer(3, GL_FLOAT, 0, COLORS)
    glVertexPointer(3, GL_FLOAT, 0, VERTICES)


def draw_tetrahedron():
    """Draw 12 corners, all in one call."""
    glDrawElements(GL_TRIANGLES, 12, GL_UNSIGNED_INT, FACES)


def display(window):
    glClearColor(1, 1, 1, 1)
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
    glPushMatrix()
    glTranslatef(-0.2, -0.2, -4)
    glRotatef(-30, 1, 0, 0)
    glRotatef(120, 0, 1, 0)
    draw_tetrahedron()
    glPopMatrix()
    glfw.swap_buffers(window)


def reshape(window, width, height):
    """Called for a new size: the viewport, and the projection with its aspect."""
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    gluPerspective(20, width / max(height, 1), 0.01, 10000)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(500, 500, "A tetrahedron", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.set_window_pos(window, 100, 100)
    glfw.make_context_current(window)
    glEnable(GL_DEPTH_TEST)
    set_arrays()
    glfw.set_framebuffer_size_callback(window, reshape)
    glfw.set_window_refresh_callback(window, display)
    reshape(window, *glfw.get_framebuffer_size(window))  # GLFW does not call it for the first size

    while not glfw.window_should_close(window):
        display(window)
        glfw.wait_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
