"""Orientation: front and back faces

A face is seen from the front if its vertices go counter-clockwise on the screen. Front faces are
filled here, back faces are drawn as lines. Face culling leaves out all faces that show one side,
usually the back. OpenGL tells the sides by the sign of the area, which stands under each triangle.
If a face lists its vertices in the wrong order, as the second triangle does, culling removes what
should be seen.

Keys: Left and Right turn the triangles; Space turns culling on; C culls the other side; F makes
clockwise faces the front.
"""
# topic: shapes
# needs: primitives
# picture: frame 0
# keys: LEFT RIGHT SPACE C F

import math
import sys

import glfw
from OpenGL.GL import *
from text import _, write

CORNERS = ((-0.42, -0.4), (0.42, -0.4), (0, 0.5))
TRIANGLES = (  # where each stands, the order of its vertices, its turn in degrees, its colour
    (-1.2, (0, 1, 2), 0, (0.85, 0.35, 0.2)),
    (0, (0, 2, 1), 0, (0.95, 0.62, 0.35)),
    (1.2, (0, 1, 2), 150, (0.25, 0.6, 0.6)),
)
angle = 0  # degrees about the vertical axis
culling = False
culled = GL_BACK
front = GL_CCW


def draw_triangle(place, order, turn, color):
    cosine = math.cos(math.radians(angle + turn))
    points = [(place + cosine * CORNERS[n][0], 0.3 + CORNERS[n][1]) for n in order]
    glColor3f(*color)
    glBegin(GL_TRIANGLES)
    for x, y in points:
        glVertex2f(x, y)
    glEnd()
    for number, (x, y) in enumerate(points):
        beside = (place + 1.12 * (x - place), 0.27 + 1.25 * (y - 0.27), 0)
        write(-5, -10, "{number}", at=beside, number=number)
    (x0, y0), (x1, y1), (x2, y2) = points
    area = ((x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)) / 2
    write(-50, -10, "area {area:+.2f}", at=(place, -0.42, 0), area=area)


def draw():
    width, height = glfw.get_framebuffer_size(glfw.get_current_context())
    glViewport(0, 0, width, height)
    glClear(GL_COLOR_BUFFER_BIT)
    glLoadIdentity()
    glScalef(0.54, 0.54 * width / height, 1)
    glLineWidth(height / 240)

    # Front faces filled, back faces as lines: the lesson polygon_modes says more.
    glPolygonMode(GL_FRONT, GL_FILL)
    glPolygonMode(GL_BACK, GL_LINE)
    glFrontFace(front)
    glCullFace(culled)
    if culling:
        glEnable(GL_CULL_FACE)
    for triangle in TRIANGLES:
        draw_triangle(*triangle)
    glDisable(GL_CULL_FACE)
    glFrontFace(GL_CCW)  # as write expects
    write(16, 64, "turned by {angle}°", angle=angle)
    write(16, 40, "front face: {name}", name="GL_CCW" if front == GL_CCW else "GL_CW")
    name = "GL_BACK" if culled == GL_BACK else "GL_FRONT"
    write(16, 16, "culling on ({name})" if culling else "culling off ({name})", name=name)


def on_key(window, key, scancode, action, mods):
    global angle, culling, culled, front
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_LEFT:
        angle -= 15
    elif key == glfw.KEY_RIGHT:
        angle += 15
    elif key == glfw.KEY_SPACE:
        culling = not culling
    elif key == glfw.KEY_C:
        culled = GL_FRONT if culled == GL_BACK else GL_BACK
    elif key == glfw.KEY_F:
        front = GL_CW if front == GL_CCW else GL_CCW
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Orientation"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)

    while not glfw.window_should_close(window):
        draw()
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
