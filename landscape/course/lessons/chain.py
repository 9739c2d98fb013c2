"""The chain: a vertex on its way to a pixel

A corner of a crate, followed from the numbers in the program to a pixel. The model's matrix takes
it to the world, the camera's to the frame of the eye, the projection matrix to clip coordinates,
the division by w to normalised device coordinates, and the viewport to the window. OpenGL keeps two
of these three matrices: GL_MODELVIEW is the product of the camera's and the model's.

Keys: Left and Right turn the crate (the model), Up and Down lift the camera; F changes the
opening angle (the projection); Space halves the viewport.
"""
# topic: cameras
# needs: teapot
# picture: frame 0
# keys: LEFT RIGHT UP DOWN F SPACE

import sys

import glfw
import numpy as np
from OpenGL.GL import *
from OpenGL.GLU import gluLookAt, gluPerspective
from text import _, write

CORNERS = ((-1, -1), (1, -1), (1, 1), (-1, 1))
VERTEX = np.array((1, 1, 1, 1))
turn = 20  # degrees that the crate is turned
lift = 2.5  # units that the camera is above the ground
angle = 45  # degrees of the view
small = False

LABELS = (  # what the numbers are, and what takes them to the next ones
    "in the crate's frame",
    "GL_MODELVIEW: the model",
    "in the frame of the world",
    "GL_MODELVIEW: the camera",
    "in the frame of the eye",
    "GL_PROJECTION",
    "in clip coordinates",
    "divided by w",
    "in normalised device coordinates",
    "glViewport",
    "in the window: x, y and depth",
)
AMBER = (0.95, 0.62, 0.35)
CREAM = (0.95, 0.9, 0.8)


def draw_crate():
    glBegin(GL_QUADS)
    for axis, shade in ((0, 0.7), (1, 1), (2, 0.85)):
        glColor3f(0.85 * shade, 0.35 * shade, 0.2 * shade)
        for side in (-1, 1):
            for u, v in CORNERS:
                glVertex3f(*np.roll((side, u, v), axis))
    glEnd()


def set_matrices(aspect):
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    gluPerspective(angle, aspect, 1, 20)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    gluLookAt(0, lift, 6, 0, 0, 0, 0, 1, 0)  # the camera
    place_crate()


def place_crate():
    glTranslatef(0.4, 0, 0)
    glRotatef(turn, 0, 1, 0)


def follow(viewport):
    """Return the vertex after each step of the chain."""
    x0, y0, width, height = viewport
    glLoadIdentity()
    place_crate()
    model = glGetFloatv(GL_MODELVIEW_MATRIX).T  # OpenGL stores its columns
    set_matrices(width / height)
    modelview = glGetFloatv(GL_MODELVIEW_MATRIX).T
    projection = glGetFloatv(GL_PROJECTION_MATRIX).T
    world = model @ VERTEX
    eye = modelview @ VERTEX
    clip = projection @ eye
    device = clip[:3] / clip[3]
    pixel = (device + 1) / 2 * (width, height, 1) + (x0, y0, 0)
    return VERTEX, world, eye, clip, device, pixel


def draw_chain(points, width, height):
    """Draw the steps from top to bottom, each with its numbers in a box."""
    scale = height // 480 or height / 480  # of the pixels that write counts in
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glOrtho(0, width / scale, 0, height / scale, -1, 1)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    top = height / scale - 8

    for number, point in enumerate(points):
        y = top - 82 * number
        draw_box(y)
        write(16, y - 23, LABELS[2 * number], CREAM)
        write_numbers(y, point)
        if number < len(points) - 1:
            draw_arrow(y)
            write(42, y - 73, LABELS[2 * number + 1], (0.4, 0.8, 0.8))


def draw_box(y):
    glColor3f(0.2, 0.25, 0.32)
    glRectf(10, y - 48, 346, y)


def write_numbers(y, point):
    numbers = " ".join(f"{value + 0:.2f}" for value in point.round(2))
    write(16, y - 44, "{numbers}", AMBER, numbers=numbers)


def draw_arrow(y):
    glColor3f(0.3, 0.6, 0.6)
    glBegin(GL_TRIANGLES)
    for dx, dy in ((-6, -54), (0, -78), (6, -54)):
        glVertex2f(26 + dx, y + dy)
    glEnd()


def draw(width, height):
    left = int(356 * (height // 480 or height / 480))  # right of the chain
    viewport = [left, height // 4, width - left, height // 2]
    if small:
        viewport[2:] = [viewport[2] // 2, viewport[3] // 2]
    glViewport(*viewport)

    # The background of the viewport, then the crate and its corner.
    for mode in (GL_PROJECTION, GL_MODELVIEW):
        glMatrixMode(mode)
        glLoadIdentity()
    glColor3f(0.2, 0.25, 0.32)
    glRectf(-1, -1, 1, 1)  # all of the viewport
    set_matrices(viewport[2] / viewport[3])
    glEnable(GL_DEPTH_TEST)
    draw_crate()
    glDisable(GL_DEPTH_TEST)
    glPointSize(height / 40)
    glColor3f(*CREAM)
    glBegin(GL_POINTS)
    glVertex3f(*VERTEX[:3])
    glEnd()
    points = follow(viewport)
    x, y = points[-1][:2]
    write(-80, 10, "{x:.0f}, {y:.0f}", AMBER, at=tuple(VERTEX[:3]), x=x, y=y)

    glViewport(0, 0, left, height)
    draw_chain(points, left, height)


def on_key(window, key, scancode, action, mods):
    global angle, lift, small, turn
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_LEFT:
        turn -= 10
    elif key == glfw.KEY_RIGHT:
        turn += 10
    elif key == glfw.KEY_DOWN:
        lift -= 0.5
    elif key == glfw.KEY_UP:
        lift += 0.5
    elif key == glfw.KEY_F:
        angle = angle % 75 + 15
    elif key == glfw.KEY_SPACE:
        small = not small
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("The chain"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)

    while not glfw.window_should_close(window):
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        draw(*glfw.get_framebuffer_size(window))
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
