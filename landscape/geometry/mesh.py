"""Triangle meshes as arrays (Mesh_tool in 2006). No OpenGL."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np


@dataclass(frozen=True)
class Mesh:
    """Vertices (n, 3) and normals (n, 3) float32, triangles (m, 3) uint32.

    ``coordinates`` holds float32 (n, 2) for each texture unit; ``colors``, uint8 or float32 (n, 4),
    may be None.
    """

    vertices: np.ndarray
    normals: np.ndarray
    triangles: np.ndarray
    coordinates: tuple[np.ndarray, ...] = ()
    colors: np.ndarray | None = None


def grid_triangles(columns: int, rows: int) -> np.ndarray:
    """Return the two triangles of each cell of a grid of vertices, uint32 (m, 3).

    Vertex number is column + row * columns; with columns along x and rows along z the triangles
    are counter-clockwise seen from above. The diagonal runs from (0, 0) to (1, 1) of each cell.
    """
    c, r = np.meshgrid(np.arange(columns - 1), np.arange(rows - 1))
    corner = (c + r * columns).ravel()
    right = corner + 1
    below = corner + columns
    across = corner + columns + 1
    two = np.stack([corner, below, across, corner, across, right], axis=1)
    return np.ascontiguousarray(two.reshape(-1, 3), np.uint32)


def vertex_normals(vertices: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Return unit normals, float32 (n, 3): each the sum of its triangles' area vectors.

    A vertex that no triangle uses gets (0, 1, 0).
    """
    a, b, c = (vertices[triangles[:, k]].astype(np.float64) for k in range(3))
    area = np.cross(b - a, c - a)
    corners = triangles.T.ravel()
    summed = [np.bincount(corners, np.tile(area[:, k], 3), len(vertices)) for k in range(3)]
    normals = np.stack(summed, axis=1)
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    unit = np.where(length > 0, normals / np.where(length > 0, length, 1.0), (0.0, 1.0, 0.0))
    return np.ascontiguousarray(unit, np.float32)


def revolve(
    profile: Sequence[tuple[float, float]], sides: int, repeat: tuple[float, float]
) -> Mesh:
    """Return the surface of revolution of a profile of (radius, height) points about the y axis.

    x = r cos v, y = h, z = r sin v, as the truncated cone of section 6. Texture coordinates repeat
    ``repeat`` = (times around, times along). Each segment of the profile has its own vertices, so
    that edges between segments stay sharp.
    """
    angle = np.linspace(0.0, 2.0 * np.pi, sides + 1)
    points = np.array(profile, np.float64)
    lengths = np.hypot(*np.diff(points, axis=0).T)
    along = np.concatenate([[0.0], np.cumsum(lengths)]) / lengths.sum()
    vertices: list[np.ndarray] = []
    coordinates: list[np.ndarray] = []
    for k in range(len(points) - 1):
        for end in (k + 1, k):
            radius, y = points[end]
            ring = [radius * np.cos(angle), np.full_like(angle, y), radius * np.sin(angle)]
            vertices.append(np.stack(ring, axis=1))
            s = angle / (2 * np.pi) * repeat[0]
            t = np.full_like(s, (1 - along[end]) * repeat[1])
            coordinates.append(np.stack([s, t], axis=1))

    band = grid_triangles(sides + 1, 2)[:, ::-1]
    v = np.ascontiguousarray(np.concatenate(vertices), np.float32)
    starts = np.arange(len(points) - 1)[:, None, None] * 2 * (sides + 1)
    t = np.ascontiguousarray((band + starts).reshape(-1, 3), np.uint32)
    n = vertex_normals(v, t)
    for ring_start in range(0, len(v), sides + 1):
        # The first and last vertex of a ring coincide: otherwise the lighting shows a seam.
        last = ring_start + sides
        mean = n[ring_start] + n[last]
        n[ring_start] = n[last] = mean / np.linalg.norm(mean)

    return Mesh(v, n, t, (np.ascontiguousarray(np.concatenate(coordinates), np.float32),))


def faceted(mesh: Mesh) -> Mesh:
    """Return the mesh with flat triangles: each has three vertices of its own and one normal."""
    corner = mesh.triangles.ravel()
    vertices = np.ascontiguousarray(mesh.vertices[corner])
    triangles = np.arange(len(corner), dtype=np.uint32).reshape(-1, 3)
    return Mesh(
        vertices,
        vertex_normals(vertices, triangles),
        triangles,
        tuple(np.ascontiguousarray(c[corner]) for c in mesh.coordinates),
        None if mesh.colors is None else np.ascontiguousarray(mesh.colors[corner]),
    )


def morton_codes(points: np.ndarray) -> np.ndarray:
    """Return the places, int64 (n,), of points (n, 3) on a Morton curve through their cube."""
    low, high = points.min(axis=0, initial=np.inf), points.max(axis=0, initial=-np.inf)
    cube = (points - low) / max(float((high - low).max(initial=0.0)), 1e-9) * 1023.0
    code = np.zeros(len(cube), np.int64)
    for bit in range(10):
        for axis in range(3):
            code |= (cube[:, axis].astype(np.int64) >> bit & 1) << (3 * bit + axis)
    return code


def gathered(mesh: Mesh) -> Mesh:
    """Return the mesh with its triangles sorted along a Morton curve, vertices by first use.

    OpenGL keeps the last few transformed vertices in a cache. Triangles that are neighbours in
    space and in the list find their vertices there. The picture stays the same.
    """
    centres = mesh.vertices[mesh.triangles].mean(axis=1)
    triangles = mesh.triangles[np.argsort(morton_codes(centres), kind="stable")]
    used, first = np.unique(triangles, return_index=True)
    order = used[np.argsort(first)]
    place = np.zeros(len(mesh.vertices), np.uint32)
    place[order] = np.arange(len(order))
    return Mesh(
        mesh.vertices[order],
        mesh.normals[order],
        place[triangles],
        tuple(c[order] for c in mesh.coordinates),
        None if mesh.colors is None else mesh.colors[order],
    )


def edges(triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the vertices, int64 (3 m,), where the edges of triangles (m, 3) begin, and end."""
    corners = triangles.astype(np.int64)
    return corners.ravel(), corners[:, [1, 2, 0]].ravel()


def is_closed(triangles: np.ndarray) -> bool:
    """Return whether every edge of triangles (m, 3) has exactly one twin in the other direction."""
    starts, ends = edges(triangles)
    side = int(starts.max(initial=0)) + 1
    forth, back = np.sort(starts * side + ends), np.sort(ends * side + starts)
    return bool(np.array_equal(forth, back) and (np.diff(forth) > 0).all())


def centred(vertices: np.ndarray) -> np.ndarray:
    """Move and scale vertices (n, 3) so that they fill -1..1 along their largest side."""
    low, high = (end(axis=0).astype(np.float64) for end in (vertices.min, vertices.max))
    half = float((high - low).max()) / 2 or 1.0
    return np.ascontiguousarray((vertices - (low + high) / 2) / half, np.float32)


def merged(meshes: Sequence[Mesh]) -> Mesh:
    """Return meshes with as many texture units each as one mesh, with colours if all have them."""
    starts = np.cumsum([0, *(len(mesh.vertices) for mesh in meshes[:-1])])
    parts = zip(meshes, starts, strict=True)
    units = zip(*(mesh.coordinates for mesh in meshes), strict=True)
    colors = [mesh.colors for mesh in meshes if mesh.colors is not None]
    return Mesh(
        np.concatenate([mesh.vertices for mesh in meshes]),
        np.concatenate([mesh.normals for mesh in meshes]),
        np.concatenate([mesh.triangles + np.uint32(start) for mesh, start in parts]),
        tuple(np.concatenate(unit) for unit in units),
        np.concatenate(colors) if len(colors) == len(meshes) else None,
    )


def moved(mesh: Mesh, x: float, z: float) -> Mesh:
    """Return a mesh moved by x and z."""
    return replace(mesh, vertices=mesh.vertices + np.array([x, 0.0, z], np.float32))


def scaled(mesh: Mesh, scale: float) -> Mesh:
    """Return a mesh ``scale`` times as large.

    glScalef would do it at each draw, but it scales the normals too and then needs GL_NORMALIZE.
    """
    return replace(mesh, vertices=mesh.vertices * np.float32(scale))
