"""A drag of the mouse that changes green and blue, with GLUT."""

import sys

from OpenGL.GL import *
from OpenGL.GLUT import *

green = blue = 0.5
mouse = 0, 0
dragging = False


def display():
    glClearColor(0, green, blue, 0)
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
    glutSwapBuffers()


def button(which, state, x, y):
    global dragging, mouse
    if which == GLUT_LEFT_BUTTON:
        dragging = state == GLUT_DOWN
        mouse = x, y


def motion(x, y):
    """Called for each move with a button down; y grows downwards."""
    global blue, green, mouse
    if dragging:
        blue = max(0, min(blue + 0.01 * (x - mouse[0]), 1))
        green = max(0, min(green - 0.01 * (y - mouse[1]), 1))
        mouse = x, y
        glutPostRedisplay()


def main():
    glutInit(sys.argv)
    glutInitDisplayMode(GLUT_RGBA | GLUT_DOUBLE | GLUT_DEPTH)
    glutInitWindowPosition(100, 100)
    glutInitWindowSize(400, 400)
    glutCreateWindow("The mouse")
    glEnable(GL_DEPTH_TEST)
    glutDisplayFunc(display)
    glutMouseFunc(button)
    glutMotionFunc(motion)
    glutMainLoop()


if __name__ == "__main__":
    main()
