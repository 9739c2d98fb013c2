"""A Bezier path: a plane that flies at one speed

A plane follows a path over a map. The path consists of two cubic Bezier curves; each has four
control points, and the last one of the first curve is the first one of the second. The plane is
drawn at COUNT places, as it is photographed at equal intervals of time. As yet there is no path,
and the plane stands at its beginning.

bezier(a, b, c, d, t) returns the point of a curve, x and y, for a number t from 0 to 1: a for 0, d
for 1. De Casteljau divides the three lines from a to b, from b to c and from c to d in the ratio t;
then the two lines between these three points, and at last the one between these two. Any other way
to the same point is right, too.

photographs(points) gets many points of the path, as they follow each other, each as x, y. It
returns the numbers of COUNT of them in the list, so that the plane flies equally far along the path
between one and the next: the first is 0, the last is the last one of the list. The points
themselves do not lie at equal distances; so sum up how far it is from each to the next. Take the
first point that is as far along the path as is wanted, or its neighbour.

OpenGL only draws lines and points. Change bezier and photographs.

Keys: the arrows move a control point.
"""
# exercise: bezier_path

import sys

import glfw
import numpy as np
from OpenGL.GL import *

CONTROLS = [  # of both curves
    np.array(place, float)
    for place in ((20, 40), (30, 230), (70, 250), (120, 150), (170, 50), (320, -20), (300, 215))
]
COUNT = 12
STEPS = 400  # points of each curve


def bezier(a, b, c, d, t):
    """Return the point of a curve with four control points, for t from 0 to 1."""
    controls = [a, b, c, d]
    while len(controls) > 1:
        controls = [(1 - t) * one + t * other for one, other in zip(controls, controls[1:])]
    return controls[0]


def photographs(points):
    """Return the numbers of COUNT points that lie equally far from each other along a path."""
    x, y = np.transpose(points)
    along = np.insert(np.sqrt(np.diff(x) ** 2 + np.diff(y) ** 2).cumsum(), 0, 0)
    numbers = np.interp(np.linspace(0, along[-1], COUNT), along, range(len(points)))
    return numbers.round().astype(int).tolist()


def make_path():
    """Return the points of both curves, (2 * STEPS + 1, 2)."""
    first = [bezier(*CONTROLS[:4], step / STEPS) for step in range(STEPS)]
    second = [bezier(*CONTROLS[3:], step / STEPS) for step in range(STEPS + 1)]
    return np.array(first + second, float)


def draw_map():
    glLineWidth(1)
    glColor3f(0.35, 0.4, 0.46)
    glBegin(GL_LINE_STRIP)
    for control in CONTROLS:
        glVertex2f(*control)
    glEnd()
    glPointSize(5)
    glBegin(GL_POINTS)
    for control in CONTROLS:
        glVertex2f(*control)
    glEnd()


def draw_flight():
    points = make_path()
    glLineWidth(5)
    glColor3f(0.3, 0.6, 0.6)
    glBegin(GL_LINE_STRIP)
    for point in points[::20]:
        glVertex2f(*point)
    glEnd()
    glPointSize(11)
    glColor3f(0.95, 0.62, 0.35)
    glBegin(GL_POINTS)
    for number in photographs(points):
        glVertex2f(*points[number])
    glEnd()


def on_key(window, key, scancode, action, mods):
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_LEFT:
        CONTROLS[2][0] -= 20
    elif key == glfw.KEY_RIGHT:
        CONTROLS[2][0] += 20
    elif key == glfw.KEY_DOWN:
        CONTROLS[2][1] -= 20
    elif key == glfw.KEY_UP:
        CONTROLS[2][1] += 20
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(320, 240, "A flight", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)

    while not glfw.window_should_close(window):
        glViewport(0, 0, *glfw.get_framebuffer_size(window))
        glLoadIdentity()
        glOrtho(0, 320, 0, 240, -1, 1)
        glClear(GL_COLOR_BUFFER_BIT)
        draw_map()
        draw_flight()
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
