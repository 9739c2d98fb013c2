"""Keys that make a grey lighter or darker, with GLUT: characters and special keys; q ends it."""

import sys

from OpenGL.GL import *
from OpenGL.GLUT import *

grey = 0.5


def display():
    glClearColor(grey, grey, grey, 0)
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
    glutSwapBuffers()


def special(key, x, y):
    """Called for keys that type no character; x and y are where the mouse is."""
    global grey
    if key == GLUT_KEY_LEFT:
        grey = max(grey - 0.05, 0)
    elif key == GLUT_KEY_RIGHT:
        grey = min(grey + 0.05, 1)
    glutPostRedisplay()


def keyboard(key, x, y):
    if key == b"q":
        glutLeaveMainLoop()


def main():
    glutInit(sys.argv)
    glutInitDisplayMode(GLUT_RGBA | GLUT_DOUBLE | GLUT_DEPTH)
    glutInitWindowPosition(100, 100)
    glutInitWindowSize(400, 400)
    glutCreateWindow("Keys")
    glEnable(GL_DEPTH_TEST)
    glutDisplayFunc(display)
    glutKeyboardFunc(keyboard)
    glutSpecialFunc(special)
    glutMainLoop()


if __name__ == "__main__":
    main()
