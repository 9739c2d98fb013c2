"""No scissors: the paper is a rectangle, drawn as far away as can be."""
# exercise: second_viewport
# the rest: start.py


def draw_map(width, height):
    """Draw the map in its corner, in a window of width x height pixels."""
    side = height // 3
    glViewport(16, 16, side, side)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    draw_paper()
    glMatrixMode(GL_PROJECTION)
    glOrtho(-6, 6, -6, 6, -2, 2)
    glMatrixMode(GL_MODELVIEW)
    glRotatef(90, 1, 0, 0)
    draw_maze()
    glViewport(0, 0, width, height)


def draw_paper():
    """Fill the viewport, and make it as far away as can be, whatever is there."""
    glDepthFunc(GL_ALWAYS)
    glDepthRange(1, 1)
    glColor3f(*PAPER[:3])
    glRectf(-1, -1, 1, 1)
    glDepthRange(0, 1)
    glDepthFunc(GL_LESS)
