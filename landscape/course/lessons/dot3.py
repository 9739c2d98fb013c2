"""Bump mapping by DOT3: a fossil that is a picture of normals

The slab is flat. Each texel of its texture is a normal, stored as a colour; the colour of each
vertex is the direction to the lamp. GL_DOT3_RGB multiplies the two at each pixel, as light on ribs
and grooves. A colour holds 0 to 1, a direction -1 to 1: one that is not moved there loses its
negative half, and one that is interpolated between far vertices becomes too short.

Keys: 1 to 5 choose: normals, directions, directions not moved, only four vertices, the light.
"""
# topic: voxels
# needs: texture_units, normals, gouraud, vertex_arrays
# picture: frame 40
# loop: 360 frames
# keys: 1 2 3 4

import sys

import glfw
import numpy as np
from OpenGL.GL import *
from text import _, write

# The slab: its rows, from -1 to 1, and its columns.
HIGH = np.linspace(-1, 1, 512)
WIDE = np.linspace(-1.3, 1.3, 512)
PLANE_S = (1 / 2.6, 0, 0, 0.5)
PLANE_T = (0, 0.5, 0, 0.5)
SHELL = (250, 214, 160)
ROCK = (190, 196, 206)

NORMALS, DIRECTIONS, NOT_MOVED, FOUR_VERTICES, LIGHT = range(5)
LABELS = "normals", "directions", "directions not moved", "four vertices", "GL_DOT3_RGB"
chosen = LIGHT


def make_relief():
    """Return the heights of an ammonite in cut rock, and where its shell is, (512, 512) each."""
    y, x = np.meshgrid(HIGH, WIDE, indexing="ij")
    radius = np.hypot(x + 0.1, y)
    angle = np.arctan2(y, x + 0.1)

    # A logarithmic spiral: the whorl is 1 more at each turn; ``across`` is -1 to 1 over a whorl.
    whorl = np.log(radius + 1e-6) / 0.65 + angle / 2 / np.pi + 0.7
    is_shell = whorl < 0
    across = 2 * (whorl % 1) - 1
    ribs = 0.11 * np.sin(42 * angle + 2.5 * across**2)
    shell = radius * (0.1 + 0.22 * np.sqrt(1 - across**2) * (1 + ribs))

    # The rock around it is cut into squares, and rough.
    joints = np.minimum(abs((x * 2.5 + 0.5) % 1 - 0.5), abs((y * 2.5 + 0.5) % 1 - 0.5))
    rock = 0.02 * np.clip(joints * 14, 0, 1)
    rock += 0.002 * np.random.default_rng(1).normal(size=x.shape)
    return np.where(is_shell, shell, rock), is_shell


def make_images():
    """Return the colours of the normals and of the stone, each uint8 (512, 512, 3)."""
    heights, is_shell = make_relief()
    along_y, along_x = np.gradient(heights, HIGH, WIDE)
    normals = np.stack((-along_x, -along_y, np.ones_like(heights)), -1)
    normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
    stone = np.where(is_shell[..., np.newaxis], SHELL, ROCK)
    return np.uint8(127.5 + 127.5 * normals), np.uint8(stone)


def make_texture(unit, image):
    glActiveTexture(unit)
    glBindTexture(GL_TEXTURE_2D, glGenTextures(1))
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR)
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 512, 512, 0, GL_RGB, GL_UNSIGNED_BYTE, image)
    for coordinate, plane in ((GL_S, PLANE_S), (GL_T, PLANE_T)):
        glTexGeni(coordinate, GL_TEXTURE_GEN_MODE, GL_OBJECT_LINEAR)
        glTexGenfv(coordinate, GL_OBJECT_PLANE, plane)


def make_grid(cells):
    """Return the corners of the cells of a grid over the slab, four for each."""
    corners = ((0, 0), (1, 0), (1, 1), (0, 1))
    places = [(i + s, j + t) for i, j in np.ndindex(cells, cells) for s, t in corners]
    return np.array([(2.6 * s / cells - 1.3, 2 * t / cells - 1, 0) for s, t in places])


def look(width, height):
    glViewport(0, 0, width, height)
    for mode in (GL_MODELVIEW, GL_PROJECTION):
        glMatrixMode(mode)
        glLoadIdentity()
    glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 60)
    glMatrixMode(GL_MODELVIEW)
    glTranslatef(0, 0.1, -4.5)
    glRotatef(-16, 1, 0, 0)


def direction_colors(places, lamp):
    """Return for each place the direction to the lamp, as a colour."""
    toward = lamp - places
    far = np.linalg.norm(toward, axis=1, keepdims=True)
    toward /= far * np.maximum(0.7 + far * far / 4, 1)  # shorter where it is far: less light
    if chosen == NOT_MOVED:
        return toward
    return 0.5 + toward / 2  # from -1 to 1 becomes 0 to 1


def draw_slab(places, lamp):
    vertices = np.hstack((direction_colors(places, lamp), places)).astype(np.float32)
    glInterleavedArrays(GL_C3F_V3F, 0, vertices)
    glPushAttrib(GL_ENABLE_BIT)

    # Unit 0 has the normals, and unit 1 multiplies by the colours of the stone.
    if chosen not in (NORMALS, DIRECTIONS):
        enable_unit(GL_TEXTURE1)
    enable_unit(GL_TEXTURE0)
    mode = GL_REPLACE if chosen == NORMALS else GL_COMBINE
    glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, mode)
    glDrawArrays(GL_QUADS, 0, len(vertices))
    glPopAttrib()


def enable_unit(unit):
    glActiveTexture(unit)
    glEnable(GL_TEXTURE_GEN_S)
    glEnable(GL_TEXTURE_GEN_T)
    if chosen != DIRECTIONS:  # only the vertices' colours are shown
        glEnable(GL_TEXTURE_2D)


def draw_lamp(lamp, height):
    glPointSize(12 * height / 480)
    glColor3f(1, 0.9, 0.6)
    glBegin(GL_POINTS)
    glVertex3f(*lamp)
    glEnd()


def on_key(window, key, scancode, action, mods):
    global chosen
    if glfw.KEY_1 <= key < glfw.KEY_1 + len(LABELS):
        chosen = key - glfw.KEY_1
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Bump mapping by DOT3"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    normals, stone = make_images()
    make_texture(GL_TEXTURE1, stone)
    make_texture(GL_TEXTURE0, normals)
    glTexEnvi(GL_TEXTURE_ENV, GL_COMBINE_RGB, GL_DOT3_RGB)
    fine_grid = make_grid(24)
    coarse_grid = make_grid(1)

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        look(width, height)
        glClear(GL_COLOR_BUFFER_BIT)
        turn = np.pi / 3 * glfw.get_time()
        lamp = 0.95 * np.cos(turn), 0.7 * np.sin(turn), 0.5
        draw_slab(coarse_grid if chosen == FOUR_VERTICES else fine_grid, lamp)
        draw_lamp(lamp, height)
        write(16, 16, LABELS[chosen])
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
