"""The places by sine and cosine; only translations are left to OpenGL."""
# exercise: transform_order
# the rest: start.py


def draw_system(year, month):
    """Draw sun, planet and moon; angles in degrees."""
    draw_ball(1.3, (0.95, 0.62, 0.35))
    x, z = turned(4.2, year)
    glPushMatrix()
    glTranslatef(x, 0, z)
    draw_ball(0.6, (0.3, 0.5, 0.8))
    glPopMatrix()
    moon_x, moon_z = turned(1.3, year + month)
    glPushMatrix()
    glTranslatef(x + moon_x, 0, z + moon_z)
    draw_ball(0.25, (0.95, 0.9, 0.8))
    glPopMatrix()


def turned(distance, angle):
    """Return x and z of a point at a distance from the y axis, at an angle in degrees."""
    return distance * math.cos(math.radians(angle)), -distance * math.sin(math.radians(angle))
