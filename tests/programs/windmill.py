"""A windmill on a hill at dusk. A timer turns its sails; + and - change the wind."""

import math
import sys

from OpenGL.GL import *
from OpenGL.GLU import *
from OpenGL.GLUT import *

sails = 20.0
wind = 2.0


def draw_sky():
    """A gradient behind everything, and a sun low over the horizon."""
    glMatrixMode(GL_PROJECTION)
    glPushMatrix()
    glLoadIdentity()
    gluOrtho2D(0, 1, 0, 1)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glDisable(GL_DEPTH_TEST)
    glDisable(GL_LIGHTING)

    glBegin(GL_QUADS)
    glColor3f(0.98, 0.62, 0.35)
    glVertex2f(0, 0)
    glVertex2f(1, 0)
    glColor3f(0.20, 0.22, 0.45)
    glVertex2f(1, 1)
    glVertex2f(0, 1)
    glEnd()

    glBegin(GL_TRIANGLE_FAN)
    glColor3f(1.0, 0.95, 0.7)
    glVertex2f(0.24, 0.42)
    glColor3f(1.0, 0.75, 0.4)
    for i in range(33):
        a = i * math.pi / 16
        glVertex2f(0.24 + 0.06 * math.cos(a), 0.42 + 0.08 * math.sin(a))
    glEnd()

    glEnable(GL_LIGHTING)
    glEnable(GL_DEPTH_TEST)
    glMatrixMode(GL_PROJECTION)
    glPopMatrix()
    glMatrixMode(GL_MODELVIEW)


def draw_hill():
    glColor3f(0.25, 0.42, 0.18)
    glPushMatrix()
    glTranslatef(0, -9, 0)
    quadric = gluNewQuadric()
    gluSphere(quadric, 8.2, 32, 16)
    gluDeleteQuadric(quadric)
    glPopMatrix()


def draw_mill():
    quadric = gluNewQuadric()
    glPushMatrix()
    glTranslatef(0, -0.9, 0)
    glRotatef(-90, 1, 0, 0)
    glColor3f(0.85, 0.8, 0.72)
    gluCylinder(quadric, 0.62, 0.42, 2.0, 24, 4)
    glTranslatef(0, 0, 2.0)
    glColor3f(0.55, 0.18, 0.12)
    gluCylinder(quadric, 0.52, 0.0, 0.6, 24, 1)
    glPopMatrix()
    gluDeleteQuadric(quadric)

    glColor3f(0.95, 0.93, 0.88)
    glPushMatrix()
    glTranslatef(0, 1.0, 0.55)
    glRotatef(sails, 0, 0, 1)
    glNormal3f(0, 0, 1)
    for i in range(4):
        glRotatef(90, 0, 0, 1)
        glBegin(GL_TRIANGLES)
        glVertex3f(0, 0, 0)
        glVertex3f(0.34, 1.5, 0)
        glVertex3f(-0.02, 1.5, 0)
        glEnd()
    glPopMatrix()


def display():
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
    draw_sky()
    glLoadIdentity()
    gluLookAt(2.2, 0.9, 6.5, 0, 0.6, 0, 0, 1, 0)
    glLightfv(GL_LIGHT0, GL_POSITION, [-4, 3, 5, 0])
    draw_hill()
    draw_mill()
    glutSwapBuffers()


def reshape(width, height):
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    gluPerspective(40, width / height, 0.5, 50)
    glMatrixMode(GL_MODELVIEW)


def turn(value):
    global sails
    sails += wind
    glutPostRedisplay()
    glutTimerFunc(20, turn, 0)


def keyboard(key, x, y):
    global wind
    if key == b"+":
        wind += 1
    elif key == b"-":
        wind -= 1
    elif key == b"\x1b":
        sys.exit()


glutInit(sys.argv)
glutInitDisplayMode(GLUT_DOUBLE | GLUT_RGB | GLUT_DEPTH)
glutInitWindowSize(400, 300)
glutCreateWindow(b"Windmill")
glEnable(GL_DEPTH_TEST)
glEnable(GL_LIGHTING)
glEnable(GL_LIGHT0)
glEnable(GL_COLOR_MATERIAL)
glutDisplayFunc(display)
glutReshapeFunc(reshape)
glutKeyboardFunc(keyboard)
glutTimerFunc(20, turn, 0)
glutMainLoop()
