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

import glfw
import numpy as np
from OpenGL.GL import *
from text import _, write

N, HALF, CORAL = 10, 144, (255, 84, 50)  # steps of a grid to each side; half of the terrain's side
COLORS = np.array(((245, 232, 205), (242, 158, 70), (80, 180, 172), (112, 150, 220)))
turn = 30
tilt = 42
morphing = True
number = np.arange((2 * N + 1) ** 2).reshape(2 * N + 1, -1)  # of each vertex of a grid
edges = np.append(number[:-1], number[:, :-1]), np.append(number[1:], number[:, 1:])
sides = np.stack((number[0], number[-1], number[:, 0], number[:, -1]))
before = sides[:, :-1:2]
odd = sides[:, 1::2]
after = sides[:, 2::2]
edges, cracks = np.array(edges), np.array(((before, odd, before), (odd, after, after)))


def height(x, y):
    """Return the terrain's height."""
    hills = 14 * np.sin(x / 31 + np.sin(y / 33)) * np.cos(y / 29 + x / 70)
    return hills + 7 * np.sin(x / 7.3 + y / 19) * np.sin(y / 7.9 - x / 23)


def vertices(focus, middle, step):
    """Return the places (n, 2) of a grid's vertices, and their x, y and z after the morph."""
    index = np.indices((2 * N + 1, 2 * N + 1))[::-1].reshape(2, -1).T - N
    place, even = middle + step * index, middle + step * (index - index % 2)
    distance = abs(place - focus).max(1)
    weight = np.clip((distance - 0.6 * N * step) / (0.3 * N * step), 0, 1)[:, None] * morphing
    here, there = (np.column_stack((each, height(*each.T))) for each in (place, even))
    return place, (1 - weight) * here + weight * there


def draw_lines(picture, points, edges, color):
    """Draw lines between points (n, 3), in perspective, each as Bresenham does."""
    a, b = np.radians((turn, tilt))
    x, y, z = points.T
    x, y = np.cos(a) * x - np.sin(a) * y, np.sin(a) * x + np.cos(a) * y
    away, up = 700 + np.cos(b) * y - np.sin(b) * z, np.sin(b) * y + np.cos(b) * z
    pixels = np.ceil((picture.shape[1] / 2 + 1040 * x / away, 232 - 1040 * up / away)).astype(int)
    start, end = pixels[:, edges[0]], pixels[:, edges[1]]
    length = np.maximum(1, abs(end - start).max(0))
    line = np.repeat(np.arange(len(length)), length + 1)
    k = np.arange(len(line)) - (np.cumsum(length + 1) - length - 1)[line]
    column, row = start[:, line] + (2 * k * (end - start)[:, line] // length[line] + 1) // 2
    on = (column >= 0) & (column < picture.shape[1]) & (row >= 0) & (row < 480)
    light = np.clip(0.75 + 0.016 * z[edges[0][line[on]], None], 0, 1)
    picture[row[on], column[on]] = light * color


def draw(columns, now):
    """Return the picture, and how many lines there are."""
    picture = np.full((480, columns, 3), (33, 41, 54), np.uint8)
    focus = 60 * np.cos(np.radians((60 * now, 60 * now - 90)))
    hole, lines = (focus, -1), 0  # the middle of the next finer grid, and how far it reaches
    for level in range(4):
        step = 3 * 2**level
        middle = 2 * step * np.round(focus / (2 * step))  # a vertex of the next grid, too
        place, points = vertices(focus, middle, step)
        inner, outer = (abs(place - hole[0]) <= hole[1]).all(1), (abs(place) > HALF).any(1)
        shown = edges[:, ~inner[edges].all(0) & ~outer[edges].any(0)]
        draw_lines(picture, points, shown, COLORS[level])
        if not morphing:
            draw_lines(picture, points, cracks[:, ~outer[cracks].any(0)], CORAL)
        hole, lines = (middle, N * step), lines + shown.shape[1]
    pole = np.array([(*focus, height(*focus) + z) for z in (0, 60)])
    draw_lines(picture, pole, np.array([[1], [0]]), COLORS[0])
    return picture, lines


def on_key(window, key, scancode, action, mods):
    global turn, tilt, morphing
    if action != glfw.RELEASE:
        turn += 5 * ((key == glfw.KEY_RIGHT) - (key == glfw.KEY_LEFT))
        tilt = min(85, max(25, tilt + 5 * ((key == glfw.KEY_UP) - (key == glfw.KEY_DOWN))))
        morphing ^= key == glfw.KEY_SPACE
        glfw.set_window_should_close(window, key == glfw.KEY_ESCAPE)


def main():
    glfw.init()
    window = glfw.create_window(640, 480, _("Level of detail"), None, None)
    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glEnable(GL_TEXTURE_2D)
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 2048, 512, 0, GL_RGB, GL_UNSIGNED_BYTE, bytes(3 << 20))
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR)
    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        columns = min(2048, 480 * width // height // 4 * 4)
        picture, lines = draw(columns, glfw.get_time())
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, columns, 480, GL_RGB, GL_UNSIGNED_BYTE, picture)
        glBegin(GL_QUADS)
        for x, y in (0, 0), (1, 0), (1, 1), (0, 1):
            glTexCoord2f(x * columns / 2048, (1 - y) * 480 / 512)  # the first row is the top
            glVertex2f(2 * x - 1, 2 * y - 1)
        glEnd()
        write(16, 40, "levels glide into each other" if morphing else "no morph")
        write(16, 16, "{lines} of {every} lines", lines=lines, every=2 * 96 * 97)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
