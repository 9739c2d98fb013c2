"""A tetrahedron in lines from a table of vertices and one of faces, with GLFW."""

import sys

import glfw
from OpenGL.GL import *

VERTICES = ((400, 400, -10), (700, 700, -10), (0, 500, -10), (500, 0, -500))
FACES = ((0, 1, 2), (0, 1, 3), (0, 2, 3), (1, 2, 3))


def set_projection():
    """See 700 by 700 units, one a pixel, and depths from 1 to 600 in front of the eye."""
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glOrtho(0, 700, 0, 700, 1, 600)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()


def display(window):
    glClearColor(1, 1, 1, 1)
    glClear(GL_COLOR_BUFFER_BIT)
    glColor3f(0, 0, 0)
    glLineWidth(2)
    glPolygonMode(GL_FRONT_AND_BACK, GL_LINE)
    glBegin(GL_TRIANGLES)
    for face in FACES:
        for vertex in face:
            glVertex3fv(VERTICES[vertex])
    glEnd()
    glfw.swap_buffers(window)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(700, 700, "A tetrahedron", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.set_window_pos(window, 100, 100)
    glfw.make_context_current(window)
    glfw.set_window_refresh_callback(window, display)
    set_projection()
    display(window)

    while not glfw.window_should_close(window):
        glfw.wait_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
