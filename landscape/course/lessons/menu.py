"""A menu: a list on the screen, chosen from by keys

OpenGL has no menus. This one is a list of texts with a marked line: Up and Down move the mark,
Enter carries the marked command out, and a digit carries its command out at once. The mark goes
round at the ends of the list. Without that it leaves the list, and Enter finds no command.

Keys: Up and Down move the mark; Enter or 1 to 4 choose a background; Space leaves out going round.
"""
# topic: window
# needs: keys
# picture: frame 1 after DOWN
# keys: UP DOWN ENTER 1 2 3 SPACE

import sys

import glfw
from OpenGL.GL import *
from text import _, write

LABELS = ("night", "forest", "brick", "sea")
COLORS = ((0.13, 0.16, 0.21), (0.16, 0.33, 0.24), (0.5, 0.23, 0.17), (0.16, 0.32, 0.5))
marked = 0
chosen = 3
round_trip = True


def choose(entry):
    """Carry out a command of the menu."""
    global chosen
    if 0 <= entry < len(LABELS):
        chosen = entry


def draw():
    glClearColor(*COLORS[chosen], 1)
    glClear(GL_COLOR_BUFFER_BIT)
    for entry, label in enumerate(LABELS):
        y = 316 - 48 * entry
        color = (0.95, 0.7, 0.4) if entry == marked else (0.95, 0.9, 0.8)
        write(104, y, "{number} {label}", color, 2, number=entry + 1, label=_(label))
    write(64, 316 - 48 * marked, "»", (0.95, 0.7, 0.4), 2)
    write(16, 40, "the mark is on line {line}", line=marked + 1)
    write(16, 16, "goes round: yes" if round_trip else "goes round: no")


def on_key(window, key, scancode, action, mods):
    global marked, round_trip
    if action == glfw.RELEASE:
        return
    if key in (glfw.KEY_UP, glfw.KEY_DOWN):
        marked += 1 if key == glfw.KEY_DOWN else -1
        if round_trip:
            marked %= len(LABELS)  # the line after the last one is the first one
    if key == glfw.KEY_ENTER:
        choose(marked)
    if glfw.KEY_1 <= key < glfw.KEY_1 + 9:  # a digit
        choose(key - glfw.KEY_1)
    if key == glfw.KEY_SPACE:
        round_trip = not round_trip
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("A menu"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)

    while not glfw.window_should_close(window):
        glViewport(0, 0, *glfw.get_framebuffer_size(window))
        draw()
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
