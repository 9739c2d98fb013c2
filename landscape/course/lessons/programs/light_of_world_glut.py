"""A teapot in a light that stays in the world, with GLUT."""

import sys

from OpenGL.GL import *
from OpenGL.GLU import gluLookAt, gluPerspective
from OpenGL.GLUT import *


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


def display():
    glClearColor(1, 1, 1, 1)
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
    glPushMatrix()
    gluLookAt(8, 10, 15, 0, 0, 0, 0, 1, 0)
    set_light()  # after gluLookAt: along the world's z axis
    set_material()
    glutSolidTeapot(2)
    glPopMatrix()
    glutSwapBuffers()


def reshape(width, height):
    """Called for a new size: the viewport, and the projection with its aspect."""
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    gluPerspective(20, width / max(height, 1), 0.01, 10000)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()


def main():
    glutInit(sys.argv)
    glutInitDisplayMode(GLUT_RGBA | GLUT_DOUBLE | GLUT_DEPTH)
    glutInitWindowPosition(100, 100)
    glutInitWindowSize(500, 500)
    glutCreateWindow("A lit teapot")
    for capability in (GL_DEPTH_TEST, GL_LIGHTING, GL_LIGHT0):
        glEnable(capability)
    glLightModeli(GL_LIGHT_MODEL_LOCAL_VIEWER, True)
    glShadeModel(GL_SMOOTH)
    glutDisplayFunc(display)
    glutReshapeFunc(reshape)
    glutMainLoop()


if __name__ == "__main__":
    main()
