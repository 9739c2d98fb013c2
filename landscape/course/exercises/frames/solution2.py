"""A context manager as frame; the cabins' places by sine and cosine, so that nothing turns back."""
# exercise: frames
# the rest: start.py

from contextlib import contextmanager


@contextmanager
def frame():
    """What is drawn in it has a frame of its own."""
    glPushMatrix()
    yield
    glPopMatrix()


def draw_wheel(angle):
    with frame():
        glTranslatef(HUB[0], HUB[1], 0)
        with frame():
            glRotatef(angle, 0, 0, 1)
            draw_rim()
        for number in range(8):
            with frame():
                around = math.radians(angle + 45 * number)
                glTranslatef(RADIUS * math.cos(around), RADIUS * math.sin(around), 0)
                draw_cabin()
                with frame():
                    glTranslatef(0.15, -0.9, 0)
                    glScalef(0.45, 0.45, 0.45)
                    draw_person()
