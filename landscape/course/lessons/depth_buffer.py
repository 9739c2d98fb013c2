"""Depth buffer: hidden surfaces, and how precise the buffer is

The depth buffer keeps the depth of what is seen at each pixel; nearer fragments replace it, others
are dropped. Without the depth test whatever is drawn last covers the rest, and no order of these
three beams would be right, because each lies above the next. With the near plane too near, the
buffer's steps are larger than the distance of the disc to the wall, and the two flicker.

Keys: Space disables the depth test; N moves the near plane from 1 to 0.0001.
"""
# topic: light
# needs: matrix_stack
# picture: frame 30
# loop: 240 frames
# keys: SPACE N

import math
import sys

import glfw
from OpenGL.GL import *
from text import _, write

tested = True
near = 1


def draw_box(width, height, depth, color):
    glBegin(GL_QUADS)
    for axis, shade in ((2, 1), (0, 0.75), (1, 0.6)):
        glColor3f(*(shade * channel for channel in color))
        for side in (-1, 1):
            for u, v in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                x, y, z = ((side, u, v), (u, side, v), (u, v, side))[axis]
                glVertex3f(x * width / 2, y * height / 2, z * depth / 2)
    glEnd()


def draw_disc(radius, z, color):
    glColor3f(*color)
    glBegin(GL_TRIANGLE_FAN)
    for n in range(48):
        glVertex3f(radius * math.cos(n * math.pi / 24), radius * math.sin(n * math.pi / 24), z)
    glEnd()


def draw_scene():
    glPushMatrix()
    glTranslatef(0, 0, -1.5)
    draw_box(22, 14, 0.1, (0.32, 0.38, 0.45))
    draw_disc(2.15, 0.06, (0.25, 0.6, 0.6))  # 0.01 above the wall
    draw_disc(1.6, 0.07, (0.95, 0.9, 0.8))
    glPopMatrix()
    for n, color in enumerate(((0.85, 0.35, 0.2), (0.95, 0.62, 0.35), (0.3, 0.5, 0.8))):
        glPushMatrix()
        glRotatef(120 * n, 0, 0, 1)
        glTranslatef(0, -0.75, 0)
        glRotatef(20, 0, 1, 0)  # the right end away from the camera: under the next beam
        draw_box(4, 0.5, 0.5, color)
        glPopMatrix()


def look(width, height):
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    top = near * 0.4
    glFrustum(-top * width / height, top * width / height, -top, top, near, 100)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glTranslatef(0.3, 0.25, -7)
    glRotatef(25 * math.sin(glfw.get_time() * math.pi / 2), 0, 1, 0)
    glRotatef(-20, 1, 0, 0)


def on_key(window, key, scancode, action, mods):
    global near, tested
    if key == glfw.KEY_SPACE and action == glfw.PRESS:
        tested = not tested
    if key == glfw.KEY_N and action == glfw.PRESS:
        near = 0.0001 if near == 1 else 1
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Depth buffer"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)

    while not glfw.window_should_close(window):
        if tested:
            glEnable(GL_DEPTH_TEST)
        else:
            glDisable(GL_DEPTH_TEST)
        look(*glfw.get_framebuffer_size(window))
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        draw_scene()

        write(16, 40, "depth test on" if tested else "depth test off")
        write(16, 16, "near plane {near}, far plane 100", near=near)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
