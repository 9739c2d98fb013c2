"""The viewport: from coordinates of -1 to 1 to pixels

Whatever is drawn ends up in normalised device coordinates: -1 to 1 in both directions. glViewport
says which rectangle of the window, in pixels, they fill. So a circle becomes as wide as the
rectangle is. That is made up for beforehand: glOrtho lets the scene's x reach as much farther as
the viewport is wider than high. Without this aspect ratio the circle is an ellipse.

Keys: the arrows change the width and the height of the viewport; Space ignores its aspect ratio.
"""
# topic: shapes
# needs: triangle
# picture: frame 0
# keys: LEFT RIGHT UP DOWN SPACE

import math
import sys

import glfw
from OpenGL.GL import *
from text import _, write

POINT = (0.5, 0.5)  # in normalised device coordinates
# The size of the viewport as parts of the window.
across = 0.7
up = 0.5
keep_aspect = True


def draw_wheel():
    """Draw a circle of sectors around the origin, with the radius 0.85."""
    for sector in range(16):
        glColor3f(*((0.85, 0.35, 0.2) if sector % 2 else (0.95, 0.62, 0.35)))
        glBegin(GL_POLYGON)
        glVertex2f(0, 0)
        for step in range(5):
            angle = (sector + step / 4) * math.pi / 8
            glVertex2f(0.85 * math.cos(angle), 0.85 * math.sin(angle))
        glEnd()


def draw():
    width, height = glfw.get_framebuffer_size(glfw.get_current_context())
    scale = height // 480 or height / 480  # of the pixels that write counts in
    w = int(across * width)
    h = int(up * height)
    x0 = (width - w) // 2
    y0 = int(0.38 * height)

    glViewport(x0, y0, w, h)
    glLoadIdentity()
    glColor3f(0.22, 0.27, 0.34)
    glRectf(-1, -1, 1, 1)  # all of the viewport
    aspect = w / h if keep_aspect else 1
    glOrtho(-aspect, aspect, -1, 1, -1, 1)
    draw_wheel()

    glLoadIdentity()
    glPointSize(height / 53)
    glColor3f(0.95, 0.9, 0.8)
    glBegin(GL_POINTS)
    glVertex2f(*POINT)
    glEnd()
    x = (POINT[0] + 1) * w / 2 + x0
    y = (POINT[1] + 1) * h / 2 + y0

    glViewport(0, 0, width, height)
    write(x / scale + 8, y / scale - 8, "{x:.0f}, {y:.0f}", x=x, y=y)
    corner = f"1, 1 = {x0 + w}, {y0 + h}"
    write(x0 / scale, y0 / scale - 22, "-1, -1 = {x}, {y}", x=x0, y=y0)
    write((x0 + w) / scale - 10 * len(corner), (y0 + h) / scale + 2, "{corner}", corner=corner)
    write(16, 64, "x = (0.5 + 1) {w}/2 + {x0} = {x:.0f}", w=w, x0=x0, x=x)
    write(16, 40, "y = (0.5 + 1) {h}/2 + {y0} = {y:.0f}", h=h, y0=y0, y=y)
    write(16, 16, "aspect {aspect:.2f}" if keep_aspect else "aspect ignored", aspect=aspect)


def on_key(window, key, scancode, action, mods):
    global across, up, keep_aspect
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_LEFT:
        across = max(0.4, across - 0.1)
    elif key == glfw.KEY_RIGHT:
        across = min(0.9, across + 0.1)
    elif key == glfw.KEY_DOWN:
        up = max(0.3, up - 0.05)
    elif key == glfw.KEY_UP:
        up = min(0.55, up + 0.05)
    elif key == glfw.KEY_SPACE:
        keep_aspect = not keep_aspect
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("The viewport"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)

    while not glfw.window_should_close(window):
        glClear(GL_COLOR_BUFFER_BIT)  # clears all of the window, whatever the viewport
        draw()
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
