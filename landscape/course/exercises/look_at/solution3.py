"""The camera as an object of the world, and the inverse of its matrix."""
# exercise: look_at
# the rest: start.py


def look(eye, target, up):
    """Move the world into the frame of a camera; three arrays x, y, z."""
    # The camera itself, as an object of the world, and then the inverse of that.
    camera = np.identity(4)
    camera[:3, 2] = eye - target
    camera[:3, 0] = np.cross(up, camera[:3, 2])
    camera[:3, 1] = np.cross(camera[:3, 2], camera[:3, 0])
    camera[:3, :3] /= np.linalg.norm(camera[:3, :3], axis=0)
    camera[:3, 3] = eye
    glMultTransposeMatrixd(np.linalg.inv(camera))
