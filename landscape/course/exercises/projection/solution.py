"""Projection: an island of dots

An island consists of points in space. x leads to the east, y to the north, z upwards. A camera
stands at `eye`; it looks to the east if it is not turned, and level if it is not tilted. As yet all
points come to the middle of the picture.

into_camera(x, y, z) takes a point into the frame of the camera and returns how far it lies ahead of
the camera, how far to its right, and how far above it. First the eye is subtracted. Then the
camera's turn is taken back: it is turned to the left, counter-clockwise as seen from above, by
`turned` degrees. At last its tilt is taken back: it is tilted upwards, away from the ground, by
`tilted` degrees.

to_pixel(ahead, right, up) returns the column and the row of the pixel in which the point is seen,
whole numbers. In the middle of the picture, WIDTH / 2 columns from the left and HEIGHT / 2 rows
from the top, one sees what lies straight ahead. A point is FOCAL * right / ahead columns to the
right of it, and FOCAL * up / ahead rows above it; fractions are cut off. If ahead is less than
NEAR, the point is not seen, and None is returned.

OpenGL only shows the picture. Change into_camera and to_pixel.

Keys: Left and Right turn the camera, Up and Down tilt it, Space lifts it.
"""
# exercise: projection

import math
import sys

import glfw
import numpy as np
from OpenGL.GL import *

WIDTH = 80  # of the picture; each of its pixels covers several of the window's
HEIGHT = 60
SIDE = 128  # of the texture: a power of two
BACKGROUND = 33, 41, 53
COLORS = ((80, 140, 190), (235, 215, 160), (110, 160, 90), (70, 115, 70), (240, 240, 245))
FOCAL = 50
NEAR = 1
eye = [1.3, 0.37, 4.2]
turned = 9  # degrees
tilted = -11


def into_camera(x, y, z):
    """Return how far a point is ahead, to the right and above, in the frame of the camera."""
    east = x - eye[0]
    north = y - eye[1]
    above = z - eye[2]
    cos = math.cos(math.radians(turned))
    sin = math.sin(math.radians(turned))
    level = cos * east + sin * north
    right = sin * east - cos * north
    cos = math.cos(math.radians(tilted))
    sin = math.sin(math.radians(tilted))
    ahead = cos * level + sin * above
    up = cos * above - sin * level
    return ahead, right, up


def to_pixel(ahead, right, up):
    """Return the column and the row of a point of the camera's frame, or None."""
    if ahead < NEAR:
        return None
    column = WIDTH / 2 + FOCAL * right / ahead
    row = HEIGHT / 2 - FOCAL * up / ahead
    return math.floor(column), math.floor(row)


def make_points():
    """Return the points of the island, the farthest rows first: x, y, z and a colour each."""
    points = []
    for x in range(30, -12, -1):
        for y in range(-14, 15):
            z = 5 * np.exp(-((x - 16) ** 2 + (y - 3) ** 2) / 40) + 0.6 * np.sin(x + 2 * y) - 0.5
            level = int(np.searchsorted((0, 0.5, 2, 4), z))
            points.append((x, y, max(z, 0), COLORS[level]))
    points += [(9, -6, z / 4, COLORS[4]) for z in range(16)]  # a tower
    return points


POINTS = make_points()


def make_picture():
    picture = np.full((HEIGHT, WIDTH, 3), BACKGROUND, np.uint8)
    for x, y, z, color in POINTS:
        pixel = to_pixel(*into_camera(x, y, z))
        if pixel is not None:
            column, row = pixel
            if 0 <= column < WIDTH and 0 <= row < HEIGHT:
                picture[row, column] = color
    return picture


def draw(picture):
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, WIDTH, HEIGHT, GL_RGB, GL_UNSIGNED_BYTE, picture)
    glBegin(GL_QUADS)
    for x, y in ((0, 0), (1, 0), (1, 1), (0, 1)):
        glTexCoord2f(x * WIDTH / SIDE, y * HEIGHT / SIDE)
        glVertex2f(2 * x - 1, 1 - 2 * y)  # the picture's first row is at the top
    glEnd()


def on_key(window, key, scancode, action, mods):
    global turned, tilted
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_LEFT:
        turned += 15
    elif key == glfw.KEY_RIGHT:
        turned -= 15
    elif key == glfw.KEY_UP:
        tilted += 7
    elif key == glfw.KEY_DOWN:
        tilted -= 7
    elif key == glfw.KEY_SPACE:
        eye[2] += 1.5
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(320, 240, "An island of dots", None, None)
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
