"""Shadow map: what the sun sees of an island of blocks

The sun draws the blocks first; a texture keeps their depths. Then the camera draws them, and what
is farther from the sun than the texture says has only the sky's light. Without the offset in the
sun's pass, faces cast stripes on themselves; planes given under the identity stick to the eye.

Keys: 1 to 4 each leave out one step: offset, comparison, planes, light of the sky; 5 restores all.
"""
# topic: voxels
# needs: hidden_faces, texture_units, caustics, planar_shadow
# picture: frame 100
# loop: 360 frames
# keys: 1 2 3 4

import sys

import glfw
import numpy as np
from OpenGL.GL import *
from text import _, write

AIR, GRASS, SAND, LOG, LEAVES, STONE = range(6)
COLORS = (
    (0, 0, 0),
    (120, 170, 70),
    (238, 212, 156),
    (130, 96, 66),
    (84, 140, 62),
    (214, 196, 176),
)
SIDE_SHADES = (0.9, 1, 0.8)  # how bright faces across x, y and z are painted
SQUARE = ((0, 0), (1, 0), (1, 1), (0, 1))
MIDDLE = (9.5, 3, 9.5)  # of the island, in blocks; the origin of all vertices
SKY = (0.4, 0.46, 0.6, 1)  # the light that remains in shadow
SIZE = 256  # of the sun's picture, in pixels

NO_OFFSET, NO_COMPARISON, UNDER_IDENTITY, BLACK_SHADOW, COMPLETE = range(5)
LABELS = "no offset", "no comparison", "planes under the identity", "GL_MODULATE", "sun and sky"
chosen = COMPLETE


def build_island():
    """Return the kind of block at each place, [x, y, z]: a hill with a beach, trees and a tower."""
    blocks = np.full((19, 16, 19), AIR)
    for x, z in np.ndindex(17, 17):
        top = 4 - 0.08 * ((x - 8) ** 2 + (z - 7) ** 2) + np.sin(x + 0.6 * z)
        blocks[x + 1, 1 : max(int(top), 0) + 2, z + 1] = GRASS if top >= 1 else SAND

    plant_tree(blocks, x=3, z=4, crown=5)
    plant_tree(blocks, x=15, z=4, crown=4)
    plant_tree(blocks, x=3, z=14, crown=4)
    plant_tree(blocks, x=15, z=15, crown=5)
    build_tower(blocks)
    return blocks


def plant_tree(blocks, x, z, crown):
    """Plant a tree whose lowest leaves are at the height ``crown``."""
    blocks[x, 2:crown, z] = LOG
    blocks[x - 1 : x + 2, crown : crown + 3, z - 1 : z + 2] = LEAVES


def build_tower(blocks):
    """Put a tower of stone with crenels into the middle of the island."""
    blocks[7:12, 1:11, 6:11] = STONE
    blocks[8:11, 9:11, 7:10] = AIR  # hollow at the top

    # Crenels: every second block of the uppermost ring is missing.
    blocks[[8, 10], 10, 6] = AIR
    blocks[[8, 10], 10, 10] = AIR
    blocks[7, 10, [7, 9]] = AIR
    blocks[11, 10, [7, 9]] = AIR


def make_mesh(blocks):
    """Return the vertices of all faces beside air: texture coordinates, normal and place."""
    vertices = []
    for axis, side in np.ndindex(3, 2):
        normal = np.roll((2 * side - 1, 0, 0), axis)
        corners = [np.roll((side, s, t), axis) - MIDDLE for s, t in SQUARE]
        beside = np.roll(blocks, 1 - 2 * side, axis)  # the neighbour of each block
        for place in np.argwhere((blocks != AIR) & (beside == AIR)):
            kind = blocks[tuple(place)]
            for (s, t), corner in zip(SQUARE, corners, strict=True):
                vertices.append(((kind + s) / 6, (axis + t) / 3, *normal, *(place + corner)))

    return np.array(vertices, np.float32)


def make_tiles():
    """Return the texture of the blocks, (24, 48, 3): a row of tiles per axis, a tile per kind."""
    grain = np.random.default_rng(2).uniform(0.88, 1.07, (3, 8, 6, 8))  # axis, t, kind, s
    tiles = np.reshape(SIDE_SHADES, (3, 1, 1, 1, 1)) * grain[..., np.newaxis]
    tiles = tiles * np.reshape(COLORS, (6, 1, 3))
    return np.uint8(tiles.reshape(24, 48, 3))


def make_textures():
    """Load the tiles into unit 1; leave a texture for the depths, still empty, in unit 0."""
    make_texture(GL_TEXTURE1, GL_NEAREST)
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 48, 24, 0, GL_RGB, GL_UNSIGNED_BYTE, make_tiles())
    make_texture(GL_TEXTURE0, GL_LINEAR)


def make_texture(unit, sampling):
    glActiveTexture(unit)
    glBindTexture(GL_TEXTURE_2D, glGenTextures(1))
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, sampling)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, sampling)


def set_combiner():
    """Let unit 0 mix the light of sun and sky with the sky's alone: the comparison is the weight.

    Unit 1 then multiplies by the tiles, as GL_MODULATE is its default.
    """
    glTexEnvi(GL_TEXTURE_ENV, GL_COMBINE_RGB, GL_INTERPOLATE)
    glTexEnvi(GL_TEXTURE_ENV, GL_SOURCE0_RGB, GL_PRIMARY_COLOR)  # sun and sky
    glTexEnvi(GL_TEXTURE_ENV, GL_SOURCE1_RGB, GL_CONSTANT)  # the sky
    glTexEnvi(GL_TEXTURE_ENV, GL_SOURCE2_RGB, GL_TEXTURE)  # 1 in the sun, 0 in shadow
    glTexEnvi(GL_TEXTURE_ENV, GL_OPERAND2_RGB, GL_SRC_COLOR)
    glTexEnvfv(GL_TEXTURE_ENV, GL_TEXTURE_ENV_COLOR, SKY)
    glLightModelfv(GL_LIGHT_MODEL_AMBIENT, SKY)


def load_identities():
    """Reset both matrices; the projection is current afterwards."""
    for mode in (GL_MODELVIEW, GL_PROJECTION):
        glMatrixMode(mode)
        glLoadIdentity()


def look_from_sun():
    """Set the matrix of the sun's picture, and return it (4, 4), with its rows as columns."""
    load_identities()
    glOrtho(-12, 12, -10, 10, -15, 15)
    glRotatef(40, 1, 0, 0)
    glRotatef(60 * glfw.get_time() + 30, 0, 1, 0)
    return glGetFloatv(GL_PROJECTION_MATRIX)


def draw_depths(count):
    """Draw what the sun sees into a corner of the window, and copy its depths to the texture."""
    glViewport(0, 0, SIZE, SIZE)
    glClear(GL_DEPTH_BUFFER_BIT)
    # Away from the sun, and the steeper a face is the further, so that no face shades itself.
    glPolygonOffset(*((0, 0) if chosen == NO_OFFSET else (3, 4)))
    glDrawArrays(GL_QUADS, 0, count)
    glPolygonOffset(0, 0)
    glCopyTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT, 0, 0, SIZE, SIZE, 0)


def look_from_camera(width, height):
    glViewport(0, 0, width, height)
    glLoadIdentity()
    glOrtho(-9.8 * width / height, 9.8 * width / height, -9.3, 10.3, -50, 50)
    glMatrixMode(GL_MODELVIEW)
    glRotatef(30, 1, 0, 0)
    glRotatef(25, 0, 1, 0)


def generate_coordinates(sun):
    """Let OpenGL compute where each vertex is in the sun's picture, and how deep: s, t and r.

    ``sun`` leads to -1 to 1; half of it, plus a half, to 0 to 1, as in a texture.
    """
    glPushMatrix()
    if chosen == UNDER_IDENTITY:
        glLoadIdentity()
    for row in range(3):
        glTexGeni(GL_S + row, GL_TEXTURE_GEN_MODE, GL_EYE_LINEAR)
        glEnable(GL_TEXTURE_GEN_S + row)
        glTexGenfv(GL_S + row, GL_EYE_PLANE, (sun[:, row] + sun[:, 3]) / 2)
    glPopMatrix()


def draw_lit(count):
    """Draw the blocks for the camera: what is deeper than the sun's picture says is in shadow."""
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
    compare = GL_NONE if chosen == NO_COMPARISON else GL_COMPARE_R_TO_TEXTURE
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, compare)
    combine = GL_MODULATE if chosen == BLACK_SHADOW else GL_COMBINE
    glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, combine)
    for unit in (GL_TEXTURE1, GL_TEXTURE0):
        glActiveTexture(unit)
        glEnable(GL_TEXTURE_2D)
    glDrawArrays(GL_QUADS, 0, count)


def on_key(window, key, scancode, action, mods):
    global chosen
    if glfw.KEY_1 <= key < glfw.KEY_1 + len(LABELS):
        chosen = key - glfw.KEY_1
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Shadow map"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    vertices = make_mesh(build_island())
    glClientActiveTexture(GL_TEXTURE1)
    glInterleavedArrays(GL_T2F_N3F_V3F, 0, vertices)
    make_textures()
    set_combiner()
    for cap in (GL_DEPTH_TEST, GL_LIGHTING, GL_LIGHT0, GL_COLOR_MATERIAL, GL_POLYGON_OFFSET_FILL):
        glEnable(cap)

    while not glfw.window_should_close(window):
        sun = look_from_sun()
        draw_depths(len(vertices))

        look_from_camera(*glfw.get_framebuffer_size(window))
        glLightfv(GL_LIGHT0, GL_POSITION, (*-sun[:3, 2], 0))  # where the sun's picture looks from
        glPushAttrib(GL_ENABLE_BIT)
        generate_coordinates(sun)
        draw_lit(len(vertices))
        glPopAttrib()

        write(16, 16, LABELS[chosen])
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
