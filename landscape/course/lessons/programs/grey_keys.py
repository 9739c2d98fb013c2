"""Keys that make a grey lighter or darker, with GLFW: one callback for all keys; Q ends it."""

import sys

import glfw
from OpenGL.GL import *

grey = 0.5


def display(window):
    glClearColor(grey, grey, grey, 0)
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
    glfw.swap_buffers(window)


def on_key(window, key, scancode, action, mods):
    global grey
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_LEFT:
        grey = max(grey - 0.05, 0)
    elif key == glfw.KEY_RIGHT:
        grey = min(grey + 0.05, 1)
    display(window)


def on_character(window, code):
    """Called with what the key types, wherever it is on the keyboard."""
    if chr(code) == "q":
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(400, 400, "Keys", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.set_window_pos(window, 100, 100)
    glfw.make_context_current(window)
    glEnable(GL_DEPTH_TEST)
    glfw.set_window_refresh_callback(window, display)
    glfw.set_key_callback(window, on_key)
    glfw.set_char_callback(window, on_character)
    display(window)

    while not glfw.window_should_close(window):
        glfw.wait_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
