"""Floating horizon: one number a column hides what is behind hills

A terrain of lines is drawn row by row, from front to back. For each column of pixels, the horizon
is the highest one that the terrain has reached there: a row farther away is seen where it is higher
than that, and raises it. Without the test the terrain is transparent. Drawn from back to front, far
mountains hide the hills in front of them: the test knows heights, and takes the order for granted.

Keys: Space turns the test off, B draws back to front, Up and Down choose how many rows are drawn,
Left and Right move the camera.
"""
# topic: flyover
# needs: bresenham, height_field, depth_buffer
# picture: frame 1
# keys: LEFT RIGHT DOWN UP SPACE B

import glfw
import numpy as np
from OpenGL.GL import *
from text import _, write

ROWS, CAMERA, LENS = 84, 70, 500  # rows; the camera's height; pixels of a unit at distance 1
SLATE, CREAM, CORAL = np.array(((33, 41, 54), (245, 232, 205), (215, 82, 52)))
SHADES = (245, 242, 90, 52), (232, 165, 150, 74), (205, 90, 150, 108)  # red, green, blue; near, far
distances = 70 * 1.028 ** np.arange(ROWS)  # of the rows from the camera
colors = np.stack([np.interp(np.arange(ROWS), (0, 24, 48, ROWS), each) for each in SHADES], 1)
across = 0
drawn = ROWS
hiding = True
backwards = False


def height(x, y):
    """Return the terrain's height x to the right of the start, and y ahead of it."""
    z = 7 * np.sin(x / 23 + np.sin(y / 31)) * np.cos(y / 29)
    for turn, length, high in (0.5, 70, 34), (2.0, 52, 26), (1.2, 17, 7), (2.7, 11, 4):
        along, aside = np.cos(turn) * x + np.sin(turn) * y, np.cos(turn) * y - np.sin(turn) * x
        ridge = 1 - abs(np.sin(along / length + np.sin(aside / length / 1.7)))
        z += high * ridge * min(1.9, y / 180)
    return z


def pixels(line):
    """Return columns and rows of the pixels of a line: its row in each column, and in one more."""
    first, last = np.minimum(line[:-1], line[1:]), np.maximum(line[:-1], line[1:])
    count = last - first + 1  # as far as the row of the next column, so that the line has no gaps
    column = np.repeat(np.arange(len(count)), count)
    return column, first[column] + np.arange(len(column)) - (np.cumsum(count) - count)[column]


def draw(columns):
    """Return the picture (480, columns, 3), how many pixels are drawn, and how many there are."""
    picture = np.full((480, columns, 3), SLATE, np.uint8)
    horizon = np.full(columns, 480)  # rows count from the top, so this is below the picture
    order = range(drawn)
    seen = 0
    every = 0
    for number in reversed(order) if backwards else order:
        away = distances[number]
        x = (np.arange(columns + 1) - columns / 2) * away / LENS + across
        line = np.ceil(120 + (CAMERA - height(x, away)) * LENS / away).astype(int)
        column, row = pixels(line)
        on = (row >= 0) & (row < 480)
        column, row = column[on], row[on]
        visible = (row < horizon[column]) | (not hiding)
        picture[row[visible], column[visible]] = colors[number]
        seen = seen + visible.sum()
        every = every + len(row)
        before = horizon
        horizon = np.minimum.reduce((horizon, line[:-1], line[1:]))

    if hiding and drawn < ROWS:  # show the last comparison: what is hidden, and the horizon
        picture[row[~visible], column[~visible]] = CORAL
        column, row = pixels(np.append(before, before[-1]).clip(1, 479))
        picture[row - 1, column] = picture[row, column] = CREAM

    return picture, seen, every


def on_key(window, key, scancode, action, mods):
    global across, drawn, hiding, backwards
    if action != glfw.RELEASE:
        across += 10 * ((key == glfw.KEY_RIGHT) - (key == glfw.KEY_LEFT))
        drawn = min(ROWS, max(2, drawn + (key == glfw.KEY_UP) - (key == glfw.KEY_DOWN)))
        hiding ^= key == glfw.KEY_SPACE
        backwards ^= key == glfw.KEY_B
        glfw.set_window_should_close(window, key == glfw.KEY_ESCAPE)


def main():
    glfw.init()
    window = glfw.create_window(640, 480, _("Floating horizon"), None, None)
    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glEnable(GL_TEXTURE_2D)
    empty = np.full((512, 2048, 3), SLATE, np.uint8)
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 2048, 512, 0, GL_RGB, GL_UNSIGNED_BYTE, empty)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR)
    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        columns = min(2048, 480 * width // height // 4 * 4)
        picture, seen, every = draw(columns)
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, columns, 480, GL_RGB, GL_UNSIGNED_BYTE, picture)
        glBegin(GL_QUADS)
        for x, y in (0, 0), (1, 0), (1, 1), (0, 1):
            glTexCoord2f(x * columns / 2048, (1 - y) * 480 / 512)  # the first row is the top
            glVertex2f(2 * x - 1, 2 * y - 1)
        glEnd()
        write(16, 64, "row {drawn} of {rows}", drawn=drawn, rows=ROWS)
        write(16, 40, "back to front" if backwards else "front to back")
        write(16, 16, "{seen} of {every} pixels drawn", seen=seen, every=every)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
