"""A texture that the program makes, on a quad that turns, with GLFW."""

import sys

import glfw
from OpenGL.GL import *
from OpenGL.GLU import gluLookAt, gluPerspective

SIZE = 128  # texels
angle = 0


def make_bitmap():
    """Return the texels, four bytes each, row after row."""
    texels = bytearray()
    for row in range(SIZE):
        for column in range(SIZE):
            texels += bytes((32 * row % 256, 32 * column % 256, 256 * row * column % 256, 255))
    return bytes(texels)


def make_texture():
    """Make a texture object and fill it; drawing then binds it by its name."""
    texture = glGenTextures(1)
    glBindTexture(GL_TEXTURE_2D, texture)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST)
    texels = make_bitmap()
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, SIZE, SIZE, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels)
    return texture


def draw_quad(texture):
    glBindTexture(GL_TEXTURE_2D, texture)
    glEnable(GL_TEXTURE_2D)
    glBegin(GL_QUADS)
    for s, t in ((0, 0), (1, 0), (1, 1), (0, 1)):
        glTexCoord2f(s, t)
        glVertex3f(6 * s - 3, 4 * t - 2, 0)
    glEnd()
    glDisable(GL_TEXTURE_2D)


def display(window):
    glClearColor(1, 1, 1, 1)
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
    glPushMatrix()
    gluLookAt(8, 10, 15, 0, 0, 0, 0, 1, 0)
    glRotatef(0.05 * angle, 0, 1, 0)
    draw_quad(texture)
    glPopMatrix()
    glfw.swap_buffers(window)


def reshape(window, width, height):
    """Called for a new size: the viewport, and the projection with its aspect."""
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    gluPerspective(20, width / max(height, 1), 0.01, 10000)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()


def main():
    global angle, texture
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(500, 500, "A made texture", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.set_window_pos(window, 100, 100)
    glfw.make_context_current(window)
    glEnable(GL_DEPTH_TEST)
    glfw.set_framebuffer_size_callback(window, reshape)
    reshape(window, *glfw.get_framebuffer_size(window))
    texture = make_texture()

    while not glfw.window_should_close(window):
        display(window)
        angle += 1
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
