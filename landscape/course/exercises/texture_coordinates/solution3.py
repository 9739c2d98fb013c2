"""Texture coordinates: a frieze of boats

A wall carries a frieze: the picture of a boat, three times side by side, upright, and sailing to
the left as in IMAGE. Here it is there only once, stretched and upside down.

The coordinate s runs along the rows of the image and t from its first row to its last, both from 0
to 1. The first row of IMAGE is the top of the picture. Beyond 1 a texture is repeated, or its edge
is drawn out, as GL_TEXTURE_WRAP_S and GL_TEXTURE_WRAP_T say.

Change COORDINATES, which belong to the corners of the wall in their order, and what else is needed
to see the picture three times.
"""
# exercise: texture_coordinates

import sys

import glfw
from OpenGL.GL import *

IMAGE = (
    "................",
    ".......M........",
    ".....WWM........",
    "....WWWM........",
    "...WWWWMRR......",
    "..WWWWWMRRR.....",
    ".WWWWWWMRRRR....",
    "WWWWWWWMRRRRR...",
    ".......M.....Y..",
    "BBBBBBBBBBBBBB..",
    ".BBBBBBBBBBBBB..",
    "..BBBBBBBBBBB...",
    "~~~~~~~~~~~~~~~~",
    "~-~~~~-~~~~~-~~~",
    "~~~-~~~~~-~~~~-~",
    "~~~~~~~~~~~~~~~~",
)
COLORS = {
    ".": (58, 78, 110),
    "M": (120, 84, 60),
    "W": (242, 230, 204),
    "R": (217, 89, 51),
    "Y": (242, 158, 89),
    "B": (140, 84, 52),
    "~": (64, 153, 153),
    "-": (110, 190, 190),
}
# The corners of the wall: lower left, lower right, upper right, upper left.
CORNERS = ((-3, -1), (3, -1), (3, 1), (-3, 1))
COORDINATES = ((0, 0), (1, 0), (1, 1), (0, 1))


def make_texture():
    texture = glGenTextures(1)
    glBindTexture(GL_TEXTURE_2D, texture)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP)
    data = bytes(channel for row in IMAGE for letter in row for channel in COLORS[letter])
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 16, 16, 0, GL_RGB, GL_UNSIGNED_BYTE, data)


def draw_wall():
    glEnable(GL_TEXTURE_2D)
    glColor3f(1, 1, 1)
    # Three pictures side by side, and the first row of each at the top.
    glMatrixMode(GL_TEXTURE)
    glPushMatrix()
    glTranslatef(0, 1, 0)
    glScalef(3, -1, 1)
    glBegin(GL_QUADS)
    for (s, t), (x, y) in zip(COORDINATES, CORNERS):
        glTexCoord2f(s, t)
        glVertex3f(x, y, 0)
    glEnd()
    glPopMatrix()
    glMatrixMode(GL_MODELVIEW)
    glDisable(GL_TEXTURE_2D)
    glColor3f(0.95, 0.62, 0.35)
    for y in (-1.15, 1):
        glRectf(-3.15, y, 3.15, y + 0.15)


def on_key(window, key, scancode, action, mods):
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(640, 480, "A frieze of boats", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    make_texture()

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 50)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glTranslatef(0, 0, -11)
        glRotatef(-25, 0, 1, 0)
        glClear(GL_COLOR_BUFFER_BIT)
        draw_wall()
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
