"""Cross and scalar product written out, with the way from the face's middle to the camera."""
# exercise: back_faces
# the rest: start.py


def seen(a, b, c):
    """Return whether a face is turned towards the camera."""
    ux, uy, uz = (second - first for first, second in zip(a, b))
    vx, vy, vz = (second - first for first, second in zip(a, c))
    normal = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
    to_the_camera = [-coordinate for coordinate in (a + b + c) / 3]
    return sum(one * other for one, other in zip(normal, to_the_camera)) > 0
