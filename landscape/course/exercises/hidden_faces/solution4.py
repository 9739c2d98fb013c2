"""A table of the six sides, and for each the cubes with nothing beside them."""
# exercise: hidden_faces
# the rest: start.py

# The corners of a cube's six faces, and the step to the cube beside each.
SIDES = (
    ((1, 0, 0), ((1, 0, 0), (1, 1, 0), (1, 1, 1), (1, 0, 1))),
    ((-1, 0, 0), ((0, 0, 0), (0, 0, 1), (0, 1, 1), (0, 1, 0))),
    ((0, 1, 0), ((0, 1, 0), (0, 1, 1), (1, 1, 1), (1, 1, 0))),
    ((0, -1, 0), ((0, 0, 0), (1, 0, 0), (1, 0, 1), (0, 0, 1))),
    ((0, 0, 1), ((0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))),
    ((0, 0, -1), ((0, 0, 0), (0, 1, 0), (1, 1, 0), (1, 0, 0))),
)


def make_faces():
    """Return the corners of the faces to draw, (n, 4, 3)."""
    cubes = np.argwhere(SOLID)
    faces = []
    for step, corners in SIDES:
        beside = cubes + step
        inside = ((beside >= 0) & (beside < SOLID.shape)).all(axis=1)
        hidden = np.zeros(len(cubes), bool)
        hidden[inside] = SOLID[tuple(beside[inside].T)]
        faces.append(cubes[~hidden, None] + np.array(corners))
    return np.concatenate(faces)
