"""A second viewport: a map in the corner

The scene is drawn twice. First as the viewer sees it, in the whole window; then with glOrtho from
straight above, in a viewport of its own in the upper right corner, with an arrow for the viewer.
The map needs a fresh background and fresh depths, but glClear does not heed the viewport: only the
scissor test limits it. Without it, the map's glClear wipes out the whole window.

Keys: Left and Right turn, Up and Down walk; Space switches the scissor test.
"""
# topic: landscape
# needs: viewport, perspective, look_at, matrix_stack, overlay
# picture: frame 0
# keys: LEFT RIGHT UP DOWN SPACE

import math
import sys

import glfw
from OpenGL.GL import *
from text import _, write

HOUSES = (-3, -1, 1.5), (1, -4, 2), (4, 0.5, 1.3)  # x, z, height
TREES = (-1, 3, 3), (0.2, 1.2, 2.4), (-5, 3.5, 3.4), (5, -4, 3), (-6, -4.5, 2.6), (6.5, 4, 3.2)
CREAM = (0.95, 0.9, 0.8)
CORAL = (0.85, 0.35, 0.2)
AMBER = (0.95, 0.62, 0.35)
TEAL = (0.25, 0.6, 0.6)
BROWN = (0.5, 0.36, 0.27)

# The viewer: place, and degrees to the right of north (-z).
x = 1.6
z = 7.0
turn = -10
scissor = True


def draw_prism(x, z, sides, bottom, top, radius, top_radius, color):
    """Draw a prism, or a cone if top_radius is 0; it is lit from the west (-x)."""
    glBegin(GL_QUADS)
    for k in range(sides):
        a = math.radians((k - 0.5) * 360 / sides)
        b = math.radians((k + 0.5) * 360 / sides)
        shade = 0.75 - 0.25 * math.cos((a + b) / 2)
        glColor3f(*(shade * channel for channel in color))
        for angle, y, r in (
            (a, bottom, radius),
            (a, top, top_radius),
            (b, top, top_radius),
            (b, bottom, radius),
        ):
            glVertex3f(x + r * math.cos(angle), y, z + r * math.sin(angle))
    glEnd()


def draw_house(x, z, height):
    draw_prism(x, z, 4, 0, height, 1.4, 1.4, CREAM)
    draw_prism(x, z, 4, height, height + 1.2, 1.8, 0, CORAL)


def draw_tree(x, z, height):
    draw_prism(x, z, 12, 0, 0.5, 0.15, 0.15, BROWN)
    draw_prism(x, z, 12, 0.4, height, 0.3 * height, 0, TEAL)


def draw_village():
    glColor3f(0.4, 0.5, 0.3)
    glBegin(GL_QUADS)
    for corner in ((-9, 0, -9), (9, 0, -9), (9, 0, 9), (-9, 0, 9)):
        glVertex3f(*corner)
    glEnd()
    for house in HOUSES:
        draw_house(*house)
    for tree in TREES:
        draw_tree(*tree)


def draw_view(width, height):
    """Draw what the viewer sees, in the whole window."""
    glViewport(0, 0, width, height)
    glClearColor(0.55, 0.68, 0.78, 1)
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 0.5, 50)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glRotatef(turn, 0, 1, 0)
    glTranslatef(-x, -1.6, -z)
    draw_village()


def draw_map(width, height):
    """Draw the map in a square in the upper right corner."""
    size = height * 2 // 5
    edge = height // 30
    corner = width - size - edge, height - size - edge, size, size
    glViewport(*corner)

    # glClear heeds the scissor test, not the viewport.
    if scissor:
        glScissor(*corner)
        glEnable(GL_SCISSOR_TEST)
    glClearColor(0.13, 0.16, 0.21, 1)
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
    glDisable(GL_SCISSOR_TEST)

    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glOrtho(-10, 10, -10, 10, 0, 20)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glRotatef(90, 1, 0, 0)  # looks down; north is up
    glTranslatef(0, -10, 0)
    draw_village()
    draw_arrow()


def draw_arrow():
    """Draw the viewer on the map, above the roofs."""
    glTranslatef(x, 8, z)
    glRotatef(-turn, 0, 1, 0)
    glColor3f(*AMBER)
    glBegin(GL_TRIANGLES)
    for corner in ((0, 0, -1.6), (-0.9, 0, 1), (0.9, 0, 1)):
        glVertex3f(*corner)
    glEnd()


def walk(distance):
    global x, z
    x += distance * math.sin(math.radians(turn))
    z -= distance * math.cos(math.radians(turn))


def on_key(window, key, scancode, action, mods):
    global turn, scissor
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_LEFT:
        turn -= 5
    elif key == glfw.KEY_RIGHT:
        turn += 5
    elif key == glfw.KEY_UP:
        walk(0.3)
    elif key == glfw.KEY_DOWN:
        walk(-0.3)
    elif key == glfw.KEY_SPACE:
        scissor = not scissor
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("A second viewport"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glEnable(GL_DEPTH_TEST)

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        draw_view(width, height)
        draw_map(width, height)

        glViewport(0, 0, width, height)
        write(16, 16, "scissor test on" if scissor else "scissor test off")
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
