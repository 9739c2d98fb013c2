"""The curve as a product of matrices; each photograph at the nearest point of the way."""
# exercise: bezier_path
# the rest: start.py


def bezier(a, b, c, d, t):
    """Return the point of a curve with four control points, for t from 0 to 1."""
    powers = np.array((1, t, t**2, t**3))
    basis = np.array(((1, 0, 0, 0), (-3, 3, 0, 0), (3, -6, 3, 0), (-1, 3, -3, 1)))
    return powers @ basis @ (a, b, c, d)


def photographs(points):
    """Return the numbers of COUNT points that lie equally far from each other along a path."""
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    along = np.concatenate(([0], np.cumsum(steps)))
    places = along[-1] * np.arange(COUNT) / (COUNT - 1)
    return [int(np.abs(along - place).argmin()) for place in places]
