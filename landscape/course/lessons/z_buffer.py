"""The z-buffer by hand: a depth beside each colour

Three triangles on a grid of 16 by 12 pixels, filled by the program itself. On the left is the grid
of colours, on the right the grid of depths, from 0, near, to 9, far. For each pixel of each
triangle the depth is compared with what is there: a nearer one replaces colour and depth, a farther
one is dropped. So the triangles may come in any order, and may even cut each other. This is what
OpenGL does with GL_DEPTH_TEST.

Keys: Left and Right take a triangle away and add it; Space draws them in the opposite order; T
leaves out the test.
"""
# topic: shapes
# needs: orientation
# picture: frame 0
# keys: LEFT RIGHT SPACE T

import sys

import glfw
from OpenGL.GL import *
from text import _, write

COLUMNS, ROWS = 16, 12
TRIANGLES = (  # three vertices of x, y and depth each, and a colour
    (((1, 1, 1.5), (15, 2, 9), (5, 11.5, 5)), (0.85, 0.35, 0.2)),
    (((1, 6, 8), (14.5, 0.5, 1), (15, 9, 2)), (0.25, 0.6, 0.6)),
    (((2, 11, 3), (8, 0.5, 3), (15, 11.5, 3)), (0.95, 0.72, 0.4)),
)
BACKGROUND = (0.2, 0.24, 0.3)
FAR = 9.9
count = 3
reverse = False
tested = True


def area(a, b, c):
    """Return twice the area of a triangle; positive if it goes counter-clockwise."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])


def fill(colors, depths, corners, color):
    """Fill a triangle: visit the pixels, and write those that pass the test."""
    a, b, c = corners
    whole = area(a, b, c)
    for row in range(ROWS):
        for column in range(COLUMNS):
            middle = (column + 0.5, row + 0.5)
            # How much each corner counts here: the part of the area opposite to it.
            parts = (
                area(b, c, middle) / whole,
                area(c, a, middle) / whole,
                area(a, b, middle) / whole,
            )
            if min(parts) < 0:
                continue  # outside
            depth = sum(part * corner[2] for part, corner in zip(parts, corners, strict=True))
            if depth < depths[row][column] or not tested:
                colors[row][column] = color
                depths[row][column] = depth


def make_picture():
    """Return the colours and the depths, a list for each row."""
    colors = [[BACKGROUND] * COLUMNS for _row in range(ROWS)]
    depths = [[FAR] * COLUMNS for _row in range(ROWS)]
    chosen = TRIANGLES[:count]
    for corners, color in reversed(chosen) if reverse else chosen:
        fill(colors, depths, corners, color)
    return colors, depths


def draw_pixel(column, row, color):
    """Draw a pixel of the grid as a square, with a gap around it."""
    glColor3f(*color)
    glRectf(column + 0.04, row + 0.04, column + 0.96, row + 0.96)


def draw_colors(colors):
    for row in range(ROWS):
        for column in range(COLUMNS):
            draw_pixel(column, row, colors[row][column])
    write(0, 8, "colours", (0.95, 0.9, 0.8), at=(0, ROWS, 0))


def draw_depths(depths):
    """Draw the depths as shades of grey, and write them into the pixels of triangles."""
    for row in range(ROWS):
        for column in range(COLUMNS):
            depth = depths[row][column]
            shade = 0.95 - 0.085 * depth
            draw_pixel(column, row, (shade, shade, shade))
            if depth < FAR:
                ink = (0, 0, 0) if shade > 0.5 else (1, 1, 1)
                middle = (column + 0.5, row + 0.5, 0)
                write(-5, -10, "{digit}", ink, at=middle, digit=int(depth))
    write(0, 8, "depths", (0.95, 0.9, 0.8), at=(0, ROWS, 0))


def set_grid(left, bottom, width, height):
    """Let a viewport show the grid, with half a pixel beside it."""
    glViewport(left, bottom, width, height)
    glLoadIdentity()
    tall = (COLUMNS + 1) * height / width
    glOrtho(-0.5, COLUMNS + 0.5, (ROWS - tall) / 2, (ROWS + tall) / 2, -1, 1)


def draw(width, height):
    colors, depths = make_picture()
    bottom = int(90 * (height // 480 or height / 480))  # above the text
    half = width // 2
    set_grid(0, bottom, half, height - bottom)
    draw_colors(colors)
    set_grid(half, bottom, half, height - bottom)
    draw_depths(depths)

    glViewport(0, 0, width, height)
    write(16, 64, "{count} triangles", count=count)
    write(16, 40, "the last one first" if reverse else "the first one first")
    write(16, 16, "the nearer one wins" if tested else "no test: the later one wins")


def on_key(window, key, scancode, action, mods):
    global count, reverse, tested
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_LEFT:
        count = max(0, count - 1)
    elif key == glfw.KEY_RIGHT:
        count = min(3, count + 1)
    elif key == glfw.KEY_SPACE:
        reverse = not reverse
    elif key == glfw.KEY_T:
        tested = not tested
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("The z-buffer by hand"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)

    while not glfw.window_should_close(window):
        glClear(GL_COLOR_BUFFER_BIT)
        draw(*glfw.get_framebuffer_size(window))
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
