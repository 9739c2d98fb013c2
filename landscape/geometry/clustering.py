"""Vertex clustering: simplifying a mesh for a distance. No OpenGL."""

import numpy as np

from landscape.geometry.mesh import Mesh


def clustered(mesh: Mesh, cell: float, charts: np.ndarray | None = None) -> Mesh:
    """Return the mesh with all vertices inside a cube of side ``cell`` merged into their mean.

    Vertex clustering (Rossignac and Borrel 1993): triangles that collapse are dropped. It makes a
    level of detail that is good while a cube is no larger than a pixel. Normals and colours are
    means; texture coordinates are dropped, unless ``charts`` (n,) says in which chart each vertex
    has them: then each chart has a vertex of its own in a cube, at the same place.
    """
    cubes = np.floor(mesh.vertices / cell).astype(np.int64)
    cubes -= cubes.min(axis=0)
    spans = cubes.max(axis=0) + 1
    number = (cubes[:, 0] * spans[1] + cubes[:, 1]) * spans[2] + cubes[:, 2]
    used, own, count = np.unique(number, return_inverse=True, return_counts=True)

    def mean(values: np.ndarray) -> np.ndarray:
        sums = [np.bincount(own, column, len(used)) for column in values.T.astype(np.float64)]
        return np.stack(sums, axis=1) / count[:, None]

    if charts is not None:
        return _in_charts(mesh, own, charts, mean(mesh.vertices), mean(mesh.normals))
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


def _in_charts(
    mesh: Mesh, cubes: np.ndarray, charts: np.ndarray, places: np.ndarray, normals: np.ndarray
) -> Mesh:
    """Return the clustered mesh with a vertex for each chart in a cube.

    ``cubes`` (n,) is the cube of each vertex; ``places`` and ``normals`` (k, 3) are the cubes'.
    """
    most = int(charts.max(initial=0)) + 1
    used, own, count = np.unique(cubes * most + charts, return_inverse=True, return_counts=True)

    def mean(values: np.ndarray) -> np.ndarray:
        sums = [np.bincount(own, column, len(used)) for column in values.T.astype(np.float64)]
        return np.stack(sums, axis=1) / count[:, None]

    a, b, c = cubes[mesh.triangles].T
    kept = np.flatnonzero((a != b) & (b != c) & (c != a))
    cube = used // most
    unit = normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-9)
    return Mesh(
        np.ascontiguousarray(places[cube], np.float32),
        np.ascontiguousarray(unit[cube], np.float32),
        np.ascontiguousarray(own[mesh.triangles[kept]], np.uint32),
        tuple(np.ascontiguousarray(mean(unit), np.float32) for unit in mesh.coordinates),
        None if mesh.colors is None else np.ascontiguousarray(mean(mesh.colors), np.uint8),
    )
