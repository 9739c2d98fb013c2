"""Bump mapping by DOT3: a fossil that is a picture of normals

The slab is flat. Each texel of its texture is a normal, as a color; the color of each vertex is the
direction to the lamp. GL_DOT3_RGB multiplies the two at each pixel, as light on ribs and grooves. A
color holds 0 to 1, a direction -1 to 1: one that is not moved there loses its negative half, and
one that is interpolated between far vertices becomes too short.

Keys: 1 to 5 choose: normals, directions, directions not moved, only four vertices, the light.
"""
# topic: voxels
# needs: texture_units, normals, gouraud, vertex_arrays
# picture: frame 40
# loop: 360 frames
# keys: 1 2 3 4

import glfw
import numpy as np
from OpenGL.GL import *
from text import _, write

LABELS = "normals", "directions", "directions not moved", "four vertices", "GL_DOT3_RGB"
HIGH, WIDE = np.linspace(-1, 1, 512), np.linspace(-1.3, 1.3, 512)  # of the slab
chosen = 4


def make_relief():
    """Return the colors of normals and stone, each uint8 (512, 512, 3)."""
    y, x = np.meshgrid(HIGH, WIDE, indexing="ij")
    radius, angle = np.hypot(x + 0.1, y), np.arctan2(y, x + 0.1)
    whorl = np.log(radius + 1e-6) / 0.65 + angle / 2 / np.pi + 0.7  # 1 more at each turn
    shell, across = whorl < 0, 2 * (whorl % 1) - 1
    ribs = 0.11 * np.sin(42 * angle + 2.5 * across**2)
    heights = np.where(shell, radius * (0.1 + 0.22 * np.sqrt(1 - across**2) * (1 + ribs)), 0)
    joints = np.minimum(abs((x * 2.5 + 0.5) % 1 - 0.5), abs((y * 2.5 + 0.5) % 1 - 0.5))
    heights += ~shell * (0.02 * np.clip(joints * 14, 0, 1))
    heights += 0.002 * np.random.default_rng(1).normal(size=x.shape) * ~shell
    along_y, along_x = np.gradient(heights, HIGH, WIDE)
    normals = np.stack((-along_x, -along_y, np.ones_like(x)), -1)
    normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
    stone = np.where(shell[..., None], (250, 214, 160), (190, 196, 206))
    return [(127.5 + 127.5 * normals).astype(np.uint8), stone.astype(np.uint8)]


def make_grid(cells):
    """Return the corners of the cells of a grid over the slab, four for each."""
    corners = ((0, 0), (1, 0), (1, 1), (0, 1))
    places = [(i + s, j + t) for i, j in np.ndindex(cells, cells) for s, t in corners]
    return np.array([(2.6 * s / cells - 1.3, 2 * t / cells - 1, 0) for s, t in places])


def on_key(window, key, scancode, action, mods):
    global chosen
    chosen = key - glfw.KEY_1 if key - glfw.KEY_1 in range(5) else chosen
    glfw.set_window_should_close(window, key == glfw.KEY_ESCAPE)


def main():
    glfw.init()
    window = glfw.create_window(640, 480, _("Bump mapping by DOT3"), None, None)
    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    for unit, image in zip((GL_TEXTURE1, GL_TEXTURE0), make_relief()[::-1], strict=True):
        glActiveTexture(unit)
        glBindTexture(GL_TEXTURE_2D, glGenTextures(1))
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR)
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 512, 512, 0, GL_RGB, GL_UNSIGNED_BYTE, image)
        for row, plane in enumerate(((1 / 2.6, 0, 0, 0.5), (0, 0.5, 0, 0.5))):
            glTexGeni(GL_S + row, GL_TEXTURE_GEN_MODE, GL_OBJECT_LINEAR)
            glTexGenfv(GL_S + row, GL_OBJECT_PLANE, plane)

    glTexEnvi(GL_TEXTURE_ENV, GL_COMBINE_RGB, GL_DOT3_RGB)
    grids = make_grid(24), make_grid(1)
    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        for mode in (GL_MODELVIEW, GL_PROJECTION):
            glMatrixMode(mode)
            glLoadIdentity()
        glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 60)
        glMatrixMode(GL_MODELVIEW)
        glTranslatef(0, 0.1, -4.5)
        glRotatef(-16, 1, 0, 0)
        glClear(GL_COLOR_BUFFER_BIT)
        turn = np.pi / 3 * glfw.get_time()
        lamp = 0.95 * np.cos(turn), 0.7 * np.sin(turn), 0.5
        places = grids[chosen == 3]
        toward = lamp - places
        far = np.linalg.norm(toward, axis=1, keepdims=True)
        toward /= far * np.maximum(0.7 + far * far / 4, 1)  # shorter where it is far: less light
        colors = toward if chosen == 2 else 0.5 + toward / 2
        data = np.hstack((colors, places)).astype(np.float32)
        glInterleavedArrays(GL_C3F_V3F, 0, data)
        glPushAttrib(GL_ENABLE_BIT)
        for unit in (GL_TEXTURE1, GL_TEXTURE0)[chosen < 2 :]:
            glActiveTexture(unit)
            for cap in (GL_TEXTURE_GEN_S, GL_TEXTURE_GEN_T, GL_TEXTURE_2D)[: 2 + (chosen != 1)]:
                glEnable(cap)
        glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE if chosen == 0 else GL_COMBINE)
        glDrawArrays(GL_QUADS, 0, len(data))
        glPopAttrib()
        glPointSize(12 * height / 480)
        glColor3f(1, 0.9, 0.6)
        glBegin(GL_POINTS)
        glVertex3f(*lamp)
        glEnd()
        write(16, 16, LABELS[chosen])
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
