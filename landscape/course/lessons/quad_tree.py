"""Quad-tree: whole tiles are culled by one test

A map, and on it the view volume of a camera at its left border. Each tile has a box that reaches
as high and as low as the ground in it, and four children, down to 10 pixels. A box that is outside
one plane of the volume is culled (coral), and no box below it is tested (dark). Without the boxes'
size, tiles are culled as soon as their middle is outside, with all that can be seen of them.

Keys: arrows turn and tilt the camera, Space tests all small tiles, S leaves out the boxes' size.
"""
# topic: flyover
# needs: height_field, box_frustum, projection_by_hand
# picture: frame 1
# keys: LEFT RIGHT UP DOWN SPACE S

import sys

import glfw
import numpy as np
from OpenGL.GL import *
from text import _, write

SIDES = 160, 80, 40, 20, 10  # of the tiles, from the roots to the leaves, in pixels
ROWS = 480  # of the map; it has as many columns as fit the window

# The view volume: half its width and half its height at distance 1, and its length.
WIDE = 0.42
HIGH = 0.3
FAR = 570
CAMERA = np.array((30, 250, 100))  # column, row, height

COLOR_MAP = np.array(
    (  # height, red, green, blue
        (18, 48, 88, 122),
        (19, 160, 152, 118),
        (28, 92, 124, 78),
        (56, 112, 108, 78),
        (78, 146, 132, 112),
        (100, 240, 236, 228),
    )
)
CORAL = (205, 82, 52)
CREAM = (250, 238, 210)

turn = 0  # degrees, clockwise on the map
tilt = 10  # degrees, downwards
descending = True  # from a tile that is seen to its children
sized = True  # boxes have a size, and are not only points


def make_heights(columns):
    """Return the heights (480, columns) of hills and lakes."""
    y, x = np.mgrid[:ROWS, :columns]
    z = np.full((ROWS, columns), 30.0)
    for angle, length, height in (0.5, 70, 40), (2.0, 43, 26), (1.2, 17, 7), (2.7, 11, 4):
        along = np.cos(angle) * x + np.sin(angle) * y
        aside = np.cos(angle) * y - np.sin(angle) * x
        z += height * (0.6 - abs(np.sin(along / length + np.sin(aside / length / 1.7))))
    return np.maximum(z, 18)


def paint(heights):
    """Return the picture (rows, columns, 3) of the map, lit from the top left."""
    light = 1 + 0.1 * np.add(*np.gradient(heights))
    levels = COLOR_MAP[:, 0]
    channels = [light * np.interp(heights, levels, COLOR_MAP[:, n]) for n in (1, 2, 3)]
    return np.stack(channels, 2)


def make_boxes(heights, side):
    """Return middle and half size (rows, columns, 3) of the box of each tile."""
    tiles = np.pad(heights, ((0, 0), (0, -heights.shape[1] % side)), "edge")
    tiles = tiles.reshape(ROWS // side, side, -1, side)
    low = tiles.min((1, 3))
    high = tiles.max((1, 3))
    row, column = side * (np.indices(low.shape) + 0.5)
    half_side = np.full_like(low, side / 2)
    middle = np.stack((column, row, (low + high) / 2), 2)
    half = np.stack((half_side, half_side, (high - low) / 2), 2)
    return middle, half


def camera_axes():
    """Return the unit vectors ahead of the camera, to its right and up."""
    angle = np.radians(turn)
    down = np.radians(tilt)
    level = np.array((np.cos(angle), np.sin(angle), 0))  # ahead, were there no tilt
    vertical = np.array((0, 0, 1))
    ahead = np.cos(down) * level - np.sin(down) * vertical
    right = np.array((-np.sin(angle), np.cos(angle), 0))
    up = np.sin(down) * level + np.cos(down) * vertical
    return ahead, right, up


def volume_planes():
    """Return the planes' normals, inwards, as columns (3, 5), and their distances (5,)."""
    ahead, right, up = camera_axes()
    normals = (
        WIDE * ahead + right,
        WIDE * ahead - right,
        HIGH * ahead + up,
        HIGH * ahead - up,
        -ahead,  # the far plane
    )
    return np.stack(normals, 1), np.array((0, 0, 0, 0, FAR))


def inside_volume(middle, half):
    """Return for each box whether no plane has all of it on its outer side."""
    normals, distances = volume_planes()
    reach = half @ abs(normals) if sized else 0  # of the corner that is farthest inside
    return ((middle - CAMERA) @ normals + reach + distances >= 0).all(2)


def enlarged(tiles, factor):
    """Return an array with each element repeated, both ways."""
    return tiles.repeat(factor, 0).repeat(factor, 1)


def cull(picture, heights):
    """Go down the tree, and mark in the picture what is culled.

    Return how many boxes are tested, how many leaves are seen, and how many leaves there are.
    """
    rows, columns = heights.shape
    row, column = np.ogrid[:rows, :columns]
    tested_boxes = 0
    seen = None
    for side in SIDES if descending else SIDES[-1:]:
        middle, half = make_boxes(heights, side)
        if seen is None:
            tested = np.ones(middle.shape[:2], bool)
        else:
            tested = enlarged(seen, 2)[: len(middle), : len(middle[0])]  # the children
        inside = inside_volume(middle, half)
        seen = tested & inside
        tested_boxes += tested.sum()

        culled = enlarged(tested & ~inside, side)[:, :columns]
        border = (row % side == 0) | (column % side == 0)
        picture[culled] *= 0.35
        picture[culled & border] = CORAL

    return tested_boxes, seen.sum(), seen.size


def draw_sight(picture):
    """Draw the left and right side of the view volume into the picture."""
    ahead, right, _up = camera_axes()
    for edge in ahead - WIDE * right, ahead + WIDE * right:
        points = (CAMERA + np.linspace(0, FAR, 1500)[:, np.newaxis] * edge).astype(int)
        x = points[:, 0]
        y = points[:, 1]
        on_map = (x >= 0) & (x < picture.shape[1]) & (y >= 0) & (y < ROWS)
        picture[y[on_map], x[on_map]] = CREAM


def draw(columns):
    """Return the picture, and the three numbers of ``cull``."""
    heights = make_heights(columns)
    picture = paint(heights)
    counts = cull(picture, heights)
    draw_sight(picture)
    return picture.clip(0, 255).astype(np.uint8), counts


def show(picture):
    """Load a picture into the texture, and draw it over the whole window."""
    rows, columns = picture.shape[:2]
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, columns, rows, GL_RGB, GL_UNSIGNED_BYTE, picture)
    glBegin(GL_QUADS)
    for x, y in (0, 0), (1, 0), (1, 1), (0, 1):
        glTexCoord2f(x * columns / 2048, (1 - y) * rows / 512)  # the first row is the top
        glVertex2f(2 * x - 1, 2 * y - 1)
    glEnd()


def on_key(window, key, scancode, action, mods):
    global turn, tilt, descending, sized
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_LEFT:
        turn -= 5
    elif key == glfw.KEY_RIGHT:
        turn += 5
    elif key == glfw.KEY_UP:
        tilt -= 5
    elif key == glfw.KEY_DOWN:
        tilt += 5
    elif key == glfw.KEY_SPACE:
        descending = not descending
    elif key == glfw.KEY_S:
        sized = not sized
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Quad-tree"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glEnable(GL_TEXTURE_2D)
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 2048, 512, 0, GL_RGB, GL_UNSIGNED_BYTE, bytes(3 << 20))
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR)
    drawn = None

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        columns = min(2048, ROWS * width // height // 4 * 4)

        # Computed again only when something has changed.
        if drawn != (columns, turn, tilt, descending, sized):
            drawn = columns, turn, tilt, descending, sized
            picture, (tested, seen, leaves) = draw(columns)
        show(picture)

        write(16, 64, "whole boxes" if sized else "only the middles of boxes")
        write(16, 40, "{tested} boxes tested", tested=tested)
        write(16, 16, "{seen} of {leaves} small tiles seen", seen=seen, leaves=leaves)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
