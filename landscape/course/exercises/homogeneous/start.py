"""Homogeneous coordinates: a street, by matrices of your own

A street with three houses is drawn from a list of lines. Each point goes through a product of
matrices of four rows and columns, `PROJECTION @ translation(...) @ rotation(...) @ point(...)`, and
the result becomes a place in the picture. Only the product is there; four functions lack their
contents, and nothing can be seen yet.

point(x, y, z) returns the homogeneous coordinates of a point, four numbers, of which the fourth is
1. translation(x, y, z) returns the matrix that moves points by x, y and z. rotation(angle) returns
the one that turns them around the y axis by an angle in degrees, counter-clockwise as seen from
above: at 90 degrees, the point (1, 0, 0) goes to (0, 0, -1). cartesian(place) makes of four numbers
x, y, z, w the three coordinates of the point for which they stand.

The vertices are columns: a matrix stands at the left of what it is multiplied with. The street's
borders end in the direction (0, 0, -1, 0), a point that is infinitely far away: no translation
moves it, and yet it has a place in the picture.

Keys: Left and Right turn the houses, Up and Down walk along the street.
"""
# exercise: homogeneous
# lessons: homogeneous, matrices, pinhole

import sys

import glfw
import numpy as np
from OpenGL.GL import *

# A pinhole camera that looks along -z, with its image plane at the origin and its eye 1 behind it.
PROJECTION = np.array(((1.6, 0, 0, 0), (0, 2, 0, 0), (0, 0, 1, 0), (0, 0, -1, 1)))
FAR = np.array((0, 0, -1, 0))  # a direction
HOUSES = (  # where they stand, how they are turned, and their colour
    ((-2.2, -1, -6), 20, (0.95, 0.62, 0.35)),
    ((2.3, -1, -5), -30, (0.3, 0.6, 0.6)),
    ((-1.9, -1, -3.5), 70, (0.85, 0.35, 0.2)),
)
OUTLINE = ((-0.7, 0), (0.7, 0), (0.7, 1), (0, 1.6), (-0.7, 1))  # of a house's front
turned = 0
walked = 0


def point(x, y, z):
    """Return the homogeneous coordinates of a point."""
    # Your code goes here.
    return np.array((0, 0, 0, 1))


def translation(x, y, z):
    """Return the matrix of a translation."""
    # Your code goes here.
    return np.identity(4)


def rotation(angle):
    """Return the matrix of a rotation around the y axis by an angle in degrees."""
    # Your code goes here.
    return np.identity(4)


def cartesian(place):
    """Return the coordinates x, y, z of a point that is given by four numbers."""
    # Your code goes here.
    return place[:3]


def draw_line(matrix, first, second):
    for place in (first, second):
        x, y, *_ = cartesian(matrix @ place)
        glVertex2f(x, y)


def draw_house(matrix):
    for number, (x, y) in enumerate(OUTLINE):
        next_x, next_y = OUTLINE[(number + 1) % 5]
        for z in (-0.6, 0.6):
            draw_line(matrix, point(x, y, z), point(next_x, next_y, z))
        draw_line(matrix, point(x, y, -0.6), point(x, y, 0.6))


def draw():
    glBegin(GL_LINES)
    camera = PROJECTION @ translation(0, 0, walked)
    glColor3f(0.6, 0.65, 0.7)
    for x in (-1, 1):
        draw_line(camera, point(x, -1, -1.5), FAR)
    for place, angle, color in HOUSES:
        glColor3f(*color)
        draw_house(camera @ translation(*place) @ rotation(angle + turned))
    glEnd()


def on_key(window, key, scancode, action, mods):
    global turned, walked
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_LEFT:
        turned -= 15
    elif key == glfw.KEY_RIGHT:
        turned += 15
    elif key == glfw.KEY_DOWN:
        walked -= 0.5
    elif key == glfw.KEY_UP:
        walked += 0.5
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(480, 360, "A street", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    glLineWidth(5)

    while not glfw.window_should_close(window):
        glViewport(0, 0, *glfw.get_framebuffer_size(window))
        glClear(GL_COLOR_BUFFER_BIT)
        draw()
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
