"""The sign of a determinant: the volume of the pyramid on the face with the camera at its top."""
# exercise: back_faces
# the rest: start.py


def seen(a, b, c):
    """Return whether a face is turned towards the camera."""
    # The volume of the pyramid on the face, with the camera at its top; its sign is the side.
    return np.linalg.det((a, b, c)) < 0
