"""A face is where the solid changes along an axis; the sign says which way it looks."""
# exercise: hidden_faces
# the rest: start.py


def make_faces():
    """Return the corners of the faces to draw, (n, 4, 3)."""
    faces = []
    for axis in range(3):
        # 1 where the way along the axis enters a cube from air, -1 where it leaves one.
        change = np.diff(np.pad(SOLID, 1).astype(int), axis=axis)
        # The padding has moved all cubes by one; along the axis, a change is before its cube.
        corner = np.ones(3, int)
        corner[axis] = 0
        across, up = np.roll(np.eye(3, dtype=int), -axis - 1, axis=0)[:2]
        for place in np.argwhere(change) - corner:
            square = [place, place + across, place + across + up, place + up]
            enters = change[tuple(place + corner)] == 1
            faces.append(square[::-1] if enters else square)
    return np.array(faces)
