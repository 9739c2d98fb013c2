"""Hidden faces: only what can be seen of a block of cubes

A face between two cubes is never seen. Compared with itself moved by a cube, the array of voxels
tells which cubes have air beside them: six comparisons, no loop over voxels. Runs of like faces
then become one long quad. Back-face culling is another thing: of what is drawn, it leaves out the
faces that look away. Where the hill is cut open they are seen, coral, and what is left inside.

Keys: 1 all faces, 2 exposed ones, 3 runs of them; C closes or cuts the hill, B culls.
"""
# topic: voxels
# needs: height_columns, clip_plane, orientation
# picture: frame 1
# keys: 1 3 C B

import glfw
import numpy as np
from OpenGL.GL import *
from text import _, write

LABELS = "1 all faces: {n}", "2 exposed faces: {n}", "3 runs of faces: {n}"
PALETTE = np.array(((95, 85, 62), (55, 70, 33), (30, 50, 30), (62, 58, 55), (55, 40, 28))) / 100
# The six directions, each an axis and a step along it, and how bright the faces there are.
SHADES = {(0, 1): 0.6, (0, -1): 0.7, (1, 1): 1, (1, -1): 0.5, (2, 1): 0.85, (2, -1): 0.75}
mode = 1
cut = True
cull = False


def make_blocks():  # of a hill with a cave: the kinds of the voxels, [x, y, z], where 0 is air
    x, y, z = np.mgrid[:36, :20, :36]
    hill = 14 * np.exp(-((x - 15) ** 2 + (z - 14) ** 2) / 110)
    up = np.round(3 + hill + 1.6 * np.sin(x / 3) * np.sin(z / 4 + 1)) - y  # cubes above it
    cave = (x - 16) ** 2 / 50 + (y - 5) ** 2 / 9 + (z - 18) ** 2 / 50 < 1
    return np.select(((up < 0) | cave, up == 0, up < 3), (0, 1 + np.digitize(y, (4, 7, 11)), 5), 4)


def beside(blocks, axis, step):
    """Return what lies beside each voxel in a direction; around the array there is air."""
    return np.roll(np.pad(blocks, 1), -step, axis)[1:-1, 1:-1, 1:-1]


def make_mesh(blocks, exposed, runs):
    """Return the corners of quads, (n, 4, 3), counter-clockwise from outside, and their colors."""
    corners, colors = [], []
    for (axis, step), shade in SHADES.items():
        faces = np.where(beside(blocks, axis, step) == 0, blocks, 0) if exposed else blocks
        u, v = (axis + 1) % 3, (axis + 2) % 3  # the directions in the face; runs go along u
        ends = [np.where(runs & (beside(faces, u, n) == faces), 0, faces) for n in (-1, 1)]
        # With u as the fastest axis, the first and the last face of a run have the same number.
        (a, c, first), (_a, _c, last) = (np.nonzero(e.transpose(axis, v, u)) for e in ends)
        quads = np.empty((len(a), 4, 3), np.float32)
        quads[:, :, axis] = a[:, None] + (step == 1)
        quads[:, :, u] = np.stack((first, last + 1, last + 1, first), 1)
        quads[:, :, v] = np.stack((c, c, c + 1, c + 1), 1)
        corners.append(quads[:, ::step])
        colors.append(shade * PALETTE[faces.transpose(axis, v, u)[a, c, first] - 1])
    return np.concatenate(corners) - 18, np.float32(np.concatenate(colors).repeat(4, axis=0))


def on_key(window, key, scancode, action, mods):
    global mode, cut, cull
    if action != glfw.RELEASE:
        mode = key - glfw.KEY_1 if key - glfw.KEY_1 in range(3) else mode
        cut, cull = cut ^ (key == glfw.KEY_C), cull ^ (key == glfw.KEY_B)
        glfw.set_window_should_close(window, key == glfw.KEY_ESCAPE)


def main():
    glfw.init()
    window = glfw.create_window(640, 480, _("Hidden faces"), None, None)
    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    glEnable(GL_DEPTH_TEST)
    glPolygonOffset(1, 1)  # the outlines lie in front of the faces
    glEnable(GL_POLYGON_OFFSET_FILL)
    glEnableClientState(GL_VERTEX_ARRAY)
    meshes = [make_mesh(make_blocks(), n > 0, n > 1) for n in range(3)]
    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 200)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glTranslatef(1, 14, -74)
        glRotatef(35, 1, 0, 0)
        glRotatef(-30, 0, 1, 0)
        glClipPlane(GL_CLIP_PLANE0, (0, 0, -1, 2.5))
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        (glEnable if cut else glDisable)(GL_CLIP_PLANE0)
        corners, colors = meshes[mode]
        glVertexPointer(3, GL_FLOAT, 0, corners)
        glColorPointer(3, GL_FLOAT, 0, colors)
        glEnable(GL_CULL_FACE)
        glCullFace(GL_BACK)
        glEnableClientState(GL_COLOR_ARRAY)
        glDrawArrays(GL_QUADS, 0, 4 * len(corners))
        glDisableClientState(GL_COLOR_ARRAY)
        if not cull:
            glCullFace(GL_FRONT)
            glColor3f(0.85, 0.35, 0.2)
            glDrawArrays(GL_QUADS, 0, 4 * len(corners))
            glDisable(GL_CULL_FACE)
        glColor3f(0.13, 0.16, 0.21)
        glPolygonMode(GL_FRONT_AND_BACK, GL_LINE)
        glDrawArrays(GL_QUADS, 0, 4 * len(corners))
        glPolygonMode(GL_FRONT_AND_BACK, GL_FILL)
        glDisable(GL_CLIP_PLANE0)
        for n in range(3):
            color = (0.95, 0.62, 0.35) if n == mode else (1, 1, 1)
            write(16, 64 - 24 * n, LABELS[n], color, n=len(meshes[n][0]))
        write(448, 16, "culling on" if cull else "culling off")
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
