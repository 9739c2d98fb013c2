"""Look-at: the camera's frame from eye, target and up

On the right is what a camera sees, on the left the camera from outside, with its three axes. They
follow from the eye, the target and the direction up, and are the rows of the matrix that turns the
world into the camera's frame; glTranslatef moves the eye to the origin before. If up is parallel to
the view, no direction is right, and nothing can be seen.

Keys: Left and Right lead the camera around, Up and Down lift it; Space lays up into the view.
"""
# topic: cameras
# needs: perspective, frames
# picture: frame 0
# keys: LEFT RIGHT UP DOWN SPACE

import sys

import glfw
import numpy as np
from OpenGL.GL import *
from text import _, write

TARGET = np.array((0, 0.3, 0))
BOXES = (  # the middle of each, half its size, its colour
    ((0, -0.05, 0), (2, 0.05, 2), (0.24, 0.29, 0.36)),
    ((0, 0.7, 0), (0.3, 0.7, 0.3), (0.85, 0.35, 0.2)),
    ((-1, 0.35, 0.7), (0.3, 0.35, 0.3), (0.95, 0.62, 0.35)),
    ((1.1, 0.25, 0.5), (0.3, 0.25, 0.3), (0.3, 0.6, 0.6)),
)
LABELS = ("right", "up", "back", "eye")
COLORS = ((0.95, 0.5, 0.35), (0.4, 0.8, 0.8), (0.6, 0.75, 1), (1, 1, 1))
# The eye: degrees around the target, and units above the ground.
turn = -55
altitude = 2
parallel = False  # up is parallel to the view


def camera_frame(eye, target, up):
    """Return the directions to the right, upwards and backwards of a camera, each with length 1."""
    back = eye - target
    right = np.cross(up, back)
    axes = right, np.cross(back, right), back
    return [axis / (np.linalg.norm(axis) or 1) for axis in axes]  # the vector 0 stays 0


def draw_scene():
    glBegin(GL_QUADS)
    for middle, size, color in BOXES:
        for axis, shade in ((0, 0.8), (1, 1), (2, 0.65)):
            glColor3f(*(shade * channel for channel in color))
            for side in (-1, 1):
                for u, v in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                    glVertex3f(*np.roll((side, u, v), axis) * size + middle)
    glEnd()


def draw_overview(aspect, eye, frame):
    """Draw the scene from outside, with the eye, its axes, and the line to the target."""
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glOrtho(-4, 4, 0.7 - 4 / aspect, 0.7 + 4 / aspect, -20, 20)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glRotatef(25, 1, 0, 0)
    glRotatef(-30, 0, 1, 0)
    draw_scene()
    glBegin(GL_LINES)
    for end, color in zip((*(eye + axis for axis in frame), TARGET), COLORS, strict=True):
        glColor3f(*color)
        glVertex3f(*eye)
        glVertex3f(*end)
    glEnd()


def draw_view(aspect, eye, frame):
    """Draw the scene as the eye sees it: by the inverse of its frame."""
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glFrustum(-0.6 * aspect, 0.6 * aspect, -0.6, 0.6, 1, 20)
    matrix = np.identity(4)
    matrix[:3, :3] = frame  # the axes are its rows
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glMultMatrixf(matrix.T)  # OpenGL reads columns
    glTranslatef(*-eye)
    draw_scene()


def draw(width, height):
    bottom = int(116 * (height // 480 or height / 480))  # above the text
    middle = width // 2
    aspect = middle / (height - bottom)
    angle = np.radians(turn)
    eye = np.array((3 * np.sin(angle), altitude, 3 * np.cos(angle)))
    frame = camera_frame(eye, TARGET, eye - TARGET if parallel else (0, 1, 0))

    glLineWidth(height / 160)
    glViewport(0, bottom, middle, height - bottom)
    draw_overview(aspect, eye, frame)
    glViewport(middle, bottom, middle, height - bottom)
    draw_view(aspect, eye, frame)

    glViewport(0, 0, width, height)
    for line, (x, y, z) in enumerate(np.add((*frame, eye), 0)):  # + 0 makes 0 of -0
        write(16, 88 - 24 * line, LABELS[line], COLORS[line])
        write(96, 88 - 24 * line, "{x:6.2f}{y:6.2f}{z:6.2f}", COLORS[line], x=x, y=y, z=z)


def on_key(window, key, scancode, action, mods):
    global turn, altitude, parallel
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_LEFT:
        turn -= 10
    elif key == glfw.KEY_RIGHT:
        turn += 10
    elif key == glfw.KEY_DOWN:
        altitude -= 0.25
    elif key == glfw.KEY_UP:
        altitude += 0.25
    elif key == glfw.KEY_SPACE:
        parallel = not parallel
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Look-at"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    glEnable(GL_DEPTH_TEST)

    while not glfw.window_should_close(window):
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        draw(*glfw.get_framebuffer_size(window))
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
