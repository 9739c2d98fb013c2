"""The matrix stack: a robot's arm

The arm stands on a base that turns. The upper arm ends in the elbow, the forearm in the wrist, and
two fingers stand on the wrist, one at each side. Each part is drawn in the frame of the part that
carries it, so it follows that part.

The second finger stands in the wrong place, and so does the lamp, which should stand beside the
base and not move: both are drawn in the frame that the part before them has left behind. Add
glPushMatrix and glPopMatrix where they are needed, so that each finger begins at the wrist and the
lamp begins where the base did. Do not change the other calls.

Keys: Up and Down bend the elbow; Left and Right turn the base.
"""
# exercise: matrix_stack

import sys
from contextlib import contextmanager

import glfw
from OpenGL.GL import *

turn = 30  # degrees
bend = 55


def draw_box(x, y, z, width, height, depth, color):
    """Draw a box that stands on the point x, y, z. Each direction has its shade."""
    glBegin(GL_QUADS)
    for axis, shade in ((1, 1), (0, 0.8), (2, 0.6)):
        glColor3f(*(shade * channel for channel in color))
        for side in (-1, 1):
            for u, v in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                a, b, c = ((side, u, v), (u, side, v), (u, v, side))[axis]
                glVertex3f(x + a * width / 2, y + (b + 1) * height / 2, z + c * depth / 2)
    glEnd()


@contextmanager
def frame():
    """Let the block have a frame of its own: afterwards the matrix is as before."""
    glPushMatrix()
    try:
        yield
    finally:
        glPopMatrix()


def draw_finger(side):
    """Draw a finger of the wrist, at the left (-1) or at the right (1)."""
    glTranslatef(side * 0.35, 0, 0)
    glRotatef(side * -25, 0, 0, 1)
    draw_box(0, 0, 0, 0.18, 0.9, 0.4, (0.95, 0.9, 0.8))


def draw_arm():
    """Draw the arm from the base to the fingers."""
    glRotatef(turn, 0, 1, 0)
    draw_box(0, 0, 0, 1.8, 0.4, 1.8, (0.45, 0.47, 0.5))
    glTranslatef(0, 0.4, 0)
    glRotatef(20, 0, 0, 1)
    draw_box(0, 0, 0, 0.6, 2.2, 0.6, (0.85, 0.35, 0.2))
    glTranslatef(0, 2.2, 0)
    glRotatef(-bend, 0, 0, 1)
    draw_box(0, 0, 0, 0.5, 1.8, 0.5, (0.95, 0.62, 0.35))
    glTranslatef(0, 1.8, 0)
    draw_box(0, 0, 0, 1, 0.15, 0.5, (0.25, 0.6, 0.6))
    for side in (-1, 1):
        with frame():
            draw_finger(side)


def draw_lamp():
    """Draw a lamp that stands beside the base."""
    glTranslatef(-2.3, 0, 0.6)
    draw_box(0, 0, 0, 0.15, 1.3, 0.15, (0.45, 0.47, 0.5))
    draw_box(0, 1.3, 0, 0.55, 0.4, 0.55, (1, 0.85, 0.45))


def draw_scene():
    draw_box(0, -0.2, 0, 6.5, 0.2, 4.5, (0.3, 0.35, 0.42))
    with frame():
        draw_arm()
    with frame():
        draw_lamp()


def on_key(window, key, scancode, action, mods):
    global turn, bend
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_LEFT:
        turn -= 15
    elif key == glfw.KEY_RIGHT:
        turn += 15
    elif key == glfw.KEY_UP:
        bend -= 15
    elif key == glfw.KEY_DOWN:
        bend += 15
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(640, 480, "A robot's arm", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    glEnable(GL_DEPTH_TEST)

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 50)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glTranslatef(-0.3, -2.2, -14.5)
        glRotatef(18, 1, 0, 0)
        glRotatef(-12, 0, 1, 0)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        draw_scene()
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
