"""Frames: the chair's, the world's and the camera's

A chair has a frame of its own. One matrix takes its points to the world's frame, another to the
camera's; the modelview matrix is their product. Without the first, it stands at the world's origin.

Keys: Left and Right turn the chair; Space leaves out its matrix; F shows it.
"""
# topic: cameras
# needs: transform_order
# picture: frame 0
# keys: LEFT RIGHT SPACE F

import sys

import glfw
from OpenGL.GL import *
from text import _, write

LEGS = [(x, 0, z, 0.1, 0.9, 0.1) for x in (-0.45, 0.45) for z in (-0.45, 0.45)]
CHAIR = [(0, 0.9, 0, 1, 0.1, 1), (0, 1, -0.45, 1, 1, 0.1), *LEGS]
CAMERA = [(0, -0.2, 0, 0.35, 0.4, 0.6), (0, -0.1, -0.4, 0.2, 0.2, 0.2)]
CORNER = (0.5, 2, -0.5)  # of the chair's back, in the chair's frame
turned = 30  # degrees
placed = True
shown = False  # the matrix that takes the chair to the world


def chair_to_world():
    if placed:
        glTranslatef(1.8, 0, -1)
        glRotatef(turned, 0, 1, 0)


def world_to_camera():
    glRotatef(90, 0, 1, 0)
    glTranslatef(2.6, -1.2, 0.3)


def camera_to_world():
    glTranslatef(-2.6, 1.2, -0.3)
    glRotatef(-90, 0, 1, 0)


def world_to_us():
    glTranslatef(0.4, -0.1, -9)
    glRotatef(32, 1, -0.8, 0)


def set_frame(*changes):
    glLoadIdentity()
    for change in changes:  # the last one is the first to act on a point
        change()


def corner(*changes):
    set_frame(*changes)
    return "({:.1f}, {:.1f}, {:.1f})".format(*((*CORNER, 1) @ glGetFloatv(GL_MODELVIEW_MATRIX)))


def write_matrix(height):
    """Write the chair's matrix: in its columns the axes and the origin, in the world's frame."""
    set_frame(chair_to_world)
    top = height / (height // 480 or height / 480)  # as write counts
    for line, row in enumerate(glGetFloatv(GL_MODELVIEW_MATRIX).T.round(2) + 0):
        a, b, c, d = row
        y = top - 30 - 24 * line
        write(16, y, "{a:6.2f} {b:6.2f} {c:6.2f} {d:6.2f}", (0.95, 0.75, 0.5), a=a, b=b, c=c, d=d)


def draw_part(boxes, color):
    """Draw boxes and the axes of their frame."""
    glBegin(GL_QUADS)
    for box in boxes:
        draw_box(box, color)
    glEnd()
    draw_axes()


def draw_box(box, color):
    """Draw a box; its x, y, z are those of the middle of its lower side."""
    x, y, z, width, height, depth = box
    for axis, shade in ((0, 0.75), (1, 1), (2, 0.6)):
        glColor3f(*(shade * channel for channel in color))
        for side in (-1, 1):
            for u, v in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                a, b, c = ((side, u, v), (u, side, v), (u, v, side))[axis]
                glVertex3f(x + a * width / 2, y + (b + 1) * height / 2, z + c * depth / 2)


def draw_axes():
    for axis in ((1, 0, 0), (0, 1, 0), (0, 0, 1)):
        glBegin(GL_LINES)
        glColor3f(*(0.45 + 0.5 * coordinate for coordinate in axis))
        glVertex3f(0, 0, 0)
        glVertex3f(*axis)
        glEnd()
        write(3, 0, "xyz"[axis.index(1)], at=axis)


def look(width, height):
    glViewport(0, 0, width, height)
    glLineWidth(height / 240)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glOrtho(-2.9 * width / height, 2.9 * width / height, -2.9, 2.9, 1, 50)
    glMatrixMode(GL_MODELVIEW)


def on_key(window, key, scancode, action, mods):
    global placed, shown, turned
    if key in (glfw.KEY_LEFT, glfw.KEY_RIGHT) and action != glfw.RELEASE:
        turned += 15 if key == glfw.KEY_RIGHT else -15
    if key == glfw.KEY_SPACE and action == glfw.PRESS:
        placed = not placed
    if key == glfw.KEY_F and action == glfw.PRESS:
        shown = not shown
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Frames"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glEnable(GL_DEPTH_TEST)
    glClearColor(0.13, 0.16, 0.21, 1)

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        look(width, height)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)

        # Each part in its own frame.
        set_frame(world_to_us)
        draw_part([(0, -0.1, 0, 7.6, 0.05, 6)], (0.27, 0.32, 0.38))

        write(-30, -22, "world", at=(0, 0, 0))
        set_frame(world_to_us, camera_to_world)
        draw_part(CAMERA, (0.95, 0.9, 0.8))
        write(-30, -34, "camera", at=(0, 0, 0))
        set_frame(world_to_us, chair_to_world)
        draw_part(CHAIR, (0.95, 0.62, 0.35))
        write(4, 4, "corner", at=CORNER)
        write(16, 64, "corner in the chair's frame {p}", p=corner())
        write(16, 40, "in the world's frame        {p}", p=corner(chair_to_world))
        write(16, 16, "in the camera's frame       {p}", p=corner(world_to_camera, chair_to_world))
        if shown:
            write_matrix(height)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
