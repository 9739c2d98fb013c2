"""The view from above as one matrix; the state kept on the attribute stack."""
# exercise: second_viewport
# the rest: start.py


def draw_map(width, height):
    """Draw the map in its corner, in a window of width x height pixels."""
    square = 16, 16, height // 3, height // 3
    glPushAttrib(GL_VIEWPORT_BIT | GL_SCISSOR_BIT | GL_COLOR_BUFFER_BIT)
    glViewport(*square)
    glScissor(*square)
    glEnable(GL_SCISSOR_TEST)
    glClearColor(*PAPER)
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
    glMatrixMode(GL_PROJECTION)
    # x to the right, z downward, and y to the viewer: the three axes divided by their reach.
    glLoadMatrixf((1 / 6, 0, 0, 0, 0, 0, -1 / 3, 0, 0, -1 / 6, 0, 0, 0, 0, 0, 1))
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    draw_maze()
    glPopAttrib()
