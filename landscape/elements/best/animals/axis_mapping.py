"""Texture coordinates projected along an axis, chosen by face (R12, section 11.2.5). No OpenGL.

Cylindrical coordinates pinch the texture near the axis; (x, z) stretches it on upright faces. Here
each face is projected along the axis it is most normal to; the faces of one axis make a chart. On
the border of two charts a vertex is duplicated, one copy for each.
"""

import numpy as np

from landscape.geometry.mesh import Mesh

# The directions of s and t on faces whose normals point mostly along x, y and z.
PLANES = np.eye(3, dtype=np.float32)[[(2, 1), (0, 2), (0, 1)]]


def by_axis(mesh: Mesh, repeat: float) -> Mesh:
    """Return a mesh of vertices in -1..1 mapped by charts, ``repeat`` textures over 2 units.

    A face whose normal points mostly along x is in the chart of (z, y), along y in that of
    (x, z), along z in that of (x, y). The vertices' smooth normals decide, not the face's own,
    which would speckle a rough skin with charts of one face.
    """
    return in_charts(mesh, facing(mesh), PLANES, repeat)


def facing(mesh: Mesh) -> np.ndarray:
    """Return the axis 0, 1 or 2 to which the smooth normals of each face (m,) are closest."""
    return np.abs(mesh.normals[mesh.triangles].sum(axis=1)).argmax(axis=1)


def in_charts(mesh: Mesh, charts: np.ndarray, planes: np.ndarray, repeat: float) -> Mesh:
    """Return a mesh of vertices in -1..1 mapped by charts, ``repeat`` textures over 2 units.

    ``charts`` (m,) is the chart of each face; ``planes`` (k, 2, 3) are the directions of s and t
    in each chart.
    """
    count = len(mesh.vertices)

    # One number per vertex and chart: chart * count + vertex.
    corners, triangles = np.unique(mesh.triangles + charts[:, None] * count, return_inverse=True)
    chart, own = np.divmod(corners, count)
    vertices = np.ascontiguousarray(mesh.vertices[own])
    along = (planes.astype(np.float32)[chart] * vertices[:, None]).sum(axis=2)
    coordinates = repeat * (along + 1) / 2
    return Mesh(
        vertices,
        np.ascontiguousarray(mesh.normals[own]),
        np.ascontiguousarray(triangles.reshape(-1, 3), np.uint32),
        (np.ascontiguousarray(coordinates, np.float32),),
        None if mesh.colors is None else np.ascontiguousarray(mesh.colors[own]),
    )
