"""Look-at: a camera that is carried around a market place

The camera still stands at the origin, in the middle of the market place. It should stand at `eye`
and look at `target`, so that the target is in the middle of the picture. The direction `up` points
upwards in the picture; it need not be perpendicular to the line of sight.

OpenGL's eye is always at the origin and looks along -z, with y upwards. So it is the world that
moves: let `look` multiply the modelview matrix so that the world comes into the camera's frame.

The axes of that frame follow from the three vectors. The first points to the right in the picture,
the second upwards, the third backward, from the target to the eye; each has length 1 and is
perpendicular to the other two. How you make the matrix is up to you. Change only look.

Keys: Left and Right carry the camera around, Up and Down lift it, Space leans it to the side.
"""
# exercise: look_at

import sys

import glfw
import numpy as np
from OpenGL.GL import *
from OpenGL.GLU import *

TARGET = np.array((0.4, 0.8, -0.3))
BOXES = (  # the middle of each, half its size, its colour
    ((0, -0.05, 0), (2.4, 0.05, 2.4), (0.3, 0.36, 0.42)),
    ((0.4, 0.8, -0.3), (0.3, 0.8, 0.3), (0.85, 0.35, 0.2)),
    ((-1.2, 0.4, 0.8), (0.5, 0.4, 0.3), (0.95, 0.62, 0.35)),
    ((1.5, 0.3, 1), (0.3, 0.3, 0.6), (0.3, 0.6, 0.6)),
    ((-1.4, 0.6, -1.4), (0.3, 0.6, 0.3), (0.55, 0.4, 0.6)),
)
turned = 30
lifted = 2.5
leaning = False


def look(eye, target, up):
    """Move the world into the frame of a camera; three arrays x, y, z."""
    gluLookAt(*eye, *target, *up)


def draw_boxes():
    glBegin(GL_QUADS)
    for middle, size, color in BOXES:
        for axis, shade in ((0, 0.8), (1, 1), (2, 0.65)):
            glColor3f(*(shade * channel for channel in color))
            for side in (-1, 1):
                for u, v in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                    glVertex3f(*np.roll((side, u, v), axis) * size + middle)
    glEnd()


def on_key(window, key, scancode, action, mods):
    global turned, lifted, leaning
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_LEFT:
        turned -= 20
    elif key == glfw.KEY_RIGHT:
        turned += 20
    elif key == glfw.KEY_DOWN:
        lifted -= 0.5
    elif key == glfw.KEY_UP:
        lifted += 0.5
    elif key == glfw.KEY_SPACE:
        leaning = not leaning
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(360, 270, "A market place", None, None)
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
        glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 0.5, 40)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        angle = np.radians(turned)
        eye = TARGET + (4.5 * np.sin(angle), lifted, 4.5 * np.cos(angle))
        look(eye, TARGET, np.array((0.5 if leaning else 0, 1, 0)))
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        draw_boxes()
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
