"""Transform order: rotation and translation, swapped

Each transform multiplies the modelview matrix from the right, so the call nearest to the drawing
acts first. With glTranslatef before glRotatef, the block turns around its own centre and is then
moved. With the two swapped, it is moved first, and swings around the world's origin.

Keys: Left and Right change the angle; Space swaps the two calls.
"""
# topic: transforms
# needs: matrices, z_buffer
# picture: frame 0
# keys: LEFT RIGHT SPACE

import sys

import glfw
from OpenGL.GL import *
from text import _, write

angle = 60  # degrees
swapped = False


def look():
    """Set the modelview matrix to what all drawings have in common: the camera."""
    glLoadIdentity()
    glTranslatef(-1.3, 0.2, -6)
    glRotatef(40, 1, 0, 0)
    glRotatef(-15, 0, 1, 0)


def place_block(turned):
    look()
    if swapped:
        glRotatef(turned, 0, 1, 0)
        glTranslatef(3, 0, 0)
    else:
        glTranslatef(3, 0, 0)
        glRotatef(turned, 0, 1, 0)


def draw_floor():
    glBegin(GL_LINES)
    glColor3f(0.26, 0.31, 0.38)
    for n in range(-8, 9):
        for x, z in ((n, -8), (n, 8), (-8, n), (8, n)):
            glVertex3f(x, -0.26, z)
    glEnd()
    write(-62, -6, "origin", at=(0, 0, 0))


def draw_arm():
    """Draw the translation as a line, in the frame in which it is made."""
    look()
    if swapped:
        glRotatef(angle, 0, 1, 0)
    glColor3f(0.95, 0.62, 0.35)
    glBegin(GL_LINES)
    glVertex3f(0, 0, 0)
    glVertex3f(3, 0, 0)
    glEnd()


def draw_block(colors):
    """Draw a block around the origin, 1.8 long; its ends at +x and -x have other colours."""
    glBegin(GL_QUADS)
    for axis, shade in ((0, 0.85), (1, 1), (2, 0.7)):
        for side in (-1, 1):
            color = colors[side if axis == 0 else 0]
            glColor3f(*(shade * channel for channel in color))
            for u, v in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                x, y, z = ((side, u, v), (u, side, v), (u, v, side))[axis]
                glVertex3f(0.9 * x, 0.25 * y, 0.45 * z)
    glEnd()


def draw_way():
    """Draw the block in lines where it was on its way, every 30 degrees."""
    glPolygonMode(GL_FRONT_AND_BACK, GL_LINE)
    for turned in range(0, angle, 30 if angle > 0 else -30):
        place_block(turned)
        draw_block(((0.5, 0.55, 0.6), (0.8, 0.8, 0.75), (0.5, 0.55, 0.6)))
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL)


def set_projection(width, height):
    glViewport(0, 0, width, height)
    glLineWidth(height / 240)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glOrtho(-3 * width / height, 3 * width / height, -3, 3, -20, 20)
    glMatrixMode(GL_MODELVIEW)


def on_key(window, key, scancode, action, mods):
    global angle, swapped
    if key in (glfw.KEY_LEFT, glfw.KEY_RIGHT) and action != glfw.RELEASE:
        angle += 15 if key == glfw.KEY_RIGHT else -15
    if key == glfw.KEY_SPACE and action == glfw.PRESS:
        swapped = not swapped
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Transform order"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glEnable(GL_DEPTH_TEST)
    glClearColor(0.13, 0.16, 0.21, 1)

    while not glfw.window_should_close(window):
        set_projection(*glfw.get_framebuffer_size(window))
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        look()
        draw_floor()
        draw_arm()
        draw_way()
        place_block(angle)
        draw_block(((0.85, 0.35, 0.2), (0.95, 0.9, 0.8), (0.95, 0.62, 0.35)))

        write(16, 40 if swapped else 16, "glRotatef({angle}, 0, 1, 0)", angle=angle)
        write(16, 16 if swapped else 40, "glTranslatef(3, 0, 0)")
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
