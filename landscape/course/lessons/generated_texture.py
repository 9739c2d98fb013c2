"""A generated texture: filters and wrapping

A texture of 16 by 16 texels, a chessboard, is made in code. On the panel a texel covers many
pixels, on the floor a pixel covers many texels. GL_NEAREST takes one texel: blocks on the panel,
and noise on the floor. GL_LINEAR mixes four, which is too few far away. Mipmaps hold the image in
halved sizes, already averaged; the floor fades to the mean colour.

Keys: 1 nearest, 2 linear, 3 mipmaps; Space repeats the texture or clamps it to its edge.
"""
# topic: textures
# needs: vertex_arrays
# picture: frame 0
# keys: 1 2 SPACE
# programs: made_texture

import sys

import glfw
from OpenGL.GL import *
from text import _, write

SIZE = 16  # texels
LABELS = ("GL_NEAREST", "GL_LINEAR", "GL_LINEAR_MIPMAP_LINEAR")
FILTERS = (GL_NEAREST, GL_LINEAR, GL_LINEAR_MIPMAP_LINEAR)
chosen = 2
repeated = True


def make_texture():
    texels = bytearray()
    for row in range(SIZE):
        for column in range(SIZE):
            light = (row // 4 + column // 4) % 2
            red, green, blue = (240, 230, 205) if light else (64, 128, 140)
            if row == 0 or column == 0:  # a line along two edges shows where the image begins
                red = 217
                green = 89
                blue = 51
            texels += bytes((red, green, blue))
    glTexParameteri(GL_TEXTURE_2D, GL_GENERATE_MIPMAP, True)  # must come before the image
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, SIZE, SIZE, 0, GL_RGB, GL_UNSIGNED_BYTE, bytes(texels))


def set_texture():
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, FILTERS[chosen])
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, FILTERS[min(chosen, 1)])
    for direction in (GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T):
        wrap = GL_REPEAT if repeated else GL_CLAMP_TO_EDGE
        glTexParameteri(GL_TEXTURE_2D, direction, wrap)


def draw_scene():
    glColor3f(1, 1, 1)
    glEnable(GL_TEXTURE_2D)
    glBegin(GL_QUADS)
    for x, z in ((-30, 0), (30, 0), (30, -60), (-30, -60)):  # 2 units an image
        glTexCoord2f(x / 2, -z / 2)
        glVertex3f(x, -1, z)
    for x, y in ((-0.25, -0.25), (1.25, -0.25), (1.25, 1.25), (-0.25, 1.25)):
        glTexCoord2f(x, y)
        glVertex3f(1.2 * x - 0.05, 1.2 * y - 0.25, -3.2)
    glEnd()
    glDisable(GL_TEXTURE_2D)


def look(width, height):
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glFrustum(-0.05 * width / height, 0.05 * width / height, -0.05, 0.05, 0.1, 100)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()


def on_key(window, key, scancode, action, mods):
    global chosen, repeated
    if glfw.KEY_1 <= key < glfw.KEY_1 + len(LABELS):
        chosen = key - glfw.KEY_1
    if key == glfw.KEY_SPACE and action == glfw.PRESS:
        repeated = not repeated
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("A generated texture"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glEnable(GL_DEPTH_TEST)
    glClearColor(0.13, 0.16, 0.21, 1)
    make_texture()

    while not glfw.window_should_close(window):
        look(*glfw.get_framebuffer_size(window))
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        set_texture()
        draw_scene()

        write(16, 440, LABELS[chosen])  # above the floor, where it can be read
        write(16, 416, "GL_REPEAT" if repeated else "GL_CLAMP_TO_EDGE")
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
