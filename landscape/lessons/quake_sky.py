"""Quake's sky: two layers of cloud on one dome

A dome around the eye is drawn first, without depth. Its texture coordinates are those of a flat
ceiling: clouds are small near the horizon. The first layer is opaque; the second one has holes by
its alpha, which the program adds, and is blended over the first. The texture matrix moves both,
the near one twice as fast. That is all that makes the sky deep.

Keys: L second layer, O order of the layers, S the same speed for both, F ceiling or plain angles.
"""
# topic: effects
# needs: blending, generated_texture, sky_box
# picture: frame 60
# keys: L O S F

import math

import glfw
import numpy as np
from OpenGL.GL import *
from text import _, write

KEYS = glfw.KEY_L, glfw.KEY_O, glfw.KEY_S, glfw.KEY_F
on = [True] * len(KEYS)
SPEED = 0.03  # textures per second of the far layer
SPEEDS, REPEATS = {"far": 1, "near": 2}, {"far": 0.35, "near": 0.55}
FLATNESS = 0.22  # the height of the ceiling's horizon
RINGS, SIDES = 16, 32


def noise(seed):
    """Return clouds 0 to 1, (128, 128): noise in which long waves are stronger than short ones."""
    white = np.random.default_rng(seed).standard_normal((128, 128))
    f2 = np.fft.fftfreq(128, 1 / 128) ** 2
    clouds = np.fft.ifft2(np.fft.fft2(white) / (1 + f2 + f2[:, None]) ** 0.9).real
    return np.clip(0.5 + 0.28 * clouds / clouds.std(), 0, 1)[..., None]


def make_texture(seed, dark, light, opaque):
    clouds = noise(seed)
    colors = np.array(dark) * (1 - clouds) + np.array(light) * clouds
    alpha = np.ones_like(clouds) if opaque else np.clip(4 * clouds - 1.9, 0, 1)
    image = (255 * np.concatenate([colors, alpha], axis=2)).astype(np.uint8).tobytes()
    glBindTexture(GL_TEXTURE_2D, texture := glGenTextures(1))
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR)
    glTexParameteri(GL_TEXTURE_2D, GL_GENERATE_MIPMAP, True)
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 128, 128, 0, GL_RGBA, GL_UNSIGNED_BYTE, image)
    return texture


def make_dome(flat):
    glNewList(dome := glGenLists(1), GL_COMPILE)
    for ring in range(RINGS):
        glBegin(GL_QUAD_STRIP)
        for side in range(SIDES + 1):
            around = 2 * math.pi * side / SIDES
            for up in (ring + 1, ring):
                rise = math.pi / 2 * up / RINGS
                x, y = math.cos(rise) * math.cos(around), math.sin(rise)
                z = math.cos(rise) * math.sin(around)
                far = y + FLATNESS if flat else 1
                glTexCoord2f(x / far, z / far)
                glVertex3f(10 * x, 10 * y, 10 * z)
        glEnd()
    glEndList()
    return dome


def draw_layer(texture, dome, repeat, shift):
    glBindTexture(GL_TEXTURE_2D, texture)
    glMatrixMode(GL_TEXTURE)
    glLoadIdentity()
    glTranslatef(shift, shift, 0)
    glScalef(repeat, repeat, 1)
    glMatrixMode(GL_MODELVIEW)
    glCallList(dome)
    glMatrixMode(GL_TEXTURE)
    glLoadIdentity()
    glMatrixMode(GL_MODELVIEW)


def draw_ruins():
    """Draw a plain and some walls, so that there is something under the sky."""
    glBegin(GL_QUADS)
    for n, (x, y) in enumerate(((-60, -4), (60, -4), (60, 60), (-60, 60))):
        glColor3f(*((0.16, 0.12, 0.1) if n < 2 else (0.3, 0.2, 0.17)))
        glVertex3f(x, -1, 4 - y)
    for n in range(11):
        x, high = 2.6 * n - 13, 1.3 + 1.1 * (n * 7 % 4)
        z = -14 - 5 * math.cos(2.1 * n)
        for side, shade in ((0, 0.09), (1, 0.15)):
            glColor3f(1.2 * shade, shade, 0.9 * shade)
            for u, v in ((0, 0), (1, 0), (1, 1), (0, 1)):
                glVertex3f(x + side * 1.2 + u * (1.2 - 0.7 * side), -1 + high * v, z - side * u)
    glEnd()


def on_key(window, key, scancode, action, mods):
    if action == glfw.PRESS:
        on[:] = [on[n] ^ (key == KEYS[n]) for n in range(len(KEYS))]
        glfw.set_window_should_close(window, key == glfw.KEY_ESCAPE)


def main():
    glfw.init()
    window = glfw.create_window(640, 480, _("Quake's sky"), None, None)
    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.62, 0.38, 0.29, 1)  # the haze between the dome's edge and the plain
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA)
    far = make_texture(4, (0.30, 0.16, 0.25), (0.98, 0.62, 0.38), True)
    near = make_texture(9, (0.36, 0.20, 0.22), (0.12, 0.08, 0.13), False)
    domes = [make_dome(flat) for flat in (False, True)]
    while not glfw.window_should_close(window):
        both, in_order, two_speeds, flat = on
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glFrustum(-0.7 * width / height, 0.7 * width / height, -0.7, 0.7, 1, 100)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glRotatef(-24, 1, 0, 0)
        glDepthMask(True)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        glDisable(GL_DEPTH_TEST)
        glEnable(GL_TEXTURE_2D)
        glEnable(GL_BLEND)
        glColor3f(1, 1, 1)
        layers = [("far", far)] + [("near", near)] * both
        for name, texture in layers if in_order else layers[::-1]:
            speed = SPEED * (SPEEDS[name] if two_speeds else 1)
            shift = speed * glfw.get_time()
            draw_layer(texture, domes[flat], REPEATS[name], shift)
        glDisable(GL_BLEND)
        glDisable(GL_TEXTURE_2D)
        glEnable(GL_DEPTH_TEST)
        draw_ruins()
        write(16, 88, "two layers" if both else "one layer")
        write(
            16, 64, "the near one over the far one" if in_order else "the far one over the near one"
        )
        write(16, 40, "two speeds" if two_speeds else "one speed")
        write(16, 16, "a flat ceiling" if flat else "plain angles")
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
