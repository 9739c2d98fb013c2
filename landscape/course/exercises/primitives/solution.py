"""One kind of primitive for each thing."""
# exercise: primitives
# the rest: start.py


def draw_trees():
    glColor3f(0.25, 0.5, 0.42)
    draw_vertices(GL_TRIANGLES, TREES)


def draw_fence():
    glColor3f(0.95, 0.9, 0.8)
    draw_vertices(GL_LINES, FENCE)


def draw_path():
    glColor3f(0.95, 0.62, 0.35)
    draw_vertices(GL_LINE_STRIP, PATH)


def draw_pond():
    glColor3f(0.5, 0.75, 0.9)
    draw_vertices(GL_LINE_LOOP, POND)


def draw_hill():
    glColor3f(0.2, 0.35, 0.4)
    draw_vertices(GL_TRIANGLE_STRIP, HILL)


def draw_sun():
    glColor3f(0.85, 0.35, 0.2)
    draw_vertices(GL_TRIANGLE_FAN, [*SUN, SUN[1]])
