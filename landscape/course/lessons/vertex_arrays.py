"""Vertex arrays: a knot in one call

A mesh of 1152 vertices and 2304 triangles. Immediate mode names each corner of each triangle, with
its colour and its normal: thousands of calls a frame. glDrawElements reads arrays of vertices and
of indices in one call, and a vertex that six triangles share can be taken from a cache. Without
indices, glDrawArrays takes the vertices as they follow each other: no knot.

Keys: 1 immediate mode, 2 glDrawArrays, 3 glDrawElements; Left and Right change how much is drawn.
"""
# topic: arrays
# needs: normals
# picture: frame 0
# loop: 360 frames
# keys: 1 2 LEFT RIGHT
# programs: tetrahedron_calls tetrahedron_arrays

import sys

import glfw
import numpy as np
from OpenGL.GL import *
from text import _, write

ALONG = 96  # vertices along the knot
AROUND = 12  # and around its tube
IMMEDIATE, ARRAYS, ELEMENTS = range(3)
LABELS = ("immediate mode", "glDrawArrays", "glDrawElements")
mode = ELEMENTS
part = 10  # tenths of the indices


def curve(u):
    """Return points of a knot that goes twice around the axis and three times through the hole."""
    radius = 2 + np.cos(3 * u)
    return np.stack((radius * np.cos(2 * u), radius * np.sin(2 * u), 1.2 * np.sin(3 * u)), -1)


def unit(vectors):
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


def make_vertices():
    """Return the vertices, normals and colours of a tube along the curve, an (n, 3) array each."""
    u = np.linspace(0, 2 * np.pi, ALONG, endpoint=False)[:, np.newaxis]
    v = np.linspace(0, 2 * np.pi, AROUND, endpoint=False)[np.newaxis, :, np.newaxis]
    along = unit(curve(u + 0.001) - curve(u - 0.001))
    side = unit(np.cross(along, (0, 0, 1)))
    normals = np.cos(v) * side + np.sin(v) * np.cross(side, along)
    vertices = curve(u) + 0.5 * normals
    colors = 0.55 + 0.4 * np.cos(u[..., np.newaxis] + np.array((0, -1.2, -2.4))) + 0 * v
    return [array.reshape(-1, 3).astype(np.float32) for array in (vertices, normals, colors)]


def make_indices():
    """Return the indices of two triangles for each square of the tube; it closes both ways."""
    m, n = np.mgrid[0:ALONG, 0:AROUND]
    here = m * AROUND
    ahead = (m + 1) % ALONG * AROUND
    beside = (n + 1) % AROUND
    a = here + n
    b = ahead + n
    c = ahead + beside
    d = here + beside
    return np.stack((a, d, c, a, c, b), -1).ravel().astype(np.uint32)


vertices, normals, colors = make_vertices()
indices = make_indices()


def draw_knot():
    """Draw the knot, and return how many calls it took."""
    count = len(indices) * part // 30 * 3
    if mode == ARRAYS:
        glDrawArrays(GL_TRIANGLES, 0, min(count, len(vertices)))
        return 1
    if mode == ELEMENTS:
        glDrawElements(GL_TRIANGLES, count, GL_UNSIGNED_INT, indices)
        return 1

    glBegin(GL_TRIANGLES)
    for index in indices[:count]:
        glColor3fv(colors[index])
        glNormal3fv(normals[index])
        glVertex3fv(vertices[index])
    glEnd()
    return 2 + 3 * count


def look(width, height):
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glFrustum(-width / height / 3, width / height / 3, -1 / 3, 1 / 3, 1, 50)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glLightfv(GL_LIGHT0, GL_POSITION, (-0.6, 0.8, 1, 0))
    glTranslatef(0, 0.2, -11)
    glRotatef(60 * glfw.get_time(), 0.3, 1, 0)


def on_key(window, key, scancode, action, mods):
    global mode, part
    if action == glfw.RELEASE:
        return
    if glfw.KEY_1 <= key < glfw.KEY_1 + len(LABELS):
        mode = key - glfw.KEY_1
    elif key == glfw.KEY_LEFT:
        part = (part - 1) % 11
    elif key == glfw.KEY_RIGHT:
        part = (part + 1) % 11
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Vertex arrays"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    for capability in (GL_DEPTH_TEST, GL_LIGHTING, GL_LIGHT0, GL_COLOR_MATERIAL):
        glEnable(capability)
    for array in (GL_VERTEX_ARRAY, GL_NORMAL_ARRAY, GL_COLOR_ARRAY):
        glEnableClientState(array)
    glVertexPointer(3, GL_FLOAT, 0, vertices)
    glNormalPointer(GL_FLOAT, 0, normals)
    glColorPointer(3, GL_FLOAT, 0, colors)
    glClearColor(0.13, 0.16, 0.21, 1)

    while not glfw.window_should_close(window):
        look(*glfw.get_framebuffer_size(window))
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        calls = draw_knot()
        write(16, 40, LABELS[mode])
        write(16, 16, "calls to draw the knot: {calls}", calls=calls)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
