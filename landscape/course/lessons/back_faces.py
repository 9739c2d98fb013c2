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

import sys

import glfw
import numpy as np
from OpenGL.GL import *
from text import _, write

SIDE = 45  # points of the volcano's grid, across and down
NEAR = 1.5  # the frustum is that of projection_by_hand
AWAY = 33  # how far away the camera is
COLOR_MAP = np.array(
    (  # height, red, green, blue
        (-2, 60, 130, 165),
        (1, 75, 170, 140),
        (6, 150, 175, 95),
        (11, 235, 155, 90),
        (17, 250, 235, 205),
    )
)
CORAL = (175, 62, 42)
BACKGROUND = (33, 41, 54)

turn = 30  # degrees
tilt = 16
dropping = True
own_line = True  # of sight, for each triangle


def make_points():
    """Return the points (n, 3) of a volcano: x, y and z, its height."""
    y, x = np.indices((SIDE, SIDE)) - SIDE // 2
    far = np.hypot(x, y)
    z = 17 * np.exp(-((far - 6) ** 2) / 45) + 1.8 * np.sin(x / 3.1) * np.cos(y / 2.7 + 1)
    return np.stack((x, y, z), 2).reshape(-1, 3).astype(float)


def make_triangles():
    """Return two triangles for each square of the grid, (n, 3): the numbers of their points."""
    number = np.arange(SIDE * SIDE).reshape(SIDE, SIDE)
    a = number[:-1, :-1]
    b = number[:-1, 1:]
    c = number[1:, :-1]
    d = number[1:, 1:]
    # (b - a) x (d - a) points up, as does (d - a) x (c - a).
    return np.stack(((a, b, d), (a, d, c)), 1).reshape(3, -1).T


def color_by_height(heights):
    levels = COLOR_MAP[:, 0]
    return np.stack([np.interp(heights, levels, COLOR_MAP[:, n]) for n in (1, 2, 3)], 1)


points = make_points()
triangles = make_triangles()
colors = color_by_height(points[:, 2])


def edges_of(triangles):
    """Return the edges of triangles, each once: the numbers of their ends, the lower one first."""
    edges = triangles[:, ((0, 1), (1, 2), (2, 0))].reshape(-1, 2)
    return np.unique(np.sort(edges, 1), axis=0)


def camera_transform():
    """Return the points (n, 3) as the camera sees them: distance ahead, to the right, up."""
    angle = np.radians(turn)
    down = np.radians(tilt)
    x, y, z = (points - (0, 0, 5)).T
    forward = np.cos(angle) * x + np.sin(angle) * y
    right = np.cos(angle) * y - np.sin(angle) * x
    ahead = AWAY + np.cos(down) * forward - np.sin(down) * z
    up = np.cos(down) * z + np.sin(down) * forward
    return np.stack((ahead, right, up), 1)


def faces_camera(corners):
    """Return for each triangle whether it faces the camera; corners: (n, 3, 3)."""
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    sight = corners[:, 0] if own_line else np.array((1, 0, 0))
    return (normals * sight).sum(1) < 0


def project(places, width, height):
    """Return the pixels (2, n), columns and rows, of places as the camera sees them."""
    x, y, z = places.T
    column = width / 2 + height / 2 * y * NEAR / x
    row = height / 2 * (1 - z * NEAR / x)
    return np.ceil((column, row)).astype(int)


def draw_lines(picture, pixels, edges, colors):
    """Draw edges between pixels (2, n); the lesson bresenham shows how."""
    start = pixels[:, edges[:, 0]]
    end = pixels[:, edges[:, 1]]
    length = np.maximum(1, abs(end - start).max(0))
    line = np.repeat(np.arange(len(length)), length + 1)  # which line each pixel belongs to
    first = np.cumsum(length + 1) - length - 1  # the number of each line's first pixel
    k = np.arange(len(line)) - first[line]
    way = (end - start)[:, line]
    column, row = start[:, line] + (2 * k * way + length[line]) // (2 * length[line])

    height, width, _channels = picture.shape
    on_screen = (column >= 0) & (column < width) & (row >= 0) & (row < height)
    picture[row[on_screen], column[on_screen]] = colors[edges[line[on_screen], 0]]


def draw(width, height):
    """Return the picture (height, width, 3), how many lines are drawn, and how many there are."""
    picture = np.full((height, width, 3), BACKGROUND, np.uint8)
    places = camera_transform()
    pixels = project(places, width, height)
    front = faces_camera(places[triangles])
    all_edges = edges_of(triangles)
    front_edges = edges_of(triangles[front])
    if not dropping:
        draw_lines(picture, pixels, all_edges, np.full((len(points), 3), CORAL))
    draw_lines(picture, pixels, front_edges, colors)
    return picture, len(front_edges if dropping else all_edges), len(all_edges)


def make_texture():
    glEnable(GL_TEXTURE_2D)
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1)
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 2048, 1024, 0, GL_RGB, GL_UNSIGNED_BYTE, None)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST)


def show(picture):
    """Load a picture into the texture, and draw it over the whole window."""
    height, width, _channels = picture.shape
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, picture)
    glBegin(GL_QUADS)
    for x, y in (0, 0), (1, 0), (1, 1), (0, 1):
        glTexCoord2f(x * width / 2048, (1 - y) * height / 1024)  # the first row is the top
        glVertex2f(2 * x - 1, 2 * y - 1)
    glEnd()


def on_key(window, key, scancode, action, mods):
    global turn, tilt, dropping, own_line
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_LEFT:
        turn -= 10
    elif key == glfw.KEY_RIGHT:
        turn += 10
    elif key == glfw.KEY_UP:
        tilt = min(70, tilt + 5)
    elif key == glfw.KEY_DOWN:
        tilt = max(6, tilt - 5)
    elif key == glfw.KEY_B:
        dropping = not dropping
    elif key == glfw.KEY_N:
        own_line = not own_line
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Back faces"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    make_texture()

    while not glfw.window_should_close(window):
        size = np.array(glfw.get_framebuffer_size(window))
        glViewport(0, 0, *size)
        scale = size[1] // 480 or size[1] / 480  # whole, except in a small window
        width, height = np.minimum(size // scale, (2048, 1024)).astype(int)
        picture, lines, every = draw(width, height)
        show(picture)

        write(16, 40, "one line of sight each" if own_line else "one line of sight for all")
        write(16, 16, "{lines} of {every} lines", lines=lines, every=every)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
