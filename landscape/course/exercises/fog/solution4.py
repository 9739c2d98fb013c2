"""Fog: a jetty in the morning

Piles of wood and buoys stand in a bay, and even the farthest ones are as clear as the near ones.

Let there be fog, in each frame from the first, over everything that is drawn. Its colour is FOG. It
mixes colours by GL_EXP2: of a colour at a distance d there remains the fraction
f = exp(-(density * d) ** 2), and the rest is fog. At the distance HALF exactly one half is to
remain: compute the density from that.

Fog concerns only what is drawn, and the sky is not drawn: it is what glClear leaves. It must have
the fog's colour as well.
"""
# exercise: fog

import math
import sys

import glfw
import numpy as np
from OpenGL.GL import *

FOG = (0.82, 0.78, 0.72)
HALF = 25  # the distance at which one half of a colour remains
PILES = [(side, -4 * row) for row in range(18) for side in (-1.2, 1.2)]  # x, z
BUOYS = ((-3, -4), (3.2, -8), (-4.5, -14), (5.5, -22), (-7, -30), (9, -42))


def draw_tube(x, z, profile, color):
    """Draw a body of revolution: profile lists its radii and heights, from the bottom."""
    angles = np.arange(13) * 2 * np.pi / 12
    shades = 0.7 - 0.3 * np.cos(angles)  # it is lit from the left
    radii, heights = np.array(profile).T
    points = np.empty((len(profile), len(angles), 3), "f")
    points[..., 0] = x + np.outer(radii, np.cos(angles))
    points[..., 1] = heights[:, None]
    points[..., 2] = z + np.outer(radii, np.sin(angles))
    glColorPointerf(np.outer(shades, color).repeat(2, axis=0).astype("f"))
    for below, above in zip(points, points[1:]):
        strip = np.stack((above, below), axis=1).reshape(-1, 3)
        glVertexPointerf(strip)
        glDrawArrays(GL_QUAD_STRIP, 0, len(strip))


def draw_bay():
    glBegin(GL_QUADS)
    glColor3f(0.12, 0.4, 0.45)
    for x, z in ((-150, 10), (150, 10), (150, -150), (-150, -150)):
        glVertex3f(x, 0, z)
    for row in range(70):
        glColor3f(*((0.55, 0.4, 0.28) if row % 2 else (0.48, 0.34, 0.24)))
        for x, z in ((-1, -row), (1, -row), (1, -row - 1), (-1, -row - 1)):
            glVertex3f(x, 0.5, z)
    glEnd()
    glEnableClientState(GL_VERTEX_ARRAY)
    glEnableClientState(GL_COLOR_ARRAY)
    for x, z in PILES:
        draw_tube(x, z, ((0.16, 0), (0.16, 1.3), (0, 1.4)), (0.5, 0.33, 0.22))
    for x, z in BUOYS:
        y = 0.1 * math.sin(2 * glfw.get_time() + x)
        profile = ((0.6, 0), (0.7, 0.4), (0.2, 1.2), (0.2, 1.6), (0, 1.8))
        draw_tube(x, z, [(r, h + y) for r, h in profile], (0.95, 0.3, 0.15))
    glDisableClientState(GL_COLOR_ARRAY)
    glDisableClientState(GL_VERTEX_ARRAY)


def on_key(window, key, scancode, action, mods):
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(640, 480, "A jetty in the morning", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(*FOG, 1)
    glEnable(GL_DEPTH_TEST)
    glFogi(GL_FOG_MODE, GL_EXP2)
    glFogf(GL_FOG_DENSITY, np.sqrt(np.log(2)) / HALF)
    glFogfv(GL_FOG_COLOR, np.array((*FOG, 1), "f"))
    glEnable(GL_FOG)

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glFrustum(-width / height / 2, width / height / 2, -0.5, 0.5, 1, 200)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glRotatef(11, 1, 0, 0)
        glTranslatef(0.4, -2.6, -4)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        draw_bay()
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
