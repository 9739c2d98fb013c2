"""Projection by hand: from points in space to pixels, without OpenGL

Sines and cosines take points into the camera's frame of reference, and a division by x', the
distance along the line of sight, takes them to the screen. OpenGL only shows the pixels. Without
the division nothing gets smaller with distance; with a square frustum on a screen that is wider
than high, the sun is an ellipse; with the fraction cut off, pixels are one too far left and up.

Keys: arrows and R turn the camera; D leaves out the division, S is the square frustum, C cuts off.
"""
# topic: flyover
# needs: height_field, perspective, look_at
# picture: frame 1
# keys: LEFT RIGHT UP DOWN R D S C

from pathlib import Path

import glfw
import numpy as np
from OpenGL.GL import *
from PIL import Image
from text import _, write

CAMERA = -38, 64, 36  # x along the image's rows, y down its columns, z up; 1 unit is a pixel
NEAR = 1.5  # the frustum: at this distance it reaches from -1 to 1, across and up
heights = np.asarray(Image.open(Path(__file__).parent / "data" / "heights.png"))[::4, ::4] / 65535
u, v = np.mgrid[-0.5:0.5:13j, 0:2:25j] * np.pi
sun = 230 + 66 * np.cos(u) * np.cos(v), 64 + 66 * np.cos(u) * np.sin(v), 52 + 66 * np.sin(u), 3 + u
ground = *4 * np.indices((33, 33))[::-1], 48 * np.maximum(heights, 0.12), heights
LEVELS = 0.12, 0.18, 0.4, 0.65, 1, 2, 4  # of the sun, from 2; and their red, green and blue
COLORS = (80, 120, 155, 235, 255, 205, 255), (130, 190, 195, 155, 245, 60, 190)
COLORS = *COLORS, (205, 175, 100, 90, 230, 50, 80)
points, edges = np.zeros((0, 4)), np.zeros((0, 2), int)
for grid in sun, ground:
    number = len(points) + np.arange(grid[0].size).reshape(grid[0].shape)  # of each point
    for a, b in (number[:, :-1], number[:, 1:]), (number[:-1], number[1:]):
        edges = np.concatenate((edges, np.stack((a.ravel(), b.ravel()), 1)))
    points = np.concatenate((points, np.stack(grid, 2).reshape(-1, 4)))
colors = np.stack([np.interp(points[:, 3], LEVELS, each) for each in COLORS], 1)
SUMMIT = u.size + heights.argmax()
theta = np.array((0, 10, 0))  # degrees about x, y and z: it rolls, looks down and turns
divided = True
square = False
cut = False


def camera_transform():
    """Return x', y' and z': how far ahead of the camera points are, to its right, and above it."""
    x, y, z = (points[:, :3] - CAMERA).T
    sin_x, sin_y, sin_z = np.sin(np.radians(theta))
    cos_x, cos_y, cos_z = np.cos(np.radians(theta))
    forward, right = sin_z * y + cos_z * x, cos_z * y - sin_z * x
    up = cos_y * z + sin_y * forward
    return cos_y * forward - sin_y * z, sin_x * up + cos_x * right, cos_x * up - sin_x * right


def project(x, y, z, width, height):
    """Return columns and rows, with fractions; (0, 0) is the top left."""
    across = 1 if square else width / height  # how far the frustum reaches left and right
    distance = x if divided else 90
    column = width * (y * NEAR / distance + across) / (2 * across)
    return np.stack((column, height * (1 - (z * NEAR / distance + 1) / 2)))


def draw(width, height):
    """Return the picture, where edges are rows of points, and the summit's column and row."""
    picture = np.full((height, width, 3), (33, 41, 54), np.uint8)
    x, y, z = camera_transform()
    places = project(np.maximum(x, NEAR), y, z, width, height)
    ahead = edges[(x[edges] > NEAR).all(1)]  # never divide by zero
    ahead = ahead[np.argsort(-x[ahead].sum(1))]  # the nearest are drawn last, over the others
    for steps, light in (np.linspace(0, 1, 64), 0.7), (np.array((0, 1)), 1):
        between = places[:, ahead[:, :1]] * (1 - steps) + places[:, ahead[:, 1:]] * steps
        column, row = pixels = (np.trunc(between) if cut else np.ceil(between)).astype(int)
        on = (pixels >= 0).all(0) & (column < width) & (row < height)
        picture[row[on], column[on]] = np.repeat(light * colors[ahead[:, :1]], len(steps), 1)[on]
    return picture, places[:, SUMMIT]


def on_key(window, key, scancode, action, mods):
    global divided, square, cut
    if action != glfw.RELEASE:
        theta[0] += 5 * (key == glfw.KEY_R)
        theta[1] += 5 * ((key == glfw.KEY_DOWN) - (key == glfw.KEY_UP))
        theta[2] += 5 * ((key == glfw.KEY_RIGHT) - (key == glfw.KEY_LEFT))
        divided ^= key == glfw.KEY_D
        square ^= key == glfw.KEY_S
        cut ^= key == glfw.KEY_C
        glfw.set_window_should_close(window, key == glfw.KEY_ESCAPE)


def main():
    glfw.init()
    window = glfw.create_window(640, 480, _("Projection by hand"), None, None)
    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glEnable(GL_TEXTURE_2D)
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1)
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 1024, 512, 0, GL_RGB, GL_UNSIGNED_BYTE, None)
    for name in GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER:
        glTexParameteri(GL_TEXTURE_2D, name, GL_NEAREST)
    while not glfw.window_should_close(window):
        size = np.array(glfw.get_framebuffer_size(window))
        glViewport(0, 0, *size)
        width, height = np.minimum(size // max(1, size[1] // 240), (1024, 512))
        picture, (column, row) = draw(width, height)
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, picture)
        glBegin(GL_QUADS)
        for x, y in (0, 0), (1, 0), (1, 1), (0, 1):
            glTexCoord2f(x * width / 1024, (1 - y) * height / 512)  # the first row is the top
            glVertex2f(2 * x - 1, 2 * y - 1)
        glEnd()
        write(16, 40, "theta x {x}°, y {y}°, z {z}°", x=theta[0], y=theta[1], z=theta[2])
        x, y = np.trunc((column, row)) if cut else np.ceil((column, row))
        write(16, 16, "summit: {a:.2f}, {b:.2f}: pixel {x:.0f}, {y:.0f}", a=column, b=row, x=x, y=y)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
