"""Height columns: an island of cubes from an image

Of the pixels of a height image, 32 x 32 are picked; each becomes a column of cubes, as high as the
pixel is bright. A cube has 8 corners but 24 vertices: three faces meet in a corner, and each
brings its own normal. With one normal a corner, which 8 vertices would have to share, the light
runs over the edges, and the steps of the ground look like cushions.

Keys: Left and Right change the number of columns, Up and Down the relief; N shares the normals.
"""
# topic: voxels
# needs: height_field, vertex_arrays
# picture: frame 1
# keys: LEFT RIGHT UP DOWN N

import sys
from pathlib import Path

import glfw
import numpy as np
from OpenGL.GL import *
from PIL import Image
from text import _, write

IMAGE = Image.open(Path(__file__).parent / "data" / "heights.png")  # 129 x 129 pixels of 16 bits
SEA = 0.12  # the sea's height; 1 is the summit's
LEVELS = 0.12, 0.14, 0.2, 0.45, 0.65  # from these heights on, the next colour
TOPS = np.array(
    (
        (0.3, 0.5, 0.8),  # sea
        (0.95, 0.85, 0.62),  # sand
        (0.5, 0.68, 0.3),  # meadow
        (0.27, 0.48, 0.27),  # wood
        (0.55, 0.5, 0.47),  # rock
        (0.97, 0.97, 0.97),  # snow
    )
)
EARTH = (0.55, 0.38, 0.25)
ROCK = (0.45, 0.43, 0.43)
# The corners of the faces of the cube from (0, 0, 0) to (1, 1, 1), counter-clockwise from outside.
FACES = np.array(
    (
        ((1, 0, 0), (1, 1, 0), (1, 1, 1), (1, 0, 1)),
        ((0, 0, 0), (0, 0, 1), (0, 1, 1), (0, 1, 0)),
        ((0, 1, 0), (0, 1, 1), (1, 1, 1), (1, 1, 0)),
        ((0, 0, 0), (1, 0, 0), (1, 0, 1), (0, 0, 1)),
        ((0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)),
        ((0, 0, 0), (0, 1, 0), (1, 1, 0), (1, 0, 0)),
    )
)
NORMALS = np.array(((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)))
side = 32
relief = 0.7
shared = False


def make_columns():
    """Return the places of all cubes, x, y, z from 0, and their colours, (n, 3) each."""
    heights = np.asarray(IMAGE.resize((side, side), Image.Resampling.NEAREST)) / 65535
    levels = 1 + np.round(relief * np.maximum(heights, SEA) * side / 2).astype(int)

    # Which cubes of a box of side x levels x side are there: those below the height of the column.
    filled = np.arange(levels.max())[:, np.newaxis] < levels[:, np.newaxis, :]
    places = np.argwhere(filled)[:, ::-1]  # z, y, x become x, y, z

    x, y, z = places.T
    below = levels[z, x] - 1 - y  # how many cubes lie above it
    colors = TOPS[np.digitize(heights[z, x], LEVELS)]
    colors[below > 0] = EARTH
    colors[below > 2] = ROCK
    colors *= np.random.default_rng(3).uniform(0.9, 1, (len(places), 1))  # no two cubes alike
    return places, colors


def make_cubes():
    """Set the arrays of all cubes, and return how many; the island is 2 wide, a cube 2 / side."""
    places, colors = make_columns()
    vertices = (places[:, np.newaxis, np.newaxis] + FACES) * 2 / side - (1, 0, 1)  # cubes, 6, 4, 3
    corner_normals = 2 * FACES - 1  # from the middle of the cube to its corners
    normals = corner_normals if shared else NORMALS[:, np.newaxis]
    normals = np.broadcast_to(normals, vertices.shape)
    glVertexPointer(3, GL_FLOAT, 0, vertices.astype(np.float32))
    glNormalPointer(GL_FLOAT, 0, normals.astype(np.float32))
    glColorPointer(3, GL_FLOAT, 0, np.repeat(colors, 24, axis=0).astype(np.float32))
    return len(places)


def look(width, height):
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 10)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glTranslatef(0, -0.06, -4.8)
    glRotatef(35, 1, 0, 0)
    glRotatef(-30, 0, 1, 0)
    glLightfv(GL_LIGHT0, GL_POSITION, (0.3, 1, 0.8, 0))


def on_key(window, key, scancode, action, mods):
    global side, relief, shared
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_LEFT:
        side = max(8, side - 8)
    elif key == glfw.KEY_RIGHT:
        side = min(56, side + 8)
    elif key == glfw.KEY_UP:
        relief = min(1, relief + 0.1)
    elif key == glfw.KEY_DOWN:
        relief = max(0, relief - 0.1)
    elif key == glfw.KEY_N:
        shared = not shared
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Height columns"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    for name in (GL_DEPTH_TEST, GL_LIGHTING, GL_LIGHT0, GL_COLOR_MATERIAL, GL_NORMALIZE):
        glEnable(name)
    for array in (GL_VERTEX_ARRAY, GL_NORMAL_ARRAY, GL_COLOR_ARRAY):
        glEnableClientState(array)
    built = None

    while not glfw.window_should_close(window):
        if built != (side, relief, shared):  # only when something has changed
            built = side, relief, shared
            cubes = make_cubes()

        look(*glfw.get_framebuffer_size(window))
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        glDrawArrays(GL_QUADS, 0, 24 * cubes)
        write(16, 40, "normals: one a corner" if shared else "normals: one a face")
        write(16, 16, "{side} × {side} columns, {cubes} cubes", side=side, cubes=cubes)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
