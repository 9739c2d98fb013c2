"""Vertex arrays: a knot in one call

A mesh of 1152 vertices and 2304 triangles. Immediate mode names each corner of each triangle, with
its colour and its normal: thousands of calls a frame. glDrawElements reads arrays of vertices and
of indices in one call, and each vertex is transformed once for the six triangles that share it.
Without indices, glDrawArrays takes the vertices as they follow each other: no knot.

Keys: 1 immediate mode, 2 glDrawArrays, 3 glDrawElements; Left and Right change how much is drawn.
"""
# topic: arrays
# needs: normals
# picture: frame 0
# loop: 360 frames
# keys: 1 2 LEFT RIGHT
# programs: tetrahedron_calls tetrahedron_arrays

import glfw
import numpy as np
from OpenGL.GL import *
from text import _, write

ALONG, AROUND = 96, 12
LABELS = ("immediate mode", "glDrawArrays", "glDrawElements")
mode = 2
part = 10  # tenths of the indices


def curve(u):
    """Return points of a knot that goes twice around the axis and three times through the hole."""
    radius = 2 + np.cos(3 * u)
    return np.stack((radius * np.cos(2 * u), radius * np.sin(2 * u), 1.2 * np.sin(3 * u)), -1)


def unit(vectors):
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


def make_knot():
    """Return vertices, normals and colors, an (n, 3) array each, and the indices of triangles."""
    u = np.linspace(0, 2 * np.pi, ALONG, endpoint=False)[:, None]
    v = np.linspace(0, 2 * np.pi, AROUND, endpoint=False)[None, :, None]
    along = unit(curve(u + 0.001) - curve(u - 0.001))
    side = unit(np.cross(along, (0, 0, 1)))
    normals = np.cos(v) * side + np.sin(v) * np.cross(side, along)
    vertices = curve(u) + 0.5 * normals
    colors = 0.55 + 0.4 * np.cos(u[..., None] + np.array((0, -1.2, -2.4))) + 0 * v
    m, n = np.mgrid[0:ALONG, 0:AROUND]
    a, b = m * AROUND + n, (m + 1) % ALONG * AROUND + n
    next_n = (n + 1) % AROUND - n
    triangles = np.stack((a, a + next_n, b + next_n, a, b + next_n, b), -1)
    arrays = (array.reshape(-1, 3).astype(np.float32) for array in (vertices, normals, colors))
    return *arrays, triangles.ravel().astype(np.uint32)


vertices, normals, colors, indices = make_knot()


def draw_knot():
    """Draw the knot, and return how many calls it took."""
    count = len(indices) * part // 30 * 3
    if mode == 1:
        glDrawArrays(GL_TRIANGLES, 0, min(count, len(vertices)))
        return 1
    if mode == 2:
        glDrawElements(GL_TRIANGLES, count, GL_UNSIGNED_INT, indices)
        return 1
    glBegin(GL_TRIANGLES)
    for index in indices[:count]:
        glColor3fv(colors[index])
        glNormal3fv(normals[index])
        glVertex3fv(vertices[index])
    glEnd()
    return 2 + 3 * count


def on_key(window, key, scancode, action, mods):
    global mode, part
    if key - glfw.KEY_1 in range(3):
        mode = key - glfw.KEY_1
    if key in (glfw.KEY_LEFT, glfw.KEY_RIGHT) and action != glfw.RELEASE:
        part = (part + (1 if key == glfw.KEY_RIGHT else -1)) % 11
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    glfw.init()
    window = glfw.create_window(640, 480, _("Vertex arrays"), None, None)
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
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glFrustum(-width / height / 3, width / height / 3, -1 / 3, 1 / 3, 1, 50)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glLightfv(GL_LIGHT0, GL_POSITION, (-0.6, 0.8, 1, 0))
        glTranslatef(0, 0.2, -11)
        glRotatef(60 * glfw.get_time(), 0.3, 1, 0)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        calls = draw_knot()
        write(16, 40, LABELS[mode])
        write(16, 16, "calls to draw the knot: {calls}", calls=calls)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
