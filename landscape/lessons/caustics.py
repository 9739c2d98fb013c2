"""Caustics: a second pass with a net of light

Waves focus sunlight into bright lines on the bed of a pool. The pool is drawn twice: plain, and
multiplied by such a net, whose texture coordinates come from planes given after the camera. Given
under the identity, they stick to the eye, and so does the net; as planes of the object, they turn
with each starfish. A product of sines, often drawn in place of the net, has no lines.

Keys: 1, 2 and 3 choose the planes; Space a product of sines; D GL_ZERO for GL_DST_COLOR.
"""
# topic: effects
# needs: generated_texture, texture_units, blending, camera_light
# picture: frame 20
# loop: 360 frames
# keys: 1 2 SPACE D

import math

import glfw
import numpy as np
from OpenGL.GL import *
from text import _, write

LABELS = "planes of the object", "planes under the identity", "planes after the camera"
WAVES = ((1, 2, 0.5, 1), (2, -1, 0.4, -1), (-3, 1, 0.2, 1), (1, -3, 0.2, -1), (3, 3, 0.1, 2))
K, L, HEIGHT, SPEED = np.array(WAVES).T[:, :, None, None]
STARS = ((-1.6, 0.8, 0.9), (1.7, -0.9, 0.7), (0.2, -0.3, 1.1), (1.5, 1.6, 0.6), (-1.5, -1.7, 0.8))
SIDE, TURN = 64, math.tau / 64  # texels; what one of them is of a wave's circle
Y, X = np.mgrid[: 4 * SIDE, : 4 * SIDE] / 4  # sixteen rays for each texel
chosen = 2
net = True
doubled = True


def load_light(time):
    if net:  # the slope of the waves moves each ray; count where they meet the bed
        slope = 2.85 * HEIGHT * np.cos(TURN * (K * X + L * Y) + SPEED * time)
        row, column = ((p + (n * slope).sum(0) + SIDE).astype(int) for p, n in ((Y, L), (X, K)))
        light = np.bincount((row % SIDE * SIDE + column % SIDE).ravel(), minlength=SIDE * SIDE) / 16
    else:
        light = (1 + np.sin(4 * TURN * X + time)) * (1 + np.sin(4 * TURN * Y + time)) / 1.6
        light = light[::4, ::4]
    data = (255 * np.clip(0.12 + 0.4 * light, 0, 1)).astype(np.uint8).tobytes()
    glTexImage2D(GL_TEXTURE_2D, 0, 1, SIDE, SIDE, 0, GL_LUMINANCE, GL_UNSIGNED_BYTE, data)


def draw_pool():
    glBegin(GL_QUADS)
    glColor3f(0.4, 0.7, 0.72)
    for x, z in ((-3, -3), (-3, 3), (3, 3), (3, -3)):
        glVertex3f(x, 0, z)
    glEnd()
    for x, z, size in STARS:
        glPushMatrix()
        glTranslatef(x, 0, z)
        glRotatef(60 * glfw.get_time() + 70 * x, 0, 1, 0)
        glBegin(GL_TRIANGLE_FAN)
        for n in range(12):
            glColor3f(*((0.98, 0.55, 0.3) if n % 2 else (0.9, 0.4, 0.22)))
            c, s = (size * (1 if n % 2 else 0.4) * f(n * math.pi / 5) for f in (math.cos, math.sin))
            glVertex3f(*((c, 0, -s) if n else (0, 0.3, 0)))  # the first is the middle
        glEnd()
        glPopMatrix()


def on_key(window, key, scancode, action, mods):
    global chosen, net, doubled
    if action == glfw.PRESS:
        chosen = key - glfw.KEY_1 if key - glfw.KEY_1 in range(3) else chosen
        net ^= key == glfw.KEY_SPACE
        doubled ^= key == glfw.KEY_D
        glfw.set_window_should_close(window, key == glfw.KEY_ESCAPE)


def main():
    glfw.init()
    window = glfw.create_window(640, 480, _("Caustics"), None, None)
    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.05, 0.2, 0.27, 1)
    glEnable(GL_DEPTH_TEST)
    glDepthFunc(GL_LEQUAL)  # in the second pass, all is as deep as in the first
    glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE)
    glBindTexture(GL_TEXTURE_2D, glGenTextures(1))
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR)
    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 60)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glTranslatef(0, 0.9, -12.4)
        glRotatef(42, 1, 0, 0)
        glRotatef(20 * math.sin(math.pi / 3 * glfw.get_time()), 0, 1, 0)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        draw_pool()
        load_light(math.tau / 3 * glfw.get_time())
        glPushMatrix()
        if chosen == 1:
            glLoadIdentity()
        for axis, plane in ((GL_S, (0.3, 0.1, 0.1, 0)), (GL_T, (-0.1, 0.1, 0.3, 0))):
            glTexGeni(axis, GL_TEXTURE_GEN_MODE, GL_OBJECT_LINEAR if chosen == 0 else GL_EYE_LINEAR)
            glTexGenfv(axis, GL_OBJECT_PLANE if chosen == 0 else GL_EYE_PLANE, plane)
        glPopMatrix()
        glPushAttrib(GL_ENABLE_BIT)
        for cap in (GL_TEXTURE_2D, GL_TEXTURE_GEN_S, GL_TEXTURE_GEN_T, GL_BLEND):
            glEnable(cap)
        glBlendFunc(GL_DST_COLOR if doubled else GL_ZERO, GL_SRC_COLOR)
        draw_pool()
        glPopAttrib()
        write(16, 64, LABELS[chosen])
        write(16, 40, "net of light" if net else "product of sines")
        write(16, 16, "GL_DST_COLOR, GL_SRC_COLOR" if doubled else "GL_ZERO, GL_SRC_COLOR")
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
