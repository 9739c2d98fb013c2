"""Sphere map: a torus that mirrors its surroundings

GL_SPHERE_MAP computes texture coordinates from the direction that each vertex mirrors; the texture
is the picture of a small mirror ball, as in the corner. It holds for one line of sight: walk around
the torus, and the sphere map turns with you. A cube map with GL_REFLECTION_MAP stays where it is.

Keys: Left and Right walk around; Space takes the cube map.
"""
# topic: effects
# needs: generated_texture, vertex_arrays, sky_box
# picture: frame 1 after RIGHT RIGHT
# keys: LEFT RIGHT SPACE

import glfw
import numpy as np
from OpenGL.GL import *
from text import _, write

CORNERS = ((-1, -1), (1, -1), (1, 1), (-1, 1))
GENERATED = ((GL_S, GL_TEXTURE_GEN_S), (GL_T, GL_TEXTURE_GEN_T), (GL_R, GL_TEXTURE_GEN_R))
STRIP = np.arange(96 * 49, dtype=np.uint32)[:, None] + np.array((49, 0), np.uint32)
turned, cube = 0, False  # degrees


def make_image(target, x, y, z):  # the direction that each texel shows
    slope, far = y / np.hypot(x, z), 1.3 / (-y).clip(0.01)  # to where it meets the floor
    colors = (0.8, 0.88, 0.95) - np.arctan(slope).clip(0)[..., None] * (0.45, 0.36, 0.15)
    colors[(abs(np.arctan2(x, z) % np.pi - 2.9) < 0.12) & (slope < 0.22)] = 0.85, 0.35, 0.2
    tiles = np.clip(25 / far * np.sin(2 * x * far) * np.sin(2 * z * far), -1, 1)[..., None]
    colors[y < 0] = ((0.48, 0.5, 0.48) + tiles * (0.28, 0.23, 0.12))[y < 0]
    glTexImage2D(target, 0, GL_RGB, *x.shape, 0, GL_RGB, GL_UNSIGNED_BYTE, np.uint8(255 * colors))


def make_maps():
    (t, s), a = np.mgrid[-1:1:512j, -1:1:512j], np.ones((512, 512))
    z = np.sqrt((1 - s * s - t * t).clip(0))  # s, t, z: the normal of the mirror ball
    make_image(GL_TEXTURE_2D, 2 * z * s, 2 * z * t, 2 * z * z - 1)
    faces = ((a, -t, -s), (-a, -t, s), (s, a, t), (s, -a, -t), (s, -t, a), (-s, -t, -a))
    for number, face in enumerate(faces):
        make_image(GL_TEXTURE_CUBE_MAP_POSITIVE_X + number, *face)


def make_torus():
    turn, around = np.meshgrid(np.linspace(0, 2 * np.pi, 97), np.linspace(0, 2 * np.pi, 49))
    x = np.cos(turn)
    y = np.sin(turn)
    radius = np.cos(around)
    normals = np.array((radius * x, radius * y, np.sin(around)), np.float32)
    glVertexPointer(3, GL_FLOAT, 0, (0.5 * normals + np.array((x, y, 0 * x))).T.astype(np.float32))
    glNormalPointer(GL_FLOAT, 0, normals.T.copy())


def draw_quad(target, points, coordinates):
    glEnable(target)
    glBegin(GL_QUADS)
    for point, coordinate in zip(points, coordinates, strict=True):
        glTexCoord3f(*coordinate)
        glVertex3f(*point)
    glEnd()
    glDisable(target)


def on_key(window, key, scancode, action, mods):
    global cube, turned
    if action != glfw.RELEASE:
        turned += 15 * ((key == glfw.KEY_RIGHT) - (key == glfw.KEY_LEFT))
        cube ^= key == glfw.KEY_SPACE
        glfw.set_window_should_close(window, key == glfw.KEY_ESCAPE)


def main():
    glfw.init()
    window = glfw.create_window(640, 480, _("Sphere map"), None, None)
    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    for name in (GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T):
        glTexParameteri(GL_TEXTURE_CUBE_MAP, name, GL_CLAMP_TO_EDGE)
    for target in (GL_TEXTURE_2D, GL_TEXTURE_CUBE_MAP):
        glTexParameteri(target, GL_TEXTURE_MIN_FILTER, GL_LINEAR)
    make_maps()
    make_torus()
    for array in (GL_VERTEX_ARRAY, GL_NORMAL_ARRAY):
        glEnableClientState(array)
    glEnable(GL_DEPTH_TEST)
    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        wide = width / height
        for mode in (GL_MODELVIEW, GL_TEXTURE, GL_PROJECTION):
            glMatrixMode(mode)
            glLoadIdentity()
        glFrustum(-wide / 4, wide / 4, -0.25, 0.25, 1, 50)
        glMatrixMode(GL_TEXTURE)
        glRotatef(-turned, 0, 1, 0)  # from eye to world coordinates
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        behind = [(10 * wide * x, 10 * y, -40) for x, y in CORNERS]
        draw_quad(GL_TEXTURE_CUBE_MAP, behind, behind)
        if not cube:
            glLoadIdentity()
            corner = [(0.1 * x - 0.3 * wide + 0.115, 0.1 * y + 0.185, -1.2) for x, y in CORNERS]
            draw_quad(GL_TEXTURE_2D, corner, [(x > 0, y > 0, 0) for x, y in CORNERS])
        glMatrixMode(GL_MODELVIEW)
        glTranslatef(0, 0, -7.5)
        glRotatef(turned, 0, 1, 0)
        glPushAttrib(GL_ENABLE_BIT)
        glEnable(GL_TEXTURE_CUBE_MAP if cube else GL_TEXTURE_2D)
        for n, generated in GENERATED[: 3 if cube else 2]:
            glTexGeni(n, GL_TEXTURE_GEN_MODE, GL_REFLECTION_MAP if cube else GL_SPHERE_MAP)
            glEnable(generated)
        glDrawElements(GL_TRIANGLE_STRIP, STRIP.size, GL_UNSIGNED_INT, STRIP)
        glPopAttrib()
        glMatrixMode(GL_TEXTURE)
        glLoadIdentity()  # the letters have a texture, too
        write(16, 16, "cube map" if cube else "sphere map", (0, 0, 0))
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
