"""The plane turned by hand, in coordinates that do not turn, with GL_CLIP_PLANE3."""
# exercise: clip_plane
# the rest: start.py


def draw_tower():
    glPushMatrix()
    glTranslatef(0.4, 0, -1)
    # The plane, turned like the tower, in coordinates that do not turn.
    angle = math.radians(turn)
    glClipPlane(GL_CLIP_PLANE3, (-2 * math.sin(angle), 0, -2 * math.cos(angle), 0.6))
    glRotatef(turn, 0, 1, 0)
    draw_stair()
    glPushAttrib(GL_ENABLE_BIT)
    glEnable(GL_CLIP_PLANE3)
    draw_wall()
    glPopAttrib()
    glPopMatrix()
