"""The smallest window, with GLUT: it is opened, and closed by its button."""

import sys

from OpenGL.GL import *
from OpenGL.GLUT import *


def display():
    """Do nothing: freeglut, as GLUT is now, ends a program without this function."""
    glutSwapBuffers()


def main():
    glutInit(sys.argv)
    glutInitDisplayMode(GLUT_RGBA | GLUT_DOUBLE | GLUT_DEPTH)
    glutInitWindowPosition(100, 100)
    glutInitWindowSize(400, 400)
    glutCreateWindow("A window")
    glEnable(GL_DEPTH_TEST)
    glutDisplayFunc(display)
    glutMainLoop()


if __name__ == "__main__":
    main()
