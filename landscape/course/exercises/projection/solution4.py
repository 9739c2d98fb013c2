"""The camera's axes and scalar products; the picture by a homogeneous matrix."""
# exercise: projection
# the rest: start.py

import math


def into_camera(x, y, z):
    """Return how far a point is ahead, to the right and above, in the frame of the camera."""
    # The axes of the camera, and how far the point lies along each.
    turn = math.radians(turned)
    tilt = math.radians(tilted)
    forward = (
        math.cos(tilt) * math.cos(turn),
        math.cos(tilt) * math.sin(turn),
        math.sin(tilt),
    )
    to_the_right = math.sin(turn), -math.cos(turn), 0
    upward = np.cross(to_the_right, forward)
    way = [coordinate - of_eye for coordinate, of_eye in zip((x, y, z), eye)]
    return [sum(a * b for a, b in zip(axis, way)) for axis in (forward, to_the_right, upward)]


def to_pixel(ahead, right, up):
    """Return the column and the row of a point of the camera's frame, or None."""
    matrix = np.array(((WIDTH / 2, FOCAL, 0), (HEIGHT / 2, 0, -FOCAL), (1, 0, 0)))
    column, row, w = matrix @ (ahead, right, up)
    return None if w < NEAR else (int(column // w), int(row // w))
