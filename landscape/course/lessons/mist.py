"""Mist: transparent layers over a floor

Level sheets with a texture of clouds are blended one over the other, dark ones below and light ones
above. Blending needs them from far to near: upwards where the eye looks down on them, downwards
where it looks up. They do not write their depth: if they do, the one that is drawn first hides what
comes later and lies behind it, whether another sheet or a beam of light.

Keys: Up and Down raise and lower the eye; S leaves out the sort; D writes the depth.
"""
# topic: effects
# needs: sorting, fog, generated_texture
# picture: frame 20
# keys: UP DOWN S D

import math
import sys

import glfw
import numpy as np
from OpenGL.GL import *
from text import _, write

HEIGHTS = [0.12 + 0.12 * n for n in range(8)]  # of the sheets
CIRCLE = [(math.cos(n * math.pi / 16), math.sin(n * math.pi / 16)) for n in range(33)]
eye = 2.4
sort = True
write_depth = False


def make_clouds():
    """Make a texture of noise in which long waves are stronger than short ones."""
    noise = np.random.default_rng(3).standard_normal((128, 128))
    f2 = np.fft.fftfreq(128, 1 / 128) ** 2
    clouds = np.fft.ifft2(np.fft.fft2(noise) / (1 + f2 + f2[:, np.newaxis]) ** 0.8).real
    data = (255 * np.clip(0.5 + 0.25 * clouds / clouds.std(), 0, 1)).astype(np.uint8).tobytes()
    glBindTexture(GL_TEXTURE_2D, glGenTextures(1))
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR)
    glTexImage2D(GL_TEXTURE_2D, 0, GL_ALPHA, 128, 128, 0, GL_ALPHA, GL_UNSIGNED_BYTE, data)


def draw_sheet(y, color):
    """Draw a level disc that thins out to its rim."""
    turn = 800 * y + 0.05 * glfw.get_time()  # each sheet has other clouds, and they drift
    glBegin(GL_TRIANGLE_FAN)
    draw_sheet_vertex(y, (0, 0), (*color, 0.95), turn)
    for c, s in CIRCLE:
        draw_sheet_vertex(y, (5 * c, 5 * s), (*color, 0), turn)
    glEnd()


def draw_sheet_vertex(y, place, color, turn):
    x, z = place
    glColor4f(*color)
    glTexCoord2f(0.12 * x + turn, 0.12 * z + 2 * turn)
    glVertex3f(x, y, -z)


def draw_columns(angle, radius, bottom, top):
    """Draw eight columns in a ring, of two colours."""
    for n in range(8):
        glPushMatrix()
        glRotatef(angle + 45 * n, 0, 1, 0)
        glTranslatef(2.7, 0, 0)
        glBegin(GL_QUAD_STRIP)
        for c, s in CIRCLE:
            for y, (r, g, b, alpha) in ((1.9, top), (0, bottom)):
                shade = 0.8 - 0.2 * c
                glColor4f(shade * r, shade * g, shade * b, alpha)
                glVertex3f(radius * c, y, -radius * s)
        glEnd()
        glPopMatrix()


def sorted_heights():
    """Return the heights of the sheets, the one that is farthest from the eye first."""
    return sorted(HEIGHTS, key=lambda y: -abs(y - eye))


def draw_sheets():
    glDepthMask(write_depth)
    glEnable(GL_TEXTURE_2D)
    for y in sorted_heights() if sort else reversed(HEIGHTS):
        light = y / HEIGHTS[-1]
        draw_sheet(y, (0.3 + 0.65 * light, 0.42 + 0.5 * light, 0.55 + 0.33 * light))
    glDisable(GL_TEXTURE_2D)


def draw_beams():
    """Add eight beams of light to what is there."""
    glBlendFunc(GL_SRC_ALPHA, GL_ONE)
    draw_columns(22.5, 0.14, (1, 0.6, 0.2, 0.4), (1, 0.6, 0.2, 0))


def look(width, height):
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glFrustum(-width / height / 3, width / height / 3, -1 / 3, 1 / 3, 1, 30)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glRotatef(math.degrees(math.atan2(eye - 0.2, 7.5)), 1, 0, 0)
    glTranslatef(0, -eye, -7.5)
    glRotatef(10 * glfw.get_time(), 0, 1, 0)


def on_key(window, key, scancode, action, mods):
    global eye, sort, write_depth
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_UP:
        eye = min(5, eye + 0.3)
    elif key == glfw.KEY_DOWN:
        eye = max(0.1, eye - 0.3)
    elif key == glfw.KEY_S:
        sort = not sort
    elif key == glfw.KEY_D:
        write_depth = not write_depth
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Mist"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    glEnable(GL_DEPTH_TEST)
    glEnable(GL_BLEND)
    make_clouds()

    while not glfw.window_should_close(window):
        look(*glfw.get_framebuffer_size(window))
        glDepthMask(True)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA)
        draw_sheet(0, (0.3, 0.26, 0.24))  # the floor
        draw_columns(0, 0.25, (0.4, 0.2, 0.14, 1), (0.9, 0.44, 0.3, 1))
        draw_sheets()
        draw_beams()

        write(16, 64, "eye at {y:.1f}, mist up to {top:.1f}", y=eye, top=HEIGHTS[-1])
        write(16, 40, "sorted" if sort else "from top to bottom")
        write(16, 16, "depth written" if write_depth else "depth not written")
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
