"""Primitives: six tables of vertices, and how to join them

A valley at evening. Six things in it are tables of vertices, and each is only drawn as points. Draw
them as what they are:

TREES has three vertices for each tree, which is a filled triangle. FENCE has two for each picket,
the lower and the upper end of a line. PATH is one line that bends at each vertex and does not come
back to its beginning. POND is the shore of a pond: a line that goes around and closes. HILL is
filled, and its vertices lie below and above in turn, from left to right. SUN is filled as well: its
first vertex is the middle, and the others lie around it; the last one is beside the second one, so
that the sun has no gap.

Change the functions from draw_trees to draw_sun. Use the tables as they are, and the colours and
the width of lines, too. Whatever draws the same picture is right.
"""
# exercise: primitives

import math
import sys

import glfw
from OpenGL.GL import *

# The picture is 32 units wide and 24 high.
TREES = (
    *((22, 8), (25, 8), (23.5, 13)),
    *((25.5, 8.5), (28.5, 8.5), (27, 14)),
    *((29, 8), (31.5, 8), (30.2, 12)),
)
FENCE = [(1 + 2 * (number // 2), 1 + 3 * (number % 2)) for number in range(14)]
PATH = ((17, 1), (20, 2), (18, 3.2), (22, 4.2), (19.5, 5.5), (22.5, 6.5))
POND = [
    (27.5 + 3.5 * math.cos(math.radians(45 * step)), 3.5 + 2 * math.sin(math.radians(45 * step)))
    for step in range(8)
]
HILL = [
    (2 * (number // 2), 12 + 3 * math.sin(number // 2 * 0.7) if number % 2 else 7)
    for number in range(22)
]
SUN = [
    (25, 19),
    *(
        (25 + 3 * math.cos(2 * math.pi * step / 16), 19 + 3 * math.sin(2 * math.pi * step / 16))
        for step in range(16)
    ),
]


def compile_list(number, kind, vertices):
    glNewList(number, GL_COMPILE)
    glBegin(kind)
    for x, y in vertices:
        glVertex2f(x, y)
    glEnd()
    glEndList()


def compile_lists():
    pieces = [vertex for pair in zip(PATH, PATH[1:]) for vertex in pair]
    for number, (kind, vertices) in enumerate(
        (
            (GL_TRIANGLES, TREES[::-1]),
            (GL_LINES, FENCE),
            (GL_LINES, pieces),
            (GL_LINE_LOOP, POND),
            (GL_TRIANGLE_STRIP, HILL),
            (GL_TRIANGLE_FAN, SUN[1:]),
        ),
        start=1,
    ):
        compile_list(number, kind, vertices)


def draw_trees():
    glColor3f(0.25, 0.5, 0.42)
    glCallList(1)


def draw_fence():
    glColor3f(0.95, 0.9, 0.8)
    glCallList(2)


def draw_path():
    glColor3f(0.95, 0.62, 0.35)
    glCallList(3)


def draw_pond():
    glColor3f(0.5, 0.75, 0.9)
    glCallList(4)


def draw_hill():
    glColor3f(0.2, 0.35, 0.4)
    glCallList(5)


def draw_sun():
    glColor3f(0.85, 0.35, 0.2)
    glCallList(6)


def on_key(window, key, scancode, action, mods):
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(480, 360, "A valley at evening", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    glPointSize(5)
    glLineWidth(5)
    compile_lists()

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glLoadIdentity()
        glOrtho(0, 32, 0, 24, -1, 1)
        glClear(GL_COLOR_BUFFER_BIT)
        draw_trees()
        draw_fence()
        draw_path()
        draw_pond()
        draw_hill()
        draw_sun()
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
