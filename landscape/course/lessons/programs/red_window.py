"""A red window, with GLFW: the loop calls the function that draws."""

import sys

import glfw
from OpenGL.GL import *


def display(window):
    glClearColor(1, 0, 0, 0)
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
    glfw.swap_buffers(window)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(400, 400, "Red", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.set_window_pos(window, 100, 100)
    glfw.make_context_current(window)
    glEnable(GL_DEPTH_TEST)
    glfw.set_window_refresh_callback(window, display)
    display(window)

    while not glfw.window_should_close(window):
        glfw.wait_events()  # calls display when the window must be drawn again

    glfw.terminate()


if __name__ == "__main__":
    main()
