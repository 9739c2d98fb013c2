"""Water: an island, its mirror image, and two layers of waves

The order makes the water. First comes the island's mirror image; then the island, whose sea bed
fades with the depth, so that the image shows through; last the surface, two layers of waves that
drift apart, blended over both. Drawn first, the surface hides the image by its depth. Without
blending, it hides all that lies below.

Keys: Space switches blending off for the surface; O draws the surface first.
"""
# topic: landscape
# needs: height_field, mirror
# picture: frame 60
# loop: 240 frames
# keys: SPACE O

import sys
from pathlib import Path

import glfw
from OpenGL.GL import *
from PIL import Image
from text import _, write

DATA = Path(__file__).parent / "data"
RELIEF = 0.6  # height of what is white in heights.png
SEA = 0.072  # height of the sea
SIDE = 128  # pixels of heights.png, across and down
STEP = 2  # pixels from vertex to vertex
blended = True
surface_last = True


def load(name):
    image = Image.open(DATA / name).convert("RGB")
    texture = glGenTextures(1)
    glBindTexture(GL_TEXTURE_2D, texture)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR)
    glTexParameteri(GL_TEXTURE_2D, GL_GENERATE_MIPMAP, GL_TRUE)
    data = GL_RGB, GL_UNSIGNED_BYTE, image.tobytes()
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, *image.size, 0, *data)
    return texture


def make_island():
    """Compile the island, with the sea at y = 0, into a display list."""
    image = Image.open(DATA / "heights.png")
    island = glGenLists(1)
    glNewList(island, GL_COMPILE)
    for row in range(0, SIDE, STEP):
        glBegin(GL_TRIANGLE_STRIP)
        for column in range(0, SIDE + 1, STEP):
            for z in (row, row + STEP):
                y = RELIEF * image.getpixel((column, z)) / 65535 - SEA
                glColor4f(1, 1, 1, 1 + y / 0.03)  # is clamped: 1 on land, 0 from y = -0.03
                glTexCoord2f(column / SIDE, z / SIDE)
                glVertex3f(2 * column / SIDE - 1, y, 2 * z / SIDE - 1)
        glEnd()
    glEndList()
    return island


def draw_image(island, ground):
    """Draw the island mirrored at the surface, and of it only what is below the surface."""
    glBindTexture(GL_TEXTURE_2D, ground)
    glClipPlane(GL_CLIP_PLANE0, (0, -1, 0, 0))
    glEnable(GL_CLIP_PLANE0)
    glScalef(1, -1, 1)
    glCallList(island)
    glScalef(1, -1, 1)  # mirrored twice is not mirrored
    glDisable(GL_CLIP_PLANE0)


def draw_surface(waves):
    """Draw two layers of waves, one of them larger and the other way round: they drift apart."""
    glBindTexture(GL_TEXTURE_2D, waves)
    if blended:
        glEnable(GL_BLEND)
    else:
        glDisable(GL_BLEND)
    glColor4f(0.25, 0.7, 0.82, 0.34)
    glBegin(GL_QUADS)
    for scale in (4, -3):
        for x, z in ((-40, -40), (-40, 40), (40, 40), (40, -40)):
            glTexCoord2f(scale * x, scale * z + 0.1 * glfw.get_time())
            glVertex3f(x, 0, z)
    glEnd()
    glEnable(GL_BLEND)


def look(width, height):
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glFrustum(-width / height / 20, width / height / 20, -0.05, 0.05, 0.1, 60)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glTranslatef(0, 0.06, -2.15)
    glRotatef(12, 1, 0, 0)
    glRotatef(180 + 6 * glfw.get_time(), 0, 1, 0)


def on_key(window, key, scancode, action, mods):
    global blended, surface_last
    if action != glfw.PRESS:
        return
    if key == glfw.KEY_SPACE:
        blended = not blended
    elif key == glfw.KEY_O:
        surface_last = not surface_last
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Water"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.62, 0.78, 0.92, 1)
    for cap in (GL_DEPTH_TEST, GL_TEXTURE_2D, GL_BLEND):
        glEnable(cap)
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA)
    glDepthFunc(GL_LEQUAL)  # the second layer of waves is as deep as the first
    ground = load("ground.png")
    waves = load("water.png")
    island = make_island()

    while not glfw.window_should_close(window):
        look(*glfw.get_framebuffer_size(window))
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        if not surface_last:
            draw_surface(waves)
        draw_image(island, ground)
        glCallList(island)
        if surface_last:
            draw_surface(waves)

        write(16, 40, "blending on" if blended else "blending off")
        write(16, 16, "surface last" if surface_last else "surface first")
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
