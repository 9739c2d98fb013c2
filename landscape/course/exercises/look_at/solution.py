"""The three axes of the camera as the rows of a matrix, and the eye moved to the origin."""
# exercise: look_at
# the rest: start.py


def look(eye, target, up):
    """Move the world into the frame of a camera; three arrays x, y, z."""
    back = eye - target
    back = back / np.linalg.norm(back)
    right = np.cross(up, back)
    right = right / np.linalg.norm(right)
    upward = np.cross(back, right)
    matrix = np.identity(4)
    matrix[:3, :3] = right, upward, back
    glMultMatrixf(matrix.T)
    glTranslatef(*-eye)
