"""Texture filters: a floor, a sign and a window

Three things in a hall have textures, and all three are white. OpenGL begins with a filter that
needs mipmaps, the image in halved sizes; a texture that lacks what its filter needs is not used.

GL_TEXTURE_MIN_FILTER says how a texture is looked up where it is made smaller, so that a pixel
covers many texels, and GL_TEXTURE_MAG_FILTER where it is made larger. Set them for each texture.

The sign is drawn from few texels, and these are to stay sharp squares, however near one comes. The
window shows a sky of even fewer texels, and is to be smooth, without any squares. The floor reaches
far away, where a pixel covers many texels: there it fades to their mean colour, for which it needs
mipmaps and the filter that mixes both texels and levels. Near the camera it is smooth.

Change make_sign, make_window and make_floor. load puts an image into the texture that is bound, in
its own size only; it does not make the smaller ones.

Keys: Up and Down walk.
"""
# exercise: texture_filters

import sys

import glfw
import numpy as np
from OpenGL.GL import *

SIGN = 1  # the names of the textures
WINDOW = 2
FLOOR = 3
ARROW = (
    "........",
    "....#...",
    "....##..",
    "#######.",
    "#######.",
    "....##..",
    "....#...",
    "........",
)
walked = 0


def load(image):
    """Load an image, an array of bytes (rows, columns, 3), into the texture that is bound."""
    rows, columns = image.shape[:2]
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, columns, rows, 0, GL_RGB, GL_UNSIGNED_BYTE, image)


def set_filters(smaller, larger):
    for name, value in ((GL_TEXTURE_MIN_FILTER, smaller), (GL_TEXTURE_MAG_FILTER, larger)):
        glTexParameterf(GL_TEXTURE_2D, name, value)


def make_sign():
    glBindTexture(GL_TEXTURE_2D, SIGN)
    colors = {"#": (40, 60, 70), ".": (242, 170, 80)}
    texels = [[colors[letter] for letter in row] for row in ARROW]
    load(np.array(texels, np.uint8))
    set_filters(GL_NEAREST, GL_NEAREST)


def make_window():
    glBindTexture(GL_TEXTURE_2D, WINDOW)
    top = ((60, 110, 190), (120, 150, 210))
    bottom = ((250, 210, 150), (230, 110, 60))
    load(np.array((top, bottom), np.uint8))
    set_filters(GL_LINEAR, GL_LINEAR)


def make_floor():
    glBindTexture(GL_TEXTURE_2D, FLOOR)
    image = np.zeros((32, 32, 3), np.uint8)
    image[:] = 70, 130, 130
    image[:16, :16] = 240, 230, 205
    image[16:, 16:] = 240, 230, 205
    load(image)
    level = 0
    while len(image) > 1:
        level += 1
        size = len(image) // 2
        image = image.reshape(size, 2, size, 2, 3).mean(axis=(1, 3)).astype(np.uint8)
        glTexImage2D(GL_TEXTURE_2D, level, GL_RGB, size, size, 0, GL_RGB, GL_UNSIGNED_BYTE, image)
    set_filters(GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR)


def draw_quad(texture, corners, repeated=1):
    glBindTexture(GL_TEXTURE_2D, texture)
    glBegin(GL_QUADS)
    for (s, t), corner in zip(((0, 1), (1, 1), (1, 0), (0, 0)), corners):
        glTexCoord2f(repeated * s, repeated * t)
        glVertex3f(*corner)
    glEnd()


def draw_hall():
    draw_quad(FLOOR, ((-20, -1, 2), (20, -1, 2), (20, -1, -38), (-20, -1, -38)), 20)
    draw_quad(SIGN, ((-1.7, -0.2, -3), (-0.3, -0.2, -3), (-0.3, 1.2, -3), (-1.7, 1.2, -3)))
    draw_quad(WINDOW, ((0.3, -0.2, -3), (1.7, -0.2, -3), (1.7, 1.2, -3), (0.3, 1.2, -3)))


def on_key(window, key, scancode, action, mods):
    global walked
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_DOWN:
        walked -= 0.2
    elif key == glfw.KEY_UP:
        walked += 0.2
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(400, 300, "A hall", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1)
    glEnable(GL_TEXTURE_2D)
    make_sign()
    make_window()
    make_floor()

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 0.5, 60)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glTranslatef(0, 0, walked)
        glClear(GL_COLOR_BUFFER_BIT)
        draw_hall()
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
