"""Frames in frames: a Ferris wheel

The parts of a Ferris wheel are drawn in one place, the middle of the picture. Each has a frame of
its own; put these frames into each other in draw_wheel.

The rim goes around its hub. The hub is at HUB, and the wheel is turned by `angle` around it,
counter-clockwise, in degrees. Eight cabins hang from the rim, RADIUS away from the hub: the first
at the right if the angle is 0, and the others each 45 degrees farther. A cabin is drawn below the
origin of its frame, from which it hangs. It turns with the wheel from place to place, but it never
tips over: its floor stays level.

In each cabin stands a person. In its frame a person stands on the origin and is 1 high; in the
frame of the cabin its feet are at (0.15, -0.9), and it is 0.45 high.

Keys: Left and Right turn the wheel.
"""
# exercise: frames

import math
import sys
from contextlib import contextmanager

import glfw
from OpenGL.GL import *

HUB = 0.5, 0.4
RADIUS = 3
turned = 10


def draw_rim():
    glColor3f(0.6, 0.65, 0.7)
    glBegin(GL_LINE_LOOP)
    for step in range(48):
        angle = 2 * math.pi * step / 48
        glVertex2f(RADIUS * math.cos(angle), RADIUS * math.sin(angle))
    glEnd()
    glBegin(GL_LINES)
    for step in range(8):
        angle = 2 * math.pi * step / 8
        glVertex2f(0, 0)
        glVertex2f(RADIUS * math.cos(angle), RADIUS * math.sin(angle))
    glEnd()


def draw_cabin():
    glColor3f(0.85, 0.35, 0.2)
    glBegin(GL_QUADS)
    for x, y in ((-0.45, -0.9), (0.45, -0.9), (0.45, -0.5), (-0.45, -0.5)):
        glVertex2f(x, y)
    for x, y in ((-0.55, -0.2), (0.55, -0.2), (0.25, 0), (-0.25, 0)):
        glVertex2f(x, y)
    glEnd()


def draw_person():
    glColor3f(0.95, 0.9, 0.8)
    glBegin(GL_POLYGON)
    for x, y in ((-0.25, 0), (0.25, 0), (0.3, 0.9), (0.1, 1), (-0.1, 1), (-0.3, 0.9)):
        glVertex2f(x, y)
    glEnd()


@contextmanager
def frame():
    """What is drawn in it has a frame of its own."""
    glPushMatrix()
    yield
    glPopMatrix()


def draw_wheel(angle):
    with frame():
        glTranslatef(HUB[0], HUB[1], 0)
        with frame():
            glRotatef(angle, 0, 0, 1)
            draw_rim()
        for number in range(8):
            with frame():
                around = math.radians(angle + 45 * number)
                glTranslatef(RADIUS * math.cos(around), RADIUS * math.sin(around), 0)
                draw_cabin()
                with frame():
                    glTranslatef(0.15, -0.9, 0)
                    glScalef(0.45, 0.45, 0.45)
                    draw_person()


def on_key(window, key, scancode, action, mods):
    global turned
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_RIGHT:
        turned -= 10
    elif key == glfw.KEY_LEFT:
        turned += 10
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(360, 360, "A Ferris wheel", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    glLineWidth(5)

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glOrtho(-5, 5, -5, 5, -1, 1)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glClear(GL_COLOR_BUFFER_BIT)
        draw_wheel(turned)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
