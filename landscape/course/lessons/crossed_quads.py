"""Crossed quads: plants of two upright pictures

Each fern is one picture on two quads that cross at right angles. They do not follow the camera,
and the wind moves their upper vertices. The alpha test drops the transparent texels, so the depth
buffer can order the leaves and nothing is sorted. With one quad only, a fern vanishes where it is
seen from the side; without the alpha test, every quad is a green card.

Keys: Space leaves out the second quad; T switches the alpha test; Up and Down move the camera.
"""
# topic: landscape
# needs: blending, billboard, sorting
# picture: frame 0
# keys: SPACE T UP DOWN

import math
import sys
from pathlib import Path

import glfw
from OpenGL.GL import *
from PIL import Image
from text import _, write

# x, z, size and rotation in degrees of each fern
FERNS = (0, 0, 2.6, 30), (2, 0, 2, 75), (0.6, 1.8, 1.8, 10), (-1.5, 1, 2, 55), (-1, -1.7, 2.2, 20)
elevation = 20  # degrees of the camera above the horizon
crossed = True
alpha_test = True


def load_texture():
    image = Image.open(Path(__file__).parent / "data" / "plant.png").convert("RGBA")
    glBindTexture(GL_TEXTURE_2D, glGenTextures(1))
    glTexParameteri(GL_TEXTURE_2D, GL_GENERATE_MIPMAP, GL_TRUE)
    data = GL_RGBA, GL_UNSIGNED_BYTE, image.tobytes()
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, *image.size, 0, *data)


def draw_band(*circles):
    """Draw the band between two circles (radius, y, colour) around the y axis."""
    glBegin(GL_QUAD_STRIP)
    for degrees in range(0, 361, 6):
        angle = math.radians(degrees)
        for radius, y, color in circles:
            glColor3f(*color)
            glVertex3f(radius * math.cos(angle), y, radius * math.sin(angle))
    glEnd()


def draw_bowl():
    draw_band((0, 0, (0.12, 0.1, 0.08)), (3, 0, (0.4, 0.33, 0.25)))  # soil
    draw_band((3, 0, (0.85, 0.35, 0.2)), (2.8, -0.6, (0.4, 0.15, 0.1)))


def draw_fern(x, z, size, rotation):
    """Draw a fern; its quads lie along the x and z axes of its own frame."""
    sway = 0.06 * size * math.cos(3 * glfw.get_time() - 1.2 * x - 0.74 * z)
    glPushMatrix()
    glTranslatef(x, 0, z)
    glRotatef(rotation, 0, 1, 0)
    glBegin(GL_QUADS)
    directions = ((1, 0), (0, 1)) if crossed else ((1, 0),)
    for along_x, along_z in directions:
        # t is 0 in the first row of the image, which is its top.
        for s, t in ((0, 1), (1, 1), (1, 0), (0, 0)):
            side = (s - 0.5) * size
            up = (1 - t) * size
            glTexCoord2f(s, t)
            glVertex3f(side * along_x + sway * (1 - t), up, side * along_z)
    glEnd()
    glPopMatrix()


def draw_ferns():
    """Draw all ferns; the alpha test leaves out their transparent texels."""
    glEnable(GL_TEXTURE_2D)
    if alpha_test:
        glEnable(GL_ALPHA_TEST)
    glColor3f(1, 1, 1)
    for fern in FERNS:
        draw_fern(*fern)
    glDisable(GL_ALPHA_TEST)
    glDisable(GL_TEXTURE_2D)


def look(width, height):
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 50)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glTranslatef(0, -0.5, -13)
    glRotatef(elevation, 1, 0, 0)
    glRotatef(20 + 15 * glfw.get_time(), 0, 1, 0)


def on_key(window, key, scancode, action, mods):
    global elevation, crossed, alpha_test
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_UP:
        elevation = min(90, elevation + 10)
    elif key == glfw.KEY_DOWN:
        elevation = max(0, elevation - 10)
    elif key == glfw.KEY_SPACE:
        crossed = not crossed
    elif key == glfw.KEY_T:
        alpha_test = not alpha_test
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Crossed quads"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    load_texture()
    glEnable(GL_DEPTH_TEST)
    glAlphaFunc(GL_GREATER, 0.5)
    glClearColor(0.13, 0.16, 0.21, 1)

    while not glfw.window_should_close(window):
        look(*glfw.get_framebuffer_size(window))
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        draw_bowl()
        draw_ferns()
        write(16, 40, "quads per fern: {count}", count=2 if crossed else 1)
        write(16, 16, "alpha test on" if alpha_test else "alpha test off")
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
