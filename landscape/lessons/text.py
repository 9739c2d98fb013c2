"""Text: a texture of letters, a display list for each

OpenGL draws no text. The image letters.png holds the characters of code page 1252 in a grid of
16 by 16. Each becomes a display list that draws one textured quad and moves on by its width, so
that a string is a single glCallLists of its bytes. The other lessons write with `write`.

Keys: Left and Right choose a character; Space shows the quads.
"""
# topic: textures
# needs: display_list, image_texture, blending
# picture: frame 0
# keys: LEFT RIGHT SPACE

from pathlib import Path

import glfw
from OpenGL.GL import *
from PIL import Image

try:
    from landscape.course.language import translated as _
except ImportError:  # copied to where the package is not installed: the texts stay English
    _ = str

WIDTH, HEIGHT = 10, 20  # pixels of a letter
texture = lists = 0  # lists: the display list of the character with code 0
chosen = ord("g")
quads = False


def make_letters():
    """Make the texture and 256 display lists."""
    global texture, lists
    image = Image.open(Path(__file__).parent / "data" / "letters.png")
    width, height = image.size
    texture = glGenTextures(1)
    glBindTexture(GL_TEXTURE_2D, texture)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST)
    data = GL_ALPHA, GL_UNSIGNED_BYTE, image.tobytes()
    glTexImage2D(GL_TEXTURE_2D, 0, GL_ALPHA, width, height, 0, *data)
    lists = glGenLists(256)
    for code in range(256):
        row, column = divmod(code, 16)
        glNewList(lists + code, GL_COMPILE)
        glBegin(GL_QUADS)
        for x, y in ((0, 0), (1, 0), (1, 1), (0, 1)):
            # The first row of the image is its top, and t counts from the first row.
            glTexCoord2f((column + x) * WIDTH / width, (row + 1 - y) * HEIGHT / height)
            glVertex2f(x * WIDTH, y * HEIGHT)
        glEnd()
        glTranslatef(WIDTH, 0, 0)
        glEndList()


def write(x, y, text, color=(1, 1, 1), size=1, **values):
    """Write a text with its {values}; x and y: pixels from the viewport's lower left corner."""
    glPushAttrib(GL_ALL_ATTRIB_BITS)
    if not lists:
        make_letters()
    for capability in (GL_LIGHTING, GL_FOG, GL_DEPTH_TEST, GL_CULL_FACE, GL_ALPHA_TEST):
        glDisable(capability)
    glEnable(GL_BLEND)
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA)
    glEnable(GL_TEXTURE_2D)
    glBindTexture(GL_TEXTURE_2D, texture)
    glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_MODULATE)
    glPolygonMode(GL_FRONT_AND_BACK, GL_LINE if quads else GL_FILL)
    width, height = glGetIntegerv(GL_VIEWPORT)[2:]
    scale = max(1, glfw.get_framebuffer_size(glfw.get_current_context())[1] // 480)
    glMatrixMode(GL_PROJECTION)
    glPushMatrix()
    glLoadIdentity()
    glOrtho(0, width / scale, 0, height / scale, -1, 1)
    glMatrixMode(GL_MODELVIEW)
    glPushMatrix()
    # First a dark copy, one pixel to the lower right: it can be read on any background.
    for shift, shade in ((1, (0, 0, 0)), (0, color)):
        glColor3f(*shade)
        glLoadIdentity()
        glTranslatef(x + shift, y - shift, 0)
        glScalef(size, size, 1)
        glListBase(lists)
        glCallLists(_(text).format(**values).encode("cp1252", "replace"))
    glPopMatrix()
    glMatrixMode(GL_PROJECTION)
    glPopMatrix()
    glPopAttrib()


def on_key(window, key, scancode, action, mods):
    global chosen, quads
    if key in (glfw.KEY_LEFT, glfw.KEY_RIGHT) and action != glfw.RELEASE:
        chosen = (chosen + (1 if key == glfw.KEY_RIGHT else -1)) % 256
    if key == glfw.KEY_SPACE and action == glfw.PRESS:
        quads = not quads
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    glfw.init()
    window = glfw.create_window(640, 480, _("Text"), None, None)
    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    while not glfw.window_should_close(window):
        glViewport(0, 0, *glfw.get_framebuffer_size(window))
        glClearColor(0.13, 0.16, 0.21, 1)
        glClear(GL_COLOR_BUFFER_BIT)
        write(30, 180, bytes([chosen]).decode("cp1252", "replace"), (1, 0.75, 0.35), size=12)
        write(200, 300, "code {code}, display list {list}", code=chosen, list=lists + chosen)
        glfw.swap_buffers(window)
        glfw.poll_events()
    glfw.terminate()


if __name__ == "__main__":
    main()
