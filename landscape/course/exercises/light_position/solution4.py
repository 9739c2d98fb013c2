"""A light's position: a lamp that stays where it is

A lamp hangs over a table with chess pieces, and the eye goes round the table. The lamp is drawn in
its place, but its light comes along with the eye: the bright sides change with the view, and not
with where the lamp is.

OpenGL multiplies a light's position by the modelview matrix at the moment when glLightfv is called,
and keeps the result. The call stands at the wrong moment. Move it, so that the light comes from the
lamp in every frame. LAMP is in the coordinates of the table.
"""
# exercise: light_position

import math
import sys

import glfw
from OpenGL.GL import *

LAMP = (1.2, 3.2, 0.6, 1)
PIECES = ((-1.8, -1.5), (0.6, -2.1), (2.2, -0.4), (-2.3, 1.1), (-0.3, 0.3), (1.3, 2.0))
PROFILE = ((0.55, 0), (0.55, 0.2), (0.3, 0.35), (0.2, 0.9), (0.38, 1.0), (0.2, 1.1), (0, 1.1))


def draw_piece():
    """Draw a chess piece: a profile that is turned round the y axis, and a ball on top."""
    for (r0, y0), (r1, y1) in zip(PROFILE, PROFILE[1:]):
        slope = math.hypot(r1 - r0, y1 - y0)
        across = (y1 - y0) / slope
        up = (r0 - r1) / slope
        glBegin(GL_QUAD_STRIP)
        for step in range(17):
            angle = 2 * math.pi * step / 16
            x = math.cos(angle)
            z = math.sin(angle)
            glNormal3f(across * x, up, across * z)
            glVertex3f(r1 * x, y1, r1 * z)
            glVertex3f(r0 * x, y0, r0 * z)
        glEnd()
    glTranslatef(0, 1.35, 0)
    draw_ball(0.3)


def draw_ball(radius):
    for row in range(8):
        glBegin(GL_QUAD_STRIP)
        for step in range(17):
            angle = 2 * math.pi * step / 16
            for i in (0, 1):
                polar = math.pi * (row + i) / 8
                x = math.sin(polar) * math.cos(angle)
                y = math.cos(polar)
                z = math.sin(polar) * math.sin(angle)
                glNormal3f(x, y, z)
                glVertex3f(radius * x, radius * y, radius * z)
        glEnd()


def draw_table():
    """Draw a table of small squares: the light is computed at their corners."""
    glNormal3f(0, 1, 0)
    glBegin(GL_QUADS)
    for i in range(-8, 8):
        for j in range(-8, 8):
            light = (i // 2 + j // 2) % 2
            color = (0.75, 0.72, 0.65, 1) if light else (0.25, 0.42, 0.45, 1)
            glMaterialfv(GL_FRONT_AND_BACK, GL_AMBIENT_AND_DIFFUSE, color)
            for u, v in ((0, 0), (0, 1), (1, 1), (1, 0)):
                glVertex3f((i + u) / 2, 0, (j + v) / 2)
    glEnd()


def listed(draw):
    """Return a display list of what a function draws."""
    number = glGenLists(1)
    glNewList(number, GL_COMPILE)
    draw()
    glEndList()
    return number


def draw_pieces(piece):
    for index, (x, z) in enumerate(PIECES):
        color = (0.95, 0.9, 0.8, 1) if index % 2 else (0.85, 0.35, 0.2, 1)
        glMaterialfv(GL_FRONT_AND_BACK, GL_AMBIENT_AND_DIFFUSE, color)
        glPushMatrix()
        glTranslatef(x, 0, z)
        glCallList(piece)
        glPopMatrix()


def draw_lamp():
    glPushMatrix()
    glTranslatef(*LAMP[:3])
    glDisable(GL_LIGHTING)
    glColor3f(1, 0.9, 0.5)
    draw_ball(0.16)
    glEnable(GL_LIGHTING)
    glPopMatrix()


def on_key(window, key, scancode, action, mods):
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(640, 480, "A lamp that stays where it is", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    glEnable(GL_DEPTH_TEST)
    glEnable(GL_LIGHTING)
    glEnable(GL_LIGHT0)
    glLightfv(GL_LIGHT0, GL_DIFFUSE, (1.7, 1.6, 1.4, 1))
    glLightf(GL_LIGHT0, GL_QUADRATIC_ATTENUATION, 0.08)
    table = listed(draw_table)
    piece = listed(draw_piece)

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 50)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glTranslatef(0, -0.9, -12.5)
        glRotatef(30, 1, 0, 0)
        glRotatef(40 + 90 * glfw.get_time(), 0, 1, 0)
        glLightfv(GL_LIGHT0, GL_POSITION, LAMP)
        glCallList(table)
        draw_pieces(piece)
        draw_lamp()
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
