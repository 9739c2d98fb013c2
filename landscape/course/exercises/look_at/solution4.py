"""Three rotations, whose angles follow from the direction of sight."""
# exercise: look_at
# the rest: start.py

import math


def look(eye, target, up):
    """Move the world into the frame of a camera; three arrays x, y, z."""
    x, y, z = eye - target
    around = math.degrees(math.atan2(x, z))
    above = math.degrees(math.atan2(y, math.hypot(x, z)))
    # Where up points to in the picture of a camera that does not lean.
    glPushMatrix()
    glLoadIdentity()
    glRotatef(above, 1, 0, 0)
    glRotatef(-around, 0, 1, 0)
    to_the_right, upward, *_ = glGetFloatv(GL_MODELVIEW_MATRIX).T @ (*up, 0)
    glPopMatrix()
    glRotatef(math.degrees(math.atan2(to_the_right, upward)), 0, 0, 1)
    glRotatef(above, 1, 0, 0)
    glRotatef(-around, 0, 1, 0)
    glTranslatef(-eye[0], -eye[1], -eye[2])
