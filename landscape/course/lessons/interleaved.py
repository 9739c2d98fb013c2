"""Interleaved arrays: types, sizes and the stride

A tetrahedron whose vertices have a position and a colour, in one array of bytes. The four rows
are its four vertices as they lie in memory, a cell for each byte. glVertexPointer and
glColorPointer say how many numbers an element has, of which type, how many bytes it is from one
element to the next, the stride, and where the first one begins. Smaller types save bytes. A
stride of 0 means that the elements touch, which is wrong here: OpenGL then reads colours as
positions.

Keys: 1 float, 2 double, 3 short for the positions; C changes the type of the colours; Space
passes the stride 0.
"""
# topic: arrays
# needs: vertex_arrays
# picture: frame 0
# keys: 2 3 1 C SPACE

import sys

import glfw
import numpy as np
from OpenGL.GL import *
from text import _, write

POSITIONS = ((-1, -1, 1), (1, -1, -1), (-1, 1, -1), (1, 1, 1))
COLORS = ((0.85, 0.35, 0.2), (0.95, 0.72, 0.35), (0.3, 0.65, 0.65), (0.95, 0.9, 0.8))
FACES = np.array((0, 1, 3, 1, 2, 3, 2, 0, 3, 0, 2, 1), np.uint8)
# OpenGL's types: the constant, its name, numpy's name, and what 1 is as a colour.
POSITION_TYPES = (
    (GL_FLOAT, "GL_FLOAT", np.float32),
    (GL_DOUBLE, "GL_DOUBLE", np.float64),
    (GL_SHORT, "GL_SHORT", np.int16),
)
COLOR_TYPES = (
    (GL_UNSIGNED_BYTE, "GL_UNSIGNED_BYTE", np.uint8, 255),
    (GL_UNSIGNED_SHORT, "GL_UNSIGNED_SHORT", np.uint16, 65535),
    (GL_FLOAT, "GL_FLOAT", np.float32, 1),
)
position = 0  # which type
color = 0
told = True  # the stride is passed

BLUE = (0.35, 0.55, 0.8)
CORAL = (0.85, 0.35, 0.2)
GREY = (0.6, 0.65, 0.7)


def make_array():
    """Return the vertices, a structured array: each has a position and then a colour."""
    kind, most = COLOR_TYPES[color][2:]
    fields = [("position", POSITION_TYPES[position][2], 3), ("color", kind, 3)]
    array = np.zeros(4, fields)
    array["position"] = POSITIONS
    array["color"] = np.multiply(COLORS, most)
    return array


def draw_tetrahedron(array):
    stride = array.itemsize if told else 0
    first = array.ctypes.data  # the address of the first byte
    glEnableClientState(GL_VERTEX_ARRAY)
    glEnableClientState(GL_COLOR_ARRAY)
    glVertexPointer(3, POSITION_TYPES[position][0], stride, GLvoidp(first))
    offset = array.dtype.fields["color"][1]  # bytes from the beginning of a vertex
    glColorPointer(3, COLOR_TYPES[color][0], stride, GLvoidp(first + offset))
    glDrawElements(GL_TRIANGLES, 12, GL_UNSIGNED_BYTE, FACES)
    glDisableClientState(GL_COLOR_ARRAY)  # what is drawn next has its own colours
    glDisableClientState(GL_VERTEX_ARRAY)


def draw_bytes(array, width, height):
    """Draw each vertex as a row of its bytes: those of the position, then those of the colour."""
    size = array.itemsize
    split = array.dtype.fields["color"][1]
    scale = height // 480 or height / 480
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glOrtho(0, width / scale, 0, height / scale, -1, 1)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    cell = (width / scale - 80) / 36
    for row in range(4):
        y = 196 - 26 * row
        for byte in range(size):
            glColor3f(*(BLUE if byte < split else COLORS[row]))
            glRectf(64 + cell * byte, y, 64 + cell * (byte + 0.9), y + 20)
        write(16, y, "{row}:", GREY, row=row)


def draw(width, height):
    array = make_array()
    bottom = int(228 * (height // 480 or height / 480))  # above the bytes
    glViewport(0, bottom, width, height - bottom)
    look(width / (height - bottom))
    draw_tetrahedron(array)

    glViewport(0, 0, width, height)
    draw_bytes(array, width, height)
    write_calls(array)


def look(aspect):
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glOrtho(-1.9 * aspect, 1.9 * aspect, -1.9, 1.9, -10, 10)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glRotatef(25, 1, 0, 0)
    glRotatef(-35, 0, 1, 0)


def write_calls(array):
    """Write the two calls as they are made, with the numbers that they are given."""
    stride = array.itemsize if told else 0
    name = POSITION_TYPES[position][1]
    write(16, 64, "glVertexPointer(3, {name}, {stride}, first)", BLUE, name=name, stride=stride)
    name = COLOR_TYPES[color][1]
    offset = array.dtype.fields["color"][1]
    write(16, 40, "glColorPointer(3, {t}, {n}, ", CORAL, t=name, n=stride)
    place = 16 + 10 * len(f"glColorPointer(3, {name}, {stride}, ")
    write(place, 40, "first + {offset})", CORAL, offset=offset)
    write(16, 16, "{count} bytes a vertex", GREY, count=array.itemsize)


def on_key(window, key, scancode, action, mods):
    global color, position, told
    if action == glfw.RELEASE:
        return
    if glfw.KEY_1 <= key < glfw.KEY_1 + 3:
        position = key - glfw.KEY_1
    elif key == glfw.KEY_C:
        color = (color + 1) % 3
    elif key == glfw.KEY_SPACE:
        told = not told
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Interleaved arrays"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glEnable(GL_DEPTH_TEST)
    glClearColor(0.13, 0.16, 0.21, 1)

    while not glfw.window_should_close(window):
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        draw(*glfw.get_framebuffer_size(window))
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
