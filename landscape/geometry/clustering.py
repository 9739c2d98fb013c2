"""Vertex clustering: simplifying a mesh for a distance. No OpenGL."""

import numpy as np

from landscape.geometry.mesh import Mesh


def clustered(mesh: Mesh, cell: float) -> Mesh:
    """Return the mesh with all vertices inside a cube of side ``cell`` merged into their mean.

    Vertex clustering (Rossignac and Borrel 1993): triangles that collapse are dropped. It makes a
    level of detail that is good while a cube is no larger than a pixel. Normals and colours are
    means; texture coordinates are dropped.
    """
    cubes = np.floor(mesh.vertices / cell).astype(np.int64)
    cubes -= cubes.min(axis=0)
    spans = cubes.max(axis=0) + 1
    number = (cubes[:, 0] * spans[1] + cubes[:, 1]) * spans[2] + cubes[:, 2]
    used, own, count = np.unique(number, return_inverse=True, return_counts=True)

    def mean(values: np.ndarray) -> np.ndarray:
        sums = [np.bincount(own, column, len(used)) for column in values.T.astype(np.float64)]
        return np.stack(sums, axis=1) / count[:, None]

    triangles = own[mesh.triangles]
    a, b, c = triangles.T
    kept = np.flatnonzero((a != b) & (b != c) & (c != a))
    normals = mean(mesh.normals)
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-9)
    return Mesh(
        np.ascontiguousarray(mean(mesh.vertices), np.float32),
        np.ascontiguousarray(normals, np.float32),
        np.ascontiguousarray(triangles[kept], np.uint32),
        (),
        None if mesh.colors is None else np.ascontiguousarray(mean(mesh.colors), np.uint8),
    )
