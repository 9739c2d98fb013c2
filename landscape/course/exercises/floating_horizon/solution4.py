"""Floating horizon: hills behind hills

A terrain is drawn as lines, row by row, the nearest row first. rows holds a pair (low, high) for
each of them: its line covers the heights low[x] to high[x], both included, of column x. Heights are
counted in pixels from the lower edge of the picture, from 0 up, and may lie above the picture. As
yet all lines are drawn, and the terrain is transparent.

Let draw_terrain draw only what is seen. A pixel is seen if it lies higher than everything that the
nearer rows have in its column, whether that is in the picture or above it; at the same height, the
nearer row stays. So no z buffer is needed, only one height for each column: the horizon. Compare
each line with it, and raise it by the line.

Change only draw_terrain. plot leaves out pixels that are not in the picture. Rows have the colors
of COLORS, from cream in front to blue far away.

Keys: Left and Right move the hills.
"""
# exercise: floating_horizon

import sys

import glfw
import numpy as np
from OpenGL.GL import *

WIDTH = 80  # of the picture; each of its pixels covers several of the window's
HEIGHT = 60
SIDE = 128  # of the texture: a power of two
BACKGROUND = 33, 41, 53
ROWS = 22
NEAR = np.array((250, 230, 190))
FAR = np.array((40, 104, 169))
COLORS = [NEAR + (FAR - NEAR) * row // (ROWS - 1) for row in range(ROWS)]
moved = 0


def make_rows():
    """Return the lines of the terrain, the nearest first: low and high, in each column."""
    x = np.arange(WIDTH + 1)
    rows = []
    for row in range(ROWS):
        ground = 2.0 * row + 6 - 22 * (row == 12) + 5 * np.sin(0.11 * (x + moved) + 0.45 * row)
        peak = 75 * np.exp(-(((x + moved - 22) / 5.5) ** 2) - (row - 5) ** 2 / 3)
        hill = 22 * np.exp(-(((x + moved - 58) / 9) ** 2) - (row - 9) ** 2 / 8)
        line = np.round(ground + peak + hill).astype(int)
        # Each column also covers the step to the next one, so that a line has no gaps.
        rows.append((np.minimum(line[:-1], line[1:]), np.maximum(line[:-1], line[1:])))
    return rows


def plot(picture, column, height, row):
    """Give a pixel the color of a row, if it is in the picture."""
    if 0 <= height < HEIGHT:
        picture[height, column] = COLORS[row]


def draw_terrain(picture, rows):
    """Draw from the farthest row to the nearest: each covers all below it in the picture."""
    for row, (low, high) in reversed(list(enumerate(rows))):
        for x in range(WIDTH):
            picture[: max(high[x] + 1, 0), x] = BACKGROUND
            for height in range(low[x], high[x] + 1):
                plot(picture, x, height, row)


def draw():
    picture = np.full((HEIGHT, WIDTH, 3), BACKGROUND, np.uint8)
    draw_terrain(picture, make_rows())
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, WIDTH, HEIGHT, GL_RGB, GL_UNSIGNED_BYTE, picture)
    glBegin(GL_QUADS)
    for x, y in ((0, 0), (1, 0), (1, 1), (0, 1)):
        glTexCoord2f(x * WIDTH / SIDE, y * HEIGHT / SIDE)
        glVertex2f(2 * x - 1, 2 * y - 1)  # the picture's first row is at the bottom
    glEnd()


def on_key(window, key, scancode, action, mods):
    global moved
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_LEFT:
        moved -= 6
    elif key == glfw.KEY_RIGHT:
        moved += 6
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(320, 240, "Hills behind hills", None, None)
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
        draw()
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
