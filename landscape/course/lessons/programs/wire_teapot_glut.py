"""A teapot in lines, seen by gluLookAt, with GLUT, which has the teapot."""

import sys

from OpenGL.GL import *
from OpenGL.GLU import gluLookAt, gluPerspective
from OpenGL.GLUT import *


def display():
    glClearColor(1, 1, 1, 1)
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    gluLookAt(10, 10, 10, 0, 0, 0, 0, 1, 0)
    glColor3f(0, 0, 0)
    glutWireTeapot(5)
    glutSwapBuffers()


def reshape(width, height):
    """Called for a new size: the viewport, and the projection with its aspect."""
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    gluPerspective(45, width / max(height, 1), 0.01, 10000)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()


def main():
    glutInit(sys.argv)
    glutInitDisplayMode(GLUT_RGBA | GLUT_DOUBLE | GLUT_DEPTH)
    glutInitWindowPosition(100, 100)
    glutInitWindowSize(400, 400)
    glutCreateWindow("The teapot")
    glEnable(GL_DEPTH_TEST)
    glutDisplayFunc(display)
    glutReshapeFunc(reshape)
    glutMainLoop()


if __name__ == "__main__":
    main()
