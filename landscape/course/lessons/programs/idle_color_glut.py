"""A background that changes by itself, with GLUT: the idle function is called between events."""

import math
import sys

from OpenGL.GL import *
from OpenGL.GLUT import *

SPEED = 0.1
step = 0


def display():
    glClearColor(0, 0.5, math.sin(SPEED * step), 0)  # OpenGL takes 0 for what is below it
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
    glutSwapBuffers()


def idle():
    global step
    step += 1
    glutPostRedisplay()


def main():
    glutInit(sys.argv)
    glutInitDisplayMode(GLUT_RGBA | GLUT_DOUBLE | GLUT_DEPTH)
    glutInitWindowPosition(100, 100)
    glutInitWindowSize(400, 400)
    glutCreateWindow("Animation")
    glEnable(GL_DEPTH_TEST)
    glutDisplayFunc(display)
    glutIdleFunc(idle)
    glutMainLoop()


if __name__ == "__main__":
    main()
