"""Mixed faces: pentagons and hexagons in one call

A football has 12 pentagons and 20 hexagons, so its faces have different numbers of vertices. A
single glDrawElements(GL_POLYGON) would draw one polygon of them all. glMultiDrawElements takes a
count and a list of indices for each face, and draws them all in one call. glArrayElement stands
between glBegin and glEnd and takes one vertex out of all the arrays: normal, colour and position
by one number.

Keys: 1 glArrayElement, 2 a glDrawElements for each face, 3 glMultiDrawElements; Left and Right
change how many faces are drawn.
"""
# topic: arrays
# needs: interleaved
# picture: frame 30
# loop: 360 frames
# keys: 1 2 LEFT RIGHT

import ctypes
import sys

import glfw
import numpy as np
from OpenGL.GL import *
from text import _, write

LABELS = ("glArrayElement", "glDrawElements", "glMultiDrawElements")
ARRAY_ELEMENT, ELEMENTS, MULTI = range(3)
mode = MULTI
drawn = 32  # faces


def make_football():
    """Return the directions to the faces' middles, and each face's corners in order.

    A football is an icosahedron whose tips are cut off at a third of each edge: a pentagon is left
    of each tip, a hexagon of each triangle.
    """
    golden = (1 + 5**0.5) / 2
    rectangle = [(0, a, b) for a in (-1, 1) for b in (-golden, golden)]
    tips = np.array([np.roll(tip, turn) for turn in range(3) for tip in rectangle])
    edges = [(a, b) for a in range(12) for b in range(12) if are_neighbours(tips[a], tips[b])]
    corners = np.array([(2 * tips[a] + tips[b]) / 3 for a, b in edges])

    middles = list(tips)
    for a, b in edges:
        for c in range(b + 1, 12):
            if a < b and (a, c) in edges and (b, c) in edges:
                middles.append(tips[a] + tips[b] + tips[c])
    return corners, middles, [face_around(middle, corners) for middle in middles]


def are_neighbours(tip, other):
    """Return whether an edge joins two tips of the icosahedron: it is 2 long."""
    return 0 < np.linalg.norm(other - tip) < 2.1


def face_around(middle, corners):
    """Return the numbers of a face's corners, counter-clockwise, seen from outside."""
    middle = middle / np.linalg.norm(middle)
    heights = corners @ middle
    numbers = np.flatnonzero(heights > heights.max() - 0.01)
    side = np.cross(middle, corners[numbers[0]])
    angles = np.arctan2(corners[numbers] @ side, corners[numbers] @ np.cross(side, middle))
    return numbers[np.argsort(angles)]


def make_arrays():
    """Return normals, colours and vertices, (180, 3) each, and the faces' indices.

    A corner has another normal in each of its faces, so it is there three times.
    """
    corners, middles, faces = make_football()
    normals = []
    colors = []
    vertices = []
    indices = []
    for middle, face in zip(middles, faces, strict=True):
        normal = middle / np.linalg.norm(middle)
        color = (0.2, 0.28, 0.33) if len(face) == 5 else (0.95, 0.9, 0.8)
        indices.append(np.arange(len(vertices), len(vertices) + len(face), dtype=np.uint32))
        for corner in face:
            normals.append(normal)
            colors.append(color)
            vertices.append(corners[corner])

    arrays = [np.array(rows, np.float32) for rows in (normals, colors, vertices)]
    return *arrays, indices


normals, colors, vertices, indices = make_arrays()
counts = np.array([len(face) for face in indices], np.int32)
# For each face the address of its first index: in C, an array of pointers.
addresses = (ctypes.c_void_p * 32)(*(face.ctypes.data for face in indices))


def draw_football():
    """Draw the faces, and return how many calls it took."""
    if mode == MULTI:
        glMultiDrawElements(GL_POLYGON, counts, GL_UNSIGNED_INT, addresses, drawn)
        return 1

    if mode == ELEMENTS:
        for face in indices[:drawn]:
            glDrawElements(GL_POLYGON, len(face), GL_UNSIGNED_INT, face)
        return drawn

    for face in indices[:drawn]:
        glBegin(GL_POLYGON)
        for index in face:
            glArrayElement(index)
        glEnd()
    return int(2 * drawn + counts[:drawn].sum())


def look(width, height):
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glFrustum(-width / height / 3, width / height / 3, -1 / 3, 1 / 3, 1, 50)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glLightfv(GL_LIGHT0, GL_POSITION, (-0.6, 0.8, 1, 0))
    glTranslatef(0, 0.15, -7)
    glRotatef(60 * glfw.get_time(), 0.3, 1, 0)


def on_key(window, key, scancode, action, mods):
    global drawn, mode
    if glfw.KEY_1 <= key < glfw.KEY_1 + len(LABELS):
        mode = key - glfw.KEY_1
    if key in (glfw.KEY_LEFT, glfw.KEY_RIGHT) and action != glfw.RELEASE:
        drawn = (drawn + (1 if key == glfw.KEY_RIGHT else -1)) % 33
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Mixed faces"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    for capability in (GL_DEPTH_TEST, GL_LIGHTING, GL_LIGHT0, GL_COLOR_MATERIAL):
        glEnable(capability)
    glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, True)  # light for the insides, too
    for array in (GL_NORMAL_ARRAY, GL_COLOR_ARRAY, GL_VERTEX_ARRAY):
        glEnableClientState(array)
    glNormalPointer(GL_FLOAT, 0, normals)
    glColorPointer(3, GL_FLOAT, 0, colors)
    glVertexPointer(3, GL_FLOAT, 0, vertices)
    glClearColor(0.13, 0.16, 0.21, 1)

    while not glfw.window_should_close(window):
        look(*glfw.get_framebuffer_size(window))
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        calls = draw_football()

        write(16, 64, LABELS[mode])
        write(16, 40, "faces: {drawn}", drawn=drawn)
        write(16, 16, "calls: {calls}", calls=calls)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
