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

import glfw
import numpy as np
from OpenGL.GL import *
from text import _, write

SIDES = 160, 80, 40, 20, 10  # of the tiles, from the roots to the leaves, in pixels
WIDE, HIGH, FAR = 0.42, 0.3, 570  # half of the volume's width and height at distance 1; its length
CAMERA = np.array((30, 250, 100))  # column, row, height
LEVELS = 18, 19, 28, 56, 78, 100  # heights, and their red, green and blue
SHADES = (48, 160, 92, 112, 146, 240), (88, 152, 124, 108, 132, 236), (122, 118, 78, 78, 112, 228)
CORAL, CREAM = (205, 82, 52), (250, 238, 210)
turn = 0
tilt = 10
descending = True
sized = True


def make_heights(columns):
    """Return the heights (480, columns) of hills and lakes."""
    y, x = np.mgrid[:480, :columns]
    z = np.full((480, columns), 30.0)
    for angle, length, high in (0.5, 70, 40), (2.0, 43, 26), (1.2, 17, 7), (2.7, 11, 4):
        along, aside = np.cos(angle) * x + np.sin(angle) * y, np.cos(angle) * y - np.sin(angle) * x
        z += high * (0.6 - abs(np.sin(along / length + np.sin(aside / length / 1.7))))
    return np.maximum(z, 18)


def make_boxes(heights, side):
    """Return middle and half size (rows, columns, 3) of the box of each tile."""
    tiles = np.pad(heights, ((0, 0), (0, -heights.shape[1] % side)), "edge")
    tiles = tiles.reshape(480 // side, side, -1, side)
    low, high = tiles.min((1, 3)), tiles.max((1, 3))
    row, column = side * (np.indices(low.shape) + 0.5)
    half = np.full_like(low, side / 2)
    return np.stack((column, row, (low + high) / 2), 2), np.stack((half, half, (high - low) / 2), 2)


def draw(columns):
    """Return the picture, how many boxes are tested, how many leaves are seen, and of how many."""
    heights = make_heights(columns)
    light = 1 + 0.1 * np.add(*np.gradient(heights))
    picture = np.stack([light * np.interp(heights, LEVELS, each) for each in SHADES], 2)
    (cos, cos_down), (sin, sin_down) = (f(np.radians((turn, tilt))) for f in (np.cos, np.sin))
    ahead, right = np.array((cos * cos_down, sin * cos_down, -sin_down)), np.array((-sin, cos, 0))
    up = np.array((cos * sin_down, sin * sin_down, cos_down))
    sides = WIDE * ahead + right, WIDE * ahead - right, HIGH * ahead + up, HIGH * ahead - up
    normals = np.stack((*sides, -ahead), 1)  # of the planes, inwards; the last is the far plane
    row, column = np.ogrid[:480, :columns]
    seen, count = np.ones((480, columns), bool), 0
    for side in SIDES if descending else SIDES[-1:]:
        middle, half = make_boxes(heights, side)
        tested = seen.repeat(2, 0).repeat(2, 1)[: len(middle), : len(middle[0])]  # the children
        reach = half @ abs(normals) if sized else 0  # of the corner that is farthest inside
        inside = ((middle - CAMERA) @ normals + reach + (0, 0, 0, 0, FAR) >= 0).all(2)
        seen, count = tested & inside, count + tested.sum()
        culled = (tested & ~inside).repeat(side, 0).repeat(side, 1)[:, :columns]
        picture[culled] *= 0.35
        picture[culled & ((row % side == 0) | (column % side == 0))] = CORAL

    for edge in ahead - WIDE * right, ahead + WIDE * right:
        x, y = (CAMERA + np.linspace(0, FAR, 1500)[:, None] * edge).astype(int).T[:2]
        on = (x >= 0) & (x < columns) & (y >= 0) & (y < 480)
        picture[y[on], x[on]] = CREAM

    return picture.clip(0, 255).astype(np.uint8), count, seen.sum(), seen.size


def on_key(window, key, scancode, action, mods):
    global turn, tilt, descending, sized
    if action != glfw.RELEASE:
        turn += 5 * ((key == glfw.KEY_RIGHT) - (key == glfw.KEY_LEFT))
        tilt += 5 * ((key == glfw.KEY_DOWN) - (key == glfw.KEY_UP))
        descending ^= key == glfw.KEY_SPACE
        sized ^= key == glfw.KEY_S
        glfw.set_window_should_close(window, key == glfw.KEY_ESCAPE)


def main():
    glfw.init()
    window = glfw.create_window(640, 480, _("Quad-tree"), None, None)
    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glEnable(GL_TEXTURE_2D)
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 2048, 512, 0, GL_RGB, GL_UNSIGNED_BYTE, bytes(3 << 20))
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR)
    drawn = None
    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        columns = min(2048, 480 * width // height // 4 * 4)
        if drawn != (columns, turn, tilt, descending, sized):
            drawn = columns, turn, tilt, descending, sized
            picture, tested, seen, leaves = draw(columns)
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, columns, 480, GL_RGB, GL_UNSIGNED_BYTE, picture)
        glBegin(GL_QUADS)
        for x, y in (0, 0), (1, 0), (1, 1), (0, 1):
            glTexCoord2f(x * columns / 2048, (1 - y) * 480 / 512)  # the first row is the top
            glVertex2f(2 * x - 1, 2 * y - 1)
        glEnd()
        write(16, 64, "whole boxes" if sized else "only the middles of boxes")
        write(16, 40, "{tested} boxes tested", tested=tested)
        write(16, 16, "{seen} of {leaves} small tiles seen", seen=seen, leaves=leaves)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
