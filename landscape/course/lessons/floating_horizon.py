"""Floating horizon: one number a column hides what is behind hills

A terrain of lines is drawn row by row, from front to back. For each column of pixels, the horizon
is the highest pixel that the terrain has reached so far: a row farther away is visible where it is
higher, and raises the horizon. Without the test the terrain is transparent. Drawn from back to
front, far mountains hide the hills in front of them: the test compares heights only, and relies on
the order.

Keys: Space turns the test off, B draws back to front, Up and Down choose how many rows are drawn,
Left and Right move the camera.
"""
# topic: flyover
# needs: bresenham, height_field, depth_buffer
# picture: frame 1
# keys: LEFT RIGHT DOWN UP SPACE B

import sys

import glfw
import numpy as np
from OpenGL.GL import *
from text import _, write

ROWS = 84  # of the terrain
CAMERA = 70  # its height
LENS = 500  # pixels of a unit at distance 1
SLATE, CREAM, CORAL = np.array(((33, 41, 54), (245, 232, 205), (215, 82, 52)))
COLOR_MAP = np.array(
    (  # number of a row, from near to far; red, green, blue
        (0, 245, 232, 205),
        (24, 242, 165, 90),
        (48, 90, 150, 150),
        (ROWS, 52, 74, 108),
    )
)
NUMBERS = np.arange(ROWS)
DISTANCES = 70 * 1.028**NUMBERS  # of the rows from the camera
COLORS = np.stack([np.interp(NUMBERS, COLOR_MAP[:, 0], COLOR_MAP[:, n]) for n in (1, 2, 3)], 1)

across = 0
drawn = ROWS
hiding = True
backwards = False


def height(x, y):
    """Return the terrain's height x to the right of the start, and y ahead of it."""
    z = 7 * np.sin(x / 23 + np.sin(y / 31)) * np.cos(y / 29)
    for turn, length, high in (0.5, 70, 34), (2.0, 52, 26), (1.2, 17, 7), (2.7, 11, 4):
        along = np.cos(turn) * x + np.sin(turn) * y
        aside = np.cos(turn) * y - np.sin(turn) * x
        ridge = 1 - abs(np.sin(along / length + np.sin(aside / length / 1.7)))
        z += high * ridge * min(1.9, y / 180)
    return z


def project_row(away, columns):
    """Return the pixel row of the terrain at a distance, for each column and one more."""
    x = (np.arange(columns + 1) - columns / 2) * away / LENS + across
    return np.ceil(120 + (CAMERA - height(x, away)) * LENS / away).astype(int)


def pixels(line):
    """Return columns and rows of the pixels of a line: its row in each column, and in one more."""
    first = np.minimum(line[:-1], line[1:])
    last = np.maximum(line[:-1], line[1:])
    count = last - first + 1  # as far as the row of the next column, so that the line has no gaps
    column = np.repeat(np.arange(len(count)), count)
    number = np.arange(len(column)) - (np.cumsum(count) - count)[column]  # in its column
    return column, first[column] + number


def draw(columns):
    """Return the picture (480, columns, 3), how many pixels are drawn, and how many there are."""
    picture = np.full((480, columns, 3), SLATE, np.uint8)
    horizon = np.full(columns, 480)  # rows count from the top, so this is below the picture
    seen = 0
    every = 0
    order = range(drawn)
    for number in reversed(order) if backwards else order:
        line = project_row(DISTANCES[number], columns)
        column, row = pixels(line)
        in_picture = (row >= 0) & (row < 480)
        column = column[in_picture]
        row = row[in_picture]

        visible = (row < horizon[column]) | (not hiding)
        picture[row[visible], column[visible]] = COLORS[number]
        seen += visible.sum()
        every += len(row)

        last_horizon = horizon
        horizon = np.minimum.reduce((horizon, line[:-1], line[1:]))

    # Show the last comparison: what it hides, and with what it compares.
    if hiding and drawn < ROWS:
        hidden = ~visible
        picture[row[hidden], column[hidden]] = CORAL
        draw_horizon(picture, last_horizon)

    return picture, seen, every


def draw_horizon(picture, horizon):
    """Draw a line two pixels high."""
    column, row = pixels(np.append(horizon, horizon[-1]).clip(1, 479))
    picture[row - 1, column] = CREAM
    picture[row, column] = CREAM


def show(picture):
    """Load a picture into the texture, and draw it over the whole window."""
    rows, columns, _channels = picture.shape
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, columns, rows, GL_RGB, GL_UNSIGNED_BYTE, picture)
    glBegin(GL_QUADS)
    for x, y in (0, 0), (1, 0), (1, 1), (0, 1):
        glTexCoord2f(x * columns / 2048, (1 - y) * rows / 512)  # the first row is the top
        glVertex2f(2 * x - 1, 2 * y - 1)
    glEnd()


def on_key(window, key, scancode, action, mods):
    global across, drawn, hiding, backwards
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_LEFT:
        across -= 10
    elif key == glfw.KEY_RIGHT:
        across += 10
    elif key == glfw.KEY_UP:
        drawn = min(ROWS, drawn + 1)
    elif key == glfw.KEY_DOWN:
        drawn = max(2, drawn - 1)
    elif key == glfw.KEY_SPACE:
        hiding = not hiding
    elif key == glfw.KEY_B:
        backwards = not backwards
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Floating horizon"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

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
        show(picture)

        write(16, 64, "row {drawn} of {rows}", drawn=drawn, rows=ROWS)
        write(16, 40, "back to front" if backwards else "front to back")
        write(16, 16, "{seen} of {every} pixels drawn", seen=seen, every=every)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
