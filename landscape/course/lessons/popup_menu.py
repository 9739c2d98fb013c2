"""A popup menu: three buttons, and a menu that has menus

The right button opens a menu where the mouse is. Moving over a line marks it; a line that leads to
another menu opens that beside it. A click with the left button carries the marked line out, and
closes the menu. The middle button drags the square. GLFW reports the buttons and the mouse; the
menu is a list of rectangles, and a test of which of them the mouse is in.

Keys: Space opens the menu; Up and Down move the mark, Enter carries it out.
"""
# topic: window
# needs: mouse, menu, animation
# picture: frame 1 after SPACE DOWN
# keys: SPACE DOWN UP ENTER

import sys

import glfw
from OpenGL.GL import *
from text import _, write

COLORS = {"coral": (0.85, 0.35, 0.2), "amber": (0.95, 0.72, 0.35), "teal": (0.25, 0.6, 0.6)}
SIZES = {"small": 60, "medium": 100, "large": 160}
MENU = (("colour", tuple(COLORS)), ("size", tuple(SIZES)), ("begin again", ()))
LABELS = {
    **{"colour": "colour", "coral": "coral", "amber": "amber", "teal": "teal"},
    **{"size": "size", "small": "small", "medium": "medium", "large": "large"},
    "begin again": "begin again",
    **{"left": "left", "middle": "middle", "right": "right"},
}
# The size of a line of the menu, in the pixels that write counts in.
LINE = 28
ACROSS = 150
BUTTONS = (glfw.MOUSE_BUTTON_LEFT, glfw.MOUSE_BUTTON_MIDDLE, glfw.MOUSE_BUTTON_RIGHT)
BUTTON_NAMES = ("left", "middle", "right")

color = "coral"
size = "medium"
place = [400.0, 260.0]  # of the square's middle
mouse = [320.0, 240.0]
opened = None  # the upper left corner of the menu
marked = None  # the line of the menu
sub_marked = None  # the line of the menu beside it


def window_size(window):
    """Return the width and height of the window as write counts: from its lower left corner."""
    width, height = glfw.get_framebuffer_size(window)
    scale = height // 480 or height / 480
    return width / scale, height / scale


def line_at(corner, count, x, y):
    """Return which of ``count`` lines below a corner the point is in, or None."""
    line = (corner[1] - y) // LINE
    return int(line) if corner[0] <= x < corner[0] + ACROSS and 0 <= line < count else None


def beside():
    """Return the upper left corner of the menu that belongs to the marked line."""
    return opened[0] + ACROSS, opened[1] - LINE * marked


def point_at(x, y):
    """Mark what the mouse is over: first in the menu beside, if one is open."""
    global marked, sub_marked
    if marked is not None and MENU[marked][1]:
        sub_marked = line_at(beside(), len(MENU[marked][1]), x, y)
        if sub_marked is not None:
            return
    marked = line_at(opened, len(MENU), x, y)


def choose():
    """Carry out the marked line, and close the menu."""
    global color, opened, place, size
    lines = MENU[marked][1] if marked is not None else ()
    if lines and sub_marked is not None:
        if lines[sub_marked] in COLORS:
            color = lines[sub_marked]
        else:
            size = lines[sub_marked]
    elif marked is not None and not lines:
        color = "coral"
        size = "medium"
        place = [400.0, 260.0]
    opened = None


def open_menu(x, y):
    global marked, opened, sub_marked
    opened = (x, y)
    marked = None
    sub_marked = None


def draw_box(window, left, bottom, width, height, color):
    """Draw a rectangle; OpenGL counts from -1 to 1 across the window, and upwards."""
    across, up = window_size(window)
    right = left + width
    top = bottom + height
    glColor3f(*color)
    glRectf(2 * left / across - 1, 2 * bottom / up - 1, 2 * right / across - 1, 2 * top / up - 1)


def draw_menu(window, corner, names, mark):
    for line, name in enumerate(names):
        x = corner[0]
        y = corner[1] - LINE * (line + 1)
        shade = (0.3, 0.55, 0.6) if line == mark else (0.27, 0.32, 0.38)
        draw_box(window, x, y, ACROSS - 2, LINE - 2, shade)
        write(x + 10, y + 3, LABELS[name])
        if dict(MENU).get(name):
            write(x + ACROSS - 20, y + 3, "»")


def draw(window):
    glViewport(0, 0, *glfw.get_framebuffer_size(window))
    side = SIZES[size]
    left = place[0] - side / 2
    bottom = place[1] - side / 2
    draw_box(window, left, bottom, side, side, COLORS[color])

    for number, button in enumerate(BUTTONS):
        pressed = glfw.get_mouse_button(window, button) == glfw.PRESS
        shade = (0.95, 0.9, 0.8) if pressed else (0.45, 0.5, 0.57)
        write(16 + 100 * number, 16, LABELS[BUTTON_NAMES[number]], shade)

    if opened:
        draw_menu(window, opened, [name for name, _lines in MENU], marked)
        if marked is not None and MENU[marked][1]:
            draw_menu(window, beside(), MENU[marked][1], sub_marked)


def on_button(window, button, action, mods):
    if action != glfw.PRESS:
        return
    if button == glfw.MOUSE_BUTTON_RIGHT:
        open_menu(*mouse)
    if button == glfw.MOUSE_BUTTON_LEFT and opened:
        choose()


def on_move(window, x, y):
    width, height = glfw.get_window_size(window)
    across, up = window_size(window)
    new = x * across / width, up - y * up / height  # y grows upwards, as write counts
    if glfw.get_mouse_button(window, glfw.MOUSE_BUTTON_MIDDLE) == glfw.PRESS:
        place[0] += new[0] - mouse[0]
        place[1] += new[1] - mouse[1]
    mouse[:] = new
    if opened:
        point_at(*new)


def on_key(window, key, scancode, action, mods):
    global marked, opened, sub_marked
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_SPACE and opened:
        opened = None
    elif key == glfw.KEY_SPACE:
        open_menu(200, 320)
    if opened and key in (glfw.KEY_UP, glfw.KEY_DOWN):
        step = 1 if key == glfw.KEY_DOWN else -1
        marked = (marked + step) % len(MENU) if marked is not None else 0
        sub_marked = 0 if MENU[marked][1] else None
    if opened and key == glfw.KEY_ENTER:
        choose()
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("A popup menu"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glfw.set_mouse_button_callback(window, on_button)
    glfw.set_cursor_pos_callback(window, on_move)
    glClearColor(0.13, 0.16, 0.21, 1)

    while not glfw.window_should_close(window):
        glClear(GL_COLOR_BUFFER_BIT)
        draw(window)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
