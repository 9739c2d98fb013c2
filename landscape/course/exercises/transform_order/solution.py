"""Turn first, then move: the moon in the frame of its planet."""
# exercise: transform_order
# the rest: start.py


def draw_system(year, month):
    """Draw sun, planet and moon; angles in degrees."""
    draw_ball(1.3, (0.95, 0.62, 0.35))
    glPushMatrix()
    glRotatef(year, 0, 1, 0)
    glTranslatef(4.2, 0, 0)
    draw_ball(0.6, (0.3, 0.5, 0.8))
    glRotatef(month, 0, 1, 0)
    glTranslatef(1.3, 0, 0)
    draw_ball(0.25, (0.95, 0.9, 0.8))
    glPopMatrix()
