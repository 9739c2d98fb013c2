"""Perspective: the volume that glFrustum sees

On the right is what a camera sees, on the left its volume from outside: what is in it is seen.
glFrustum makes it a pyramid without its tip, so far things are small. glOrtho makes it a box, and
far things are as large as near ones. The near plane cuts off whatever is nearer.

Keys: Up and Down move the near plane; Left and Right change the opening angle; Space: glOrtho.
"""
# topic: cameras
# needs: pinhole, frames
# picture: frame 0
# keys: UP DOWN LEFT RIGHT SPACE

import math
import sys

import glfw
from OpenGL.GL import *
from text import _, write

FAR = 6.3
CORNERS = ((-1, -1), (1, -1), (1, 1), (-1, 1))
near = 1.5
angle = 45  # degrees, from the lower to the upper edge of what is seen
parallel = False


def draw_scene():
    """Draw two rows of boxes before the camera, which is at the origin and looks along -z."""
    glBegin(GL_QUADS)
    for z, y in ((-2.7, -0.6), (-4, 0.1), (-5.3, 0.8)):
        draw_box(-0.55, y, z, (0.9, 0.38, 0.22))
        draw_box(0.55, y, z, (0.3, 0.68, 0.68))
    glEnd()


def draw_box(x, y, z, color):
    """Draw a box around its middle, with a shade for the faces across each axis."""
    for axis, shade in ((0, 0.8), (1, 1), (2, 0.65)):
        glColor3f(*(shade * channel for channel in color))
        for side in (-1, 1):
            for u, v in CORNERS:
                dx, dy, dz = ((side, u, v), (u, side, v), (u, v, side))[axis]
                glVertex3f(x + 0.3 * dx, y + 0.3 * dy, z + 0.3 * dz)


def draw_volume(top, aspect):
    """Draw the eye and the edges of the volume; ``top`` is half the height of its near end."""
    end = top if parallel else top * FAR / near
    glColor3f(0.95, 0.9, 0.8)
    glBegin(GL_POINTS)
    glVertex3f(0, 0, 0)
    glEnd()
    glPolygonMode(GL_FRONT_AND_BACK, GL_LINE)
    glBegin(GL_QUAD_STRIP)
    for u, v in (*CORNERS, CORNERS[0]):
        glVertex3f(top * aspect * u, top * v, -near)
        glVertex3f(end * aspect * u, end * v, -FAR)
    glEnd()
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL)


def look_from_outside(aspect):
    reach = max(4.3, 4.3 / aspect)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glOrtho(-reach * aspect, reach * aspect, -reach, reach, -20, 20)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glRotatef(25, 1, 0, 0)
    glRotatef(-50, 0, 1, 0)
    glTranslatef(0, 0, 3.4)


def look_from_camera(top, aspect):
    """Set the camera's matrices, and return the projection, row by row."""
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    project = glOrtho if parallel else glFrustum
    project(-top * aspect, top * aspect, -top, top, near, FAR)
    matrix = glGetFloatv(GL_PROJECTION_MATRIX).T  # OpenGL stores its columns
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    return matrix


def draw(width, height):
    bottom = int(144 * (height // 480 or height / 480))  # above the text
    half = width // 2
    aspect = half / (height - bottom)
    distance = 4 if parallel else near  # 4: among the boxes
    top = distance * math.tan(math.radians(angle / 2))

    look_from_outside(aspect)
    glViewport(0, bottom, half, height - bottom)
    glPointSize(height / 60)
    glLineWidth(height / 400)
    draw_scene()
    draw_volume(top, aspect)

    matrix = look_from_camera(top, aspect)
    glViewport(half, bottom, half, height - bottom)
    draw_scene()

    glViewport(0, 0, width, height)
    write(16, 112, "glOrtho" if parallel else "glFrustum")
    write(120, 112, "near {near:.1f}, {angle}°", near=near, angle=angle)
    for line, (a, b, c, d) in enumerate(matrix):
        write(16, 88 - 24 * line, "{a:6.2f} {b:6.2f} {c:6.2f} {d:6.2f}", a=a, b=b, c=c, d=d)


def on_key(window, key, scancode, action, mods):
    global near, angle, parallel
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_UP:
        near = min(5, near + 0.5)
    elif key == glfw.KEY_DOWN:
        near = max(0.5, near - 0.5)
    elif key == glfw.KEY_LEFT:
        angle = max(20, angle - 5)
    elif key == glfw.KEY_RIGHT:
        angle = min(50, angle + 5)
    elif key == glfw.KEY_SPACE:
        parallel = not parallel
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Perspective"), None, None)
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
