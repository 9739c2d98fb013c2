"""The side of the face's plane on which the eye lies, by a normal and the way to a corner."""
# exercise: back_faces
# the rest: start.py


def seen(a, b, c):
    """Return whether a face is turned towards the camera."""
    normal = np.cross(b - a, c - a)
    sight = a
    return normal @ sight < 0
