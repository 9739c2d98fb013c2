"""A quad-tree: tiles of a map that a camera sees

A map of 64 x 64, and on it the wedge that a camera sees. What is to be drawn are tiles, squares
that the wedge meets; as yet it is the whole map.

visible(x, y, size) returns the tiles that are to be drawn of the square at x, y: a list of triples
x, y, size. Let it ask first where the square lies, by look(x, y, size). If that returns OUTSIDE,
nothing is to be drawn. If it returns INSIDE, the square itself is the tile. If it returns ACROSS,
the border of the wedge may cross it: then the square is divided into four of half the size, and
each of them is treated in the same way; but squares of the size SMALLEST are not divided, they are
tiles.

look is expensive: it is called once for each square that is treated, and for no other one. Under
the map a dot is lit for each call.

OpenGL only shows the picture. Change only visible.

Keys: Left and Right turn the camera.
"""
# exercise: quad_tree

import sys

import glfw
import numpy as np
from OpenGL.GL import *

WIDTH = 64  # of the picture; each of its pixels covers several of the window's
HEIGHT = 72
SIDE = 128  # of the texture: a power of two
BACKGROUND = (26, 32, 42)
DOT = (242, 240, 230)
MAP = 64
SMALLEST = 4
COLORS = {  # of the tiles, by their size
    64: (120, 110, 190),
    32: (80, 130, 200),
    16: (70, 160, 150),
    8: (150, 180, 90),
    4: (225, 160, 70),
}
OUTSIDE = "outside"
INSIDE = "inside"
ACROSS = "across"
turned = 10
calls = 0


def look(x, y, size):
    """Return whether a square is OUTSIDE of what the camera sees, INSIDE, or ACROSS its border."""
    global calls
    calls += 1
    corners = [(x + i * size, y + j * size, 1) for i in (0, 1) for j in (0, 1)]
    angles = np.radians((turned - 28, turned + 28, turned))
    cos = np.cos(angles)
    sin = np.sin(angles)
    # Two sides through the camera at (5, 30), and the end of the view: positive within.
    borders = np.array(
        (
            (-sin[0], cos[0], 5 * sin[0] - 30 * cos[0]),
            (sin[1], -cos[1], 30 * cos[1] - 5 * sin[1]),
            (-cos[2], -sin[2], 5 * cos[2] + 30 * sin[2] + 52),
        )
    )
    within = np.array(corners) @ borders.T >= 0
    if not within.any(axis=0).all():
        return OUTSIDE
    return INSIDE if within.all() else ACROSS


def visible(x, y, size):
    """Return the tiles that are to be drawn of a square, each as x, y, size."""
    where = look(x, y, size)
    if where == ACROSS and size > SMALLEST:
        half = size // 2
        for number in range(4):
            yield from visible(x + half * (number % 2), y + half * (number // 2), half)
    elif where != OUTSIDE:
        yield x, y, size


def make_picture():
    global calls
    picture = np.full((HEIGHT, WIDTH, 3), BACKGROUND, np.uint8)
    calls = 0
    for x, y, size in visible(0, 0, MAP):
        picture[y : y + size, x : x + size] = np.array(COLORS.get(size, DOT)) // 2
        picture[y : y + size - 1, x : x + size - 1] = COLORS.get(size, DOT)
    dots = picture[MAP + 2 :].reshape(-1, 3)
    dots[:calls] = DOT
    return picture


def draw(picture):
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, WIDTH, HEIGHT, GL_RGB, GL_UNSIGNED_BYTE, picture)
    glBegin(GL_QUADS)
    for x, y in ((0, 0), (1, 0), (1, 1), (0, 1)):
        glTexCoord2f(x * WIDTH / SIDE, y * HEIGHT / SIDE)
        glVertex2f(2 * x - 1, 1 - 2 * y)  # the picture's first row is at the top
    glEnd()


def on_key(window, key, scancode, action, mods):
    global turned
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_LEFT:
        turned -= 20
    elif key == glfw.KEY_RIGHT:
        turned += 20
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(320, 360, "Tiles of a map", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glEnable(GL_TEXTURE_2D)
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, SIDE, SIDE, 0, GL_RGB, GL_UNSIGNED_BYTE, None)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST)

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glClear(GL_COLOR_BUFFER_BIT)
        draw(make_picture())
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
