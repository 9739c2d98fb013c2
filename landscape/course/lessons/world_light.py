"""A light in the world's frame: the sun over standing stones

The sun stands still while the camera goes around. So its direction must be set in each frame after
the camera's transform, which the modelview matrix then carries over to it. Set before it, the
direction is taken in the camera's frame: the light turns with the viewer, and the lit sides of the
stones no longer face the sun.

Keys: Left and Right move the camera around; Space sets the direction before the viewing transform.
"""
# topic: light
# needs: camera_light
# picture: frame 0
# keys: LEFT RIGHT SPACE

import math
import sys

import glfw
from OpenGL.GL import *
from text import _, write

SUN = (0, 0.55, 1, 0)  # the fourth coordinate 0: a direction, not a place
around = -130  # degrees, of the camera
fixed = True


def draw_stone(width, height, depth):
    glBegin(GL_QUADS)
    for axis in range(3):
        for side in (-1, 1):
            normal = [side * (n == axis) for n in range(3)]
            glNormal3f(*normal)
            for u, v in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                x, y, z = ((side, u, v), (u, side, v), (u, v, side))[axis]
                narrow = 0.9 - 0.1 * y  # at the top
                glVertex3f(narrow * x * width / 2, (y + 1) * height / 2, narrow * z * depth / 2)
    glEnd()


def draw_place():
    glMaterialfv(GL_FRONT, GL_AMBIENT_AND_DIFFUSE, (0.3, 0.5, 0.42, 1))
    glNormal3f(0, 1, 0)
    glBegin(GL_TRIANGLE_FAN)
    for n in range(48):
        glVertex3f(4.4 * math.cos(n * math.pi / 24), 0, -4.4 * math.sin(n * math.pi / 24))
    glEnd()
    glMaterialfv(GL_FRONT, GL_AMBIENT_AND_DIFFUSE, (0.95, 0.88, 0.78, 1))
    for n in range(9):
        glPushMatrix()
        glRotatef(40 * n, 0, 1, 0)
        glTranslatef(0, 0, 3.3)
        draw_stone(1.1, 1.5 + 0.35 * (n % 3), 0.6)
        glPopMatrix()
    draw_stone(0.8, 0.7, 1.6)


def draw_sun():
    """Draw the sun where it ought to be, far away in its direction."""
    glDisable(GL_LIGHTING)
    glColor3f(1, 0.85, 0.45)
    glBegin(GL_POINTS)
    glVertex3f(*(8 * coordinate for coordinate in SUN[:3]))
    glEnd()
    glEnable(GL_LIGHTING)


def look(width, height):
    glViewport(0, 0, width, height)
    glPointSize(height / 12)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glFrustum(-width / height / 2, width / height / 2, -0.5, 0.5, 1, 50)
    glMatrixMode(GL_MODELVIEW)


def on_key(window, key, scancode, action, mods):
    global around, fixed
    if key in (glfw.KEY_LEFT, glfw.KEY_RIGHT) and action != glfw.RELEASE:
        around += 15 if key == glfw.KEY_RIGHT else -15
    if key == glfw.KEY_SPACE and action == glfw.PRESS:
        fixed = not fixed
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("A light in the world's frame"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    for capability in (GL_DEPTH_TEST, GL_LIGHTING, GL_LIGHT0, GL_NORMALIZE, GL_POINT_SMOOTH):
        glEnable(capability)
    glLightfv(GL_LIGHT0, GL_DIFFUSE, (1, 0.95, 0.85, 1))
    glLightModelfv(GL_LIGHT_MODEL_AMBIENT, (0.3, 0.34, 0.42, 1))
    glClearColor(0.13, 0.16, 0.21, 1)

    while not glfw.window_should_close(window):
        look(*glfw.get_framebuffer_size(window))
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        glLoadIdentity()
        if not fixed:
            glLightfv(GL_LIGHT0, GL_POSITION, SUN)
        glTranslatef(0, -0.7, -8.5)
        glRotatef(18, 1, 0, 0)
        glRotatef(around, 0, 1, 0)
        if fixed:
            glLightfv(GL_LIGHT0, GL_POSITION, SUN)
        draw_sun()
        draw_place()

        write(16, 16, "view first, then the light" if fixed else "light first, then the view")
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
