"""Plain Python: a set of cubes, and a look at the six beside each."""
# exercise: hidden_faces
# the rest: start.py


def make_faces():
    """Return the corners of the faces to draw, (n, 4, 3)."""
    cubes = {tuple(place) for place in np.argwhere(SOLID).tolist()}
    faces = []
    for cube in sorted(cubes):
        for axis in range(3):
            for step in (1, -1):
                beside = list(cube)
                beside[axis] += step
                if tuple(beside) not in cubes:
                    faces.append(face(cube, axis, step))
    return faces


def face(cube, axis, step):
    """Return the four corners of a face, counter-clockwise as seen from outside."""
    corners = []
    for u, v in ((0, 0), (1, 0), (1, 1), (0, 1)):
        corner = list(cube)
        corner[axis] += step == 1
        corner[(axis + 1) % 3] += u
        corner[(axis + 2) % 3] += v
        corners.append(corner)
    return corners if step == 1 else corners[::-1]
