"""Back faces: triangles that are turned away from the camera (section 3, "back-face culling").

The terrain is seen from above only. The camera is above a triangle's plane if the three vectors to
its corners, in their order around it, have a determinant of the right sign; it is six times the
volume of the tetrahedron of triangle and camera. It is the same in the camera's frame of reference
as in the terrain's, and does not need the projection. In a wireframe, what is left out are the far
slopes of hills, most of which hills hide.
"""

import numpy as np

from landscape.flyover.camera import Points

# A triangle with less of the camera above it is seen edge-on, or it has no area because its
# vertices glided together, and its determinant is what rounding has left of 0.
LEAST = 1e-6  # units above the triangle's plane, chosen


def facing(points: Points, area: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return which triangles face the camera, for quads of vertices ``points`` (n, s, s) each.

    Points are relative to the camera, in any frame of reference that has not been reflected.
    ``area`` (n,) is that of each grid's quads. The result is bool (n, s - 1, s - 1) for the
    triangles corner, right, across, and for the triangles corner, across, below.
    """
    x, y, z = points
    ax = x[:, :-1, :-1]
    ay = y[:, :-1, :-1]
    az = z[:, :-1, :-1]
    cx = x[:, 1:, 1:]
    cy = y[:, 1:, 1:]
    cz = z[:, 1:, 1:]

    # Both triangles share the diagonal: one cross product, across x corner, serves both.
    nx = cy * az - cz * ay
    ny = cz * ax - cx * az
    nz = cx * ay - cy * ax
    right, below = np.s_[:, :-1, 1:], np.s_[:, 1:, :-1]
    least = (LEAST * area)[:, None, None]
    first = nx * x[right] + ny * y[right] + nz * z[right]
    second = nx * x[below] + ny * y[below] + nz * z[below]
    return first < -least, second > least
