"""A teapot in lines, seen by gluLookAt, with GLFW."""

import sys
from pathlib import Path

import glfw
import numpy as np
from OpenGL.GL import *
from OpenGL.GLU import gluLookAt, gluPerspective

PATCHES = np.loadtxt(Path(__file__).parents[1] / "data" / "teapot.txt").reshape(32, 4, 4, 3)


def wire_teapot(size):
    """As GLUT's: 32 patches, which OpenGL divides into lines."""
    glEnable(GL_MAP2_VERTEX_3)
    glMapGrid2f(7, 0, 1, 7, 0, 1)
    for patch in PATCHES:
        glMap2f(GL_MAP2_VERTEX_3, 0, 1, 0, 1, size * patch)
        glEvalMesh2(GL_LINE, 0, 7, 0, 7)


def display(window):
    glClearColor(1, 1, 1, 1)
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    gluLookAt(10, 10, 10, 0, 0, 0, 0, 1, 0)
    glColor3f(0, 0, 0)
    wire_teapot(5)
    glfw.swap_buffers(window)


def reshape(window, width, height):
    """Called for a new size: the viewport, and the projection with its aspect."""
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    gluPerspective(45, width / max(height, 1), 0.01, 10000)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(400, 400, "The teapot", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.set_window_pos(window, 100, 100)
    glfw.make_context_current(window)
    glEnable(GL_DEPTH_TEST)
    glfw.set_framebuffer_size_callback(window, reshape)
    glfw.set_window_refresh_callback(window, display)
    reshape(window, *glfw.get_framebuffer_size(window))  # GLFW does not call it for the first size

    while not glfw.window_should_close(window):
        display(window)
        glfw.wait_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
