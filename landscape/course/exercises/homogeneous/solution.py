"""The matrices written out, row by row."""
# exercise: homogeneous
# the rest: start.py


def point(x, y, z):
    """Return the homogeneous coordinates of a point."""
    return np.array((x, y, z, 1))


def translation(x, y, z):
    """Return the matrix of a translation."""
    return np.array(((1, 0, 0, x), (0, 1, 0, y), (0, 0, 1, z), (0, 0, 0, 1)))


def rotation(angle):
    """Return the matrix of a rotation around the y axis by an angle in degrees."""
    cos = np.cos(np.radians(angle))
    sin = np.sin(np.radians(angle))
    return np.array(((cos, 0, sin, 0), (0, 1, 0, 0), (-sin, 0, cos, 0), (0, 0, 0, 1)))


def cartesian(place):
    """Return the coordinates x, y, z of a point that is given by four numbers."""
    x, y, z, w = place
    return x / w, y / w, z / w
