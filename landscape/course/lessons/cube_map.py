"""Cube map: a sky looked up by direction, and a rabbit that reflects it

A cube map is six pictures looked up by a direction (OpenGL 1.3). For the sky, each corner of a box
is its own texture coordinate; for the rabbit, GL_REFLECTION_MAP computes the mirrored direction,
and the texture matrix turns it to world coordinates. The pictures lie on the cube as if it were
seen from outside. Loaded as they were taken, from inside, no picture fits its neighbours.

Keys: Left and Right turn; Space tints the faces, O loads them as they were taken.
"""
# topic: voxels
# needs: sky_box, sphere_map, ply_mesh
# picture: frame 1
# keys: LEFT RIGHT SPACE O

import sys
from pathlib import Path

import glfw
import numpy as np
from OpenGL.GL import *
from PIL import Image
from text import _, write

DATA = Path(__file__).parent / "data"
# The faces in OpenGL's order: names, the places of their pictures in sky.jpg, and tints.
LABELS = "+x", "-x", "+y", "-y", "+z", "-z"
PLACES = 1, 3, 4, 5, 2, 0
TINTS = (1, 0.4, 0.2), (1, 0.7, 0.3), (0.4, 0.8, 0.4), (0.3, 0.6, 0.6), (0.4, 0.6, 1), (0.7, 0.5, 1)
turn = 295
tinted = False
as_taken = False


def load_faces():
    pictures = np.split(np.asarray(Image.open(DATA / "sky.jpg")), 6, axis=1)
    for number, place in enumerate(PLACES):
        face = pictures[place]
        if not as_taken:  # left and right swapped, for +y and -y instead top and bottom
            face = face[::-1] if number in (2, 3) else face[:, ::-1]
        if tinted:
            face = np.uint8(face * 0.5 + 120 * np.array(TINTS[number]))
        load_face(GL_TEXTURE_CUBE_MAP_POSITIVE_X + number, face)


def load_face(target, face):
    height, width, _channels = face.shape
    data = GL_RGB, GL_UNSIGNED_BYTE, face.tobytes()
    glTexImage2D(target, 0, GL_RGB, width, height, 0, *data)


def load_rabbit():
    """Set the arrays of vertices and normals, and return the triangles."""
    vertices = np.loadtxt(DATA / "rabbit.ply", np.float32, skiprows=10, max_rows=752)
    triangles = np.loadtxt(DATA / "rabbit.ply", np.uint32, skiprows=762, usecols=(1, 2, 3))
    a, b, c = vertices[triangles].swapaxes(0, 1)
    normals = np.zeros_like(vertices)
    np.add.at(normals, triangles, np.cross(b - a, c - a)[:, np.newaxis])  # at each of its corners
    glVertexPointer(3, GL_FLOAT, 0, vertices)
    glNormalPointer(GL_FLOAT, 0, normals)
    return triangles


def draw_box():
    glBegin(GL_QUADS)
    for face in range(6):
        for u, v in ((-4, -4), (4, -4), (4, 4), (-4, 4)):
            corner = np.roll((4 if face < 3 else -4, u, v), face % 3)
            glTexCoord3fv(corner)  # where it lies is what it shows
            glVertex3fv(corner)
    glEnd()


def look(width, height):
    glViewport(0, 0, width, height)
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glFrustum(-width / height / 2, width / height / 2, -0.55, 0.45, 0.7, 20)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glRotatef(turn, 0, 1, 0)  # the sky is turned, but not moved


def draw_rabbit(triangles):
    """Draw the rabbit; its texture coordinates are the directions that it mirrors."""
    glLoadIdentity()
    glTranslatef(0, -0.1, -2.2)
    glRotatef(turn, 0, 1, 0)
    glEnable(GL_DEPTH_TEST)
    glEnable(GL_NORMALIZE)
    for n in range(3):  # S, T, R
        glTexGeni(GL_S + n, GL_TEXTURE_GEN_MODE, GL_REFLECTION_MAP)
        glEnable(GL_TEXTURE_GEN_S + n)

    glMatrixMode(GL_TEXTURE)
    glRotatef(-turn, 0, 1, 0)  # from eye to world coordinates
    glDrawElements(GL_TRIANGLES, triangles.size, GL_UNSIGNED_INT, triangles)
    glLoadIdentity()


def on_key(window, key, scancode, action, mods):
    global turn, tinted, as_taken
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_LEFT:
        turn -= 15
    elif key == glfw.KEY_RIGHT:
        turn += 15
    elif key == glfw.KEY_SPACE:
        tinted = not tinted
        load_faces()
    elif key == glfw.KEY_O:
        as_taken = not as_taken
        load_faces()
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Cube map"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    for name in (GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T):
        glTexParameteri(GL_TEXTURE_CUBE_MAP, name, GL_CLAMP_TO_EDGE)
    glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MIN_FILTER, GL_LINEAR)
    load_faces()
    triangles = load_rabbit()
    for array in (GL_VERTEX_ARRAY, GL_NORMAL_ARRAY):
        glEnableClientState(array)

    while not glfw.window_should_close(window):
        look(*glfw.get_framebuffer_size(window))
        glPushAttrib(GL_ENABLE_BIT)
        glEnable(GL_TEXTURE_CUBE_MAP)
        draw_box()
        draw_rabbit(triangles)
        glPopAttrib()

        if tinted:
            for n in range(len(LABELS)):
                write(16 + 40 * n, 40, LABELS[n], TINTS[n])
        write(16, 16, "pictures as they were taken" if as_taken else "mirrored, as OpenGL expects")
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
