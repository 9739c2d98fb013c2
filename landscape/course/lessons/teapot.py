"""The teapot: gluLookAt and gluPerspective, and GLUT's shapes

GLU has both of a camera's matrices as calls. gluLookAt(eye, target, up) multiplies the modelview
matrix, gluPerspective(angle, aspect, near, far) the projection matrix. They are set here as most
programs do: the projection when the window's size changes, the view in each frame. The shapes are
those of GLUT: a cube, a sphere and the teapot, 32 bicubic patches that OpenGL divides by itself.

Keys: 1 cube, 2 sphere, 3 teapot; the arrows lead the camera around; F and C change the opening
angle; Space scales the shape by 1.4, 0.6, 1.
"""
# topic: cameras
# needs: main_loop, perspective, look_at
# picture: frame 0
# keys: 1 2 LEFT RIGHT UP DOWN F C SPACE
# programs: wire_teapot

import math
import sys
from pathlib import Path

import glfw
import numpy as np
from OpenGL.GL import *
from OpenGL.GLU import gluLookAt, gluPerspective
from text import _, write

PATCHES = np.loadtxt(Path(__file__).parent / "data" / "teapot.txt").reshape(32, 4, 4, 3)
CORNERS = ((-1, -1), (1, -1), (1, 1), (-1, 1))
LABELS = ("cube", "sphere", "teapot")
CUBE, SPHERE, TEAPOT = range(3)
shape = TEAPOT

# The eye: degrees around the shape, and degrees above it.
turn = 35
lift = 25
angle = 40  # of the view, from its lower to its upper edge; degrees
scaled = False


def draw_cube(size):
    glBegin(GL_QUADS)
    for axis in range(3):
        for side in (-1, 1):
            for u, v in CORNERS:
                glVertex3f(*(np.roll((side, u, v), axis) * size / 2))
    glEnd()


def draw_sphere(radius, slices, stacks):
    for stack in range(stacks):
        glBegin(GL_QUAD_STRIP)
        for n in range(slices + 1):
            around = math.tau * n / slices
            for polar in (math.pi * (stack + 1) / stacks, math.pi * stack / stacks):
                ring = radius * math.sin(polar)
                x = ring * math.cos(around)
                y = ring * math.sin(around)
                glVertex3f(x, y, radius * math.cos(polar))
        glEnd()


def draw_teapot(size):
    """Draw the patches; an evaluator computes their points from 4 by 4 control points."""
    glEnable(GL_MAP2_VERTEX_3)
    glMapGrid2f(4, 0, 1, 4, 0, 1)
    for patch in PATCHES:
        glMap2f(GL_MAP2_VERTEX_3, 0, 1, 0, 1, size * patch)
        glEvalMesh2(GL_LINE, 0, 4, 0, 4)
    glDisable(GL_MAP2_VERTEX_3)


def set_projection(window, width, height):
    """Called by GLFW when the window has a new size, and by the keys that change the angle."""
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    gluPerspective(angle, width / max(height, 1), 1, 100)
    glMatrixMode(GL_MODELVIEW)


def eye_place():
    """Return the place of the eye, 7 units from the middle."""
    away = 7 * math.cos(math.radians(lift))
    up = 7 * math.sin(math.radians(lift))
    around = math.radians(turn)
    return away * math.sin(around), up, away * math.cos(around)


def draw(height):
    glLoadIdentity()
    eye = eye_place()
    gluLookAt(*eye, 0, 0, 0, 0, 1, 0)  # the eye, the target, the direction up
    if scaled:
        glScalef(1.4, 0.6, 1)
    glPolygonMode(GL_FRONT_AND_BACK, GL_LINE)
    glLineWidth(height / 240)
    glColor3f(0.95, 0.72, 0.5)
    if shape == CUBE:
        draw_cube(2)
    elif shape == SPHERE:
        draw_sphere(1.3, 24, 12)
    else:
        draw_teapot(1.5)

    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL)
    write(16, 64, LABELS[shape], (0.95, 0.72, 0.5))
    x, y, z = eye
    write(16, 40, "gluLookAt({x:.1f}, {y:.1f}, {z:.1f}, 0, 0, 0, 0, 1, 0)", x=x, y=y, z=z)
    write(16, 16, "gluPerspective({angle}, aspect, 1, 100)", angle=angle)


def on_key(window, key, scancode, action, mods):
    global angle, lift, scaled, shape, turn
    if action == glfw.RELEASE:
        return
    if glfw.KEY_1 <= key < glfw.KEY_1 + len(LABELS):
        shape = key - glfw.KEY_1
    elif key == glfw.KEY_LEFT:
        turn -= 10
    elif key == glfw.KEY_RIGHT:
        turn += 10
    elif key == glfw.KEY_UP:
        lift = min(80, lift + 5)
    elif key == glfw.KEY_DOWN:
        lift = max(-80, lift - 5)
    elif key == glfw.KEY_F:
        angle = min(100, angle + 5)
    elif key == glfw.KEY_C:
        angle = max(20, angle - 5)
    elif key == glfw.KEY_SPACE:
        scaled = not scaled
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)

    if key in (glfw.KEY_F, glfw.KEY_C):
        set_projection(window, *glfw.get_framebuffer_size(window))


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("The teapot"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glfw.set_framebuffer_size_callback(window, set_projection)
    set_projection(window, *glfw.get_framebuffer_size(window))  # the first size is no change
    glClearColor(0.13, 0.16, 0.21, 1)

    while not glfw.window_should_close(window):
        glClear(GL_COLOR_BUFFER_BIT)
        draw(glfw.get_framebuffer_size(window)[1])
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
