"""A background that changes by itself, with GLFW: the loop goes on without waiting."""

import math
import sys

import glfw
from OpenGL.GL import *

SPEED = 0.1
step = 0


def display(window):
    glClearColor(0, 0.5, math.sin(SPEED * step), 0)  # OpenGL takes 0 for what is below it
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
    glfw.swap_buffers(window)


def main():
    global step
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(400, 400, "Animation", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.set_window_pos(window, 100, 100)
    glfw.make_context_current(window)
    glEnable(GL_DEPTH_TEST)

    while not glfw.window_should_close(window):
        display(window)
        step += 1
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
