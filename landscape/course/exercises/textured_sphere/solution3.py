"""The textured sphere: a map around a planet

MAP is the map of a planet: its first row is the far north, its last row the far south, and along a
row one goes east. Lay it around the ball, once, without a gap: the planet has only one colour yet,
as no vertex has texture coordinates.

A vertex of the ball lies at a longitude, the angle around the y axis, and at an angle from the
north pole. s is the part of the whole turn, from 0 to 1, t the part of the way from pole to pole:
0 in the north, 1 in the south. The vertices of column 0 lie at longitude 0, and s is 0 there.

The last strip of the ball lies between the last column and the first one again. There, s must not
go back from nearly 1 to 0: the whole map would be squeezed into the strip. What is needed in that
place instead?

Change draw_planet. The ball keeps its shape and its light.

Keys: Left and Right turn the planet, Up and Down tilt it.
"""
# exercise: textured_sphere

import sys

import glfw
from OpenGL.GL import *
from OpenGL.GLU import *

MAP = (
    "****************",
    "**~~**..~~~***~*",
    "~~.##..~~~~..~~~",
    "~.####~~~~.##.~~",
    "~~.##.~~~~~.dd.~",
    "~~~.~~~~~~~~ddd~",
    "~~~~~~##~~~~.d~~",
    "****************",
)
COLORS = {
    "*": (240, 245, 250),
    "~": (50, 100, 160),
    ".": (90, 160, 170),
    "#": (60, 130, 70),
    "d": (220, 170, 90),
}
COLUMNS = 24
ROWS = 16
turned = 0
tilted = 20


def make_texture():
    texels = bytes(channel for row in MAP for letter in row for channel in COLORS[letter])
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 16, 8, 0, GL_RGB, GL_UNSIGNED_BYTE, texels)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE)


def draw_planet():
    quadric = gluNewQuadric()
    gluQuadricTexture(quadric, GL_TRUE)
    # Its poles are on the z axis, and t is 0 at the lower one.
    glMatrixMode(GL_TEXTURE)
    glTranslatef(0, 1, 0)
    glScalef(1, -1, 1)
    glMatrixMode(GL_MODELVIEW)
    glPushMatrix()
    glRotatef(-90, 0, 1, 0)
    glRotatef(-90, 1, 0, 0)
    gluSphere(quadric, 1, COLUMNS, ROWS)
    glPopMatrix()
    glMatrixMode(GL_TEXTURE)
    glLoadIdentity()
    glMatrixMode(GL_MODELVIEW)
    gluDeleteQuadric(quadric)


def on_key(window, key, scancode, action, mods):
    global turned, tilted
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_LEFT:
        turned -= 30
    elif key == glfw.KEY_RIGHT:
        turned += 30
    elif key == glfw.KEY_UP:
        tilted -= 20
    elif key == glfw.KEY_DOWN:
        tilted += 20
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(300, 300, "A planet", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.08, 0.1, 0.14, 1)
    for capability in (GL_DEPTH_TEST, GL_LIGHTING, GL_LIGHT0, GL_TEXTURE_2D):
        glEnable(capability)
    glMaterialfv(GL_FRONT, GL_AMBIENT_AND_DIFFUSE, (1, 1, 1, 1))
    glLightfv(GL_LIGHT0, GL_POSITION, (-1, 1, 3, 0))
    make_texture()

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glOrtho(-1.2 * width / height, 1.2 * width / height, -1.2, 1.2, -3, 3)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glRotatef(tilted, 1, 0, 0)
        glRotatef(turned, 0, 1, 0)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        draw_planet()
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
