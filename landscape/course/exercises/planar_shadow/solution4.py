"""No matrix: each corner is moved along its ray from the lamp onto the floor."""
# exercise: planar_shadow
# the rest: start.py


def on_floor(x, y, z):
    """Return where the ray from the lamp through a point meets the floor."""
    lamp_x, lamp_y, lamp_z, _w = lamp
    way = (lamp_y + FLOOR[3]) / (lamp_y - y)
    return lamp_x + way * (x - lamp_x), -FLOOR[3], lamp_z + way * (z - lamp_z)


def draw_flat_table():
    """Draw all sides of the boxes, flattened onto the floor."""
    glBegin(GL_QUADS)
    for low, high, _color in BOXES:
        for axis in range(3):
            for side in (low, high):
                for first, second in ((low, low), (high, low), (high, high), (low, high)):
                    corner = [0, 0, 0]
                    corner[axis] = side[axis]
                    corner[(axis + 1) % 3] = first[(axis + 1) % 3]
                    corner[(axis + 2) % 3] = second[(axis + 2) % 3]
                    glVertex3f(*on_floor(*corner))
    glEnd()


def draw_shadow():
    glEnable(GL_BLEND)
    glEnable(GL_POLYGON_OFFSET_FILL)  # the shadow is a little nearer than the floor
    glColor4f(0, 0, 0, 0.5)
    glEnable(GL_STENCIL_TEST)
    glStencilFunc(GL_EQUAL, 1, 1)
    glStencilOp(GL_KEEP, GL_KEEP, GL_ZERO)
    draw_flat_table()
    glDisable(GL_STENCIL_TEST)
    glDisable(GL_POLYGON_OFFSET_FILL)
    glDisable(GL_BLEND)
