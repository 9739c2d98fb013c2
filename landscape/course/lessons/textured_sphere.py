"""A texture on a sphere: longitude and latitude, the seam and the poles

The texture coordinate s is the longitude, t the latitude. The last column of vertices lies on the
first one, but needs s = 1 instead of 0. If the two share a vertex, the last strip runs through the
whole image backward: a seam with a tiny mirrored map in it. At the poles a whole row of texels
falls on one point.

Keys: the arrows turn the planet; Space lets the last column share the first one's vertices.
"""
# topic: textures
# needs: generated_texture, world_light
# picture: frame 0
# keys: LEFT RIGHT UP DOWN SPACE

import math
import sys
from pathlib import Path

import glfw
from OpenGL.GL import *
from PIL import Image
from text import _, write

COLUMNS, ROWS = 36, 24
turned = 0  # degrees
tilted = 20
seam = True  # the last column has vertices of its own


def make_texture():
    image = Image.open(Path(__file__).parent / "data" / "planet.png").convert("RGB")
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE)
    # The first row of the image is the north: t is 0 there, and grows to the south.
    texels = image.tobytes()
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, *image.size, 0, GL_RGB, GL_UNSIGNED_BYTE, texels)


def draw_planet():
    glEnable(GL_TEXTURE_2D)
    for row in range(ROWS):
        glBegin(GL_QUAD_STRIP)
        for column in range(COLUMNS + 1):
            angle = column * math.tau / COLUMNS
            s = column / COLUMNS if seam else column % COLUMNS / COLUMNS
            for t in (row / ROWS, (row + 1) / ROWS):
                ring = math.sin(t * math.pi)
                x = ring * math.cos(angle)
                y = math.cos(t * math.pi)
                z = -ring * math.sin(angle)
                glTexCoord2f(s, t)
                glNormal3f(x, y, z)
                glVertex3f(x, y, z)
        glEnd()
    glDisable(GL_TEXTURE_2D)


def look(width, height):
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 50)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glLightfv(GL_LIGHT0, GL_POSITION, (-0.7, 0.5, 1, 0))
    glTranslatef(0, 0.05, -4.6)
    glRotatef(tilted, 1, 0, 0)
    glRotatef(turned - 80, 0, 1, 0)  # the seam is in sight


def on_key(window, key, scancode, action, mods):
    global seam, tilted, turned
    if key in (glfw.KEY_LEFT, glfw.KEY_RIGHT) and action != glfw.RELEASE:
        turned += 10 if key == glfw.KEY_RIGHT else -10
    if key in (glfw.KEY_UP, glfw.KEY_DOWN) and action != glfw.RELEASE:
        tilted = max(-90, min(90, tilted + (10 if key == glfw.KEY_DOWN else -10)))
    if key == glfw.KEY_SPACE and action == glfw.PRESS:
        seam = not seam
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("A texture on a sphere"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    for capability in (GL_DEPTH_TEST, GL_LIGHTING, GL_LIGHT0):
        glEnable(capability)
    glMaterialfv(GL_FRONT, GL_AMBIENT_AND_DIFFUSE, (1, 1, 1, 1))  # the texture has the colours
    glClearColor(0.04, 0.05, 0.08, 1)
    make_texture()

    while not glfw.window_should_close(window):
        look(*glfw.get_framebuffer_size(window))
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        draw_planet()

        write(16, 40, "turned {turned}°, tilted {tilted}°", turned=turned, tilted=tilted)
        write(16, 16, "last column: s = 1" if seam else "last column: s = 0")
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
