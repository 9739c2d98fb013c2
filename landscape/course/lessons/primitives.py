"""Primitives: ten ways to draw the same vertices

The argument of glBegin says what is made of the vertices: points, lines, triangles, quads or one
polygon. All ten kinds get the same numbered vertices here. Their order decides: around the outline
it suits the loop, the fan and the polygon; in zigzag it suits the strips. With the other order,
shapes cross themselves. What is left over, as a single vertex of a line, is not drawn.

Keys: Left and Right change the number of vertices; Space changes their order.
"""
# topic: shapes
# needs: triangle, viewport
# picture: frame 1 after RIGHT
# keys: LEFT RIGHT SPACE

import math
import sys

import glfw
from OpenGL.GL import *
from text import _, write

KINDS = (  # each with its name and its place in the grid
    (GL_POINTS, "POINTS", 0, 2),
    (GL_LINES, "LINES", 1, 2),
    (GL_LINE_STRIP, "LINE_STRIP", 2, 2),
    (GL_LINE_LOOP, "LINE_LOOP", 3, 2),
    (GL_TRIANGLES, "TRIANGLES", 0, 1),
    (GL_TRIANGLE_STRIP, "TRIANGLE_STRIP", 1, 1),
    (GL_TRIANGLE_FAN, "TRIANGLE_FAN", 2, 1),
    (GL_POLYGON, "POLYGON", 3, 1),
    (GL_QUADS, "QUADS", 2, 0),
    (GL_QUAD_STRIP, "QUAD_STRIP", 3, 0),
)
# From left to right, below and above in turn; -1 to 1.
ZIGZAG = (
    *((-1, -0.4), (-1, 0.4), (-0.4, -1), (-0.4, 1)),
    *((0.4, -1), (0.4, 1), (1, -0.4), (1, 0.4)),
)
AROUND = [ZIGZAG[number] for number in (0, 2, 4, 6, 7, 5, 3, 1)]
count = 7
around = True


def draw_kind(kind, vertices):
    """Draw one kind: its faces, and lines and points over them."""
    for mode, color in ((GL_FILL, (0.2, 0.45, 0.5)), (GL_LINE, (0.95, 0.62, 0.35))):
        glPolygonMode(GL_FRONT_AND_BACK, mode)
        glColor3f(*color)
        glBegin(kind)
        for x, y in vertices:
            glVertex2f(x, y)
        glEnd()
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL)


def write_numbers(vertices, x, y):
    """Write the number of each vertex outside it, seen from the middle x, y."""
    for number, (u, v) in enumerate(vertices):
        out = 1 + 13 / math.hypot(u - x, v - y)
        write(x + out * (u - x) - 5, y + out * (v - y) - 10, "{number}", number=number)


def draw():
    width, height = glfw.get_framebuffer_size(glfw.get_current_context())
    scale = height // 480 or height / 480  # of the pixels that write counts in
    glPointSize(height / 80)
    glLineWidth(height / 240)
    across = width / 4 / scale  # a cell of the grid, as write counts
    up = height / 3 / scale
    for kind, name, column, row in KINDS:
        glViewport(column * width // 4, row * height // 3, width // 4, height // 3)
        glLoadIdentity()
        glOrtho(0, across, 0, up, -1, 1)
        # An outline in the middle of the cell, above its name, with room for the numbers.
        x = across / 2
        y = up / 2 + 10
        right = across / 2 - 24
        top = up / 2 - 36
        order = AROUND if around else ZIGZAG
        vertices = [(x + u * right, y + v * top) for u, v in order[:count]]
        draw_kind(kind, vertices)
        write_numbers(vertices, x, y)
        write(x - 5 * len(name), 4, "{name}", (0.95, 0.9, 0.8), name=name)

    glViewport(0, 0, width, height)
    write(16, 40, "{count} vertices", count=count)
    write(16, 16, "around" if around else "zigzag")


def on_key(window, key, scancode, action, mods):
    global count, around
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_LEFT:
        count = max(1, count - 1)
    elif key == glfw.KEY_RIGHT:
        count = min(8, count + 1)
    elif key == glfw.KEY_SPACE:
        around = not around
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Primitives"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)

    while not glfw.window_should_close(window):
        glClear(GL_COLOR_BUFFER_BIT)
        draw()
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
