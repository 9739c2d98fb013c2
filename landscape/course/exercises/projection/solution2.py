"""The rotations as two matrices."""
# exercise: projection
# the rest: start.py


def into_camera(x, y, z):
    """Return how far a point is ahead, to the right and above, in the frame of the camera."""
    turn, tilt = np.radians((turned, tilted))
    cos = np.cos(turn)
    sin = np.sin(turn)
    around = np.array(((cos, sin, 0), (sin, -cos, 0), (0, 0, 1)))
    cos = np.cos(tilt)
    sin = np.sin(tilt)
    upward = np.array(((cos, 0, sin), (0, 1, 0), (-sin, 0, cos)))
    return upward @ around @ np.subtract((x, y, z), eye)


def to_pixel(ahead, right, up):
    """Return the column and the row of a point of the camera's frame, or None."""
    if ahead >= NEAR:
        size = FOCAL / ahead
        return int(WIDTH / 2 + size * right), int(HEIGHT / 2 - size * up)
