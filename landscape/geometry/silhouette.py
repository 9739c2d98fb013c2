"""Silhouettes and shadow volumes of triangle meshes (Crow 1977). No OpenGL.

A light sees some triangles of a closed mesh from their front. The edges between those and the rest
are the silhouette. Drawn away from the light, they are the sides of the mesh's shadow volume, which
the triangles that face the light close at the near end and their images at the far end.
"""

import numpy as np

from landscape.geometry.mesh import edges


def faces_light(vertices: np.ndarray, triangles: np.ndarray, light: np.ndarray) -> np.ndarray:
    """Return which triangles (m, 3) show their front to a point (3,), bool (m,)."""
    a, b, c = (vertices[triangles[:, k]].astype(np.float64) for k in range(3))
    return np.asarray((np.cross(b - a, c - a) * (light - a)).sum(axis=1) > 0.0)


def boundary(triangles: np.ndarray) -> np.ndarray:
    """Return the directed edges (k, 2) of triangles (m, 3) that no opposite edge cancels.

    An edge that is left over several times is returned as often. Each vertex begins as many edges
    as it ends, so that they form closed lines whatever the mesh.
    """
    starts, ends = edges(triangles)
    low, high = np.minimum(starts, ends), np.maximum(starts, ends)
    side = int(high.max(initial=0)) + 1
    keys, own = np.unique(low * side + high, return_inverse=True)
    net = np.bincount(own, np.where(starts < ends, 1, -1), len(keys)).astype(np.int64)
    low, high = keys // side, keys % side
    directed = np.stack([np.where(net > 0, low, high), np.where(net > 0, high, low)], axis=1)
    return np.repeat(directed, np.abs(net), axis=0)


def shadow_volume(
    vertices: np.ndarray, triangles: np.ndarray, light: np.ndarray, times: float, caps: bool
) -> tuple[np.ndarray, np.ndarray]:
    """Return the vertices, float32 (2n, 3), and triangles, uint32, of a mesh's shadow volume.

    Its far end is ``times`` as far from the light (3,) as the mesh. Its triangles face outwards.
    Without ``caps`` both ends are open.
    """
    far = light + times * (vertices - light)
    lit = triangles[faces_light(vertices, triangles, light)].astype(np.int64)
    count = len(vertices)
    a, b = boundary(lit).T
    parts = [np.stack([b, a, a + count], axis=1), np.stack([b, a + count, b + count], axis=1)]
    if caps:
        parts += [lit, lit[:, ::-1] + count]
    both = np.concatenate([vertices, far]).astype(np.float32)
    return both, np.ascontiguousarray(np.concatenate(parts), np.uint32)
