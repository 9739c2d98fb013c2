"""Shadow map: what a lamp sees of a stair

A lamp shines on a stair, a post and a chest, but as yet there are no shadows. draw_lit compares
each pixel with the depth texture that is bound: with r, and at the place s, t, both after division
by q. Fill in make_shadow_map, which is called when the camera has been placed.

- Draw the scene as the lamp sees it, in the SIZE x SIZE pixels at the lower left of the window, and
  copy its depths into the texture, by glCopyTexImage2D. look_from_lamp multiplies the current
  matrix by the lamp's projection and viewing matrices, P V. The things are to be moved away from
  the lamp a little, by glPolygonOffset, so that no face shadows itself.

- Let the texture compare r with its depths.

- Give the planes of s, t, r and q, as GL_EYE_PLANE: the rows of B P V, where B leads from -1 ... 1
  to 0 ... 1. OpenGL multiplies them by the inverse of the current modelview matrix, which must be
  the camera's.

Afterwards the viewport and the matrices are as before, no color has been changed, and the depth
buffer is clear for the camera.

Keys: Left and Right move the lamp.
"""
# exercise: shadow_map

import sys

import glfw
import numpy as np
from OpenGL.GL import *

SIZE = 256
# From -1 ... 1 to 0 ... 1.
BIAS = np.array(((0.5, 0, 0, 0.5), (0, 0.5, 0, 0.5), (0, 0, 0.5, 0.5), (0, 0, 0, 1)))
AXES = GL_S, GL_T, GL_R, GL_Q
SKY = (0.38, 0.42, 0.5)
LAMP = (0.62, 0.58, 0.5)
lamp = -35  # degrees around the scene
BOXES = (  # two corners and a color
    ((-2.8, -0.3, -2.6), (2.8, 0, 2.4), (0.95, 0.9, 0.8)),
    ((-2.4, 0, -2), (2.4, 0.5, -0.6), (0.5, 0.62, 0.66)),
    ((-2.4, 0.5, -2), (2.4, 1, -1.1), (0.5, 0.62, 0.66)),
    ((-2.4, 1, -2), (2.4, 1.5, -1.6), (0.5, 0.62, 0.66)),
    ((-1.3, 0, 0.3), (-0.9, 2.6, 0.7), (0.85, 0.35, 0.2)),
    ((0.9, 0, 0.2), (2.1, 0.8, 1.1), (0.95, 0.62, 0.35)),
)


def draw_scene(light=(1, 1, 1)):
    for low, high, color in BOXES:
        glBegin(GL_QUADS)
        for axis in range(3):
            for side in (low, high):
                shade = (0.8, 1, 0.9)[axis]
                glColor3f(*(shade * a * b for a, b in zip(color, light)))
                for first, second in ((low, low), (high, low), (high, high), (low, high)):
                    corner = [0, 0, 0]
                    corner[axis] = side[axis]
                    corner[(axis + 1) % 3] = first[(axis + 1) % 3]
                    corner[(axis + 2) % 3] = second[(axis + 2) % 3]
                    glVertex3f(*corner)
        glEnd()


def look_from_lamp():
    """Multiply the current matrix by the lamp's projection and viewing matrices."""
    glFrustum(-0.42, 0.42, -0.42, 0.42, 1, 20)
    glTranslatef(0, 0, -10)
    glRotatef(42, 1, 0, 0)
    glRotatef(-lamp, 0, 1, 0)


def draw_lit():
    """Draw the scene in the light of the sky, and add the lamp's where the texture gives 1."""
    draw_scene(SKY)
    caps = [GL_TEXTURE_GEN_S, GL_TEXTURE_GEN_T, GL_TEXTURE_GEN_R, GL_TEXTURE_GEN_Q]
    for cap in (GL_TEXTURE_2D, GL_BLEND, *caps):
        glEnable(cap)
    draw_scene(LAMP)
    for cap in (GL_TEXTURE_2D, GL_BLEND, *caps):
        glDisable(cap)


def lamp_matrix():
    """Return the lamp's projection and viewing matrices, P V, (4, 4)."""
    glPushMatrix()
    glLoadIdentity()
    look_from_lamp()
    matrix = np.array(glGetDoublev(GL_MODELVIEW_MATRIX)).T
    glPopMatrix()
    return matrix


def draw_depths(matrix):
    """Draw what a matrix shows into the lower left of the window: depths, and no colors."""
    glPushAttrib(GL_ALL_ATTRIB_BITS)
    glViewport(0, 0, SIZE, SIZE)
    glColorMask(False, False, False, False)
    glEnable(GL_POLYGON_OFFSET_FILL)
    glPolygonOffset(3, 4)
    glMatrixMode(GL_PROJECTION)
    glPushMatrix()
    glLoadMatrixd(matrix.T)
    glMatrixMode(GL_MODELVIEW)
    glPushMatrix()
    glLoadIdentity()
    draw_scene()
    glPopMatrix()
    glMatrixMode(GL_PROJECTION)
    glPopMatrix()
    glPopAttrib()


def make_shadow_map():
    matrix = lamp_matrix()
    draw_depths(matrix)
    glCopyTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT, 0, 0, SIZE, SIZE, 0)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_R_TO_TEXTURE)
    glClear(GL_DEPTH_BUFFER_BIT)
    for axis, plane in zip(AXES, BIAS @ matrix):
        glTexGenfv(axis, GL_EYE_PLANE, plane)


def on_key(window, key, scancode, action, mods):
    global lamp
    if key in (glfw.KEY_LEFT, glfw.KEY_RIGHT) and action != glfw.RELEASE:
        lamp += 5 if key == glfw.KEY_RIGHT else -5
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(640, 480, "A lamp and a stair", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    glEnable(GL_DEPTH_TEST)
    glBindTexture(GL_TEXTURE_2D, glGenTextures(1))
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR)
    for axis in AXES:
        glTexGeni(axis, GL_TEXTURE_GEN_MODE, GL_EYE_LINEAR)
    glBlendFunc(GL_ONE, GL_ONE)
    glDepthFunc(GL_LEQUAL)

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 40)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glTranslatef(0, -0.6, -12.8)
        glRotatef(28, 1, 0, 0)
        glRotatef(-20, 0, 1, 0)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        make_shadow_map()
        draw_lit()
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
