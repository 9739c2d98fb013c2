"""Box and frustum: which regions of a terrain need not be drawn

A box is out of view where its eight corners are beyond one plane of the frustum. In world space
the planes come from the matrix; in clip space they are -w < x < w, and so for y and z. A test the
other way round finds more boxes: those beside all corners of the frustum. To ask for boxes with a
corner in view is wrong: what is close and large is left out.

Keys: 1 world space, 2 clip space, 3 both ways round, 4 a corner in view; Left and Right turn.
"""
# topic: voxels
# needs: height_columns, perspective, second_viewport
# picture: frame 1
# keys: 1 3 4 LEFT RIGHT

from pathlib import Path

import glfw
import numpy as np
from OpenGL.GL import *
from PIL import Image
from text import _, write

LABELS = "planes in world space", "corners in clip space", "both ways round", "a corner in view"
IMAGE = Image.open(Path(__file__).parent / "data" / "heights.png").crop((0, 0, 128, 128))
# 8 x 8 regions of 16 x 16 pixels: the highest pixel of each is the height of its box.
TOPS = np.maximum(0.12, np.asarray(IMAGE) / 65535).reshape(8, 16, 8, 16).max((1, 3)).ravel()
Z, X = np.mgrid[-8:8:2, -8:8:2].reshape(2, 64)
LOW, HIGH = np.stack((X, 0 * X, Z), 1), np.stack((X + 1.92, 6 * TOPS, Z + 1.92), 1)
CUBE = np.indices((2, 2, 2)).reshape(3, 8).T  # its corners, from (0, 0, 0) to (1, 1, 1)
CORNERS = np.insert(np.where(CUBE, HIGH[:, None], LOW[:, None]), 3, 1, 2)  # x, y, z, 1 of each box
FACES = np.array(((4, 6, 7, 5), (0, 1, 3, 2), (2, 3, 7, 6), (1, 5, 7, 3), (0, 2, 6, 4)))
SHADES = np.repeat((0.7, 0.55, 1, 0.85, 0.5), 4)[:, None]  # of their vertices
TINTS = np.array(((0.3, 0.5, 0.8), (0.5, 0.68, 0.35), (0.27, 0.5, 0.32), (0.95, 0.9, 0.8)))
TINTS = TINTS[np.digitize(TOPS, (0.121, 0.45, 0.6))]
mode, turn = 1, -10


def in_view(matrix, frustum):  # the matrix takes x, y, z, 1 of world space to clip space
    planes = np.concatenate((matrix[:, 3:] + matrix[:, :3], matrix[:, 3:] - matrix[:, :3]), 1)
    xyz, w = np.split(CORNERS @ matrix, (3,), 2)
    # For each box, corner and plane: a plane is a column a, b, c, d, and a x + b y + c z + d < 0.
    beyond = CORNERS @ planes < 0 if mode == 0 else np.concatenate((xyz < -w, xyz > w), 2)
    if mode == 3:
        return ~beyond.any(2).all(1)
    beside = ((frustum.max(0)[:3] < LOW) | (frustum.min(0)[:3] > HIGH)).any(1)
    return ~(beyond.all(1).any(1) | beside & (mode == 2))


def draw(corners, tints):
    glVertexPointer(4, GL_FLOAT, 0, np.float32(corners[:, FACES]))
    glColorPointer(3, GL_FLOAT, 0, np.float32(tints[:, None] * SHADES))
    glDrawArrays(GL_QUADS, 0, 20 * len(corners))


def on_key(window, key, scancode, action, mods):
    global mode, turn
    if action != glfw.RELEASE:
        mode = key - glfw.KEY_1 if key - glfw.KEY_1 in range(4) else mode
        turn += 10 * ((key == glfw.KEY_RIGHT) - (key == glfw.KEY_LEFT))
        glfw.set_window_should_close(window, key == glfw.KEY_ESCAPE)


def main():
    glfw.init()
    window = glfw.create_window(640, 480, _("Box and frustum"), None, None)
    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glEnable(GL_DEPTH_TEST)
    glEnableClientState(GL_VERTEX_ARRAY)
    glEnableClientState(GL_COLOR_ARRAY)
    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        wide = width / height / 2
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glFrustum(-wide / 2, wide / 2, -0.25, 0.25, 0.8, 10)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glRotatef(turn, 0, 1, 0)
        glTranslatef(0, -3, -2)
        matrix = glGetDoublev(GL_MODELVIEW_MATRIX) @ glGetDoublev(GL_PROJECTION_MATRIX)
        frustum = np.insert(2 * CUBE - 1, 3, 1, 1) @ np.linalg.inv(matrix)
        frustum /= frustum[:, 3:]
        seen = in_view(matrix, frustum)
        glViewport(0, 0, width, height)
        glClearColor(0.13, 0.16, 0.21, 1)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        glLoadIdentity()
        glTranslatef(2.4, -1, -28)
        glRotatef(50, 1, 0, 0)
        glRotatef(-50, 0, 1, 0)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glFrustum(-wide, wide, -0.5, 0.5, 1, 60)
        draw(CORNERS[seen], TINTS[seen])
        draw(CORNERS[~seen], 0 * TINTS[~seen] + 0.42)
        glPolygonMode(GL_FRONT_AND_BACK, GL_LINE)
        draw(frustum[None], np.array([(1.2, 0.8, 0.45)]))
        glPolygonMode(GL_FRONT_AND_BACK, GL_FILL)
        write(16, 40, LABELS[mode])
        write(16, 16, "{n} of {all} boxes drawn", n=seen.sum(), all=len(seen))
        corner = height // 30, height * 17 // 30, width * 2 // 5, height * 2 // 5
        glViewport(*corner)
        glScissor(*corner)
        glEnable(GL_SCISSOR_TEST)
        glClearColor(0.55, 0.68, 0.78, 1)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        glDisable(GL_SCISSOR_TEST)
        glLoadMatrixd(matrix)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        draw(CORNERS[seen], TINTS[seen])
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
