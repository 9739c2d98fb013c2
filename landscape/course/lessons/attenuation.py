"""Attenuation: constant, linear and quadratic

Light is divided by kc + kl d + kq d², where d is the distance to the lamp. Each row has a lamp of
its own at the left: the first one does not become weaker, the second one by d, the third one by
d², as in nature. The factor f is written below each ball. Without the constant term, f has no
limit near the lamp, and the nearest balls are too bright.

Keys: Left and Right move the lamps; Space leaves out the constant term.
"""
# topic: light
# needs: light_model
# picture: frame 0
# keys: LEFT RIGHT SPACE

import math
import sys

import glfw
from OpenGL.GL import *
from text import _, write

LABELS = ("constant", "linear", "quadratic")
lamp = -3.5  # x of the lamps
constant = 1


def draw_ball():
    """Draw the half of a ball that faces the camera, in rings from its middle to its edge."""
    for ring in range(12):
        glBegin(GL_QUAD_STRIP)
        for n in range(33):
            angle = n * math.pi / 16
            for latitude in (ring * math.pi / 24, (ring + 1) * math.pi / 24):
                radius = math.sin(latitude)
                x = radius * math.cos(angle)
                y = radius * math.sin(angle)
                z = math.cos(latitude)
                glNormal3f(x, y, z)
                glVertex3f(0.6 * x, 0.6 * y, 0.6 * z)
        glEnd()


def draw_row(row):
    y = 1.95 - 1.95 * row
    kc, kl, kq = attenuation(row)
    glLightfv(GL_LIGHT0, GL_POSITION, (lamp, y, 1, 1))
    glLightf(GL_LIGHT0, GL_CONSTANT_ATTENUATION, kc)
    glLightf(GL_LIGHT0, GL_LINEAR_ATTENUATION, kl)
    glLightf(GL_LIGHT0, GL_QUADRATIC_ATTENUATION, kq)
    write(-16, 2, LABELS[row], (0.95, 0.62, 0.35), at=(-3.5, y + 0.62, 0))
    for column in range(5):
        x = 1.55 * column - 2.7
        d = math.dist((lamp, 1), (x, 0))
        glPushMatrix()
        glTranslatef(x, y, 0)
        draw_ball()
        glPopMatrix()
        write(-30, -18, "f {f:.2f}", at=(x, y - 0.62, 0), f=1 / (kc + kl * d + kq * d * d))

    draw_lamp(y)


def attenuation(row):
    """Return the three constants of a row: constant, linear and quadratic."""
    if row == 0:
        return 1, 0, 0
    if row == 1:
        return constant, 0.5, 0
    return constant, 0, 0.25


def draw_lamp(y):
    glDisable(GL_LIGHTING)
    glColor3f(1, 1, 0.8)
    glBegin(GL_POINTS)
    glVertex3f(lamp, y, 1)
    glEnd()
    glEnable(GL_LIGHTING)


def look(width, height):
    glViewport(0, 0, width, height)
    glPointSize(height / 53)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glOrtho(-3.3 * width / height, 3.3 * width / height, -3.65, 3.05, -2, 2)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()


def on_key(window, key, scancode, action, mods):
    global constant, lamp
    if key in (glfw.KEY_LEFT, glfw.KEY_RIGHT) and action != glfw.RELEASE:
        lamp += 0.4 if key == glfw.KEY_RIGHT else -0.4
    if key == glfw.KEY_SPACE and action == glfw.PRESS:
        constant = 1 - constant
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Attenuation"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    for capability in (GL_DEPTH_TEST, GL_LIGHTING, GL_LIGHT0):
        glEnable(capability)
    glMaterialfv(GL_FRONT, GL_AMBIENT_AND_DIFFUSE, (0.95, 0.9, 0.8, 1))
    glLightModelfv(GL_LIGHT_MODEL_AMBIENT, (0.06, 0.06, 0.06, 1))
    glClearColor(0.08, 0.1, 0.13, 1)

    while not glfw.window_should_close(window):
        look(*glfw.get_framebuffer_size(window))
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        for row in range(3):
            draw_row(row)

        write(16, 16, "constant term {kc}", kc=constant)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
