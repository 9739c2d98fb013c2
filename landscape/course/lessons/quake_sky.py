"""Quake's sky: two layers of cloud on one dome

A dome around the eye is drawn first, without depth. Its texture coordinates are those of a flat
ceiling: clouds are small near the horizon. The first layer is opaque; the second has holes, by an
alpha channel that the program adds, and is blended over the first. The texture matrix moves both,
the near one twice as fast. That is all that makes the sky deep.

Keys: L second layer, O order of the layers, S the same speed for both, F ceiling or plain angles.
"""
# topic: effects
# needs: blending, generated_texture, sky_box
# picture: frame 60
# keys: L O S F

import math
import sys

import glfw
import numpy as np
from OpenGL.GL import *
from text import _, write

SPEED = 0.03  # textures per second of the far layer
FAR_REPEAT = 0.35  # how often a layer's texture repeats on the ceiling
NEAR_REPEAT = 0.55
FLATNESS = 0.22  # the height of the ceiling's horizon
RINGS = 16
SIDES = 32

both = True  # both layers
in_order = True  # the far one first
two_speeds = True
flat = True  # a ceiling, not plain angles


def noise(seed):
    """Return clouds 0 to 1, (128, 128): noise in which long waves are stronger than short ones."""
    white = np.random.default_rng(seed).standard_normal((128, 128))
    f2 = np.fft.fftfreq(128, 1 / 128) ** 2
    clouds = np.fft.ifft2(np.fft.fft2(white) / (1 + f2 + f2[:, np.newaxis]) ** 0.9).real
    return np.clip(0.5 + 0.28 * clouds / clouds.std(), 0, 1)[..., np.newaxis]


def make_texture(seed, dark, light, opaque):
    clouds = noise(seed)
    colors = np.array(dark) * (1 - clouds) + np.array(light) * clouds
    alpha = np.ones_like(clouds) if opaque else np.clip(4 * clouds - 1.9, 0, 1)
    image = (255 * np.concatenate([colors, alpha], axis=2)).astype(np.uint8).tobytes()
    texture = glGenTextures(1)
    glBindTexture(GL_TEXTURE_2D, texture)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR)
    glTexParameteri(GL_TEXTURE_2D, GL_GENERATE_MIPMAP, True)
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 128, 128, 0, GL_RGBA, GL_UNSIGNED_BYTE, image)
    return texture


def make_dome(flat):
    """Return a display list of half a sphere, with the coordinates of a ceiling or of angles."""
    dome = glGenLists(1)
    glNewList(dome, GL_COMPILE)
    for ring in range(RINGS):
        glBegin(GL_QUAD_STRIP)
        for side in range(SIDES + 1):
            draw_dome_vertex(ring + 1, side, flat)
            draw_dome_vertex(ring, side, flat)
        glEnd()
    glEndList()
    return dome


def draw_dome_vertex(ring, side, flat):
    rise = math.pi / 2 * ring / RINGS
    around = 2 * math.pi * side / SIDES
    x = math.cos(rise) * math.cos(around)
    y = math.sin(rise)
    z = math.cos(rise) * math.sin(around)
    far = y + FLATNESS if flat else 1  # where the line of sight meets the ceiling
    glTexCoord2f(x / far, z / far)
    glVertex3f(10 * x, 10 * y, 10 * z)


def draw_layer(texture, dome, repeat, speed):
    """Draw the dome with a texture that the texture matrix moves."""
    shift = speed * glfw.get_time()
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


def draw_sky(far, near, dome):
    """Draw one or two layers around the eye; nothing is behind them."""
    glDisable(GL_DEPTH_TEST)
    glEnable(GL_TEXTURE_2D)
    glEnable(GL_BLEND)
    glColor3f(1, 1, 1)
    near_speed = 2 * SPEED if two_speeds else SPEED
    if both and not in_order:
        draw_layer(near, dome, NEAR_REPEAT, near_speed)
    draw_layer(far, dome, FAR_REPEAT, SPEED)
    if both and in_order:
        draw_layer(near, dome, NEAR_REPEAT, near_speed)
    glDisable(GL_BLEND)
    glDisable(GL_TEXTURE_2D)
    glEnable(GL_DEPTH_TEST)


def draw_ruins():
    """Draw a plain and some walls, so that there is something under the sky."""
    glBegin(GL_QUADS)
    for x, z, color in (
        (-60, 8, (0.16, 0.12, 0.1)),
        (60, 8, (0.16, 0.12, 0.1)),
        (60, -56, (0.3, 0.2, 0.17)),
        (-60, -56, (0.3, 0.2, 0.17)),
    ):
        glColor3f(*color)
        glVertex3f(x, -1, z)

    for n in range(11):
        x = 2.6 * n - 13
        z = -14 - 5 * math.cos(2.1 * n)
        high = 1.3 + 1.1 * (n * 7 % 4)
        for side, shade in ((0, 0.09), (1, 0.15)):  # the front and the right side of each wall
            glColor3f(1.2 * shade, shade, 0.9 * shade)
            for u, v in ((0, 0), (1, 0), (1, 1), (0, 1)):
                glVertex3f(x + side * 1.2 + u * (1.2 - 0.7 * side), -1 + high * v, z - side * u)
    glEnd()


def look(width, height):
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glFrustum(-0.7 * width / height, 0.7 * width / height, -0.7, 0.7, 1, 100)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glRotatef(-24, 1, 0, 0)


def on_key(window, key, scancode, action, mods):
    global both, in_order, two_speeds, flat
    if action != glfw.PRESS:
        return
    if key == glfw.KEY_L:
        both = not both
    elif key == glfw.KEY_O:
        in_order = not in_order
    elif key == glfw.KEY_S:
        two_speeds = not two_speeds
    elif key == glfw.KEY_F:
        flat = not flat
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Quake's sky"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.62, 0.38, 0.29, 1)  # the haze between the dome's edge and the plain
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA)
    far = make_texture(4, (0.30, 0.16, 0.25), (0.98, 0.62, 0.38), opaque=True)
    near = make_texture(9, (0.36, 0.20, 0.22), (0.12, 0.08, 0.13), opaque=False)
    dome_of_angles = make_dome(flat=False)
    dome_of_ceiling = make_dome(flat=True)

    while not glfw.window_should_close(window):
        look(*glfw.get_framebuffer_size(window))
        glDepthMask(True)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        draw_sky(far, near, dome_of_ceiling if flat else dome_of_angles)
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
