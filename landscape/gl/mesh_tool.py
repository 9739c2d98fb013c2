"""Triangle meshes as arrays (Mesh_tool in 2006): building and drawing them."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from landscape.gl.calls import gl
from landscape.gl.state import client_arrays


@dataclass(frozen=True)
class Mesh:
    """Vertices (n, 3) and normals (n, 3) float32, triangles (m, 3) uint32, one (n, 2) per unit.

    ``colors``, uint8 (n, 4), may be left out.
    """

    vertices: np.ndarray
    normals: np.ndarray
    triangles: np.ndarray
    coordinates: tuple[np.ndarray, ...] = ()
    colors: np.ndarray | None = None

    def draw(self) -> None:
        """Send the mesh with one glDrawElements."""
        with client_arrays(self.vertices, self.normals, self.colors, self.coordinates):
            gl.glDrawElements(
                gl.GL_TRIANGLES, self.triangles.size, gl.GL_UNSIGNED_INT, self.triangles
            )


def grid_triangles(columns: int, rows: int) -> np.ndarray:
    """Return the two triangles of each cell of a grid of vertices, uint32 (m, 3).

    Vertex number is column + row * columns; with columns along x and rows along z the triangles
    are counter-clockwise seen from above. The diagonal runs from (0, 0) to (1, 1) of each cell.
    """
    c, r = np.meshgrid(np.arange(columns - 1), np.arange(rows - 1))
    corner = (c + r * columns).ravel()
    right, below, across = corner + 1, corner + columns, corner + columns + 1
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
    """Return the surface a profile of (radius, height) points sweeps about the y axis.

    x = r cos v, y = h, z = r sin v, as the truncated cone of section 6; texture coordinates run
    ``repeat`` times round and along. Each segment of the profile has vertices of its own, so that
    edges between segments stay sharp.
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
        # First and last vertex of a ring are one point: without this the seam shows in the light.
        last = ring_start + sides
        mean = n[ring_start] + n[last]
        n[ring_start] = n[last] = mean / np.linalg.norm(mean)
    return Mesh(v, n, t, (np.ascontiguousarray(np.concatenate(coordinates), np.float32),))


def centred(vertices: np.ndarray) -> np.ndarray:
    """Move and scale vertices (n, 3) so that they fill -1..1 along their largest side."""
    low, high = (end(axis=0).astype(np.float64) for end in (vertices.min, vertices.max))
    half = float((high - low).max()) / 2 or 1.0
    return np.ascontiguousarray((vertices - (low + high) / 2) / half, np.float32)
