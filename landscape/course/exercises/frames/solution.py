"""A frame for the hub, and in it one for each cabin, turned back so that it hangs upright."""
# exercise: frames
# the rest: start.py


def draw_wheel(angle):
    glPushMatrix()
    glTranslatef(*HUB, 0)
    glRotatef(angle, 0, 0, 1)
    draw_rim()
    for number in range(8):
        glPushMatrix()
        glRotatef(45 * number, 0, 0, 1)
        glTranslatef(RADIUS, 0, 0)
        glRotatef(-45 * number - angle, 0, 0, 1)
        draw_cabin()
        glTranslatef(0.15, -0.9, 0)
        glScalef(0.45, 0.45, 1)
        draw_person()
        glPopMatrix()
    glPopMatrix()
