"""The way from the middle of the tube to the point, divided by its length."""
# exercise: normals
# the rest: start.py


def normal(u, v):
    """Return the normal of the ring at two angles in radians."""
    x, y, z = point(u, v)
    outward = x - RING * math.cos(u), y - RING * math.sin(u), z
    length = math.hypot(*outward)
    return tuple(part / length for part in outward)
