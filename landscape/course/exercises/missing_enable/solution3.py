"""One missing line: boxes that hide each other

Five towers stand on a board that turns. They are drawn one after the other, in the order of the
list, wherever they stand. Each pixel should show what is nearest to the eye; but the towers that
are drawn last cover those in front of them.

OpenGL can keep the distance of what each pixel shows, and leave out what lies farther away: this is
the depth test. The window has the buffer for it, and glClear empties it in each frame; only one
line is missing, which turns the test on. Write it in place of the comment. Change nothing else.
"""
# exercise: missing_enable

import sys

import glfw
from OpenGL.GL import *

TOWERS = (  # x, z, height, colour
    (-1.6, -1.6, 2.4, (0.85, 0.35, 0.2)),
    (1.6, 1.6, 1.6, (0.95, 0.62, 0.35)),
    (1.6, -1.6, 2.0, (0.25, 0.6, 0.6)),
    (-1.6, 1.6, 1.2, (0.3, 0.5, 0.8)),
    (0, 0, 3.2, (0.95, 0.9, 0.8)),
)


def draw_box(x, y, z, width, height, depth, color):
    """Draw a box that stands on the point x, y, z. Each direction has its shade."""
    glBegin(GL_QUADS)
    for axis, shade in ((1, 1), (0, 0.8), (2, 0.6)):
        glColor3f(*(shade * channel for channel in color))
        for side in (-1, 1):
            for u, v in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                a, b, c = ((side, u, v), (u, side, v), (u, v, side))[axis]
                glVertex3f(x + a * width / 2, y + (b + 1) * height / 2, z + c * depth / 2)
    glEnd()


def draw_scene():
    draw_box(0, -0.3, 0, 5.4, 0.3, 5.4, (0.45, 0.47, 0.5))
    for x, z, height, color in TOWERS:
        draw_box(x, 0, z, 1.2, height, 1.2, color)


def make_scene():
    """Return a display list of the board and the towers."""
    scene = glGenLists(1)
    glNewList(scene, GL_COMPILE)
    draw_scene()
    glEndList()
    return scene


def on_key(window, key, scancode, action, mods):
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(640, 480, "One missing line", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    glEnable(GL_DEPTH_TEST)
    scene = make_scene()

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 50)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glTranslatef(0, -0.6, -13.5)
        glRotatef(28, 1, 0, 0)
        glRotatef(25 + 60 * glfw.get_time(), 0, 1, 0)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        glCallList(scene)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
