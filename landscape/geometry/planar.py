"""Planar shadows: the matrix that projects along a light's rays onto a plane. No OpenGL.

A plane is p = (a, b, c, d) with p . v = a x + b y + c z + d w, which is 0 on it and positive on the
side that its normal (a, b, c) points to. A light is l = (x, y, z, w) in homogeneous coordinates:
with w = 1 it shines from the point (x, y, z), with w = 0 from infinitely far in the direction
(x, y, z).

The shadow of a vertex v is the point of the line through v and l that lies on the plane. Every
point of that line is s v + t l, homogeneous coordinates up to a factor. On the plane
s (p . v) + t (p . l) = 0, which s = p . l and t = -(p . v) fulfil:

    v' = (p . l) v - (p . v) l = ((p . l) I - l p^T) v,    M = (p . l) I - l p^T.

As p . M = 0, M v is on the plane for every v, and M l = 0: the light itself has no shadow.

M and -M move points alike, since v' and -v' are the same point. The sign of w' tells them apart:

    w' = (p . l) v_w - (p . v) l_w,

for v_w = 1 and a point light w' = p . l - p . v: positive where v is nearer to the plane than the
light, on the light's side of it. For a light at infinity w' = p . l: positive where the light is in
front of the plane. OpenGL clips whatever has a negative w' (a vertex is inside the view volume only
if -w <= x <= w), so that M draws true shadows alone. -M draws the others, the anti-shadows: of what
is beyond the light, and under a light that is behind the plane.
"""

import numpy as np


def shadow_matrix(plane: np.ndarray, light: np.ndarray) -> np.ndarray:
    """Return M = (p . l) I - l p^T, float64 (4, 4), for column vectors; both arguments are (4,)."""
    p, l = np.asarray(plane, np.float64), np.asarray(light, np.float64)  # noqa: E741 (as above)
    return np.asarray((p @ l) * np.eye(4) - np.outer(l, p))


def misprinted_matrix(plane: np.ndarray, light: np.ndarray, misprint: str) -> np.ndarray:
    """Return M (4, 4) with an error of the notes on glSkel: "matrix" or "plane"; "none" has none.

    Their last cell is a lx + b ly * c lz for a lx + b ly + c lz ("matrix"). Their equation of the
    plane is b x + b y + c z + d = 0 for a x + b y + c z + d = 0 ("plane").
    """
    p, l = np.asarray(plane, np.float64), np.asarray(light, np.float64)  # noqa: E741 (as above)
    if misprint == "plane":
        return shadow_matrix(np.array([p[1], p[1], p[2], p[3]]), l)
    printed = shadow_matrix(p, l)
    if misprint == "matrix":
        printed[3, 3] = p[0] * l[0] + (p[1] * l[1]) * (p[2] * l[2])
    return printed


def shadows_of(points: np.ndarray, plane: np.ndarray, light: np.ndarray) -> np.ndarray:
    """Return the shadows (n, 3) of points (n, 3); NaN for a point that casts none on the plane."""
    homogeneous = np.column_stack([points, np.ones(len(points))])
    moved = homogeneous @ shadow_matrix(plane, light).T
    w = np.where(moved[:, 3] > 0, moved[:, 3], np.nan)
    return np.asarray(moved[:, :3] / w[:, None])
