"""The matrix stack: a car with axles and wheels

A car is a body and two axles, with two wheels on each. Every part is drawn in the frame of the
part that carries it: glPushMatrix keeps that frame, glPopMatrix returns to it. So the wheels turn
with their axle, and all of them follow the body.

Keys: Left and Right steer; Space leaves out glPushMatrix and glPopMatrix.
"""
# topic: cameras
# needs: transform_order, perspective
# picture: frame 45
# loop: 120 frames
# keys: LEFT RIGHT SPACE

import math
import sys

import glfw
from OpenGL.GL import *
from text import _, write

steering = 25  # degrees
stack = True


def draw_box(width, height, depth, color):
    """Draw a box around the origin. There is no light yet: each direction has its shade."""
    glBegin(GL_QUADS)
    for axis, shade in ((0, 0.85), (1, 1), (2, 0.7)):
        glColor3f(*(shade * channel for channel in color))
        for side in (-1, 1):
            for u, v in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                x, y, z = ((side, u, v), (u, side, v), (u, v, side))[axis]
                glVertex3f(x * width / 2, y * height / 2, z * depth / 2)
    glEnd()


def draw_wheel():
    """Draw a wheel around the z axis, 1 across, in sectors, which show how it turns."""
    rim = [(0.5 * math.cos(n * math.pi / 6), 0.5 * math.sin(n * math.pi / 6)) for n in range(13)]
    for a, b, shade in zip(rim, rim[1:], 6 * (0.3, 0.9), strict=False):
        glColor3f(shade, shade, shade)
        glBegin(GL_TRIANGLE_STRIP)  # one side, the tread and the other side
        for x, y, z in ((0, 0, -1), (*a, -1), (*b, -1), (*a, 1), (*b, 1), (0, 0, 1)):
            glVertex3f(x, y, 0.13 * z)
        glEnd()


def draw_part(part, *arguments, at=(0, 0, 0), turned=(0, 0, 0, 1)):
    """Draw a part in a frame of its own: moved to ``at``, then turned (degrees, axis)."""
    if stack:
        glPushMatrix()
    glTranslatef(*at)
    glRotatef(*turned)
    part(*arguments)
    if stack:
        glPopMatrix()


def draw_axle(angle):
    """Draw an axle along z with its wheels, turned by an angle in degrees."""
    glRotatef(angle, 0, 0, 1)
    draw_box(0.1, 0.1, 2, (0.5, 0.5, 0.55))
    draw_part(draw_wheel, at=(0, 0, -1))
    draw_part(draw_wheel, at=(0, 0, 1))


def draw_car(angle):
    draw_box(3.8, 0.5, 1.6, (0.85, 0.35, 0.2))
    draw_part(draw_box, 1.8, 0.6, 1.4, (0.95, 0.62, 0.35), at=(-0.3, 0.55, 0))
    draw_part(draw_box, 1.4, 0.36, 1.42, (0.25, 0.35, 0.45), at=(-0.3, 0.57, 0))  # side windows
    draw_part(draw_box, 1.82, 0.36, 1.2, (0.25, 0.35, 0.45), at=(-0.3, 0.57, 0))
    for z in (-0.55, 0.55):
        draw_part(draw_box, 0.1, 0.2, 0.3, (0.95, 0.9, 0.8), at=(1.9, 0.05, z))
    draw_part(draw_axle, angle, at=(-1.2, -0.3, 0))
    draw_part(draw_axle, angle, at=(1.2, -0.3, 0), turned=(steering, 0, 1, 0))


def look(width, height):
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 50)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glTranslatef(0, 0.1, -8)
    glRotatef(25, 1, 0, 0)
    glRotatef(-30, 0, 1, 0)


def on_key(window, key, scancode, action, mods):
    global steering, stack
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_RIGHT:
        steering -= 5
    elif key == glfw.KEY_LEFT:
        steering += 5
    elif key == glfw.KEY_SPACE:
        stack = not stack
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Matrix stack"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glEnable(GL_DEPTH_TEST)
    glClearColor(0.13, 0.16, 0.21, 1)

    while not glfw.window_should_close(window):
        look(*glfw.get_framebuffer_size(window))
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        draw_car(-90 * glfw.get_time())

        write(16, 40, "steering {angle}°", angle=steering)
        write(16, 16, "matrix stack on" if stack else "matrix stack off")
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
