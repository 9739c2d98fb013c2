"""Keys: the arrows lighten and darken a grey

GLFW calls the function on_key each time a key is pressed, held or released. The function draws
nothing: it changes the variable grey, and the next picture is drawn with it. The value is kept
between 0 and 1. Without that limit it runs on beyond white, and then the keys seem to be dead.

Keys: Left and Right darken and lighten; Space leaves out the limit.
"""
# topic: window
# needs: window
# picture: frame 0
# keys: LEFT RIGHT SPACE
# programs: grey_keys

import sys

import glfw
from OpenGL.GL import *
from text import _, write

grey = 0.5
limited = True


def draw():
    glClearColor(grey, grey, grey, 1)
    glClear(GL_COLOR_BUFFER_BIT)
    color = (0, 0, 0) if grey > 0.6 else (1, 1, 1)
    write(16, 40, "grey {grey:.2f}", color, grey=grey)
    write(16, 16, "limit on" if limited else "limit off", color)


def on_key(window, key, scancode, action, mods):
    global grey, limited
    if action == glfw.RELEASE:
        return  # only presses count, and the repetitions while a key is held
    if key == glfw.KEY_LEFT:
        grey -= 0.05
    if key == glfw.KEY_RIGHT:
        grey += 0.05
    if key == glfw.KEY_SPACE:
        limited = not limited
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)
    if limited:
        grey = max(0, min(grey, 1))


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Keys"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)

    while not glfw.window_should_close(window):
        glViewport(0, 0, *glfw.get_framebuffer_size(window))
        draw()
        glfw.swap_buffers(window)
        glfw.poll_events()  # here GLFW calls on_key

    glfw.terminate()


if __name__ == "__main__":
    main()
