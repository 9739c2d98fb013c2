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
import sys

import glfw
import numpy as np
from OpenGL.GL import *
from text import _, write

SIDE = 64  # texels across and down
TURN = math.tau / SIDE  # what one texel is of a wave's circle
WAVES = (  # how many fit along x and along z, height, speed
    (1, 2, 0.5, 1),
    (2, -1, 0.4, -1),
    (-3, 1, 0.2, 1),
    (1, -3, 0.2, -1),
    (3, 3, 0.1, 2),
)
DEPTH = 2.85  # of the pool: how far the slope of a wave moves a ray, chosen
STARS = (  # x, z and size
    (-1.6, 0.8, 0.9),
    (1.7, -0.9, 0.7),
    (0.2, -0.3, 1.1),
    (1.5, 1.6, 0.6),
    (-1.5, -1.7, 0.8),
)
PLANE_S = (0.3, 0.1, 0.1, 0)  # a little of y, so that the net does not run down walls in streaks
PLANE_T = (-0.1, 0.1, 0.3, 0)

OF_OBJECT, UNDER_IDENTITY, AFTER_CAMERA = range(3)
LABELS = "planes of the object", "planes under the identity", "planes after the camera"
chosen = AFTER_CAMERA
net = True
doubled = True


def count_rays(time):
    """Return how much light each texel of the bed gets, (64, 64), under waves that focus it."""
    y, x = np.mgrid[: 4 * SIDE, : 4 * SIDE] / 4  # sixteen rays for each texel
    moved_x = 0
    moved_y = 0
    for k_x, k_z, height, speed in WAVES:
        slope = DEPTH * height * np.cos(TURN * (k_x * x + k_z * y) + speed * time)
        moved_x += k_x * slope
        moved_y += k_z * slope

    # Count the rays by the texel that they meet.
    column = (x + moved_x + SIDE).astype(int) % SIDE
    row = (y + moved_y + SIDE).astype(int) % SIDE
    rays = np.bincount((row * SIDE + column).ravel(), minlength=SIDE * SIDE)
    return rays / 16


def multiply_sines(time):
    """Return a product of sines, (64, 64): spots of light, and no lines."""
    y, x = np.mgrid[:SIDE, :SIDE]
    return (1 + np.sin(4 * TURN * x + time)) * (1 + np.sin(4 * TURN * y + time)) / 1.6


def load_light(time):
    light = (count_rays(time) if net else multiply_sines(time)).ravel()
    texels = (255 * np.clip(0.12 + 0.4 * light, 0, 1)).astype(np.uint8).tobytes()
    glTexImage2D(
        GL_TEXTURE_2D, 0, GL_LUMINANCE, SIDE, SIDE, 0, GL_LUMINANCE, GL_UNSIGNED_BYTE, texels
    )


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
        draw_star(size)
        glPopMatrix()


def draw_star(size):
    """Draw a fan around a raised middle; every other corner is the tip of an arm."""
    glBegin(GL_TRIANGLE_FAN)
    glColor3f(0.9, 0.4, 0.22)
    glVertex3f(0, 0.3, 0)
    for n in range(1, 12):
        is_tip = n % 2 == 1
        glColor3f(*((0.98, 0.55, 0.3) if is_tip else (0.9, 0.4, 0.22)))
        radius = size * (1 if is_tip else 0.4)
        angle = n * math.pi / 5
        glVertex3f(radius * math.cos(angle), 0, -radius * math.sin(angle))
    glEnd()


def look(width, height):
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 60)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glTranslatef(0, 0.9, -12.4)
    glRotatef(42, 1, 0, 0)
    glRotatef(20 * math.sin(math.pi / 3 * glfw.get_time()), 0, 1, 0)


def generate_coordinates():
    """Give the planes of s and t; those of the eye are taken with the matrix of this moment."""
    glPushMatrix()
    if chosen == UNDER_IDENTITY:
        glLoadIdentity()
    for coordinate, plane in ((GL_S, PLANE_S), (GL_T, PLANE_T)):
        if chosen == OF_OBJECT:
            glTexGeni(coordinate, GL_TEXTURE_GEN_MODE, GL_OBJECT_LINEAR)
            glTexGenfv(coordinate, GL_OBJECT_PLANE, plane)
        else:
            glTexGeni(coordinate, GL_TEXTURE_GEN_MODE, GL_EYE_LINEAR)
            glTexGenfv(coordinate, GL_EYE_PLANE, plane)
    glPopMatrix()


def draw_light():
    """Draw the pool once more, and multiply what is there by the texture."""
    glPushAttrib(GL_ENABLE_BIT)
    for cap in (GL_TEXTURE_2D, GL_TEXTURE_GEN_S, GL_TEXTURE_GEN_T, GL_BLEND):
        glEnable(cap)
    glBlendFunc(GL_DST_COLOR if doubled else GL_ZERO, GL_SRC_COLOR)
    draw_pool()
    glPopAttrib()


def on_key(window, key, scancode, action, mods):
    global chosen, net, doubled
    if action != glfw.PRESS:
        return
    if glfw.KEY_1 <= key < glfw.KEY_1 + len(LABELS):
        chosen = key - glfw.KEY_1
    elif key == glfw.KEY_SPACE:
        net = not net
    elif key == glfw.KEY_D:
        doubled = not doubled
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Caustics"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.05, 0.2, 0.27, 1)
    glEnable(GL_DEPTH_TEST)
    glDepthFunc(GL_LEQUAL)  # in the second pass, all is as deep as in the first
    glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE)
    glBindTexture(GL_TEXTURE_2D, glGenTextures(1))
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR)

    while not glfw.window_should_close(window):
        look(*glfw.get_framebuffer_size(window))
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        draw_pool()
        load_light(math.tau / 3 * glfw.get_time())
        generate_coordinates()
        draw_light()

        write(16, 64, LABELS[chosen])
        write(16, 40, "net of light" if net else "product of sines")
        write(16, 16, "GL_DST_COLOR, GL_SRC_COLOR" if doubled else "GL_ZERO, GL_SRC_COLOR")
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
