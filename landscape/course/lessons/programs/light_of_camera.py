"""A teapot in a light that stays behind the viewer, with GLFW."""

import sys
from pathlib import Path

import glfw
import numpy as np
from OpenGL.GL import *
from OpenGL.GLU import gluLookAt, gluPerspective

PATCHES = np.loadtxt(Path(__file__).parents[1] / "data" / "teapot.txt").reshape(32, 4, 4, 3)


def solid_teapot(size):
    """As GLUT's: 32 patches, which OpenGL divides into quads, with normals."""
    glEnable(GL_MAP2_VERTEX_3)
    glEnable(GL_AUTO_NORMAL)
    glMapGrid2f(7, 0, 1, 7, 0, 1)
    for patch in PATCHES:
        glMap2f(GL_MAP2_VERTEX_3, 0, 1, 0, 1, size * patch)
        glEvalMesh2(GL_FILL, 0, 7, 0, 7)


def set_light():
    """Set a light at infinity, along the z axis of the frame that is current."""
    glLightfv(GL_LIGHT0, GL_DIFFUSE, (0.6, 0.6, 0.6, 1))
    glLightfv(GL_LIGHT0, GL_SPECULAR, (0.6, 0.6, 0.6, 1))
    glLightfv(GL_LIGHT0, GL_POSITION, (0, 0, 10, 0))


def set_material():
    glMaterialfv(GL_FRONT_AND_BACK, GL_DIFFUSE, (1, 1, 1, 1))
    glMaterialfv(GL_FRONT_AND_BACK, GL_SPECULAR, (1, 1, 1, 1))
    glMaterialf(GL_FRONT_AND_BACK, GL_SHININESS, 110)
    glMaterialfv(GL_FRONT_AND_BACK, GL_AMBIENT, (0.2, 0.2, 0.2, 1))


def display(window):
    glClearColor(1, 1, 1, 1)
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
    glPushMatrix()
    gluLookAt(8, 10, 15, 0, 0, 0, 0, 1, 0)
    set_material()
    solid_teapot(2)
    glPopMatrix()
    glfw.swap_buffers(window)


def reshape(window, width, height):
    """Called for a new size: the viewport, and the projection with its aspect."""
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    gluPerspective(20, width / max(height, 1), 0.01, 10000)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    set_light()  # before gluLookAt: along the camera's z axis


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(500, 500, "A lit teapot", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.set_window_pos(window, 100, 100)
    glfw.make_context_current(window)
    for capability in (GL_DEPTH_TEST, GL_LIGHTING, GL_LIGHT0):
        glEnable(capability)
    glLightModeli(GL_LIGHT_MODEL_LOCAL_VIEWER, True)
    glShadeModel(GL_SMOOTH)
    glEnable(GL_NORMALIZE)  # the patches' normals are not of length 1
    glfw.set_framebuffer_size_callback(window, reshape)
    glfw.set_window_refresh_callback(window, display)
    reshape(window, *glfw.get_framebuffer_size(window))  # GLFW does not call it for the first size

    while not glfw.window_should_close(window):
        display(window)
        glfw.wait_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
