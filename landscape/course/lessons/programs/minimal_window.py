"""The smallest window, with GLFW: it is opened, and closed by its button."""

import sys

import glfw
from OpenGL.GL import *


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(400, 400, "A window", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.set_window_pos(window, 100, 100)
    glfw.make_context_current(window)
    glEnable(GL_DEPTH_TEST)

    while not glfw.window_should_close(window):
        glfw.swap_buffers(window)  # nothing has been drawn
        glfw.wait_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
