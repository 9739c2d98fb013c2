"""Hidden faces: a gate of cubes

SOLID says where cubes are: SOLID[x, y, z] is true if there is a cube from (x, y, z) to
(x + 1, y + 1, z + 1). make_faces returns the corners of the faces that are drawn, an array of
faces x 4 corners x 3 coordinates. As yet these are the tops of all cubes, even of those that have
another cube on top of them.

Let it return the sides of all six directions, but only those that have air in front of them. There
is air all around the array, too. Each of them is returned once, as a square of side 1, and its four
corners are counter-clockwise as seen from outside the cube: GL_CULL_FACE leaves out the others.

Change only make_faces. It needs no loop over cubes: what lies beside each of them is the same
array, moved by one place.

Keys: Left and Right turn the gate.
"""
# exercise: hidden_faces

import sys

import glfw
import numpy as np
from OpenGL.GL import *

SOLID = np.zeros((7, 6, 4), bool)
SOLID[:, 0] = True  # the ground
SOLID[:2, :, 1:3] = True  # a tower on either side
SOLID[5:, :5, 1:3] = True
SOLID[2:5, 4, 1:3] = True  # what they carry
SOLID[3, 1, 3] = True  # a stone before the gate
turn = 35  # degrees


def make_faces():
    """Return the corners of the faces to draw, (n, 4, 3)."""
    cubes = {tuple(place) for place in np.argwhere(SOLID).tolist()}
    faces = []
    for cube in sorted(cubes):
        for axis in range(3):
            for step in (1, -1):
                beside = list(cube)
                beside[axis] += step
                if tuple(beside) not in cubes:
                    faces.append(face(cube, axis, step))
    return faces


def face(cube, axis, step):
    """Return the four corners of a face, counter-clockwise as seen from outside."""
    corners = []
    for u, v in ((0, 0), (1, 0), (1, 1), (0, 1)):
        corner = list(cube)
        corner[axis] += step == 1
        corner[(axis + 1) % 3] += u
        corner[(axis + 2) % 3] += v
        corners.append(corner)
    return corners if step == 1 else corners[::-1]


def draw(faces):
    a, b, c = (faces[:, corner] for corner in range(3))
    normals = np.cross(b - a, c - b)
    shades = 0.72 + normals @ (0.1, 0.2, -0.05)
    colors = shades[:, None] * (0.95, 0.72, 0.5)
    glVertexPointer(3, GL_FLOAT, 0, faces.astype(np.float32))
    glColorPointer(3, GL_FLOAT, 0, colors.repeat(4, axis=0).astype(np.float32))
    glDrawArrays(GL_QUADS, 0, 4 * len(faces))


def on_key(window, key, scancode, action, mods):
    global turn
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_LEFT:
        turn -= 15
    elif key == glfw.KEY_RIGHT:
        turn += 15
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(640, 480, "A gate of cubes", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    glEnable(GL_DEPTH_TEST)
    glEnable(GL_CULL_FACE)
    glEnableClientState(GL_VERTEX_ARRAY)
    glEnableClientState(GL_COLOR_ARRAY)
    faces = np.asarray(make_faces())

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 50)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glTranslatef(0, 0.2, -19)
        glRotatef(25, 1, 0, 0)
        glRotatef(turn, 0, 1, 0)
        glTranslatef(-3.5, -3, -2)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        draw(faces)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
