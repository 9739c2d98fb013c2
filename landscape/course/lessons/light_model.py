"""Light model: ambient, diffuse and specular

The colour of a vertex is a sum of three terms: ambient, diffuse and specular light. Ambient light
comes from everywhere. Diffuse light depends on the angle between the normal and the direction to
the light. Specular light is ks times the nth power of the cosine of the angle between the normal
and the halfway direction: larger n makes the highlight smaller, larger ks makes it brighter.

Keys: 1, 2 and 3 switch the ambient, the diffuse and the specular term.
"""
# topic: light
# needs: depth_buffer
# picture: frame 0
# keys: 1 2 3

import math
import sys

import glfw
from OpenGL.GL import *
from text import _, write

KS = (0.2, 0.5, 0.9)
N = (5, 20, 100)
LABELS = ("ambient", "diffuse", "specular")
BLACK = (0, 0, 0, 1)
on = [True, True, True]


def draw_ball():
    """Draw the half of a ball that faces the camera, in rings from its middle to its edge."""
    for ring in range(16):
        glBegin(GL_QUAD_STRIP)
        for n in range(41):
            angle = n * math.pi / 20
            for latitude in (ring * math.pi / 32, (ring + 1) * math.pi / 32):
                radius = math.sin(latitude)
                x = radius * math.cos(angle)
                y = radius * math.sin(angle)
                z = math.cos(latitude)
                glNormal3f(x, y, z)
                glVertex3f(x, y, z)
        glEnd()


def set_material(ks, n):
    ambient, diffuse, specular = on
    glMaterialfv(GL_FRONT, GL_AMBIENT, (0.25, 0.1, 0.06, 1) if ambient else BLACK)
    glMaterialfv(GL_FRONT, GL_DIFFUSE, (0.75, 0.3, 0.18, 1) if diffuse else BLACK)
    glMaterialfv(GL_FRONT, GL_SPECULAR, (ks, ks, ks, 1) if specular else BLACK)
    glMaterialf(GL_FRONT, GL_SHININESS, n)


def draw_grid():
    for row, n in enumerate(N):
        for column, ks in enumerate(KS):
            place = (2.4 * column - 2.1, 2.4 - 2.25 * row, 0)
            set_material(ks, n)
            glPushMatrix()
            glTranslatef(*place)
            draw_ball()
            glPopMatrix()
            if row == 0:
                write(-35, 2, "ks = {ks}", at=(place[0], 3.45, 0), ks=ks)
        write(0, -6, "n = {n}", at=(-4.6, place[1], 0), n=n)


def look(width, height):
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glOrtho(-4 * width / height, 4 * width / height, -4, 4, 6, 10)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glTranslatef(0.3, 0.1, -8)


def on_key(window, key, scancode, action, mods):
    if key in (glfw.KEY_1, glfw.KEY_2, glfw.KEY_3) and action == glfw.PRESS:
        on[key - glfw.KEY_1] = not on[key - glfw.KEY_1]
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Light model"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    for capability in (GL_DEPTH_TEST, GL_LIGHTING, GL_LIGHT0):
        glEnable(capability)
    glLightfv(GL_LIGHT0, GL_POSITION, (-0.6, 0.8, 1, 0))
    glLightfv(GL_LIGHT0, GL_AMBIENT, (1, 1, 1, 1))
    glLightModelfv(GL_LIGHT_MODEL_AMBIENT, BLACK)  # no ambient light but that of the lamp
    glClearColor(0.13, 0.16, 0.21, 1)

    while not glfw.window_should_close(window):
        look(*glfw.get_framebuffer_size(window))
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        draw_grid()
        for n in range(3):
            write(16 + 120 * n, 16, LABELS[n], (1, 1, 1) if on[n] else (0.4, 0.45, 0.5))
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
