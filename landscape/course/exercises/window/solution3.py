"""A window: the sky over the roofs

A street at dusk, and a moon that moves. The sky is black, as nothing fills the window with a
colour, and the moon leaves a trail, as each picture is drawn over the one before it.

Fill the whole window with the colour of the sky at the beginning of each picture. The colour
depends on `light`: its red is light itself, its green 0.5 times light, its blue 0.35 times light.
In OpenGL, 1 is the full brightness of a channel.

Then let the keys change it. Up adds 0.1 to `light`, and Down takes 0.1 away, once when the key is
pressed, and once each time it is repeated because it is held; when it is let go, nothing happens.
`light` is never less than 0 nor more than 1: at 1, Up does nothing, and a single Down then leads
to 0.9.

Change draw_sky and on_key.
"""
# exercise: window

import math
import sys

import glfw
import numpy as np
from OpenGL.GL import *

light = 0.5


def draw_sky():
    """Fill the window with the colour of the sky."""
    glColor3fv(light * np.array((1, 0.5, 0.35)))
    glEnableClientState(GL_VERTEX_ARRAY)
    glVertexPointerf([(-1, -1), (1, -1), (-1, 1), (1, 1)])
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4)
    glDisableClientState(GL_VERTEX_ARRAY)


def draw_street():
    glColor3f(0.1, 0.13, 0.18)
    for left, right, top in ((-1, -0.5, -0.2), (-0.5, 0.1, -0.45), (0.1, 0.55, 0), (0.55, 1, -0.3)):
        glRectf(left, -1, right, top)
        glBegin(GL_TRIANGLES)
        glVertex2f(left, top)
        glVertex2f(right, top)
        glVertex2f((left + right) / 2, top + 0.25)
        glEnd()
    glColor3f(0.95, 0.75, 0.4)
    for x, y in (
        (-0.8, -0.5),
        (-0.65, -0.5),
        (-0.3, -0.7),
        (0.25, -0.3),
        (0.25, -0.6),
        (0.8, -0.6),
    ):
        glRectf(x, y, x + 0.08, y + 0.15)


def draw_moon(x):
    glColor3f(0.95, 0.92, 0.85)
    glBegin(GL_POLYGON)
    for step in range(24):
        angle = 2 * math.pi * step / 24
        glVertex2f(x + 0.12 * math.cos(angle), 0.6 + 0.16 * math.sin(angle))
    glEnd()


def on_key(window, key, scancode, action, mods):
    global light
    steps = {glfw.KEY_UP: 0.1, glfw.KEY_DOWN: -0.1}
    if action != glfw.RELEASE:
        light = float(np.clip(light + steps.get(key, 0), 0, 1))
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(320, 240, "The sky over the roofs", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        draw_sky()
        draw_moon(-0.8 + glfw.get_time() % 1.6)
        draw_street()
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
