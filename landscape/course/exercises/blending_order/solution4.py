"""Blending: two glass tubes and a ball

A ball on a pillar stands between two tubes of coloured glass. The alpha of the glass is 0.35, but
one sees through neither. The eye goes round them, so now one tube is the nearer one, now the other.

Change draw_scene so that the glass is right from every side. Glass is blended: 0.35 of its own
colour, and 0.65 of what is there already. So what it covers must be there before it: everything
opaque, and the tube behind it. Each tube has a near and a far wall, and both must be visible: so
glass writes no depths, but it is still hidden by what is opaque and nearer. After the last tube
everything is as it was before the first.

eye() returns where the eye is. Use draw_tube for each tube once, and do not change it.

Keys: Left and Right go round.
"""
# exercise: blending_order

import math
import sys

import glfw
import numpy as np
from OpenGL.GL import *

# x and z of the middle, and the colour with its alpha.
TUBES = ((-1.5, 0, (0.9, 0.35, 0.2, 0.35)), (1.5, 0, (0.2, 0.55, 0.9, 0.35)))
turn = 50  # degrees


def eye():
    """Return x and z of the eye."""
    distance = 11 * math.cos(math.radians(20))  # it is seen from 20 degrees above
    return -distance * math.sin(math.radians(turn)), distance * math.cos(math.radians(turn))


def draw_tube(x, z, color):
    """Draw a tube of glass, which is open above and below; its color times its alpha."""
    *channels, alpha = color
    glColor4f(*(alpha * channel for channel in channels), alpha)
    angles = np.arange(33) * 2 * np.pi / 32
    points = np.empty((33, 2, 3), "f")
    points[..., 0] = x + np.cos(angles)[:, None]
    points[..., 1] = 2.6, 0
    points[..., 2] = z + np.sin(angles)[:, None]
    glEnableClientState(GL_VERTEX_ARRAY)
    glVertexPointerf(points.reshape(-1, 3))
    glDrawArrays(GL_QUAD_STRIP, 0, 66)
    glDisableClientState(GL_VERTEX_ARRAY)


def draw_body(profile, color):
    """Draw an opaque body of revolution: profile lists its radii and heights, from above."""
    for (r0, y0), (r1, y1) in zip(profile, profile[1:]):
        glBegin(GL_QUAD_STRIP)
        for step in range(25):
            angle = 2 * math.pi * step / 24
            shade = 0.7 - 0.3 * math.cos(angle)
            glColor3f(*(shade * channel for channel in color))
            glVertex3f(r0 * math.cos(angle), y0, r0 * math.sin(angle))
            glVertex3f(r1 * math.cos(angle), y1, r1 * math.sin(angle))
        glEnd()


def draw_opaque():
    """Draw the floor, the pillar and the ball on it."""
    glBegin(GL_QUADS)
    for i in range(-4, 4):
        for j in range(-4, 4):
            glColor3f(*((0.3, 0.34, 0.4) if (i + j) % 2 else (0.62, 0.62, 0.6)))
            for u, v in ((0, 0), (0, 1), (1, 1), (1, 0)):
                glVertex3f(i + u, 0, j + v)
    glEnd()
    draw_body(((0.35, 1.2), (0.25, 1.1), (0.25, 0.15), (0.35, 0)), (0.95, 0.9, 0.8))
    angles = [math.pi * step / 10 for step in range(11)]
    ball = [(0.55 * math.sin(a), 1.7 + 0.55 * math.cos(a)) for a in angles]
    draw_body(ball, (0.95, 0.7, 0.3))


def draw_scene():
    draw_opaque()
    glEnable(GL_BLEND)
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA)
    glDepthMask(GL_FALSE)
    distances = [math.dist((x, z), eye()) for x, z, _color in TUBES]
    for number in np.argsort(distances)[::-1]:
        draw_tube(*TUBES[number])
    glDepthMask(GL_TRUE)
    glDisable(GL_BLEND)


def on_key(window, key, scancode, action, mods):
    global turn
    if key in (glfw.KEY_LEFT, glfw.KEY_RIGHT) and action != glfw.RELEASE:
        turn += 15 if key == glfw.KEY_RIGHT else -15
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(640, 480, "Two glass tubes and a ball", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    glEnable(GL_DEPTH_TEST)

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 50)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glTranslatef(0, 0, -11)
        glRotatef(20, 1, 0, 0)
        glTranslatef(0, -0.9, 0)
        glRotatef(turn, 0, 1, 0)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        draw_scene()
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
