"""A drag of the mouse that changes green and blue, with GLFW."""

import sys

import glfw
from OpenGL.GL import *

green = blue = 0.5
mouse = 0, 0


def display(window):
    glClearColor(0, green, blue, 0)
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
    glfw.swap_buffers(window)


def on_move(window, x, y):
    """Called for each move, with a button or without; y grows downwards."""
    global blue, green, mouse
    if glfw.get_mouse_button(window, glfw.MOUSE_BUTTON_LEFT) == glfw.PRESS:
        blue = max(0, min(blue + 0.01 * (x - mouse[0]), 1))
        green = max(0, min(green - 0.01 * (y - mouse[1]), 1))
        display(window)
    mouse = x, y


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(400, 400, "The mouse", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.set_window_pos(window, 100, 100)
    glfw.make_context_current(window)
    glEnable(GL_DEPTH_TEST)
    glfw.set_window_refresh_callback(window, display)
    glfw.set_cursor_pos_callback(window, on_move)
    display(window)

    while not glfw.window_should_close(window):
        glfw.wait_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
