"""glPushMatrix and glPopMatrix around what must not move the rest."""
# exercise: matrix_stack
# the rest: start.py


def draw_arm():
    """Draw the arm from the base to the fingers."""
    glRotatef(turn, 0, 1, 0)
    draw_box(0, 0, 0, 1.8, 0.4, 1.8, (0.45, 0.47, 0.5))
    glTranslatef(0, 0.4, 0)
    glRotatef(20, 0, 0, 1)
    draw_box(0, 0, 0, 0.6, 2.2, 0.6, (0.85, 0.35, 0.2))
    glTranslatef(0, 2.2, 0)
    glRotatef(-bend, 0, 0, 1)
    draw_box(0, 0, 0, 0.5, 1.8, 0.5, (0.95, 0.62, 0.35))
    glTranslatef(0, 1.8, 0)
    draw_box(0, 0, 0, 1, 0.15, 0.5, (0.25, 0.6, 0.6))
    glPushMatrix()
    draw_finger(-1)
    glPopMatrix()
    draw_finger(1)


def draw_scene():
    draw_box(0, -0.2, 0, 6.5, 0.2, 4.5, (0.3, 0.35, 0.42))
    glPushMatrix()
    draw_arm()
    glPopMatrix()
    draw_lamp()
