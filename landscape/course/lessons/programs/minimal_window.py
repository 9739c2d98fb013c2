"""The smallest window, with GLFW: it is opened, and closed by its button."""

import glfw
from OpenGL.GL import *


def main():
    glfw.init()
    window = glfw.create_window(400, 400, "A window", None, None)
    glfw.set_window_pos(window, 100, 100)
    glfw.make_context_current(window)
    glEnable(GL_DEPTH_TEST)
    while not glfw.window_should_close(window):
        glfw.swap_buffers(window)  # nothing has been drawn
        glfw.wait_events()
    glfw.terminate()


if __name__ == "__main__":
    main()
