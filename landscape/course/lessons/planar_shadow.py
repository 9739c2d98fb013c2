"""Planar shadow: a matrix that flattens rings onto floor and wall

M = (p.l) I - l p^T moves each vertex along its ray of the light l onto the plane p; drawn with it,
dark and blended, the rings become a shadow. Without the stencil test, layers darken twice; without
the polygon offset, shadow and plane fight for depth; with -p, only what is above the light casts
one.

Keys: S stencil test, O offset, D light at infinity, L light below the rings' top, N sign of p.
"""
# topic: effects
# needs: stencil_mirror, blending, matrix_stack
# picture: frame 40
# loop: 240 frames
# keys: S O D L N

import math
import sys

import glfw
from OpenGL.GL import *
from text import _, write

CORAL = (0.85, 0.35, 0.2, 1)
AMBER = (0.95, 0.62, 0.35, 1)
TEAL = (0.25, 0.6, 0.6, 1)
SHADOW = (0, 0, 0, 0.5)
WALL = (0, 0, 1, 3)  # the plane a x + b y + c z + d = 0, as a, b, c, d
FLOOR = (0, 1, 0, 2)
PLANES = (  # a plane, its colour, its corners
    (WALL, (0.36, 0.41, 0.48), ((-4, -2, -3), (4, -2, -3), (4, 3, -3), (-4, 3, -3))),
    (FLOOR, (0.5, 0.46, 0.4), ((-4, -2, -3), (-4, -2, 4), (4, -2, 4), (4, -2, -3))),
)

stencil = True
offset = True
point = True  # a point light, not one at infinity
high = True  # above the rings
facing = True  # p, not -p


def make_ring():
    """Return a display list of a torus: 32 strips around a tube of radius 0.13."""
    circle = [(math.cos(n * math.pi / 16), math.sin(n * math.pi / 16)) for n in range(33)]
    ring = glGenLists(1)
    glNewList(ring, GL_COMPILE)
    for n in range(32):
        glBegin(GL_QUAD_STRIP)
        for c, s in circle:
            for x, y in circle[n : n + 2]:
                glNormal3f(c * x, c * y, s)
                glVertex3f((1.6 + 0.13 * c) * x, (1.6 + 0.13 * c) * y, 0.13 * s)
        glEnd()
    glEndList()
    return ring


def draw_rings(ring, colors):
    """Draw three rings, each turning in the one before it, about x and y by turns."""
    glPushMatrix()
    for turn, color in enumerate(colors):
        glColor4f(*color)
        glRotatef(90 * glfw.get_time() + 60, turn % 2, 1 - turn % 2, 0)
        glCallList(ring)
        glScalef(0.78, 0.78, 0.78)  # the next one fits into it
    glPopMatrix()


def shadow_matrix(p, light):
    """Return M = (p.l) I - l p^T, row by row."""
    dot = sum(p[n] * light[n] for n in range(4))
    matrix = []
    for i in range(4):
        row = [-light[i] * p[j] + 0 for j in range(4)]  # + 0 makes 0 of -0
        row[i] += dot
        matrix.append(row)
    return matrix


def look(width, height):
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 60)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glTranslatef(-0.3, 1.5, -17.5)
    glRotatef(22, 1, 0, 0)
    glRotatef(20, 0, 1, 0)


def draw_plane(color, corners):
    """Draw a plane; its pixels become 1 in the stencil buffer."""
    glColor3f(*color)
    glBegin(GL_QUADS)
    for corner in corners:
        glVertex3f(*corner)
    glEnd()


def draw_shadow(ring, matrix):
    """Draw the rings flattened onto a plane, where it has no shadow yet."""
    glStencilFunc(GL_EQUAL if stencil else GL_ALWAYS, 1, 3)
    if offset:
        glEnable(GL_POLYGON_OFFSET_FILL)
    else:
        glDisable(GL_POLYGON_OFFSET_FILL)
    glPushMatrix()
    glMultTransposeMatrixf(matrix)  # reads it row by row
    draw_rings(ring, (SHADOW, SHADOW, SHADOW))
    glPopMatrix()
    glDisable(GL_POLYGON_OFFSET_FILL)
    glStencilFunc(GL_ALWAYS, 1, 3)


def write_numbers(p, light, matrix):
    write(16, 40, "stencil test on" if stencil else "stencil test off")
    write(16, 16, "polygon offset on" if offset else "polygon offset off")
    write(340, 136, "p = ({p[0]}, {p[1]}, {p[2]}, {p[3]})", p=p)
    write(340, 112, "l = ({l[0]:.1f}, {l[1]:.1f}, {l[2]:.1f}, {l[3]})", l=light)
    for line, row in enumerate(matrix):
        write(340, 88 - 24 * line, "{m[0]:6.2f} {m[1]:6.2f} {m[2]:6.2f} {m[3]:6.2f}", m=row)


def on_key(window, key, scancode, action, mods):
    global stencil, offset, point, high, facing
    if action != glfw.PRESS:
        return
    if key == glfw.KEY_S:
        stencil = not stencil
    elif key == glfw.KEY_O:
        offset = not offset
    elif key == glfw.KEY_D:
        point = not point
    elif key == glfw.KEY_L:
        high = not high
    elif key == glfw.KEY_N:
        facing = not facing
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Planar shadow"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA)
    glPolygonOffset(-2, -4)  # nearer to the eye than the plane
    glStencilOp(GL_KEEP, GL_KEEP, GL_INCR)  # pixels of a plane become 1, those in shadow 2
    for n in (GL_DEPTH_TEST, GL_STENCIL_TEST, GL_BLEND, GL_NORMALIZE, GL_LIGHT0, GL_COLOR_MATERIAL):
        glEnable(n)
    ring = make_ring()

    while not glfw.window_should_close(window):
        look(*glfw.get_framebuffer_size(window))
        light = 2 * math.sin(math.pi / 2 * glfw.get_time()), 3 if high else -1, 1.5, int(point)
        glLightfv(GL_LIGHT0, GL_POSITION, light)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT)

        for plane, color, corners in PLANES:
            draw_plane(color, corners)
            p = plane if facing else [-number for number in plane]
            matrix = shadow_matrix(p, light)
            draw_shadow(ring, matrix)

        glEnable(GL_LIGHTING)
        draw_rings(ring, (CORAL, AMBER, TEAL))
        glDisable(GL_LIGHTING)

        write_numbers(p, light, matrix)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
