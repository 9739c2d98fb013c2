"""Height field: a terrain from an image

Every pixel of heights.png is a height, and a vertex of a square grid. Two rows of the grid make
one triangle strip, drawn by indices from vertex arrays. The normal of a vertex comes from the
heights of its neighbours, its colour from its own height. With all normals upright, the light
falls evenly on every slope, and valleys and ridges disappear.

Keys: Left and Right change the resolution; Space shows the triangles; N sets all normals upright.
"""
# topic: landscape
# needs: vertex_arrays, display_list, normals, light_model
# picture: frame 30
# loop: 240 frames
# keys: LEFT RIGHT SPACE N

import sys
from pathlib import Path

import glfw
import numpy as np
from OpenGL.GL import *
from PIL import Image
from text import _, write

IMAGE = Image.open(Path(__file__).parent / "data" / "heights.png")
HEIGHTS = np.asarray(IMAGE) / 65535  # 129 x 129 pixels of 16 bits, now 0 to 1
SEA = 0.12  # the sea's height in the image
RELIEF = 0.7  # the height of 1 above the grid
COLOR_MAP = np.array(
    (  # height, red, green, blue
        (0, 0.14, 0.34, 0.55),  # deep sea
        (0.11, 0.25, 0.6, 0.6),  # shallows
        (0.13, 0.95, 0.85, 0.62),  # sand
        (0.18, 0.5, 0.65, 0.3),  # meadow
        (0.35, 0.24, 0.42, 0.24),  # wood
        (0.55, 0.5, 0.44, 0.4),  # rock
        (0.8, 0.97, 0.97, 0.97),  # snow
    )
)
step = 2  # every second pixel
upright = False
wireframe = False
terrain = 0  # the display list


def make_terrain():
    """Compile the terrain, from -1 to 1 in x and z, into a display list."""
    global terrain
    samples = HEIGHTS[::step, ::step]
    along = np.linspace(-1, 1, len(samples))
    x, z = np.meshgrid(along, along)
    y = RELIEF * np.maximum(samples, SEA)
    vertices = np.stack((x, y, z), axis=2)

    # The slopes of y are the differences between the neighbours on both sides, by their distance.
    slope_z, slope_x = np.gradient(0 * y if upright else y, along, along)
    normals = np.stack((-slope_x, np.ones_like(y), -slope_z), axis=2)
    normals /= np.linalg.norm(normals, axis=2, keepdims=True)

    levels = COLOR_MAP[:, 0]
    colors = np.stack([np.interp(samples, levels, COLOR_MAP[:, n]) for n in (1, 2, 3)], axis=2)

    # Vertex 0 is the first of the first row. A strip zigzags between one row and the next.
    numbers = np.arange(y.size, dtype=np.uint32).reshape(y.shape)
    strips = np.stack((numbers[:-1], numbers[1:]), axis=2)

    glVertexPointer(3, GL_FLOAT, 0, vertices.astype(np.float32))
    glNormalPointer(GL_FLOAT, 0, normals.astype(np.float32))
    glColorPointer(3, GL_FLOAT, 0, colors.astype(np.float32))
    terrain = terrain or glGenLists(1)
    glNewList(terrain, GL_COMPILE)
    for strip in strips:
        glDrawElements(GL_TRIANGLE_STRIP, strip.size, GL_UNSIGNED_INT, strip)
    glEndList()


def look(width, height):
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 10)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glTranslatef(0, 0, -4.6)
    glRotatef(35, 1, 0, 0)
    glRotatef(6 * glfw.get_time() - 20, 0, 1, 0)
    glLightfv(GL_LIGHT0, GL_POSITION, (-1, 0.8, 0.3, 0))


def on_key(window, key, scancode, action, mods):
    global step, upright, wireframe
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_LEFT:
        step = min(32, step * 2)
    if key == glfw.KEY_RIGHT:
        step = max(1, step // 2)
    if key == glfw.KEY_N:
        upright = not upright
    if key == glfw.KEY_SPACE:
        wireframe = not wireframe
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)
    make_terrain()


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Height field"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    for capability in (GL_DEPTH_TEST, GL_LIGHTING, GL_LIGHT0, GL_COLOR_MATERIAL):
        glEnable(capability)
    for array in (GL_VERTEX_ARRAY, GL_NORMAL_ARRAY, GL_COLOR_ARRAY):
        glEnableClientState(array)
    make_terrain()

    while not glfw.window_should_close(window):
        look(*glfw.get_framebuffer_size(window))
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        glPolygonMode(GL_FRONT_AND_BACK, GL_LINE if wireframe else GL_FILL)
        glCallList(terrain)
        side = len(HEIGHTS[::step])

        write(16, 16, "{side} × {side} vertices", side=side)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
