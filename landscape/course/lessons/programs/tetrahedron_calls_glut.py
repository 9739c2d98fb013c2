"""A tetrahedron of mixed colours by a call for each corner, with GLUT."""

import sys

from OpenGL.GL import *
from OpenGL.GLU import gluPerspective
from OpenGL.GLUT import *

VERTICES = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
COLORS = [[0, 0, 0], [0.7, 0.5, 0.2], [0.5, 0.7, 0.9], [0.6, 1, 0.6]]
FACES = [0, 1, 2, 0, 1, 3, 0, 2, 3, 1, 2, 3]


def draw_tetrahedron():
    """Name each corner of each face: 2 calls for each of 12 corners."""
    glBegin(GL_TRIANGLES)
    for vertex in FACES:
        glColor3fv(COLORS[vertex])
        glVertex3fv(VERTICES[vertex])
    glEnd()


def display():
    glClearColor(1, 1, 1, 1)
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
    glPushMatrix()
    glTranslatef(-0.2, -0.2, -4)
    glRotatef(-30, 1, 0, 0)
    glRotatef(120, 0, 1, 0)
    draw_tetrahedron()
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
    glutCreateWindow("A tetrahedron")
    glEnable(GL_DEPTH_TEST)
    glutDisplayFunc(display)
    glutReshapeFunc(reshape)
    glutMainLoop()


if __name__ == "__main__":
    main()
