"""Back faces: two crystals

Two crystals, drawn without a z buffer: face after face, in the order of their list, so that those
behind cover those in front. A body without dents needs no z buffer if faces that are turned away
from the camera are left out.

seen(a, b, c) gets the three corners of a face, arrays x, y, z, and returns whether the face is
turned towards the camera. The camera is at the origin; x leads to the right, y upwards, and what is
in front of the camera has a negative z. Seen from outside of the crystal, the corners of a face
follow each other counter-clockwise.

A face is turned towards the camera if its normal, which leads out of the crystal, points against
the line of sight. That line leads from the camera to the face, and is another one for each face:
near the borders of the picture, faces are seen that one would not see in its middle.

OpenGL only shows the picture. Change only seen.

Keys: Left and Right turn the crystals, Up and Down tilt them.
"""
# exercise: back_faces

import sys

import glfw
import numpy as np
from OpenGL.GL import *

WIDTH = 80  # of the picture; each of its pixels covers several of the window's
HEIGHT = 60
SIDE = 128  # of the texture: a power of two
BACKGROUND = 33, 41, 53
FOCAL = 28
SIDES = 6
CENTERS = ((-1.7, -1, -2.7), (1.8, 1.1, -2.8))
COLORS = [(100 + 25 * face, 60 + 9 * face, 220 - 30 * face) for face in range(6)]
COLORS += [(70 + 9 * face, 230 - 22 * face, 90 + 20 * face) for face in range(6)]
turned = 12
tilted = 20


def seen(a, b, c):
    """Return whether a face is turned towards the camera."""
    # The volume of the pyramid on the face, with the camera at its top; its sign is the side.
    return np.linalg.det((a, b, c)) < 0


def make_crystal(center):
    """Return the faces of a crystal, each with its three corners: (12, 3, 3)."""
    turn, tilt = np.radians((turned, tilted))
    around = turn + 2 * np.pi * np.arange(SIDES) / SIDES
    ring = np.stack((np.sin(around), 0 * around, np.cos(around)), axis=-1)
    top = np.array((0, 1.3, 0))
    bottom = np.array((0, -1.3, 0))
    faces = []
    for number in range(SIDES):
        first = ring[number]
        second = ring[(number + 1) % SIDES]
        faces += [(first, second, top), (second, first, bottom)]
    cos = np.cos(tilt)
    sin = np.sin(tilt)
    return np.array(faces) @ np.array(((1, 0, 0), (0, cos, sin), (0, -sin, cos))) + center


def fill(picture, a, b, c, color):
    """Fill a triangle of the picture; its corners are columns and rows."""
    row, column = np.mgrid[0:HEIGHT, 0:WIDTH]
    sides = [
        (x1 - x0) * (row - y0) - (y1 - y0) * (column - x0)
        for (x0, y0), (x1, y1) in ((a, b), (b, c), (c, a))
    ]
    picture[(np.min(sides, axis=0) >= 0) | (np.max(sides, axis=0) <= 0)] = color


def make_picture():
    picture = np.full((HEIGHT, WIDTH, 3), BACKGROUND, np.uint8)
    for crystal, center in enumerate(CENTERS):
        for number, (a, b, c) in enumerate(make_crystal(center)):
            if seen(a, b, c):
                places = [(40 - FOCAL * x / z, 30 + FOCAL * y / z) for x, y, z in (a, b, c)]
                fill(picture, *places, COLORS[6 * crystal + number % 6])
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
        turned -= 10
    elif key == glfw.KEY_RIGHT:
        turned += 10
    elif key == glfw.KEY_UP:
        tilted -= 10
    elif key == glfw.KEY_DOWN:
        tilted += 10
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(320, 240, "Two crystals", None, None)
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
