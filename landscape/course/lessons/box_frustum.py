"""Box and frustum: which regions of a terrain need not be drawn

A box is out of view if all its eight corners are beyond the same plane of the frustum. In world
space the planes come from the matrix; in clip space they are -w < x < w, and so for y and z. A test
the other way round finds more boxes: those that have all corners of the frustum on one side. To
draw only boxes with a corner in view is wrong: what is close and large is left out.

Keys: 1 world space, 2 clip space, 3 both ways round, 4 a corner in view; Left and Right turn.
"""
# topic: voxels
# needs: height_columns, perspective, second_viewport
# picture: frame 1
# keys: 1 3 4 LEFT RIGHT

import sys
from pathlib import Path

import glfw
import numpy as np
from OpenGL.GL import *
from PIL import Image
from text import _, write

CUBE = np.indices((2, 2, 2)).reshape(3, 8).T  # its corners, from (0, 0, 0) to (1, 1, 1)
FACES = np.array(((4, 6, 7, 5), (0, 1, 3, 2), (2, 3, 7, 6), (1, 5, 7, 3), (0, 2, 6, 4)))
SHADES = np.repeat((0.7, 0.55, 1, 0.85, 0.5), 4)[:, np.newaxis]  # of the faces' vertices
SEA, GRASS, FOREST, SNOW = (0.3, 0.5, 0.8), (0.5, 0.68, 0.35), (0.27, 0.5, 0.32), (0.95, 0.9, 0.8)
GREY = (0.42, 0.42, 0.42)
ORANGE = (1.2, 0.8, 0.45)

WORLD_SPACE, CLIP_SPACE, BOTH_WAYS, CORNER_IN_VIEW = range(4)
LABELS = "planes in world space", "corners in clip space", "both ways round", "a corner in view"
mode = CLIP_SPACE
turn = -10


def region_heights():
    """Return the height of the highest pixel in each of 8 x 8 regions of 16 x 16 pixels, (64,)."""
    image = Image.open(Path(__file__).parent / "data" / "heights.png").crop((0, 0, 128, 128))
    heights = np.maximum(0.12, np.asarray(image) / 65535)
    return heights.reshape(8, 16, 8, 16).max((1, 3)).ravel()


TOPS = region_heights()
Z, X = np.mgrid[-8:8:2, -8:8:2].reshape(2, 64)
LOW = np.stack((X, 0 * X, Z), 1)
HIGH = np.stack((X + 1.92, 6 * TOPS, Z + 1.92), 1)
TINTS = np.array((SEA, GRASS, FOREST, SNOW))[np.digitize(TOPS, (0.121, 0.45, 0.6))]


def with_w(points):
    """Return homogeneous points: x, y, z and 1."""
    return np.concatenate((points, np.ones((*points.shape[:-1], 1))), -1)


CORNERS = with_w(np.where(CUBE, HIGH[:, np.newaxis], LOW[:, np.newaxis]))  # of each box, (64, 8, 4)


def beyond_in_world_space(matrix):
    """Return for each box, corner and plane of the frustum whether the corner is beyond it.

    A plane is a column a, b, c, d of ``planes``, and what is beyond it has a x + b y + c z + d < 0.
    """
    xyz = matrix[:, :3]
    w = matrix[:, 3:]
    planes = np.concatenate((w + xyz, w - xyz), 1)
    return CORNERS @ planes < 0


def beyond_in_clip_space(matrix):
    """Return the same: in clip space, a point is in view if -w < x < w, and so for y and z."""
    clip = CORNERS @ matrix
    xyz = clip[..., :3]
    w = clip[..., 3:]
    return np.concatenate((xyz < -w, xyz > w), 2)


def beside_frustum(frustum):
    """Return for each box whether the frustum, all corners (8, 4), lies beyond one of its sides."""
    lowest = frustum.min(0)[:3]
    highest = frustum.max(0)[:3]
    return ((highest < LOW) | (lowest > HIGH)).any(1)


def in_view(matrix, frustum):
    """Return which boxes are drawn; the matrix takes world space to clip space."""
    if mode == WORLD_SPACE:
        beyond = beyond_in_world_space(matrix)
    else:
        beyond = beyond_in_clip_space(matrix)
    if mode == CORNER_IN_VIEW:
        corner_in_view = ~beyond.any(2)
        return corner_in_view.any(1)

    out_of_view = beyond.all(1).any(1)  # all corners, beyond any plane
    if mode == BOTH_WAYS:
        out_of_view |= beside_frustum(frustum)
    return ~out_of_view


def draw(corners, tints):
    """Draw boxes by their corners (n, 8, 4), each in a tint."""
    glVertexPointer(4, GL_FLOAT, 0, np.float32(corners[:, FACES]))
    glColorPointer(3, GL_FLOAT, 0, np.float32(tints[:, np.newaxis] * SHADES))
    glDrawArrays(GL_QUADS, 0, 20 * len(corners))


def viewer_matrix(wide):
    """Return the matrix of the viewer in the middle, from world space to clip space."""
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glFrustum(-wide / 2, wide / 2, -0.25, 0.25, 0.8, 10)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glRotatef(turn, 0, 1, 0)
    glTranslatef(0, -3, -2)
    return glGetDoublev(GL_MODELVIEW_MATRIX) @ glGetDoublev(GL_PROJECTION_MATRIX)


def frustum_corners(matrix):
    """Return the corners of the frustum in world space, (8, 4): of a cube in clip space."""
    corners = with_w(2 * CUBE - 1) @ np.linalg.inv(matrix)
    return corners / corners[:, 3:]


def draw_overview(width, height, seen, frustum):
    """Draw all boxes from outside, those that are not seen in grey, and the frustum."""
    glViewport(0, 0, width, height)
    glClearColor(0.13, 0.16, 0.21, 1)
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
    glLoadIdentity()
    glTranslatef(2.4, -1, -28)
    glRotatef(50, 1, 0, 0)
    glRotatef(-50, 0, 1, 0)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    wide = width / height / 2
    glFrustum(-wide, wide, -0.5, 0.5, 1, 60)
    draw(CORNERS[seen], TINTS[seen])
    draw(CORNERS[~seen], np.full((np.sum(~seen), 3), GREY))

    glPolygonMode(GL_FRONT_AND_BACK, GL_LINE)
    draw(frustum[np.newaxis], np.array([ORANGE]))
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL)


def draw_view(width, height, seen, matrix):
    """Draw what the viewer sees, in the corner."""
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


def on_key(window, key, scancode, action, mods):
    global mode, turn
    if action == glfw.RELEASE:
        return
    if glfw.KEY_1 <= key < glfw.KEY_1 + len(LABELS):
        mode = key - glfw.KEY_1
    elif key == glfw.KEY_LEFT:
        turn -= 10
    elif key == glfw.KEY_RIGHT:
        turn += 10
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Box and frustum"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glEnable(GL_DEPTH_TEST)
    glEnableClientState(GL_VERTEX_ARRAY)
    glEnableClientState(GL_COLOR_ARRAY)

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        matrix = viewer_matrix(width / height / 2)
        frustum = frustum_corners(matrix)
        seen = in_view(matrix, frustum)

        draw_overview(width, height, seen, frustum)
        write(16, 40, LABELS[mode])
        write(16, 16, "{n} of {all} boxes drawn", n=seen.sum(), all=len(seen))
        draw_view(width, height, seen, matrix)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
