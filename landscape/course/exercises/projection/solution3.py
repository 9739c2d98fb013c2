"""The rotations as products of complex numbers."""
# exercise: projection
# the rest: start.py


def turn_by(degrees):
    """Return the number that turns another one, if it is multiplied with it."""
    return np.exp(1j * np.radians(degrees))


def into_camera(x, y, z):
    """Return how far a point is ahead, to the right and above, in the frame of the camera."""
    around = complex(x - eye[0], y - eye[1]) * turn_by(-turned)
    upward = complex(around.real, z - eye[2]) * turn_by(-tilted)
    return upward.real, -around.imag, upward.imag


def to_pixel(ahead, right, up):
    """Return the column and the row of a point of the camera's frame, or None."""
    # Seen from behind, or from beside, there is nothing to divide by.
    if ahead < NEAR:
        return None
    return np.floor((WIDTH / 2 + FOCAL * right / ahead, HEIGHT / 2 - FOCAL * up / ahead)).astype(
        int
    )
