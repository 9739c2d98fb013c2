"""Similar triangles: the pinhole camera in section

The pinhole camera from above: O is the eye, z the way it looks, and the line at the distance d is
its image plane. The triangles from O to P and from O to its image have the same angles, so X / d
= x / z. The triangle O, A, B says how far the plane is: half the picture's width over d is the
tangent of half the opening angle.

Keys: Left and Right move P nearer and farther, Up and Down aside; D and F change the opening
angle.
"""
# topic: cameras
# needs: pinhole
# picture: frame 0
# keys: LEFT RIGHT UP DOWN D F

import math
import sys

import glfw
from OpenGL.GL import *
from text import _, write

WIDTH = 3  # of the picture, in the units of the scene
angle = 60  # degrees

# The point P.
x = 1.75
z = 5.5

GREY = (0.45, 0.5, 0.57)
AMBER = (0.95, 0.62, 0.35)
CREAM = (0.95, 0.9, 0.8)


def draw_shape(kind, points, color):
    glColor3f(*color)
    glBegin(kind)
    for point in points:
        glVertex2f(*point)
    glEnd()


def draw_section(d, image):
    """Draw the section; z is to the right and x upwards, as the camera would be turned on paper."""
    half = WIDTH / 2
    draw_shape(GL_TRIANGLES, ((0, 0), (z, 0), (z, x)), (0.2, 0.28, 0.33))
    draw_shape(GL_TRIANGLES, ((0, 0), (d, 0), (d, image)), (0.45, 0.22, 0.15))
    draw_shape(GL_LINES, ((-0.3, 0), (8.2, 0)), GREY)
    draw_shape(GL_LINES, ((d, -half), (d, half)), CREAM)
    for side in (-1, 1):
        draw_shape(GL_LINES, ((0, 0), (3 * d, 3 * side * half)), (0.3, 0.6, 0.6))
    draw_shape(GL_LINES, ((0, 0), (z, x)), AMBER)
    draw_shape(GL_LINES, ((z, 0), (z, x)), AMBER)
    arc = [math.radians(angle / 2 * n / 12) for n in range(13)]
    draw_shape(GL_LINE_STRIP, [(math.cos(a), math.sin(a)) for a in arc], (0.4, 0.8, 0.8))
    draw_shape(GL_POINTS, ((0, 0), (d, 0), (d, half), (z, x), (d, image)), CREAM)
    write_names(d, image)


def write_names(d, image):
    half = WIDTH / 2
    write(-18, -24, "O", at=(0, 0, 0))
    write(4, -24, "A", at=(d, 0, 0))
    write(6, 4, "B", at=(d, half, 0))
    write(8, 0, "P", AMBER, at=(z, x, 0))
    write(-34, 2, "P'", (0.95, 0.5, 0.35), at=(d, image, 0))
    write(10, 6, "{angle}°/2", (0.4, 0.8, 0.8), at=(1, 0.15, 0), angle=angle)
    write(8, -8, "x", AMBER, at=(z, x / 2, 0))
    write(-10, -24, "z", at=(8, 0, 0))
    write(-5, -24, "d", at=(d / 2, 0, 0))


def draw(width, height):
    bottom = int(116 * (height // 480 or height / 480))  # above the text
    glViewport(0, bottom, width, height - bottom)
    reach = 9.2 * (height - bottom) / width / 2
    glLoadIdentity()
    glOrtho(-0.7, 8.5, -reach - 0.1, reach - 0.1, -1, 1)
    glPointSize(height / 60)
    glLineWidth(height / 240)
    d = WIDTH / 2 / math.tan(math.radians(angle / 2))
    image = x * d / z
    draw_section(d, image)
    glViewport(0, 0, width, height)
    write(
        16, 88, "d = {w}/2 / tan({angle}°/2) = {d:.2f}", (0.4, 0.8, 0.8), w=WIDTH, angle=angle, d=d
    )
    write(16, 64, "X = x d/z = {x:.2f} × {d:.2f} / {z:.1f} = {X:.2f}", x=x, d=d, z=z, X=image)
    write(16, 40, "(x, y, z, z/d) = ({x:.2f}, 0, {z:.1f}, {w:.2f})", AMBER, x=x, z=z, w=z / d)
    write(16, 16, "divided by z/d   ({X:.2f}, 0, {d:.2f}, 1)", AMBER, X=image, d=d)


def on_key(window, key, scancode, action, mods):
    global angle, x, z
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_LEFT:
        z = max(4.0, z - 0.5)
    elif key == glfw.KEY_RIGHT:
        z = min(7.5, z + 0.5)
    elif key == glfw.KEY_DOWN:
        x = max(0.5, x - 0.25)
    elif key == glfw.KEY_UP:
        x = min(2.0, x + 0.25)
    elif key == glfw.KEY_D:
        angle = max(45, angle - 5)
    elif key == glfw.KEY_F:
        angle = min(90, angle + 5)
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Similar triangles"), None, None)
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
