"""A second viewport: a map of the maze

A maze seen from the entrance, and a red ball somewhere in it. A map will help. Fill in draw_map:

The map is a square. Its side is a third of the window's height (height // 3), and its lower left
corner is 16 pixels from the left and from the lower edge of the window. Its background is PAPER,
and nothing of the large picture remains in the square, neither its colours nor its depths:
glClear does that, within the scissor box. Then draw_maze draws the maze seen from straight above,
without perspective: x goes from -6 at the left edge to 6 at the right one, z from -6 at the upper
edge to 6 at the lower one, and higher things hide lower ones. The walls are one unit high.

After the map, everything is as it was before: draw_frame, which follows, draws a frame around the
whole window, and the next picture begins as the first one did.

Keys: Left and Right turn. Resize the window: the map keeps its place and its proportions.
"""
# exercise: second_viewport

import math
import sys

import glfw
from OpenGL.GL import *

PAPER = (0.95, 0.9, 0.8, 1)
MAZE = (
    "############",
    "#  #      ##",
    "#    ####  #",
    "#### #  ## #",
    "#    #   # #",
    "# ####   # #",
    "# #    ### #",
    "#   ##   # #",
    "# #  ### # #",
    "# ##     # #",
    "#  #  #    #",
    "#####  #####",
)
turn = 12  # degrees


def draw_box(x, z, height, color):
    """Draw a box of 1 x 1 units. Each direction has its shade."""
    glBegin(GL_QUADS)
    for axis, shade in ((1, 1), (0, 0.8), (2, 0.6)):
        glColor3f(*(shade * channel for channel in color))
        for side in (0, 1):
            for u, v in ((0, 0), (1, 0), (1, 1), (0, 1)):
                a, b, c = ((side, u, v), (u, side, v), (u, v, side))[axis]
                glVertex3f(x + a, b * height, z + c)
    glEnd()


def draw_maze():
    for row, line in enumerate(MAZE):
        for column, letter in enumerate(line):
            if letter == "#":
                draw_box(column - 6, row - 6, 1, (0.3, 0.55, 0.42))
    for step in range(6):  # a ball of rings
        glColor3f(0.95 - 0.09 * step, 0.32 - 0.03 * step, 0.2)
        glBegin(GL_QUAD_STRIP)
        for side in range(17):
            for polar in (math.pi * step / 6, math.pi * (step + 1) / 6):
                angle = math.pi * side / 8
                r = 0.4 * math.sin(polar)
                x = 0.5 + r * math.cos(angle)
                z = -1.5 + r * math.sin(angle)
                glVertex3f(x, 0.4 + 0.4 * math.cos(polar), z)
        glEnd()


def draw_map(width, height):
    """Draw the map in its corner, in a window of width x height pixels."""
    side = height // 3
    glViewport(16, 16, side, side)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    draw_paper()
    glMatrixMode(GL_PROJECTION)
    glOrtho(-6, 6, -6, 6, -2, 2)
    glMatrixMode(GL_MODELVIEW)
    glRotatef(90, 1, 0, 0)
    draw_maze()
    glViewport(0, 0, width, height)


def draw_paper():
    """Fill the viewport, and make it as far away as can be, whatever is there."""
    glDepthFunc(GL_ALWAYS)
    glDepthRange(1, 1)
    glColor3f(*PAPER[:3])
    glRectf(-1, -1, 1, 1)
    glDepthRange(0, 1)
    glDepthFunc(GL_LESS)


def draw_frame():
    """Draw a frame around the window."""
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glDisable(GL_DEPTH_TEST)
    glColor3f(0.95, 0.62, 0.35)
    glBegin(GL_TRIANGLE_STRIP)
    for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1), (-1, -1)):
        glVertex2f(x, y)
        glVertex2f(0.98 * x, 0.98 * y)
    glEnd()
    glEnable(GL_DEPTH_TEST)


def on_key(window, key, scancode, action, mods):
    global turn
    if key in (glfw.KEY_LEFT, glfw.KEY_RIGHT) and action != glfw.RELEASE:
        turn += 8 if key == glfw.KEY_RIGHT else -8
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(640, 480, "A map of the maze", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    glEnable(GL_DEPTH_TEST)

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 0.5, 50)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glTranslatef(0, -1.2, -9)
        glRotatef(30, 1, 0, 0)
        glRotatef(turn, 0, 1, 0)
        draw_maze()
        draw_map(width, height)
        draw_frame()
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
