"""Text: a texture of letters, a display list for each

OpenGL draws no text. Each of the 256 characters in letters.png becomes a display list that draws
a quad and moves on by its width, so that a string is a single glCallLists of its bytes.

Keys: Left and Right choose a character; Space shows the quads.
"""
# topic: textures
# needs: display_list, textured_sphere, blending
# picture: frame 0
# keys: LEFT RIGHT SPACE

import sys
from pathlib import Path

import glfw
from OpenGL.GL import *
from PIL import Image

try:
    from landscape.course.language import translated as _
except ImportError:  # copied to where the package is not installed: the texts stay English
    _ = str

# Pixels of a letter.
WIDTH = 10
HEIGHT = 20
texture = 0
lists = 0  # the display list of the character with code 0
chosen = ord("g")
quads = False


def make_letters():
    global texture, lists
    letters = Image.open(Path(__file__).parent / "data" / "letters.png").tobytes()
    texture = glGenTextures(1)
    glBindTexture(GL_TEXTURE_2D, texture)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST)
    glTexImage2D(GL_TEXTURE_2D, 0, GL_ALPHA, 256, 512, 0, GL_ALPHA, GL_UNSIGNED_BYTE, letters)

    lists = glGenLists(256)
    for code in range(256):
        glNewList(lists + code, GL_COMPILE)
        glBegin(GL_QUADS)
        for x, y in ((0, 0), (1, 0), (1, 1), (0, 1)):
            # The image is 256 by 512; its first row is its top, and t counts from that row.
            glTexCoord2f((code % 16 + x) * WIDTH / 256, (code // 16 + 1 - y) * HEIGHT / 512)
            glVertex2f(x * WIDTH, y * HEIGHT)
        glEnd()
        glTranslatef(WIDTH, 0, 0)
        glEndList()


def write(x, y, text, /, color=(1, 1, 1), size=1, at=None, **values):
    """Write a text; x, y: pixels from the viewport's lower left corner, or from a point ``at``."""
    glPushAttrib(GL_ALL_ATTRIB_BITS)
    if not lists:
        make_letters()
    set_state()

    left, bottom, width, height = glGetIntegerv(GL_VIEWPORT)
    size_y = glfw.get_framebuffer_size(glfw.get_current_context())[1]
    scale = size_y // 480 or size_y / 480  # whole, for sharp letters, except in a small window
    if at:
        glRasterPos3f(*at)  # is transformed like a vertex, and can be read in pixels
        point = glGetFloatv(GL_CURRENT_RASTER_POSITION)[:2]
        x, y = (x, y) + ((point - (left, bottom)) / scale).round()

    text = _(text).format(**values) if values else _(text)
    for mode in (GL_PROJECTION, GL_MODELVIEW):
        glMatrixMode(mode)
        glPushMatrix()
        glLoadIdentity()
    glListBase(lists)
    glOrtho(0, width / scale, 0, height / scale, -1, 1)
    draw_letters(x + 1, y - 1, text, (0, 0, 0), size)  # a shadow, for bright backgrounds
    draw_letters(x, y, text, color, size)

    # All is as before.
    glPopMatrix()
    glMatrixMode(GL_PROJECTION)
    glPopMatrix()
    glPopAttrib()


def set_state():
    """Let the letters be blended over the picture, and nothing else change their colour."""
    for cap in (GL_LIGHTING, GL_COLOR_MATERIAL, GL_FOG, GL_DEPTH_TEST, GL_CULL_FACE, GL_ALPHA_TEST):
        glDisable(cap)
    glEnable(GL_BLEND)
    glEnable(GL_TEXTURE_2D)
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA)
    glBindTexture(GL_TEXTURE_2D, 0 if quads else texture)
    glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_MODULATE)
    glPolygonMode(GL_FRONT_AND_BACK, GL_LINE if quads else GL_FILL)


def draw_letters(x, y, text, color, size):
    """Call the display list of each letter; each moves on by its width."""
    glColor3f(*color)
    glPushMatrix()
    glTranslatef(x, y, 0)
    glScalef(size, size, 1)
    glCallLists(text.encode("cp1252", "replace"))
    glPopMatrix()


def on_key(window, key, scancode, action, mods):
    global chosen, quads
    if key in (glfw.KEY_LEFT, glfw.KEY_RIGHT) and action != glfw.RELEASE:
        chosen = (chosen + (1 if key == glfw.KEY_RIGHT else -1)) % 256
    if key == glfw.KEY_SPACE and action == glfw.PRESS:
        quads = not quads
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Text"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)

    while not glfw.window_should_close(window):
        glViewport(0, 0, *glfw.get_framebuffer_size(window))
        glClearColor(0.13, 0.16, 0.21, 1)
        glClear(GL_COLOR_BUFFER_BIT)
        letters = bytes(range(256)).decode("cp1252", "replace")
        for row in range(16):
            line = " ".join(letters[16 * row : 16 * row + 16])
            write(290, 420 - 24 * row, line, (0.5, 0.6, 0.6))
        write(70, 160, letters[chosen], (1, 0.75, 0.35), size=12)
        write(16, 16, "code {code}, display list {list}", code=chosen, list=lists + chosen)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
