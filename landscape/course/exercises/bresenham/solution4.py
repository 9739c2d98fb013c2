"""Bresenham: a fan of lines, pixel by pixel

segment(x0, y0, x1, y1) returns the pixels of a line from (x0, y0) to (x1, y1), as pairs (x, y) of
whole numbers; x is the column of the picture, counted from the left, and y the row, counted from
the top. As yet these are only the two ends.

Let it return all pixels of the line, in order: the first is (x0, y0), the last (x1, y1). A line
that is wider than it is high has one pixel in each of its columns, in the row nearest to the line;
one that is higher than it is wide has one pixel in each of its rows, in the nearest column. Lines
lead in all directions; the one in the middle begins and ends in the same pixel.

Change only segment. Bresenham's algorithm of 1965 needs only additions and comparisons of whole
numbers; any other way that finds these pixels is right as well. A pixel is amber at a line's
beginning and blue at its end, and it is brighter if it is returned twice. Pixels that are not in
the picture are left out.

Keys: Space draws each line from its other end.
"""
# exercise: bresenham

import sys

import glfw
import numpy as np
from OpenGL.GL import *

WIDTH = 64  # of the picture; each of its pixels covers many of the window's
HEIGHT = 48
SIDE = 64  # of the texture: a power of two
BACKGROUND = 33, 41, 53
AMBER = np.array((190, 95, 15))  # what a pixel adds
BLUE = np.array((10, 80, 170))
CENTER = 32, 24
# Where the lines of a quarter of the fan begin and end, to the right of its center and below it.
QUARTER = (
    ((7, 0), (30, 0)),
    ((7, 2), (30, 7)),
    ((7, 4), (30, 18)),
    ((6, 6), (23, 23)),
    ((4, 6), (15, 23)),
    ((2, 6), (6, 23)),
    ((0, 6), (0, 23)),
)
inward = False


def segment(x0, y0, x1, y1):
    """Return the pixels of a line, pairs (x, y), in order: one error for both directions."""
    dx = abs(x1 - x0)
    dy = -abs(y1 - y0)
    step_x = (x1 > x0) - (x1 < x0)
    step_y = (y1 > y0) - (y1 < y0)
    error = dx + dy
    pixels = [(x0, y0)]
    while (x0, y0) != (x1, y1):
        twice = 2 * error
        if twice >= dy:
            error += dy
            x0 += step_x
        if twice <= dx:
            error += dx
            y0 += step_y
        pixels.append((x0, y0))
    return pixels


def make_lines():
    """Return the lines of the fan, each as x0, y0, x1, y1."""
    x, y = CENTER
    lines = [(x, y, x, y)]
    for right, down in ((1, 1), (1, -1), (-1, 1), (-1, -1)):
        for (x0, y0), (x1, y1) in QUARTER:
            line = x + right * x0, y + down * y0, x + right * x1, y + down * y1
            if line not in lines:
                lines.append(line)
    return lines


def make_picture():
    picture = np.full((HEIGHT, WIDTH, 3), BACKGROUND)
    for x0, y0, x1, y1 in make_lines():
        pixels = list(segment(x1, y1, x0, y0) if inward else segment(x0, y0, x1, y1))
        for number, (x, y) in enumerate(pixels):
            if 0 <= x < WIDTH and 0 <= y < HEIGHT:
                part = number / max(len(pixels) - 1, 1)  # 0 at the beginning, 1 at the end
                picture[y, x] += ((1 - part) * AMBER + part * BLUE).astype(int)
    return picture.clip(0, 255).astype(np.uint8)


def draw(picture):
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, WIDTH, HEIGHT, GL_RGB, GL_UNSIGNED_BYTE, picture)
    glBegin(GL_QUADS)
    for x, y in ((0, 0), (1, 0), (1, 1), (0, 1)):
        glTexCoord2f(x * WIDTH / SIDE, y * HEIGHT / SIDE)
        glVertex2f(2 * x - 1, 1 - 2 * y)  # the picture's first row is at the top
    glEnd()


def on_key(window, key, scancode, action, mods):
    global inward
    if action == glfw.PRESS and key == glfw.KEY_SPACE:
        inward = not inward
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(320, 240, "A fan of lines", None, None)
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
