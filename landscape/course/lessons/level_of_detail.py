"""Level of detail: nested grids that glide into each other

Near the pole, the terrain has a vertex every 3 units, then every 6, 12 and 24. Before a grid ends,
its odd vertices glide to even ones, which the next grid has, too: the two fit, and while the pole
moves, nothing jumps. Without this morph, cracks gape between a grid and the next (coral).

Keys: Space turns the morph off, Left and Right turn the terrain, Up and Down tilt it.
"""
# topic: flyover
# needs: quad_tree, back_faces
# picture: frame 30
# loop: 360 frames
# keys: LEFT RIGHT UP DOWN SPACE

import sys

import glfw
import numpy as np
from OpenGL.GL import *
from text import _, write

N = 10  # steps of a grid from its middle to each side
STEP = 3  # the finest grid's; each grid has steps twice as long as the one before
HALF = 144  # half of the terrain's side
COLORS = np.array(((245, 232, 205), (242, 158, 70), (80, 180, 172), (112, 150, 220)))  # of grids
CORAL = (255, 84, 50)
BACKGROUND = (33, 41, 54)

turn = 30
tilt = 42
morphing = True


def height(x, y):
    """Return the terrain's height."""
    hills = 14 * np.sin(x / 31 + np.sin(y / 33)) * np.cos(y / 29 + x / 70)
    return hills + 7 * np.sin(x / 7.3 + y / 19) * np.sin(y / 7.9 - x / 23)


def grid_edges():
    """Return the edges of a grid, (2, n): the numbers of their starts and of their ends."""
    number = np.arange((2 * N + 1) ** 2).reshape(2 * N + 1, -1)  # of each vertex
    starts = np.append(number[:-1], number[:, :-1])
    ends = np.append(number[1:], number[:, 1:])
    return np.array((starts, ends))


def grid_cracks():
    """Return the sides of the triangles that may gape at a grid's border, as edges (2, n).

    An odd vertex of the border has a neighbour before it and one after it, which the next grid
    has, too, but without the odd one between them.
    """
    number = np.arange((2 * N + 1) ** 2).reshape(2 * N + 1, -1)
    borders = np.stack((number[0], number[-1], number[:, 0], number[:, -1]))
    before = borders[:, :-1:2].ravel()
    odd = borders[:, 1::2].ravel()
    after = borders[:, 2::2].ravel()
    starts = np.concatenate((before, odd, before))
    ends = np.concatenate((odd, after, after))
    return np.array((starts, ends))


EDGES = grid_edges()
CRACKS = grid_cracks()


def vertices(focus, middle, step):
    """Return the places (n, 2) of a grid's vertices, and their x, y and z after the morph."""
    row, column = np.indices((2 * N + 1, 2 * N + 1)).reshape(2, -1) - N
    index = np.stack((column, row), 1)
    place = middle + step * index
    even_place = middle + step * (index - index % 2)

    # From 0 near the pole to 1 before the border.
    distance = abs(place - focus).max(1)
    weight = np.clip((distance - 0.6 * N * step) / (0.3 * N * step), 0, 1)
    weight = weight[:, np.newaxis] * morphing

    here = np.column_stack((place, height(*place.T)))
    there = np.column_stack((even_place, height(*even_place.T)))
    return place, (1 - weight) * here + weight * there


def project(points, columns):
    """Return the pixels (2, n), columns and rows, of points (n, 3), in perspective."""
    x, y, z = points.T
    angle = np.radians(turn)
    down = np.radians(tilt)
    right = np.cos(angle) * x - np.sin(angle) * y
    forward = np.sin(angle) * x + np.cos(angle) * y
    away = 700 + np.cos(down) * forward - np.sin(down) * z  # the camera is 700 units off
    up = np.sin(down) * forward + np.cos(down) * z
    return np.ceil((columns / 2 + 1040 * right / away, 232 - 1040 * up / away)).astype(int)


def line_pixels(start, end):
    """Return the pixels (2, m) of lines between pixels (2, n), and which line each belongs to.

    The lesson bresenham shows how: one pixel per step along the longer side.
    """
    length = np.maximum(1, abs(end - start).max(0))
    line = np.repeat(np.arange(len(length)), length + 1)
    first = np.cumsum(length + 1) - length - 1  # the number of each line's first pixel
    k = np.arange(len(line)) - first[line]
    pixels = start[:, line] + (2 * k * (end - start)[:, line] // length[line] + 1) // 2
    return pixels, line


def draw_lines(picture, points, edges, color):
    """Draw lines between points (n, 3), the higher they start the brighter."""
    rows, columns, _channels = picture.shape
    pixels = project(points, columns)
    (column, row), line = line_pixels(pixels[:, edges[0]], pixels[:, edges[1]])
    on_screen = (column >= 0) & (column < columns) & (row >= 0) & (row < rows)
    z = points[edges[0][line[on_screen]], 2]
    light = np.clip(0.75 + 0.016 * z, 0, 1)
    picture[row[on_screen], column[on_screen]] = light[:, np.newaxis] * color


def draw(columns, now):
    """Return the picture, and how many lines there are."""
    picture = np.full((480, columns, 3), BACKGROUND, np.uint8)
    angle = np.radians(60 * now)
    focus = 60 * np.array((np.cos(angle), np.sin(angle)))  # the place of the pole

    # From the finest grid outwards; each has a hole where the one before it is.
    lines = 0
    hole_middle = focus
    hole_reach = -1  # the finest one has none
    for level, color in enumerate(COLORS):
        step = STEP * 2**level
        middle = 2 * step * np.round(focus / (2 * step))  # a vertex of the next grid, too
        place, points = vertices(focus, middle, step)
        in_hole = (abs(place - hole_middle) <= hole_reach).all(1)
        outside = (abs(place) > HALF).any(1)
        shown = EDGES[:, ~in_hole[EDGES].all(0) & ~outside[EDGES].any(0)]
        draw_lines(picture, points, shown, color)
        if not morphing:
            draw_lines(picture, points, CRACKS[:, ~outside[CRACKS].any(0)], CORAL)
        lines += shown.shape[1]
        hole_middle = middle
        hole_reach = N * step

    foot = height(*focus)
    pole = np.array([(*focus, foot), (*focus, foot + 60)])
    draw_lines(picture, pole, np.array([[1], [0]]), COLORS[0])
    return picture, lines


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
    global turn, tilt, morphing
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_LEFT:
        turn -= 5
    elif key == glfw.KEY_RIGHT:
        turn += 5
    elif key == glfw.KEY_UP:
        tilt = min(85, tilt + 5)
    elif key == glfw.KEY_DOWN:
        tilt = max(25, tilt - 5)
    elif key == glfw.KEY_SPACE:
        morphing = not morphing
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Level of detail"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glEnable(GL_TEXTURE_2D)
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 2048, 512, 0, GL_RGB, GL_UNSIGNED_BYTE, bytes(3 << 20))
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR)

    squares = 2 * HALF // STEP  # a side, if the finest grid covered everything
    every = 2 * squares * (squares + 1)
    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        columns = min(2048, 480 * width // height // 4 * 4)
        picture, lines = draw(columns, glfw.get_time())
        show(picture)

        write(16, 40, "levels glide into each other" if morphing else "no morph")
        write(16, 16, "{lines} of {every} lines", lines=lines, every=every)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
