"""No rotation: the quad's corners lie along the vector at right angles to the sight."""
# exercise: billboard
# the rest: start.py


def draw_tree(x, z):
    """Draw a tree that stands on the point x, 0, z."""
    glPushMatrix()
    glTranslatef(x, 0, z)
    # The unit vector to the eye, and the one to the right of it, which the quad follows.
    distance = math.dist((x, z), eye())
    to_x = (eye()[0] - x) / distance
    to_z = (eye()[1] - z) / distance
    right_x = to_z
    right_z = -to_x
    glBegin(GL_QUADS)
    for s, t in ((0, 1), (1, 1), (1, 0), (0, 0)):
        across = 2.2 * (s - 0.5)
        glTexCoord2f(s, t)
        glVertex3f(across * right_x, 2.2 * (1 - t), across * right_z)
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
