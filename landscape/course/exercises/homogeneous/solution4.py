"""OpenGL makes the matrices, and they are read back."""
# exercise: homogeneous
# the rest: start.py


def point(x, y, z):
    """Return the homogeneous coordinates of a point."""
    return np.array((x, y, z, 1))


def matrix_of(function, *numbers):
    """Let OpenGL make the matrix; it hands matrices out by columns."""
    glPushMatrix()
    glLoadIdentity()
    function(*numbers)
    matrix = glGetDoublev(GL_MODELVIEW_MATRIX).T
    glPopMatrix()
    return matrix


def translation(x, y, z):
    """Return the matrix of a translation."""
    return matrix_of(glTranslatef, x, y, z)


def rotation(angle):
    """Return the matrix of a rotation around the y axis by an angle in degrees."""
    return matrix_of(glRotatef, angle, 0, 1, 0)


def cartesian(place):
    """Return the coordinates x, y, z of a point that is given by four numbers."""
    return np.divide(place, place[3])


def draw():
    camera = PROJECTION @ translation(0, 0, walked)
    glColor3f(0.6, 0.65, 0.7)
    glBegin(GL_LINES)
    for x in (-1, 1):
        draw_line(camera, point(x, -1, -1.5), FAR)
    glEnd()
    for place, angle, color in HOUSES:
        glColor3f(*color)
        matrix = camera @ translation(*place) @ rotation(angle + turned)
        glBegin(GL_LINES)
        draw_house(matrix)
        glEnd()
