"""Shadow map: what the sun sees of an island of blocks

The sun draws the blocks first; a texture keeps their depths. Then the camera draws them, and what
is farther from the sun than the texture says has only the sky's light. Without the offset in the
sun's pass, faces cast stripes on themselves; planes given under the identity stick to the eye.

Keys: 1 to 4 leave out the offset, the comparison, the planes, the light of the sky; 5 nothing.
"""
# topic: voxels
# needs: hidden_faces, texture_units, caustics, planar_shadow
# picture: frame 100
# loop: 360 frames
# keys: 1 2 3 4

import glfw
import numpy as np
from OpenGL.GL import *
from text import _, write

AIR, GRASS, SAND, LOG, LEAVES, STONE = range(6)
COLORS = ((0,) * 3, (120, 170, 70), (238, 212, 156), (130, 96, 66), (84, 140, 62), (214, 196, 176))
LABELS = "no offset", "no comparison", "planes under the identity", "GL_MODULATE", "sun and sky"
SKY, SQUARE = (0.4, 0.46, 0.6, 1), ((0, 0), (1, 0), (1, 1), (0, 1))
blocks, chosen = np.zeros((19, 16, 19), int), 4  # blocks: what is in each place
for x, z in np.ndindex(17, 17):
    top = 4 - 0.08 * ((x - 8) ** 2 + (z - 7) ** 2) + np.sin(x + 0.6 * z)
    blocks[x + 1, 1 : max(int(top), 0) + 2, z + 1] = GRASS if top >= 1 else SAND
for x, z, y in (3, 4, 5), (15, 4, 4), (3, 14, 4), (15, 15, 5):  # y: of the lowest leaves
    blocks[x, 2:y, z] = LOG
    blocks[x - 1 : x + 2, y : y + 3, z - 1 : z + 2] = LEAVES
blocks[7:12, 1:11, 6:11] = STONE
blocks[8:11, 9:11, 7:10] = blocks[8:12:2, 10, 6:11:4] = blocks[7:12:4, 10, 7:11:2] = AIR
vertices = []  # texture coordinates, normal and place of each
for axis, side in np.ndindex(3, 2):
    normal = np.roll((2 * side - 1, 0, 0), axis)
    corners = [np.roll((side, s, t), axis) - (9.5, 3, 9.5) for s, t in SQUARE]
    face = np.c_[[(s / 6, (axis + t) / 3, *normal) for s, t in SQUARE], corners]
    for place in np.argwhere((blocks > 0) & (np.roll(blocks, 1 - 2 * side, axis) == AIR)):
        vertices += [*(face + (blocks[tuple(place)] / 6, 0, 0, 0, 0, *place))]


def on_key(window, key, scancode, action, mods):
    global chosen
    chosen = key - glfw.KEY_1 if key - glfw.KEY_1 in range(5) else chosen
    glfw.set_window_should_close(window, key == glfw.KEY_ESCAPE)


def main():
    glfw.init()
    window = glfw.create_window(640, 480, _("Shadow map"), None, None)
    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    glClientActiveTexture(GL_TEXTURE1)
    glInterleavedArrays(GL_T2F_N3F_V3F, 0, np.array(vertices, np.float32))
    shades, grain = (0.9, 1, 0.8), np.random.default_rng(2).uniform(0.88, 1.07, (3, 8, 6, 8))
    tiles = np.einsum("a,atis,ic->atisc", shades, grain, COLORS)  # by axis, t, tile, s and color
    for unit, sampling in ((GL_TEXTURE1, GL_NEAREST), (GL_TEXTURE0, GL_LINEAR)):
        glActiveTexture(unit)
        glBindTexture(GL_TEXTURE_2D, glGenTextures(1))
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, sampling)
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, sampling)
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 48, 24, 0, GL_RGB, GL_UNSIGNED_BYTE, np.uint8(tiles))

    glTexEnvi(GL_TEXTURE_ENV, GL_COMBINE_RGB, GL_INTERPOLATE)  # of sun and sky with sky alone
    for number, source in enumerate((GL_PRIMARY_COLOR, GL_CONSTANT, GL_TEXTURE)):
        glTexEnvi(GL_TEXTURE_ENV, GL_SOURCE0_RGB + number, source)
    glTexEnvi(GL_TEXTURE_ENV, GL_OPERAND2_RGB, GL_SRC_COLOR)
    glTexEnvfv(GL_TEXTURE_ENV, GL_TEXTURE_ENV_COLOR, SKY)
    glLightModelfv(GL_LIGHT_MODEL_AMBIENT, SKY)
    for cap in (GL_DEPTH_TEST, GL_LIGHTING, GL_LIGHT0, GL_COLOR_MATERIAL, GL_POLYGON_OFFSET_FILL):
        glEnable(cap)
    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        for mode in (GL_MODELVIEW, GL_PROJECTION):
            glMatrixMode(mode)
            glLoadIdentity()
        glOrtho(-12, 12, -10, 10, -15, 15)
        glRotatef(40, 1, 0, 0)
        glRotatef(60 * glfw.get_time() + 30, 0, 1, 0)
        sun = glGetFloatv(GL_PROJECTION_MATRIX)  # its columns are the rows of the matrix
        glViewport(0, 0, 256, 256)
        glClear(GL_DEPTH_BUFFER_BIT)
        glPolygonOffset(*((0, 0) if chosen == 0 else (3, 4)))
        glDrawArrays(GL_QUADS, 0, len(vertices))
        glPolygonOffset(0, 0)
        glCopyTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT, 0, 0, 256, 256, 0)
        glViewport(0, 0, width, height)
        glLoadIdentity()
        glOrtho(-9.8 * width / height, 9.8 * width / height, -9.3, 10.3, -50, 50)
        glMatrixMode(GL_MODELVIEW)
        glRotatef(30, 1, 0, 0)
        glRotatef(25, 0, 1, 0)
        glLightfv(GL_LIGHT0, GL_POSITION, (*-sun[:3, 2], 0))
        glPushAttrib(GL_ENABLE_BIT)
        glPushMatrix()
        if chosen == 2:
            glLoadIdentity()
        for row in range(3):  # of the matrix that leads to the sun's picture, from 0 to 1
            glTexGeni(GL_S + row, GL_TEXTURE_GEN_MODE, GL_EYE_LINEAR)
            glEnable(GL_TEXTURE_GEN_S + row)
            glTexGenfv(GL_S + row, GL_EYE_PLANE, (sun[:, row] + sun[:, 3]) / 2)
        glPopMatrix()
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        compare = GL_NONE if chosen == 1 else GL_COMPARE_R_TO_TEXTURE
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, compare)
        glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_MODULATE if chosen == 3 else GL_COMBINE)
        for unit in (GL_TEXTURE1, GL_TEXTURE0):
            glActiveTexture(unit)
            glEnable(GL_TEXTURE_2D)
        glDrawArrays(GL_QUADS, 0, len(vertices))
        glPopAttrib()
        write(16, 16, LABELS[chosen])
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
