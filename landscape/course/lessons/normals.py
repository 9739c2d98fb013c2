"""Normals: of faces and of vertices

Light depends on normals, and normals are whatever the program gives. With one normal for a face,
the ring looks like the facets that it is made of. With one for each vertex, the normalized sum of
the normals around it, the same mesh looks round. Without normalizing, the sums are nearly 4 long,
and everything is too bright.

Keys: Space switches between faces and vertices; N leaves out normalizing; L hides the lines.
"""
# topic: light
# needs: light_model
# picture: frame 45
# loop: 360 frames
# keys: SPACE N L

import math
import sys

import glfw
from OpenGL.GL import *
from text import _, write

ROUND, ACROSS = 20, 10  # faces around the ring and around its tube
smooth = True
normalizing = True
lines = True


def point(m, n):
    """Return the vertex number m around the ring, and n around its tube."""
    angle = m * math.tau / ROUND
    turn = n * math.tau / ACROSS
    radius = 1.5 + 0.6 * math.cos(turn)
    return radius * math.cos(angle), radius * math.sin(angle), 0.6 * math.sin(turn)


def normalized(*vector):
    return [part / math.hypot(*vector) for part in vector]


def difference(a, b):
    return [q - p for p, q in zip(a, b, strict=True)]


def face_normal(m, n):
    """Return the normal of a face: the normalized cross product of two of its sides."""
    a = point(m, n)
    ux, uy, uz = difference(a, point(m + 1, n))
    vx, vy, vz = difference(a, point(m, n + 1))
    return normalized(uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx)


FACES = {(m, n): face_normal(m, n) for m in range(ROUND) for n in range(ACROSS)}


def vertex_normal(m, n):
    """Return the sum of the normals of the four faces around a vertex."""
    around = [FACES[(m - i) % ROUND, (n - j) % ACROSS] for i in (0, 1) for j in (0, 1)]
    total = [sum(coordinates) for coordinates in zip(*around, strict=True)]
    return normalized(*total) if normalizing else total


def draw_ring():
    glBegin(GL_QUADS)
    for (m, n), normal in FACES.items():
        for corner in ((m, n), (m + 1, n), (m + 1, n + 1), (m, n + 1)):
            glNormal3f(*(vertex_normal(*corner) if smooth else normal))
            glVertex3f(*point(*corner))
    glEnd()


def draw_lines():
    """Draw the normals, from the vertices or from the middles of the faces."""
    glDisable(GL_LIGHTING)
    glColor3f(0.95, 0.62, 0.35)
    glBegin(GL_LINES)
    for (m, n), normal in FACES.items():
        start = point(m, n) if smooth else point(m + 0.5, n + 0.5)
        along = vertex_normal(m, n) if smooth else normal
        glVertex3f(*start)
        glVertex3f(*(p + 0.25 * q for p, q in zip(start, along, strict=True)))
    glEnd()
    glEnable(GL_LIGHTING)


def look(width, height):
    glViewport(0, 0, width, height)
    glLineWidth(height / 320)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glFrustum(-width / height / 3, width / height / 3, -1 / 3, 1 / 3, 1, 50)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glLightfv(GL_LIGHT0, GL_POSITION, (-0.6, 0.8, 0.8, 0))
    glTranslatef(0, 0.2, -6.6)
    glRotatef(-50, 1, 0, 0)
    glRotatef(60 * glfw.get_time(), 0, 0, 1)


def on_key(window, key, scancode, action, mods):
    global lines, normalizing, smooth
    if action != glfw.PRESS:
        return
    if key == glfw.KEY_SPACE:
        smooth = not smooth
    elif key == glfw.KEY_N:
        normalizing = not normalizing
    elif key == glfw.KEY_L:
        lines = not lines
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Normals"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    for capability in (GL_DEPTH_TEST, GL_LIGHTING, GL_LIGHT0):
        glEnable(capability)
    glMaterialfv(GL_FRONT, GL_AMBIENT_AND_DIFFUSE, (0.25, 0.6, 0.6, 1))
    glClearColor(0.13, 0.16, 0.21, 1)

    while not glfw.window_should_close(window):
        look(*glfw.get_framebuffer_size(window))
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        draw_ring()
        if lines:
            draw_lines()
        write(16, 40, "normals of vertices" if smooth else "normals of faces")
        write(16, 16, "normalized" if normalizing else "not normalized")
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
