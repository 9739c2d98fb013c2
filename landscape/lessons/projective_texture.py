"""Projective texture: a slide projector in a room of blocks

The projector is a second camera: its matrix leads from each point to a place on the slide, and the
planes of the texture coordinates are its rows. The division by q makes a second picture, upside
down, on what is behind the projector; the clip plane w = 0 takes it away. With q = 1 nothing is
divided; without a border, slides stand side by side.

Keys: 1 leaves out the clip plane, 2 sets q to 1, 3 leaves out the border, 4 leaves out nothing.
"""
# topic: voxels
# needs: hidden_faces, perspective, clip_plane, blending, shadow_map
# picture: frame 80
# loop: 360 frames
# keys: 1 2 3

import glfw
import numpy as np
from OpenGL.GL import *
from text import _, write

LABELS = "no clip plane", "q = 1", "GL_REPEAT", "one slide"
CORNERS = (0, 0), (1, 0), (1, 1), (0, 1)
PANES = (255, 205, 75), (225, 55, 45), (50, 110, 230), (255, 155, 45), (45, 165, 130)
PLACE = np.array((7.5, 6.5, 7.5))  # of the projector, the origin of all vertices
COLORS = ((0, 0, 0), (0.8, 0.77, 0.74), (0.62, 0.45, 0.32), (0.85, 0.35, 0.2))
blocks, chosen = np.zeros((16, 14, 16), int), 3  # blocks: the color of each, 0 is air
blocks[1:15, 1, 1:15] = blocks[1, 1:11, 1:15] = blocks[1:15, 1:11, 1] = 1
blocks[2, 2:11, [3, 10]] = blocks[[3, 10], 2:11, 2] = 1
blocks[1, 11, 2:15:2] = blocks[2:15:2, 11, 1] = 1
for step in range(4):
    blocks[6 + step, 2 : 3 + step, 2:5] = blocks[2:5, 2 : 3 + step, 13 - step] = 2
blocks[7, 2:6, 7] = 2
blocks[7, 6, 7] = 3
vertices = []  # color, normal and place of each
for axis, side in np.ndindex(3, 2):
    normal = np.roll((2 * side - 1, 0, 0), axis)
    corners = [np.roll((side, s, t), axis) - PLACE for s, t in CORNERS]
    for place in np.argwhere((blocks > 0) & (np.roll(blocks, 1 - 2 * side, axis) == 0)):
        color = *np.array(COLORS[blocks[tuple(place)]]) * (0.9 if sum(place) % 2 else 1), 1
        vertices += [(*color, *normal, *(place + corner)) for corner in corners]


def make_slide():
    y, x = np.mgrid[-1:1:256j, -1:1:256j]
    ring, turn = 5 * np.hypot(x, y), np.arctan2(y, x) * 6 / np.pi
    slide = np.array(PANES)[ring.astype(int) % 5]
    slide[(ring > 1) & (np.abs(turn - 3) < 0.5)] = 250, 245, 230  # the panes at the top
    # Between the panes is black lead.
    slide[(ring > 4.9) | (ring % 1 < 0.12) | (ring > 1) & (np.abs(turn % 1 - 0.5) > 0.44)] = 0
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 256, 256, 0, GL_RGB, GL_UNSIGNED_BYTE, np.uint8(slide))


def on_key(window, key, scancode, action, mods):
    global chosen
    chosen = key - glfw.KEY_1 if key - glfw.KEY_1 in range(4) else chosen
    glfw.set_window_should_close(window, key == glfw.KEY_ESCAPE)


def main():
    glfw.init()
    window = glfw.create_window(640, 480, _("Projective texture"), None, None)
    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    glInterleavedArrays(GL_C4F_N3F_V3F, 0, np.array(vertices, np.float32))
    glBindTexture(GL_TEXTURE_2D, glGenTextures(1))
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR)
    make_slide()
    glLightModelfv(GL_LIGHT_MODEL_AMBIENT, (0, 0, 0, 1))
    glLightfv(GL_LIGHT1, GL_AMBIENT, (0.22, 0.25, 0.32, 1))
    glLightfv(GL_LIGHT1, GL_DIFFUSE, (0.3, 0.28, 0.26, 1))
    glPolygonOffset(-1, -1)
    glBlendFunc(GL_ONE, GL_ONE)
    for cap in (GL_DEPTH_TEST, GL_LIGHTING, GL_COLOR_MATERIAL):
        glEnable(cap)
    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        for mode in (GL_MODELVIEW, GL_PROJECTION):
            glMatrixMode(mode)
            glLoadIdentity()
        glFrustum(-0.66, 0.66, -0.66, 0.66, 1, 10)
        glRotatef(32 + 10 * np.sin(np.pi / 3 * glfw.get_time()), 0, 1, 0)
        x, y, w = glGetFloatv(GL_PROJECTION_MATRIX).T[[0, 1, 3]]  # rows of the matrix
        glLoadIdentity()
        glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 60)
        glMatrixMode(GL_MODELVIEW)
        glTranslatef(0, 1.5, -40)
        glRotatef(28, 1, 0, 0)
        glRotatef(-45, 0, 1, 0)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        glLightfv(GL_LIGHT1, GL_POSITION, (2, 6, 4, 0))
        glLightfv(GL_LIGHT0, GL_POSITION, (0, 0, 0, 1))
        glPushAttrib(GL_ALL_ATTRIB_BITS)
        glEnable(GL_LIGHT1)
        glDrawArrays(GL_QUADS, 0, len(vertices))
        glDisable(GL_LIGHT1)
        for cap in (GL_LIGHT0, GL_BLEND, GL_TEXTURE_2D, GL_POLYGON_OFFSET_FILL):
            glEnable(cap)
        glClipPlane(GL_CLIP_PLANE0, w)
        (glDisable if chosen == 0 else glEnable)(GL_CLIP_PLANE0)
        wrap = GL_REPEAT if chosen == 2 else GL_CLAMP_TO_BORDER  # the border is black
        for name in (GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T):
            glTexParameteri(GL_TEXTURE_2D, name, wrap)
        q = (0, 0, 0, 1) if chosen == 1 else w
        for axis, plane in ((0, (x + q) / 2), (1, (y + q) / 2), (3, q)):  # s, t, q
            glTexGeni(GL_S + axis, GL_TEXTURE_GEN_MODE, GL_EYE_LINEAR)
            glTexGenfv(GL_S + axis, GL_EYE_PLANE, plane)
            glEnable(GL_TEXTURE_GEN_S + axis)
        glDrawArrays(GL_QUADS, 0, len(vertices))
        glPopAttrib()
        write(16, 16, LABELS[chosen])
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
