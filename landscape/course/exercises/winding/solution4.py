"""No table: a loop around the ring, the other way round below."""
# exercise: winding
# the rest: start.py
# without: FACES

COLORS = RED, ORANGE, CREAM, GREEN, BLUE, VIOLET  # of the faces from each point of the ring


def draw_gem():
    """Draw a fan around the point above, and one around the point below, the other way round."""
    for middle, shade, step in ((TOP, 1, 1), (BOTTOM, 0.62, -1)):
        ring = list(range(0, 7 * step, step))
        for first, second in zip(ring, ring[1:]):
            color = COLORS[min(first, second) % 6]
            glColor3f(*(shade * channel for channel in color))
            glBegin(GL_TRIANGLE_FAN)
            for number in (middle, first % 6, second % 6):
                glVertex3f(*point(number))
            glEnd()
