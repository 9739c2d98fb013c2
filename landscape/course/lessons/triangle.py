"""The triangle: vertices between glBegin and glEnd

A triangle and a hexagon. glBegin says what is to be drawn, each glVertex2f adds a corner, a vertex,
and glEnd ends the shape. A vertex takes the colour that glColor3f has set last, and between the
vertices OpenGL interpolates. If the colour is set only once, it holds for the whole shape.

Keys: Up and Down change the number of vertices of the hexagon; Space sets only the first colour.
"""
# topic: shapes
# needs: animation
# picture: frame 0
# keys: UP DOWN SPACE

import math
import sys

import glfw
from OpenGL.GL import *
from text import _, write

COLORS = (
    (0.85, 0.35, 0.2),
    (0.95, 0.62, 0.35),
    (0.95, 0.9, 0.8),
    (0.25, 0.6, 0.6),
    (0.3, 0.5, 0.8),
    (0.55, 0.35, 0.6),
)
vertices = 6
each = True  # each vertex has a colour of its own


def draw_triangle():
    glBegin(GL_TRIANGLES)
    glColor3f(0.85, 0.35, 0.2)
    glVertex2f(-1.2, -0.4)
    if each:
        glColor3f(0.95, 0.9, 0.8)
    glVertex2f(-0.1, -0.4)
    if each:
        glColor3f(0.25, 0.6, 0.6)
    glVertex2f(-0.65, 0.7)
    glEnd()


def draw_polygon():
    glBegin(GL_POLYGON)
    for number in range(vertices):
        if each or number == 0:
            glColor3f(*COLORS[number % 6])
        angle = 2 * math.pi * number / vertices
        glVertex2f(0.65 + 0.55 * math.cos(angle), 0.15 + 0.55 * math.sin(angle))
    glEnd()


def draw():
    width, height = glfw.get_framebuffer_size(glfw.get_current_context())
    glViewport(0, 0, width, height)
    # Coordinates: y from -1 to 1, and x as much farther as the window is wider than high.
    glLoadIdentity()
    glScalef(height / width, 1, 1)

    glClearColor(0.13, 0.16, 0.21, 1)
    glClear(GL_COLOR_BUFFER_BIT)
    draw_triangle()
    draw_polygon()
    write(16, 40, "vertices: 3 and {vertices}", vertices=vertices)
    write(16, 16, "a colour for each vertex" if each else "only the first colour")


def on_key(window, key, scancode, action, mods):
    global vertices, each
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_UP:
        vertices += 1
    if key == glfw.KEY_DOWN:
        vertices = max(3, vertices - 1)
    if key == glfw.KEY_SPACE:
        each = not each
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("The triangle"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)

    while not glfw.window_should_close(window):
        draw()
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
