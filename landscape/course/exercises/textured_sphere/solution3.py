"""gluSphere with its own coordinates, put right by the texture matrix."""
# exercise: textured_sphere
# the rest: start.py
# without: import math

from OpenGL.GLU import *


def draw_planet():
    quadric = gluNewQuadric()
    gluQuadricTexture(quadric, GL_TRUE)
    # Its poles are on the z axis, and t is 0 at the lower one.
    glMatrixMode(GL_TEXTURE)
    glTranslatef(0, 1, 0)
    glScalef(1, -1, 1)
    glMatrixMode(GL_MODELVIEW)
    glPushMatrix()
    glRotatef(-90, 0, 1, 0)
    glRotatef(-90, 1, 0, 0)
    gluSphere(quadric, 1, COLUMNS, ROWS)
    glPopMatrix()
    glMatrixMode(GL_TEXTURE)
    glLoadIdentity()
    glMatrixMode(GL_MODELVIEW)
    gluDeleteQuadric(quadric)
