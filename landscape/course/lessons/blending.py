"""Blending: alpha, sum and product, and when the order matters

Three panes of coloured glass in front of a light and a dark wall. glBlendFunc says how a new colour
is combined with the one already there. By alpha, the new one covers part of the old one: the pane
drawn last looks nearest, and another order gives another picture. Adding, as light does, and
multiplying, as a filter does, give the same in any order.

Keys: 1 sum, 2 product, 3 alpha; Space draws the panes in the opposite order.
"""
# topic: textures
# needs: depth_buffer
# picture: frame 0
# keys: 1 2 SPACE

import math
import sys

import glfw
from OpenGL.GL import *
from text import _, write

PANES = (((0.85, 0.35, 0.2), 90), ((0.95, 0.75, 0.25), 210), ((0.2, 0.5, 0.75), 330))
FUNCTIONS = (
    (GL_SRC_ALPHA, GL_ONE),
    (GL_ZERO, GL_SRC_COLOR),
    (GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA),
)
LABELS = (
    "GL_SRC_ALPHA, GL_ONE",
    "GL_ZERO, GL_SRC_COLOR",
    "GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA",
)
chosen = 2
backward = False


def draw_wall():
    """Draw stripes, light ones above and dark ones below."""
    glBegin(GL_QUADS)
    for n in range(40):
        for bottom, shade in ((0, 0.93 - 0.1 * (n % 2)), (-2, 0.18 + 0.06 * (n % 2))):
            glColor3f(shade, shade, shade)
            for x, y in ((0, 0), (0.25, 0), (0.25, 2), (0, 2)):
                glVertex2f(n / 4 - 5 + x, bottom + y)
    glEnd()


def draw_pane(color, angle):
    x = 0.62 * math.cos(math.radians(angle))
    y = 0.62 * math.sin(math.radians(angle))
    glColor4f(*color, 0.6)
    glBegin(GL_TRIANGLE_FAN)
    for n in range(64):
        turn = n * math.tau / 64
        glVertex2f(x + math.cos(turn), 0.1 + y + math.sin(turn))
    glEnd()


def look(width, height):
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glOrtho(-2 * width / height, 2 * width / height, -2, 2, -1, 1)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()


def on_key(window, key, scancode, action, mods):
    global backward, chosen
    if glfw.KEY_1 <= key < glfw.KEY_1 + len(LABELS):
        chosen = key - glfw.KEY_1
    if key == glfw.KEY_SPACE and action == glfw.PRESS:
        backward = not backward
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Blending"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)

    while not glfw.window_should_close(window):
        look(*glfw.get_framebuffer_size(window))
        glClear(GL_COLOR_BUFFER_BIT)
        draw_wall()
        glEnable(GL_BLEND)
        glBlendFunc(*FUNCTIONS[chosen])
        for pane in reversed(PANES) if backward else PANES:
            draw_pane(*pane)
        glDisable(GL_BLEND)

        write(16, 40, LABELS[chosen])
        write(16, 16, "opposite order" if backward else "red, amber, blue")
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
