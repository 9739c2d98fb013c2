"""Fresnel by a cube map: water that reflects and refracts

The scene is drawn into two textures: mirrored at the water, and as it is seen through the water.
GL_INTERPOLATE mixes them by the alpha of a cube map, which holds for each direction how much the
water reflects: 2 % straight down, all when grazing. Its coordinates are the vertex minus the eye;
without the eye, they begin in the middle of the scene.

Keys: 1 to 5 choose: the reflection, the refraction, the alpha, the mix without the eye, the mix.
"""
# topic: voxels
# needs: mirror, water, cube_map, texture_units, projective_texture
# picture: frame 60
# loop: 360 frames
# keys: 1 2 3 4

import glfw
import numpy as np
from OpenGL.GL import *
from text import _, write

LABELS = "reflection", "refraction", "alpha", "mix without the eye", "mix"
COLORS = np.array(((0, 0, 0), (235, 212, 158), (124, 172, 78), (214, 98, 62), (250,) * 3)) / 255
SHADES = ((0.62, 0.85), (0.72, 1), (0.75, 0.7))
WATER = np.array((0.8, 0.93, 0.95))
SEA = 7
SQUARE = ((0, 0), (1, 0), (1, 1), (0, 1))
DEEP = (0.05, 0.28, 0.36, 1)
SKY = (0.62, 0.79, 0.92, 1)
UNITS = {GL_TEXTURE0: GL_TEXTURE_2D, GL_TEXTURE1: GL_TEXTURE_2D, GL_TEXTURE2: GL_TEXTURE_CUBE_MAP}
SOURCES = GL_TEXTURE0, GL_TEXTURE1, GL_TEXTURE2, GL_TEXTURE0, GL_TEXTURE0
PASSES = (GL_TEXTURE0, -1, 1, SKY), (GL_TEXTURE1, 0.75, -1, DEEP), (0, 1, 1, SKY)
blocks, chosen = np.zeros((34, 22, 34), int), 4  # blocks: the color of each, 0 is air
for x, z in np.ndindex(32, 32):
    wave = np.sin(0.42 * x + 0.3) * np.cos(0.36 * z) + 0.5 * np.sin(0.8 * z + 0.5 * x)
    top = int(np.clip(5.5 + 3.8 * wave - 0.012 * ((x - 16) ** 2 + (z - 16) ** 2), 1, 20))
    blocks[x + 1, 1:top, z + 1], blocks[x + 1, top, z + 1] = 1, 2 if top > SEA else 1
blocks[17:20, 1:15, 12:15], blocks[17:20, 8:15:2, 12:15] = 4, 3  # a lighthouse
vertices = []  # color and place of each; the last four are the water's
for axis, side in np.ndindex(3, 2):
    corners = [np.roll((side, s, t), axis) - (17, 7.8, 17) for s, t in SQUARE]
    for place in np.argwhere((blocks > 0) & (np.roll(blocks, 1 - 2 * side, axis) == 0)):
        color = COLORS[blocks[tuple(place)]] * SHADES[axis][side] * WATER ** max(SEA - place[1], 0)
        vertices += [(*color, *(place + corner)) for corner in corners]
vertices += [(1, 1, 1, 16000 * s - 8000, 0, 16000 * t - 8000) for s, t in SQUARE]


def on_key(window, key, scancode, action, mods):
    global chosen
    chosen = key - glfw.KEY_1 if key - glfw.KEY_1 in range(5) else chosen
    glfw.set_window_should_close(window, key == glfw.KEY_ESCAPE)


def main():
    glfw.init()
    window = glfw.create_window(640, 480, _("Fresnel by a cube map"), None, None)
    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    assert glGetIntegerv(GL_MAX_TEXTURE_UNITS) > 2, "this lesson needs three texture units"
    glInterleavedArrays(GL_C3F_V3F, 0, np.array(vertices, np.float32))
    glEnable(GL_DEPTH_TEST)
    for unit, target in UNITS.items():
        glActiveTexture(unit)
        glBindTexture(target, glGenTextures(1))
        glTexParameteri(target, GL_TEXTURE_MIN_FILTER, GL_LINEAR)
        for name in (GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T):
            glTexParameteri(target, name, GL_CLAMP_TO_EDGE)

    t, s = np.mgrid[-1:1:512j, -1:1:512j]
    for face in range(6):  # by Schlick's formula
        cosine = np.abs(1 if face in (2, 3) else t) / np.sqrt(1 + s * s + t * t)
        data = GL_ALPHA, GL_UNSIGNED_BYTE, np.uint8(5 + 250 * (1 - cosine) ** 5)
        glTexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + face, 0, GL_ALPHA8, 512, 512, 0, *data)

    glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_COMBINE)
    glTexEnvi(GL_TEXTURE_ENV, GL_SOURCE1_RGB, GL_TEXTURE1)
    glTexEnvi(GL_TEXTURE_ENV, GL_SOURCE2_RGB, GL_TEXTURE2)  # its alpha is how much of source 0
    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        for mode in (GL_MODELVIEW, GL_PROJECTION):
            glMatrixMode(mode)
            glLoadIdentity()
        glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 0.7, 12000)
        glMatrixMode(GL_MODELVIEW)
        glTranslatef(0, -1.8, -27)
        glRotatef(11, 1, 0, 0)
        glRotatef(20 * np.sin(np.pi / 3 * glfw.get_time()), 0, 1, 0)
        for unit, scale, side, color in PASSES:
            size = [2 ** int(np.log2(n)) if unit else n for n in (width, height)]
            glViewport(0, 0, *size)
            glClearColor(*color)
            glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
            glScalef(1, scale, 1)
            glClipPlane(GL_CLIP_PLANE0, (0, side, 0, 0))
            glEnable(GL_CLIP_PLANE0)
            glDrawArrays(GL_QUADS, 0, len(vertices) - 4)
            glDisable(GL_CLIP_PLANE0)
            glScalef(1, 1 / scale, 1)
            if unit:
                glActiveTexture(unit)
                glCopyTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 0, 0, *size, 0)
        camera, from_eye = glGetFloatv(GL_MODELVIEW_MATRIX), np.eye(4)
        from_eye[:3, 3] = -np.linalg.inv(camera)[3, :3] * (chosen != 3)
        seen = (camera @ glGetFloatv(GL_PROJECTION_MATRIX)).T
        glPushAttrib(GL_ENABLE_BIT)
        for unit, planes in zip(UNITS, ((seen + seen[3]) / 2,) * 2 + (from_eye,), strict=True):
            glActiveTexture(unit)
            glEnable(UNITS[unit])
            for row in range(4):
                glTexGeni(GL_S + row, GL_TEXTURE_GEN_MODE, GL_OBJECT_LINEAR)
                glTexGenfv(GL_S + row, GL_OBJECT_PLANE, planes[row])
                glEnable(GL_TEXTURE_GEN_S + row)
        glTexEnvi(GL_TEXTURE_ENV, GL_COMBINE_RGB, GL_REPLACE if chosen < 3 else GL_INTERPOLATE)
        glTexEnvi(GL_TEXTURE_ENV, GL_SOURCE0_RGB, SOURCES[chosen])
        glTexEnvi(GL_TEXTURE_ENV, GL_OPERAND0_RGB, GL_SRC_ALPHA if chosen == 2 else GL_SRC_COLOR)
        glDrawArrays(GL_QUADS, len(vertices) - 4, 4)
        glActiveTexture(GL_TEXTURE0)
        glPopAttrib()
        write(16, 16, LABELS[chosen])
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
