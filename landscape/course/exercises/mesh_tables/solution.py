"""The table of faces by hand, drawn in immediate mode."""
# exercise: mesh_tables
# the rest: start.py

FACES = (
    *((3, 0, 4), (0, 1, 4), (1, 2, 4), (2, 3, 4)),
    *((0, 3, 5), (1, 0, 5), (2, 1, 5), (3, 2, 5)),
)


def draw_gem():
    glBegin(GL_TRIANGLES)
    for face in FACES:
        corners = [VERTICES[number] for number in face]
        glColor3f(*color_of(corners))
        for corner in corners:
            glVertex3f(*corner)
    glEnd()
