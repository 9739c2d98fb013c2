"""Points with w = 2; the rotation by its columns, the axes of the turned frame."""
# exercise: homogeneous
# the rest: start.py


def point(x, y, z):
    """Return the homogeneous coordinates of a point."""
    return np.array((2 * x, 2 * y, 2 * z, 2))  # the same point


def translation(x, y, z):
    """Return the matrix of a translation."""
    return np.vstack((np.hstack((np.identity(3), [[x], [y], [z]])), (0, 0, 0, 1)))


def rotation(angle):
    """Return the matrix of a rotation around the y axis by an angle in degrees."""
    # The axes of the turned frame are the columns.
    turn = np.exp(1j * np.radians(angle))
    right = (turn.real, 0, -turn.imag)
    up = (0, 1, 0)
    back = (turn.imag, 0, turn.real)
    matrix = np.identity(4)
    matrix[:3, :3] = np.transpose((right, up, back))
    return matrix


def cartesian(place):
    """Return the coordinates x, y, z of a point that is given by four numbers."""
    return [number / place[-1] for number in place]
