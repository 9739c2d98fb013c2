"""The three parts in immediate mode, each between its own glBegin and glEnd."""
# exercise: first_drawing
# the rest: start.py


def draw_hull():
    glColor3f(0.55, 0.33, 0.2)
    glBegin(GL_QUADS)
    glVertex2f(-0.6, -0.3)
    glVertex2f(0.6, -0.3)
    glVertex2f(0.4, -0.6)
    glVertex2f(-0.4, -0.6)
    glEnd()


def draw_sail():
    glBegin(GL_TRIANGLES)
    glColor3f(0.95, 0.9, 0.8)
    glVertex2f(0.05, -0.25)
    glColor3f(0.85, 0.35, 0.2)
    glVertex2f(0.05, 0.75)
    glColor3f(0.3, 0.5, 0.8)
    glVertex2f(0.6, -0.25)
    glEnd()


def draw_pennant():
    glColor3f(0.95, 0.62, 0.35)
    glBegin(GL_TRIANGLES)
    glVertex2f(0.05, 0.78)
    glVertex2f(0.05, 0.92)
    glVertex2f(-0.25, 0.85)
    glEnd()
