"""Hidden faces: only what can be seen of a block of cubes

A face between two cubes is never seen. Compared with itself moved by a cube, the array of voxels
tells which cubes have air beside them: six comparisons, no loop over voxels. Runs of like faces
then become one long quad. Back-face culling is something else: it skips those of the drawn faces
that look away. Where the hill is cut open, their backs show in coral, and so does what is left
inside.

Keys: 1 all faces, 2 exposed ones, 3 runs of them; C closes or cuts the hill, B culls.
"""
# topic: voxels
# needs: height_columns, clip_plane, orientation
# picture: frame 1
# keys: 1 3 C B

import sys

import glfw
import numpy as np
from OpenGL.GL import *
from text import _, write

AIR = 0  # the other kinds, from 1, have a colour each
PALETTE = np.array(((95, 85, 62), (55, 70, 33), (30, 50, 30), (62, 58, 55), (55, 40, 28))) / 100
# The six directions, each an axis and a step along it, and how bright the faces there are.
SHADES = {(0, 1): 0.6, (0, -1): 0.7, (1, 1): 1, (1, -1): 0.5, (2, 1): 0.85, (2, -1): 0.75}
CORAL = (0.85, 0.35, 0.2)
BACKGROUND = (0.13, 0.16, 0.21)

ALL, EXPOSED, RUNS = range(3)  # which faces are drawn
LABELS = "1 all faces: {n}", "2 exposed faces: {n}", "3 runs of faces: {n}"
mode = EXPOSED
cut = True
cull = False


def make_blocks():
    """Return the kinds of the voxels of a hill with a cave, [x, y, z]."""
    x, y, z = np.mgrid[:36, :20, :36]
    hill = 14 * np.exp(-((x - 15) ** 2 + (z - 14) ** 2) / 110)
    above = np.round(3 + hill + 1.6 * np.sin(x / 3) * np.sin(z / 4 + 1)) - y  # cubes above it
    cave = (x - 16) ** 2 / 50 + (y - 5) ** 2 / 9 + (z - 18) ** 2 / 50 < 1

    empty = (above < 0) | cave
    at_the_top = 1 + np.digitize(y, (4, 7, 11))  # sand, grass, forest or rock, by height
    earth = 5
    rock = 4
    return np.select((empty, above == 0, above < 3), (AIR, at_the_top, earth), rock)


def beside(blocks, axis, step):
    """Return what lies beside each voxel in a direction; around the array there is air."""
    return np.roll(np.pad(blocks, 1), -step, axis)[1:-1, 1:-1, 1:-1]


def find_runs(faces, u):
    """Return the faces with which runs along the axis u begin, and those with which they end."""
    first = np.where(beside(faces, u, -1) == faces, 0, faces)
    last = np.where(beside(faces, u, 1) == faces, 0, faces)
    return first, last


def make_mesh(blocks, mode):
    """Return the corners of quads, (n, 4, 3), counter-clockwise from outside, and their colours."""
    corners = []
    colors = []
    for (axis, step), shade in SHADES.items():
        air_beside = beside(blocks, axis, step) == AIR
        faces = blocks if mode == ALL else np.where(air_beside, blocks, AIR)
        u = (axis + 1) % 3  # the directions in the face; runs go along u
        v = (axis + 2) % 3
        first, last = find_runs(faces, u) if mode == RUNS else (faces, faces)

        # With u as the fastest axis, the first and the last face of a run have the same number.
        layer, line, begin = np.nonzero(first.transpose(axis, v, u))
        end = np.nonzero(last.transpose(axis, v, u))[2] + 1

        quads = np.empty((len(layer), 4, 3), np.float32)
        quads[:, :, axis] = layer[:, np.newaxis] + (step == 1)
        quads[:, :, u] = np.stack((begin, end, end, begin), 1)
        quads[:, :, v] = np.stack((line, line, line + 1, line + 1), 1)
        corners.append(quads[:, ::step])  # the other way round on the other side
        kinds = faces.transpose(axis, v, u)[layer, line, begin]
        colors.append(shade * PALETTE[kinds - 1])

    corners = np.concatenate(corners) - 18
    colors = np.concatenate(colors).repeat(4, axis=0)
    return corners, np.float32(colors)


def look(width, height):
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 200)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glTranslatef(1, 14, -74)
    glRotatef(35, 1, 0, 0)
    glRotatef(-30, 0, 1, 0)


def draw_faces(count):
    """Draw the fronts of the faces in their colours, and their backs in coral unless culled."""
    glEnable(GL_CULL_FACE)
    glCullFace(GL_BACK)
    glEnableClientState(GL_COLOR_ARRAY)
    glDrawArrays(GL_QUADS, 0, count)
    glDisableClientState(GL_COLOR_ARRAY)
    if not cull:
        glCullFace(GL_FRONT)
        glColor3f(*CORAL)
        glDrawArrays(GL_QUADS, 0, count)
        glDisable(GL_CULL_FACE)


def draw_outlines(count):
    glColor3f(*BACKGROUND)
    glPolygonMode(GL_FRONT_AND_BACK, GL_LINE)
    glDrawArrays(GL_QUADS, 0, count)
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL)


def write_counts(meshes):
    for n, (corners, _colors) in enumerate(meshes):
        color = (0.95, 0.62, 0.35) if n == mode else (1, 1, 1)
        write(16, 64 - 24 * n, LABELS[n], color, n=len(corners))
    write(448, 16, "culling on" if cull else "culling off")


def on_key(window, key, scancode, action, mods):
    global mode, cut, cull
    if action == glfw.RELEASE:
        return
    if glfw.KEY_1 <= key < glfw.KEY_1 + len(LABELS):
        mode = key - glfw.KEY_1
    elif key == glfw.KEY_C:
        cut = not cut
    elif key == glfw.KEY_B:
        cull = not cull
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Hidden faces"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(*BACKGROUND, 1)
    glEnable(GL_DEPTH_TEST)
    glPolygonOffset(1, 1)  # the outlines lie in front of the faces
    glEnable(GL_POLYGON_OFFSET_FILL)
    glEnableClientState(GL_VERTEX_ARRAY)
    meshes = [make_mesh(make_blocks(), mode) for mode in (ALL, EXPOSED, RUNS)]

    while not glfw.window_should_close(window):
        look(*glfw.get_framebuffer_size(window))
        glClipPlane(GL_CLIP_PLANE0, (0, 0, -1, 2.5))
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        if cut:
            glEnable(GL_CLIP_PLANE0)
        else:
            glDisable(GL_CLIP_PLANE0)

        corners, colors = meshes[mode]
        glVertexPointer(3, GL_FLOAT, 0, corners)
        glColorPointer(3, GL_FLOAT, 0, colors)
        draw_faces(4 * len(corners))
        draw_outlines(4 * len(corners))
        glDisable(GL_CLIP_PLANE0)
        write_counts(meshes)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
