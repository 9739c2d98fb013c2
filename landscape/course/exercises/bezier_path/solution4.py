"""De Casteljau's construction as a loop; photographs by interpolation along the way."""
# exercise: bezier_path
# the rest: start.py


def bezier(a, b, c, d, t):
    """Return the point of a curve with four control points, for t from 0 to 1."""
    controls = [a, b, c, d]
    while len(controls) > 1:
        controls = [(1 - t) * one + t * other for one, other in zip(controls, controls[1:])]
    return controls[0]


def photographs(points):
    """Return the numbers of COUNT points that lie equally far from each other along a path."""
    x, y = np.transpose(points)
    along = np.insert(np.sqrt(np.diff(x) ** 2 + np.diff(y) ** 2).cumsum(), 0, 0)
    numbers = np.interp(np.linspace(0, along[-1], COUNT), along, range(len(points)))
    return numbers.round().astype(int).tolist()
