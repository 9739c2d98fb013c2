"""The mouse: dragging changes two colour channels

Dragging to the right adds blue to the background, dragging upwards adds green. What counts is the
distance from the mouse's last position, so each move stores the new one. The button is tested:
without that test, the colour already changes when the mouse only crosses the window.

Keys: Space leaves out the test of the button.
"""
# topic: window
# needs: keys
# picture: frame 0
# keys: SPACE
# programs: drag_colors

import sys

import glfw
from OpenGL.GL import *
from text import _, write

green = 0.45
blue = 0.55

# Where the mouse was, in pixels from the upper left corner.
last_x = 0
last_y = 0
dragging = False
tested = True


def draw():
    glClearColor(0.1, green, blue, 1)
    glClear(GL_COLOR_BUFFER_BIT)
    write(16, 64, "green {green:.2f}", green=green)
    write(16, 40, "blue {blue:.2f}", blue=blue)
    write(16, 16, "drag the mouse" if tested else "move the mouse: the button does not count")


def on_button(window, button, action, mods):
    global dragging
    if button == glfw.MOUSE_BUTTON_LEFT:
        dragging = action == glfw.PRESS


def on_move(window, x, y):
    global green, blue, last_x, last_y
    if dragging or not tested:
        blue = max(0, min(blue + 0.005 * (x - last_x), 1))
        green = max(0, min(green - 0.005 * (y - last_y), 1))  # minus: y grows downwards
    last_x = x
    last_y = y


def on_key(window, key, scancode, action, mods):
    global tested
    if key == glfw.KEY_SPACE and action == glfw.PRESS:
        tested = not tested
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("The mouse"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glfw.set_mouse_button_callback(window, on_button)
    glfw.set_cursor_pos_callback(window, on_move)

    while not glfw.window_should_close(window):
        glViewport(0, 0, *glfw.get_framebuffer_size(window))
        draw()
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
