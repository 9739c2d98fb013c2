"""The main loop: a picture only when something has changed

The loops of the lessons before draw all the time, although nothing changes most of the time. This
one sleeps in glfw.wait_events until an event comes, and draws only if a callback has asked for
it: after a key, after a new size, or when the window was hidden and must be drawn again. That is
GLUT's way, with a display, a reshape and an idle function. The picture counts what has happened.

Keys: the arrows move the window on the screen; Space draws without end, as an animation needs it.
"""
# topic: window
# needs: animation
# picture: frame 1 after RIGHT
# keys: LEFT RIGHT UP DOWN SPACE

import sys

import glfw
from OpenGL.GL import *
from text import _, write

place = [100, 100]  # of the window's upper left corner, in pixels of the screen
size = [640, 480]  # of the framebuffer
counts = {"pictures": 0, "keys": 0, "sizes": 0, "refreshes": 0}
LABELS = {
    "pictures": "pictures drawn: {count}",
    "keys": "keys pressed: {count}",
    "sizes": "new sizes: {count}",
    "refreshes": "asked to draw again: {count}",
}
changed = True  # the picture on the screen is no longer right
endless = False


def display(window):
    """Draw the picture, all of it: called whenever it is no longer right."""
    global changed
    changed = False
    counts["pictures"] += 1
    glClear(GL_COLOR_BUFFER_BIT)
    draw_screen()
    for line, (name, count) in enumerate(counts.items()):
        color = (0.95, 0.72, 0.4) if line == 0 else (1, 1, 1)
        write(16, 136 - 24 * line, LABELS[name], color, count=count)
    x, y = place
    write(16, 40, "window at {x}, {y}, of {w} × {h} pixels", x=x, y=y, w=size[0], h=size[1])
    write(16, 16, "draws without end" if endless else "waits for events")
    glfw.swap_buffers(window)


def draw_box(left, top, width, height, color):
    """Draw a rectangle of a screen of 1280 by 800 pixels, small, in the window's upper part."""
    x = -0.75 + 1.5 * left / 1280
    y = 0.9 - 1.15 * top / 800
    glColor3f(*color)
    glRectf(x, y, x + 1.5 * width / 1280, y - 1.15 * height / 800)


def draw_screen():
    draw_box(0, 0, 1280, 800, (0.22, 0.27, 0.34))
    draw_box(place[0], place[1] - 30, 640, 30, (0.3, 0.55, 0.6))  # its title bar
    draw_box(*place, 640, 480, (0.85, 0.35, 0.2))


def ask_for_picture():
    """As glutPostRedisplay: draw when all events have been dealt with."""
    global changed
    changed = True


def on_size(window, width, height):
    """As GLUT's reshape function; it is not called for the first size."""
    counts["sizes"] += 1
    size[:] = width, height
    glViewport(0, 0, width, height)
    ask_for_picture()


def on_refresh(window):
    """The window was hidden, and comes to light again."""
    counts["refreshes"] += 1
    ask_for_picture()


def on_key(window, key, scancode, action, mods):
    global endless
    if action == glfw.RELEASE:
        return
    counts["keys"] += 1
    if key == glfw.KEY_LEFT:
        place[0] -= 40
    elif key == glfw.KEY_RIGHT:
        place[0] += 40
    elif key == glfw.KEY_UP:
        place[1] -= 40
    elif key == glfw.KEY_DOWN:
        place[1] += 40
    elif key == glfw.KEY_SPACE:
        endless = not endless
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)
    glfw.set_window_pos(window, *place)
    ask_for_picture()


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    # What the framebuffer must have is said before the window is made.
    glfw.window_hint(glfw.DOUBLEBUFFER, True)  # False: draw where it is seen, then glFlush
    glfw.window_hint(glfw.DEPTH_BITS, 24)  # a depth buffer, for GL_DEPTH_TEST
    window = glfw.create_window(*size, _("The main loop"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.set_window_pos(window, *place)
    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glfw.set_framebuffer_size_callback(window, on_size)
    glfw.set_window_refresh_callback(window, on_refresh)
    size[:] = glfw.get_framebuffer_size(window)
    glViewport(0, 0, *size)
    glClearColor(0.13, 0.16, 0.21, 1)

    while not glfw.window_should_close(window):
        if changed or endless:
            display(window)
        if endless:
            glfw.poll_events()
        else:
            glfw.wait_events()  # sleeps until there is one

    glfw.terminate()


if __name__ == "__main__":
    main()
