# Another way to solve it, without a matrix: the tests must let it pass, too. Write as many of these
# as you can think of: solution3.py, solution4.py. Each may be a whole program, or, by the line
# `# the rest` as here, only what is not as in start.py; `# without` names what it has not at all.
# exercise: clock_hand
# the rest: start.py
# without: draw_hand


def draw_scene():
    draw_dial()
    angle = math.radians(turned)
    glColor3f(0.85, 0.35, 0.2)
    glBegin(GL_TRIANGLES)
    for x, y in ((-0.06, 0), (0.06, 0), (0, 0.5)):
        glVertex2f(
            DIAL[0] + math.cos(angle) * x + math.sin(angle) * y,
            DIAL[1] - math.sin(angle) * x + math.cos(angle) * y,
        )
    glEnd()
    draw_mark()
