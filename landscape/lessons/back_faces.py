"""Back faces: edges of triangles that face away are not drawn

A wire model shows what is behind it, too. A triangle faces away where its normal points along the
line of sight to it, and an edge is drawn only if one of its triangles faces the camera. Many lines
are saved, and what is left can be read. With the middle line of sight for all triangles, some that
face away are kept, and some that can be seen are dropped, mostly near the picture's borders.

Keys: arrows turn the volcano and tilt it; B draws all edges, N takes one line of sight for all.
"""
# topic: flyover
# needs: bresenham, orientation
# picture: frame 1
# keys: LEFT RIGHT UP DOWN B N

import glfw
import numpy as np
from OpenGL.GL import *
from text import _, write

SIDE, NEAR = 45, 1.5  # points a side; the frustum is that of projection_by_hand
turn, tilt = 30, 16  # degrees
dropping, own_line = True, True
y, x = np.indices((SIDE, SIDE)) - SIDE // 2
far = np.hypot(x, y)
z = 17 * np.exp(-((far - 6) ** 2) / 45) + 1.8 * np.sin(x / 3.1) * np.cos(y / 2.7 + 1)
points = np.stack((x, y, z), 2).reshape(-1, 3).astype(float)
number = np.arange(SIDE * SIDE).reshape(SIDE, SIDE)
a = number[:-1, :-1]
b = number[:-1, 1:]
c = number[1:, :-1]
d = number[1:, 1:]
# Two triangles a square of the grid: (b - a) x (d - a) points up, as does (d - a) x (c - a).
triangles = np.stack(((a, b, d), (a, d, c)), 1).reshape(3, -1).T
LEVELS = -2, 1, 6, 11, 17  # heights, and their red, green and blue
COLORS = (60, 75, 150, 235, 250), (130, 170, 175, 155, 235), (165, 140, 95, 90, 205)
colors = np.stack([np.interp(points[:, 2], LEVELS, each) for each in COLORS], 1)


def edges_of(triangles):
    """Return the edges of triangles, each once: the numbers of their ends, the lower one first."""
    edges = triangles[:, ((0, 1), (1, 2), (2, 0))].reshape(-1, 2)
    return np.unique(np.sort(edges, 1), axis=0)


def draw_lines(picture, pixels, edges, colors):
    """Draw edges between pixels (2, n), each as Bresenham does."""
    start, end = pixels[:, edges[:, 0]], pixels[:, edges[:, 1]]
    longer = np.maximum(1, abs(end - start).max(0))
    line = np.repeat(np.arange(len(longer)), longer + 1)  # to which line each pixel belongs
    k = np.arange(len(line)) - (np.cumsum(longer + 1) - longer - 1)[line]
    way, longer = (end - start)[:, line], longer[line]
    column, row = start[:, line] + (2 * k * way + longer) // (2 * longer)
    on = (column >= 0) & (column < picture.shape[1]) & (row >= 0) & (row < picture.shape[0])
    picture[row[on], column[on]] = colors[edges[line[on], 0]]


def draw(width, height):
    """Return the picture (height, width, 3), how many lines are drawn, and how many there are."""
    picture = np.full((height, width, 3), (33, 41, 54), np.uint8)
    angle, down = np.radians((turn, tilt))
    x, y, z = (points - (0, 0, 5)).T
    x, y = np.cos(angle) * x + np.sin(angle) * y, np.cos(angle) * y - np.sin(angle) * x
    # The camera is 33 units away: x becomes the distance ahead of it; y is to the right, z up.
    x, z = 33 + np.cos(down) * x - np.sin(down) * z, np.cos(down) * z + np.sin(down) * x
    corners = np.stack((x, y, z), 1)[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    sight = corners[:, 0] if own_line else np.array((1, 0, 0))
    front = (normals * sight).sum(1) < 0
    pixels = np.ceil((width / 2 + height / 2 * y * NEAR / x, height / 2 * (1 - z * NEAR / x)))
    pixels = pixels.astype(int)
    every, edges = edges_of(triangles), edges_of(triangles[front])
    if not dropping:
        draw_lines(picture, pixels, every, np.full((len(points), 3), (175, 62, 42)))
    draw_lines(picture, pixels, edges, colors)
    return picture, len(edges) if dropping else len(every), len(every)


def on_key(window, key, scancode, action, mods):
    global turn, tilt, dropping, own_line
    if action != glfw.RELEASE:
        turn += 10 * ((key == glfw.KEY_RIGHT) - (key == glfw.KEY_LEFT))
        tilt = min(70, max(6, tilt + 5 * ((key == glfw.KEY_UP) - (key == glfw.KEY_DOWN))))
        dropping ^= key == glfw.KEY_B
        own_line ^= key == glfw.KEY_N
        glfw.set_window_should_close(window, key == glfw.KEY_ESCAPE)


def main():
    glfw.init()
    window = glfw.create_window(640, 480, _("Back faces"), None, None)
    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glEnable(GL_TEXTURE_2D)
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1)
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 2048, 1024, 0, GL_RGB, GL_UNSIGNED_BYTE, None)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST)
    while not glfw.window_should_close(window):
        size = np.array(glfw.get_framebuffer_size(window))
        glViewport(0, 0, *size)
        scale = size[1] // 480 or size[1] / 480  # whole, except in a small window
        width, height = np.minimum(size // scale, (2048, 1024)).astype(int)
        picture, lines, every = draw(width, height)
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, picture)
        glBegin(GL_QUADS)
        for x, y in (0, 0), (1, 0), (1, 1), (0, 1):
            glTexCoord2f(x * width / 2048, (1 - y) * height / 1024)  # the first row is the top
            glVertex2f(2 * x - 1, 2 * y - 1)
        glEnd()
        write(16, 40, "one line of sight each" if own_line else "one line of sight for all")
        write(16, 16, "{lines} of {every} lines", lines=lines, every=every)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
