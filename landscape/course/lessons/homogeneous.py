"""Homogeneous coordinates: one point, many quadruples

OpenGL keeps four numbers for each vertex, (x, y, z, W). The point that they mean is x/W, y/W,
z/W, so all multiples of a quadruple are the same point. On the left, with x and W alone, they lie
on one line through O, and the point is where that line meets W = 1. On the right one point is
drawn three times, with two, three and four coordinates. Only W = 0 has no such point: it is a
direction.

Keys: Left and Right change x, Up and Down change W; Space makes W 0, a direction.
"""
# topic: transforms
# needs: viewport, primitives
# picture: frame 0
# keys: LEFT RIGHT UP DOWN SPACE

import sys

import glfw
from OpenGL.GL import *
from text import _, write

x = 3.0
y = 1.5
w = 2.0
direction = False  # W is 0

GREY = (0.35, 0.4, 0.47)
CORAL = (0.85, 0.35, 0.2)
AMBER = (0.95, 0.62, 0.35)
TEAL = (0.3, 0.65, 0.65)
CREAM = (0.95, 0.9, 0.8)


def draw_shape(kind, points, color):
    glColor3f(*color)
    glBegin(kind)
    for point in points:
        glVertex2f(*point)
    glEnd()


def draw_classes(height):
    """Draw the plane of x and W: every line through O is one point."""
    big = 0 if direction else w
    draw_shape(GL_LINES, ((-5, 0), (5, 0), (0, -1), (0, 5)), GREY)
    draw_shape(GL_LINES, ((-5, 1), (5, 1)), TEAL)
    draw_shape(GL_LINES, ((-5 * x, -5 * big), (5 * x, 5 * big)), AMBER)
    glPointSize(height / 60)
    draw_shape(GL_POINTS, [(n * x / 2, n * big / 2) for n in (-1, 1, 3, 4)], AMBER)
    glPointSize(height / 32)
    draw_shape(GL_POINTS, [(x, big)], CORAL)
    if not direction:
        draw_shape(GL_POINTS, [(x / w, 1)], CREAM)
        write(-14, -36, "x/W", CREAM, at=(x / w, 1, 0))
    write(-24, 12, "x, W", CORAL, at=(x, big, 0))
    write(-16, -22, "O", at=(0, 0, 0))
    write(6, -20, "W", at=(0, 4.6, 0))
    write(-48, 6, "W = 1", TEAL, at=(4.4, 1, 0))
    write(-20, -22, "x", at=(4.4, 0, 0))


def draw_forms(height):
    """Draw the same point three times, smaller each time."""
    draw_shape(GL_LINES, ((-5, 0), (5, 0), (0, -5), (0, 5)), GREY)
    write(-20, -22, "x", at=(4.4, 0, 0))
    write(6, -20, "y", at=(0, 4.6, 0))
    if direction:
        draw_shape(GL_LINES, ((0, 0), (5 * x, 5 * y)), AMBER)
        return
    forms = (
        (glVertex2f, (x / w, y / w), TEAL, 20),
        (glVertex3f, (x / w, y / w, 0), AMBER, 30),
        (glVertex4f, (x, y, 0, w), CREAM, 60),
    )
    for vertex, coordinates, color, size in forms:
        glPointSize(height / size)
        glColor3f(*color)
        glBegin(GL_POINTS)
        vertex(*coordinates)
        glEnd()


def draw(width, height):
    bottom = int(110 * (height // 480 or height / 480))  # above the text
    middle = width // 2
    glLineWidth(height / 240)
    for draw_part, left in ((draw_classes, 0), (draw_forms, middle)):
        glViewport(left, bottom, middle, height - bottom)
        glLoadIdentity()
        glOrtho(-1.3, 4.7, -1, 4.7, -1, 1)
        draw_part(height)
    glViewport(0, 0, width, height)
    if direction:
        write(16, 40, "glVertex4f({x:.1f}, {y:.1f}, 0, 0)", AMBER, x=x, y=y)
        write(16, 16, "a direction: no point with W = 1 is a multiple of it")
    else:
        write(16, 64, "glVertex2f({x:.2f}, {y:.2f})", TEAL, x=x / w, y=y / w)
        write(16, 40, "glVertex3f({x:.2f}, {y:.2f}, 0)", AMBER, x=x / w, y=y / w)
        write(16, 16, "glVertex4f({x:.1f}, {y:.1f}, 0, {w:.1f})", x=x, y=y, w=w)
        write(336, 16, "the same point", (0.6, 0.65, 0.7))


def on_key(window, key, scancode, action, mods):
    global direction, w, x
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_LEFT:
        x = max(0.5, x - 0.5)
    elif key == glfw.KEY_RIGHT:
        x = min(4, x + 0.5)
    elif key == glfw.KEY_DOWN:
        w = max(1, w - 0.5)
    elif key == glfw.KEY_UP:
        w = min(4, w + 0.5)
    elif key == glfw.KEY_SPACE:
        direction = not direction
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Homogeneous coordinates"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)

    while not glfw.window_should_close(window):
        glClear(GL_COLOR_BUFFER_BIT)
        draw(*glfw.get_framebuffer_size(window))
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
