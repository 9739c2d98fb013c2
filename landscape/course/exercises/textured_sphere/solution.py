"""Texture coordinates from the angles, beside each vertex."""
# exercise: textured_sphere
# the rest: start.py


def draw_planet():
    for row in range(ROWS):
        glBegin(GL_QUAD_STRIP)
        for column in range(COLUMNS + 1):
            longitude = 2 * math.pi * column / COLUMNS
            for polar in (math.pi * row / ROWS, math.pi * (row + 1) / ROWS):
                x = math.sin(polar) * math.cos(longitude)
                y = math.cos(polar)
                z = -math.sin(polar) * math.sin(longitude)
                s = column / COLUMNS
                t = polar / math.pi
                glTexCoord2f(s, t)
                glNormal3f(x, y, z)
                glVertex3f(x, y, z)
        glEnd()
