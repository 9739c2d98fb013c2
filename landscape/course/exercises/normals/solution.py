"""The normal by its formula: the point of the unit sphere at the same angles."""
# exercise: normals
# the rest: start.py


def normal(u, v):
    """Return the normal of the ring at two angles in radians."""
    return math.cos(v) * math.cos(u), math.cos(v) * math.sin(u), math.sin(v)
