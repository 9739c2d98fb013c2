"""The plane in the tower's own coordinates, on only while the wall is drawn."""
# exercise: clip_plane
# the rest: start.py


def draw_tower():
    glPushMatrix()
    glTranslatef(0.4, 0, -1)
    glRotatef(turn, 0, 1, 0)
    glClipPlane(GL_CLIP_PLANE0, (0, 0, -1, 0.3))
    glEnable(GL_CLIP_PLANE0)
    draw_wall()
    glDisable(GL_CLIP_PLANE0)
    draw_stair()
    glPopMatrix()
