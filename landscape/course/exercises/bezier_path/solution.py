"""De Casteljau's construction step by step; photographs by the length of the way, searched."""
# exercise: bezier_path
# the rest: start.py


def bezier(a, b, c, d, t):
    """Return the point of a curve with four control points, for t from 0 to 1."""
    ab = a + t * (b - a)
    bc = b + t * (c - b)
    cd = c + t * (d - c)
    abc = ab + t * (bc - ab)
    bcd = bc + t * (cd - bc)
    return abc + t * (bcd - abc)


def photographs(points):
    """Return the numbers of COUNT points that lie equally far from each other along a path."""
    lengths = [0]
    for one, other in zip(points, points[1:]):
        lengths.append(lengths[-1] + np.hypot(*(other - one)))
    wanted = np.linspace(0, lengths[-1], COUNT)
    return np.searchsorted(lengths, wanted - 1e-6)
