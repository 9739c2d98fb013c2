"""Triangle meshes as arrays (Mesh_tool in 2006): building, reading PLY files, drawing."""

import io
import logging
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from landscape.errors import InputError
from landscape.gl.calls import gl
from landscape.gl.state import client_arrays


@dataclass(frozen=True)
class Mesh:
    """Vertices (n, 3) and normals (n, 3) float32, triangles (m, 3) uint32, one (n, 2) per unit."""

    vertices: np.ndarray
    normals: np.ndarray
    triangles: np.ndarray
    coordinates: tuple[np.ndarray, ...] = ()

    def draw(self) -> None:
        """Send the mesh with one glDrawElements."""
        with client_arrays(self.vertices, self.normals, coordinates=self.coordinates):
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


def read_ply(path: Path) -> tuple[np.ndarray, np.ndarray]:
    """Read a PLY file: vertices float32 (n, 3) and triangles uint32 (m, 3), counts kept.

    ASCII or binary of either byte order; polygons are cut into triangles. InputError names a file
    that is missing, truncated, not a PLY, or has no faces, wrong indices or NaN.
    """
    import trimesh

    logging.getLogger("trimesh").setLevel(logging.CRITICAL)
    try:
        data = path.read_bytes()
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror})") from None
    if not data.startswith(b"ply"):
        raise InputError(f"{path}: expected a PLY file, whose first line is 'ply'")
    counts = _header_counts(data)
    try:
        loaded: Any = trimesh.load(
            io.BytesIO(data), file_type="ply", process=False, maintain_order=True, force="mesh"
        )
        vertices = np.ascontiguousarray(loaded.vertices, np.float32)
        triangles = np.asarray(loaded.faces, np.int64)
    except Exception as error:
        # trimesh raises whatever its parser stumbled on: any of it means a damaged file here.
        raise InputError(f"{path}: expected a whole PLY mesh ({_first_line(error)})") from None
    if len(triangles) == 0:
        raise InputError(f"{path}: expected a mesh with faces, found none")
    if len(vertices) < counts["vertex"] or len(triangles) < counts["face"]:
        raise InputError(
            f"{path}: truncated: the header promises {counts['vertex']} vertices and "
            f"{counts['face']} faces"
        )
    if not np.isfinite(vertices).all():
        raise InputError(f"{path}: expected finite coordinates, found NaN or infinity")
    if triangles.min() < 0 or triangles.max() >= len(vertices):
        raise InputError(f"{path}: a face names a vertex that does not exist")
    return vertices, np.ascontiguousarray(triangles, np.uint32)


def _header_counts(data: bytes) -> dict[str, int]:
    """Return the numbers of vertices and faces that a PLY header promises, 0 where silent."""
    counts = {"vertex": 0, "face": 0}
    for line in data[: data.find(b"end_header")].split(b"\n"):
        words = line.decode("latin-1").split()
        if len(words) == 3 and words[0] == "element" and words[2].isdigit():
            counts[words[1]] = int(words[2])
    return counts


def _first_line(error: Exception) -> str:
    text = str(error).strip()
    return text.splitlines()[0][:100] if text else type(error).__name__


def centred(vertices: np.ndarray) -> np.ndarray:
    """Move and scale vertices (n, 3) so that they fill -1..1 along their largest side."""
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    half = float((high - low).max()) / 2 or 1.0
    return np.ascontiguousarray((vertices - (low + high) / 2) / half, np.float32)
