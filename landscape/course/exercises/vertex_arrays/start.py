"""Vertex arrays: a vase in one call

The vase is drawn in immediate mode: Python calls OpenGL for every corner of every triangle, three
times each, in every frame. Draw it from the arrays instead, with one call, and without glBegin.

The arrays are there already. VERTICES has x, y, z of each vertex, and NORMALS its normal, both in
32-bit floating-point numbers. COLORS has red, green, blue and alpha of each vertex, a byte each.
TRIANGLES has the indices of the three corners of each triangle, in 32-bit unsigned integers.

Change draw_vase, and what is needed before it. The picture stays as it is, and draw_table, too.
"""
# exercise: vertex_arrays
# lessons: vertex_arrays

import sys

import glfw
import numpy as np
from OpenGL.GL import *

ROWS = 20
SIDES = 32


def make_vase():
    """Return the vertices, the normals and the colors, a row each, and the triangles."""
    v, u = np.mgrid[0 : ROWS + 1, 0:SIDES]
    y = v / ROWS * 3
    angle = u * 2 * np.pi / SIDES
    radius = 0.75 + 0.35 * np.sin(1.9 * y - 0.4) + 0.06 * np.cos(8 * angle)
    slope = 0.35 * 1.9 * np.cos(1.9 * y - 0.4)
    x = np.sin(angle)
    z = np.cos(angle)
    vertices = np.stack((radius * x, y, radius * z), -1).reshape(-1, 3)
    normals = np.stack((x, -slope, z), -1).reshape(-1, 3)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    warm = np.array((217, 89, 51, 255))
    cold = np.array((242, 190, 110, 255))
    mix = (0.5 + 0.5 * np.cos(4 * np.pi * v / ROWS + 4 * angle))[..., None]
    colors = (mix * warm + (1 - mix) * cold).reshape(-1, 4)
    first = (v[:-1] * SIDES + u[:-1]).ravel()
    second = (v[:-1] * SIDES + (u[:-1] + 1) % SIDES).ravel()
    above = first + SIDES, second + SIDES
    triangles = np.stack((first, second, above[1], first, above[1], above[0]), -1).reshape(-1, 3)
    return (
        vertices.astype(np.float32),
        normals.astype(np.float32),
        colors.astype(np.uint8),
        triangles.astype(np.uint32),
    )


VERTICES, NORMALS, COLORS, TRIANGLES = make_vase()


def draw_vase():
    # Your code goes here.
    glBegin(GL_TRIANGLES)
    for triangle in TRIANGLES:
        for index in triangle:
            glColor4ubv(COLORS[index])
            glNormal3fv(NORMALS[index])
            glVertex3fv(VERTICES[index])
    glEnd()


def draw_table():
    glBegin(GL_TRIANGLE_FAN)
    glNormal3f(0, 1, 0)
    glColor3f(0.3, 0.36, 0.42)
    for step in range(48):
        angle = 2 * np.pi * step / 48
        glVertex3f(2.2 * np.sin(angle), 0, 2.2 * np.cos(angle))
    glEnd()


def on_key(window, key, scancode, action, mods):
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(640, 480, "A vase in one call", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    for capability in (GL_DEPTH_TEST, GL_LIGHTING, GL_LIGHT0, GL_COLOR_MATERIAL):
        glEnable(capability)
    glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, GL_TRUE)  # you see into the vase
    glLightfv(GL_LIGHT0, GL_POSITION, (-2, 3, 3, 0))

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 50)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glTranslatef(0, -0.9, -9)
        glRotatef(25, 1, 0, 0)
        glRotatef(30 * glfw.get_time(), 0, 1, 0)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        draw_vase()
        draw_table()
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
