"""Which way round the corners go in the picture, as OpenGL decides it."""
# exercise: back_faces
# the rest: start.py


def seen(a, b, c):
    """Return whether a face is turned towards the camera."""
    # The corners in the picture, and which way round they go there.
    (ax, ay), (bx, by), (cx, cy) = (corner[:2] / -corner[2] for corner in (a, b, c))
    return (bx - ax) * (cy - ay) - (by - ay) * (cx - ax) > 0
