"""Each direction at once: the solid compared with itself moved by one cube."""
# exercise: hidden_faces
# the rest: start.py


def make_faces():
    """Return the corners of the faces to draw, (n, 4, 3)."""
    padded = np.pad(SOLID, 1)  # false all around
    faces = []
    for axis in range(3):
        for step in (1, -1):
            beside = np.roll(padded, -step, axis)[1:-1, 1:-1, 1:-1]
            cubes = np.argwhere(SOLID & ~beside)
            side = np.zeros((4, 3), int)
            side[:, axis] = step == 1
            side[[1, 2], (axis + 1) % 3] = 1
            side[[2, 3], (axis + 2) % 3] = 1
            faces.append(cubes[:, None] + side[::step])
    return np.concatenate(faces)
