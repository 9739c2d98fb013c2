"""Clip plane: a tower, cut open

A round tower turns on its hill. Inside there is a winding stair, which nobody sees. Cut the wall
and the roof open: of them, leave out what is in front of the plane z = 0.3, that is, where z is
greater than 0.3 in the coordinates in which the tower is drawn. The cut belongs to the tower: it
turns with it. The stair and the hill stay whole.

OpenGL keeps the points with a x + b y + c z + d >= 0. It takes a, b, c, d in the coordinates of the
modelview matrix at the moment when glClipPlane is called. Planes cut only while they are enabled.

Keys: Left and Right turn the tower.
"""
# exercise: clip_plane

import math
import sys

import glfw
from OpenGL.GL import *

turn = -30  # degrees


def draw_round(profile, sides, color):
    """Draw a body of revolution: profile lists its radii and heights, from the bottom."""
    glColor3f(*color)
    for (r0, y0), (r1, y1) in zip(profile, profile[1:]):
        slope = math.hypot(r1 - r0, y1 - y0)
        glBegin(GL_QUAD_STRIP)
        for step in range(sides + 1):
            angle = 2 * math.pi * step / sides
            x = math.sin(angle)
            z = math.cos(angle)
            glNormal3f((y1 - y0) / slope * x, (r0 - r1) / slope, (y1 - y0) / slope * z)
            glVertex3f(r1 * x, y1, r1 * z)
            glVertex3f(r0 * x, y0, r0 * z)
        glEnd()


def draw_wall():
    draw_round(((1.1, 0), (1, 0.2), (1, 3), (1.25, 3.2), (1.25, 3.6)), 40, (0.95, 0.9, 0.8))
    draw_round(((1.25, 3.6), (1.5, 3.5), (0, 5.1)), 40, (0.85, 0.35, 0.2))


def draw_stair():
    draw_round(((0.12, 0), (0.12, 3.6)), 12, (0.6, 0.62, 0.65))
    glColor3f(0.25, 0.6, 0.6)
    for step in range(30):
        a = math.radians(24 * step)
        b = math.radians(24 * step + 24)
        y = 0.11 * step
        inner = 0.1
        outer = 0.85
        corners = [
            (r * math.sin(t), r * math.cos(t))
            for r, t in ((inner, a), (outer, a), (outer, b), (inner, b))
        ]
        glBegin(GL_QUADS)
        glNormal3f(0, 1, 0)
        for x, z in corners:
            glVertex3f(x, y + 0.11, z)
        glNormal3f(math.sin((a + b) / 2), 0, math.cos((a + b) / 2))
        for (x, z), low in zip((corners[1], corners[2], corners[2], corners[1]), (1, 1, 0, 0)):
            glVertex3f(x, y if low else y + 0.11, z)
        glNormal3f(-math.cos(a), 0, math.sin(a))
        for (x, z), low in zip((corners[0], corners[1], corners[1], corners[0]), (1, 1, 0, 0)):
            glVertex3f(x, y if low else y + 0.11, z)
        glEnd()


def draw_tower(wall, stair):
    glPushMatrix()
    glTranslatef(0.4, 0, -1)
    glRotatef(turn, 0, 1, 0)
    glClipPlane(GL_CLIP_PLANE0, (0, 0, -1, 0.3))
    glEnable(GL_CLIP_PLANE0)
    glCallList(wall)
    glDisable(GL_CLIP_PLANE0)
    glCallList(stair)
    glPopMatrix()


def listed(draw):
    """Return a display list of what a function draws."""
    number = glGenLists(1)
    glNewList(number, GL_COMPILE)
    draw()
    glEndList()
    return number


def draw_hill():
    draw_round(((8, -2.5), (5, -0.9), (3, -0.25), (1.5, -0.02), (0, 0)), 32, (0.4, 0.52, 0.3))


def on_key(window, key, scancode, action, mods):
    global turn
    if key in (glfw.KEY_LEFT, glfw.KEY_RIGHT) and action != glfw.RELEASE:
        turn += 15 if key == glfw.KEY_RIGHT else -15
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(640, 480, "A tower, cut open", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.55, 0.7, 0.85, 1)
    for capability in (GL_DEPTH_TEST, GL_LIGHTING, GL_LIGHT0, GL_COLOR_MATERIAL, GL_NORMALIZE):
        glEnable(capability)
    glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, GL_TRUE)  # the wall is lit from inside, too
    glLightfv(GL_LIGHT0, GL_POSITION, (-1, 1, 1.5, 0))
    wall = listed(draw_wall)
    stair = listed(draw_stair)

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 50)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glTranslatef(-0.4, -2.3, -12.5)
        glRotatef(14, 1, 0, 0)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        draw_tower(wall, stair)
        draw_hill()
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
