"""Each tree turned by the angle to the eye; the alpha test leaves out what is transparent."""
# exercise: billboard
# the rest: start.py


def draw_tree(x, z):
    """Draw a tree that stands on the point x, 0, z."""
    glPushMatrix()
    glTranslatef(x, 0, z)
    eye_x, eye_z = eye()
    glRotatef(math.degrees(math.atan2(z - eye_z, eye_x - x)), 0, 1, 0)
    glBegin(GL_QUADS)
    for s, t in ((0, 1), (1, 1), (1, 0), (0, 0)):
        glTexCoord2f(s, t)
        glVertex3f(0, 2.2 * (1 - t), 2.2 * (0.5 - s))
    glEnd()
    glPopMatrix()


def draw_orchard():
    glBegin(GL_TRIANGLE_FAN)
    glColor3f(0.62, 0.72, 0.4)
    glVertex3f(0, 0, 0)
    glColor3f(0.45, 0.58, 0.32)
    for step in range(49):
        glVertex3f(5 * math.cos(step * math.pi / 24), 0, -5 * math.sin(step * math.pi / 24))
    glEnd()
    glEnable(GL_TEXTURE_2D)
    glEnable(GL_ALPHA_TEST)  # leaves out what is transparent in the picture
    glColor3f(1, 1, 1)
    for x, z in TREES:
        draw_tree(x, z)
    glDisable(GL_ALPHA_TEST)
    glDisable(GL_TEXTURE_2D)
