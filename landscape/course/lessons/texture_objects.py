"""Texture objects: names, formats, and giving them back

glGenTextures gives names, glBindTexture chooses the texture that all calls are about, and
glTexImage2D fills it. Here one picture of red, green, blue and alpha is given to six textures, each
with another internal format: what OpenGL keeps of it. Bound again later, each is there at once,
without being sent again. A texture that glDeleteTextures has given back draws nothing but the plain
colour.

Keys: 1 to 6 delete a texture, and make it again; Space leaves out glBindTexture when drawing.
"""
# topic: textures
# needs: generated_texture, blending
# picture: frame 0
# keys: 1 2 3 SPACE

import math
import sys

import glfw
from OpenGL.GL import *
from text import _, write

SIZE = 64  # texels
FORMATS = (  # internal formats; their names say which numbers are kept
    (GL_RGB, "GL_RGB"),
    (GL_RGBA, "GL_RGBA"),
    (GL_R3_G3_B2, "GL_R3_G3_B2"),
    (GL_LUMINANCE, "GL_LUMINANCE"),
    (GL_ALPHA, "GL_ALPHA"),
    (GL_INTENSITY, "GL_INTENSITY"),
)
textures = [0] * 6  # their names; 0 is no texture object
bound = True


def make_texels():
    """Return a picture of SIZE by SIZE texels: a ball with a soft edge, in rows from below."""
    texels = bytearray()
    for row in range(SIZE):
        for column in range(SIZE):
            x = (column + 0.5) * 2 / SIZE - 1
            y = (row + 0.5) * 2 / SIZE - 1
            light = max(0.0, 1 - math.hypot(x + 0.3, y - 0.3) / 1.3)
            alpha = min(1.0, max(0.0, 6 * (0.9 - math.hypot(x, y))))
            color = (250 * light, 90 + 110 * (row / SIZE) * light, 200 * (1 - light))
            texels += bytes(int(part) for part in (*color, 255 * alpha))
    return bytes(texels)


TEXELS = make_texels()


def make_texture(number):
    textures[number] = glGenTextures(1)
    glBindTexture(GL_TEXTURE_2D, textures[number])
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE)
    glTexImage2D(
        GL_TEXTURE_2D,  # the target, and 0, the full size; smaller mipmaps would be 1, 2, ...
        0,
        FORMATS[number][0],  # what OpenGL keeps
        SIZE,
        SIZE,
        0,  # no border
        GL_RGBA,  # what the bytes are: four numbers a texel
        GL_UNSIGNED_BYTE,  # from 0 to 255 each
        TEXELS,
    )


def delete_texture(number):
    glDeleteTextures([textures[number]])
    textures[number] = 0


def draw_panel(x, y, size):
    """Draw a chessboard, and the texture over it, by alpha."""
    draw_board(x, y, size)
    glEnable(GL_TEXTURE_2D)
    glEnable(GL_BLEND)
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA)
    glColor3f(0.95, 0.9, 0.8)  # the texture is multiplied by it
    glBegin(GL_QUADS)
    for s, t in ((0, 0), (1, 0), (1, 1), (0, 1)):
        glTexCoord2f(s, t)
        glVertex2f(x + size * s, y + size * t)
    glEnd()
    glDisable(GL_BLEND)
    glDisable(GL_TEXTURE_2D)


def draw_board(x, y, size):
    for row in range(6):
        for column in range(6):
            glColor3f(*((0.3, 0.36, 0.42) if (row + column) % 2 else (0.42, 0.48, 0.54)))
            left = x + size * column / 6
            low = y + size * row / 6
            glRectf(left, low, left + size / 6, low + size / 6)


def draw(width, height):
    glViewport(0, 0, width, height)
    glLoadIdentity()
    glOrtho(0, 480 * width / height, 0, 480, -1, 1)
    for number, (_format, name) in enumerate(FORMATS):
        x = 30 + 208 * (number % 3)
        y = 285 - 215 * (number // 3)
        if bound:
            glBindTexture(GL_TEXTURE_2D, textures[number])
        draw_panel(x, y, 160)
        write(0, -24, "{key}: {name}", at=(x, y, 0), key=number + 1, name=name)
        if not textures[number]:
            write(40, 70, "deleted", (0.4, 0.2, 0.1), at=(x, y, 0))

    if bound:
        write(16, 8, "bound before each panel", (0.6, 0.65, 0.7))
    else:
        write(16, 8, "not bound: the last one bound is in all panels", (0.95, 0.62, 0.35))


def on_key(window, key, scancode, action, mods):
    global bound
    if action != glfw.PRESS:
        return
    if glfw.KEY_1 <= key < glfw.KEY_1 + len(FORMATS):
        number = key - glfw.KEY_1
        if textures[number]:
            delete_texture(number)
        else:
            make_texture(number)
    elif key == glfw.KEY_SPACE:
        bound = not bound
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Texture objects"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    for number in range(6):
        make_texture(number)

    while not glfw.window_should_close(window):
        glClear(GL_COLOR_BUFFER_BIT)
        draw(*glfw.get_framebuffer_size(window))
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
