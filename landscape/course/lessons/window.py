"""A window: a coloured background

The smallest program that draws with OpenGL: GLFW opens a window with an OpenGL context, and the
loop draws one picture after another. Apart from the text, a picture is one call here: glClear fills
the window with the colour that glClearColor has set. Red, green and blue go from 0 to 1.

Keys: Escape ends the program.
"""
# topic: window
# needs: none
# picture: frame 0
# keys: none
# programs: minimal_window red_window

import sys

import glfw
from OpenGL.GL import *
from text import _, write

red = 0.85
green = 0.35
blue = 0.2


def draw():
    glClearColor(red, green, blue, 1)
    glClear(GL_COLOR_BUFFER_BIT)
    write(16, 64, "red {red}", red=red)
    write(16, 40, "green {green}", green=green)
    write(16, 16, "blue {blue}", blue=blue)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("A window"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)  # from here on, OpenGL draws to this window

    while not glfw.window_should_close(window):
        glViewport(0, 0, *glfw.get_framebuffer_size(window))  # draw to all of the window
        draw()
        glfw.swap_buffers(window)  # shows the picture, which was drawn out of sight
        glfw.poll_events()  # the close button, a new size, keys
        if glfw.get_key(window, glfw.KEY_ESCAPE) == glfw.PRESS:
            glfw.set_window_should_close(window, True)

    glfw.terminate()


if __name__ == "__main__":
    main()
