"""Viewport and scissors on the corner, cleared to paper, and a view from above."""
# exercise: second_viewport
# the rest: start.py


def draw_map(width, height):
    """Draw the map in its corner, in a window of width x height pixels."""
    side = height // 3
    glViewport(16, 16, side, side)
    glScissor(16, 16, side, side)
    glEnable(GL_SCISSOR_TEST)
    glClearColor(*PAPER)
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
    glDisable(GL_SCISSOR_TEST)
    glClearColor(0.13, 0.16, 0.21, 1)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glOrtho(-6, 6, -6, 6, -2, 2)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glRotatef(90, 1, 0, 0)
    draw_maze()
    glViewport(0, 0, width, height)
