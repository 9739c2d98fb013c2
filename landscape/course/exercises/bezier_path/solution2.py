"""Bernstein's polynomials; photographs taken while the way is walked."""
# exercise: bezier_path
# the rest: start.py

import math


def bezier(a, b, c, d, t):
    """Return the point of a curve with four control points, for t from 0 to 1."""
    s = 1 - t
    return s**3 * a + 3 * s**2 * t * b + 3 * s * t**2 * c + t**3 * d


def photographs(points):
    """Return the numbers of COUNT points that lie equally far from each other along a path."""
    total = 0
    for one, other in zip(points, points[1:]):
        total += math.dist(one, other)
    found = [0]
    way = 0
    for number in range(1, len(points)):
        way += math.dist(points[number - 1], points[number])
        while len(found) < COUNT - 1 and way >= total * len(found) / (COUNT - 1):
            found.append(number)
    return [*found, len(points) - 1]
