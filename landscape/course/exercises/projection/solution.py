"""Two rotations of the camera written out, and the division by the depth."""
# exercise: projection
# the rest: start.py

import math


def into_camera(x, y, z):
    """Return how far a point is ahead, to the right and above, in the frame of the camera."""
    east = x - eye[0]
    north = y - eye[1]
    above = z - eye[2]
    cos = math.cos(math.radians(turned))
    sin = math.sin(math.radians(turned))
    level = cos * east + sin * north
    right = sin * east - cos * north
    cos = math.cos(math.radians(tilted))
    sin = math.sin(math.radians(tilted))
    ahead = cos * level + sin * above
    up = cos * above - sin * level
    return ahead, right, up


def to_pixel(ahead, right, up):
    """Return the column and the row of a point of the camera's frame, or None."""
    if ahead < NEAR:
        return None
    column = WIDTH / 2 + FOCAL * right / ahead
    row = HEIGHT / 2 - FOCAL * up / ahead
    return math.floor(column), math.floor(row)
