"""Coordinates from 0 to 1, scaled by the texture matrix."""
# exercise: texture_coordinates
# the rest: start.py

COORDINATES = ((0, 0), (1, 0), (1, 1), (0, 1))


def make_texture():
    texture = glGenTextures(1)
    glBindTexture(GL_TEXTURE_2D, texture)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP)
    data = bytes(channel for row in IMAGE for letter in row for channel in COLORS[letter])
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 16, 16, 0, GL_RGB, GL_UNSIGNED_BYTE, data)


def draw_wall():
    glEnable(GL_TEXTURE_2D)
    glColor3f(1, 1, 1)
    # Three pictures side by side, and the first row of each at the top.
    glMatrixMode(GL_TEXTURE)
    glPushMatrix()
    glTranslatef(0, 1, 0)
    glScalef(3, -1, 1)
    glBegin(GL_QUADS)
    for (s, t), (x, y) in zip(COORDINATES, CORNERS):
        glTexCoord2f(s, t)
        glVertex3f(x, y, 0)
    glEnd()
    glPopMatrix()
    glMatrixMode(GL_MODELVIEW)
    glDisable(GL_TEXTURE_2D)
    glColor3f(0.95, 0.62, 0.35)
    for y in (-1.15, 1):
        glRectf(-3.15, y, 3.15, y + 0.15)
