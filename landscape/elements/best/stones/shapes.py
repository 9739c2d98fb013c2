"""The shapes of stones, read from one mesh: crags, boulders, stones, pebbles, driftwood. No OpenGL.

They stand in a row in ``stones.ply``, coarser ones, for farther away, in rows behind
(studio/castle/stones.py). Vertices are split where the surface has an edge, so that rock looks
broken, and where the axis changes along which the texture is projected.
"""

from dataclasses import dataclass, fields
from pathlib import Path

import numpy as np

from framelens.base.errors import InputError
from landscape.files.cache import content, recall
from landscape.files.meshes import read_colours, read_mesh
from landscape.geometry.mesh import vertex_normals

APART = 3.0  # units from one shape to the next in the file (studio/castle/stones.py)
# How many shapes of each kind there are in the row.
CRAG, BOULDER, STONE, PEBBLE, LOG = range(5)
KINDS = (4, 3, 3, 2, 2)
CREASE = 0.72  # chosen: faces whose normals have a smaller dot product meet at a sharp edge


@dataclass(frozen=True)
class Shape:
    """One shape, its largest extent -1..1.

    Vertices, normals float32 (n, 3), texture coordinates (n, 2) in the vertices' units; how open
    to the sky a vertex is, (n,) in 0..1; triangles (m, 3).
    """

    vertices: np.ndarray
    normals: np.ndarray
    coordinates: np.ndarray
    openness: np.ndarray
    triangles: np.ndarray


def first_shape(kind: int) -> int:
    """Return the number of the first shape of a kind."""
    return sum(KINDS[:kind])


def read_shapes(path: Path) -> list[list[Shape]]:
    """Return the levels of each shape, the finest first; InputError names the file."""
    vertices, triangles = read_mesh(path)
    colours = read_colours(path)
    column, row = (np.round(vertices[:, axis] / APART).astype(int) for axis in (0, 2))
    count = sum(KINDS)
    if colours is None or column.max() != count - 1 or set(np.unique(column)) != set(range(count)):
        raise InputError(
            "{path}: expected {count} painted stones in a row, {apart:g} units apart",
            path=path,
            count=count,
            apart=APART,
        )

    found = []
    for k in range(count):
        levels = []
        for level in range(int(row[column == k].max()) + 1):
            mine = (column == k) & (row == level)
            number = np.cumsum(mine) - 1
            own = vertices[mine] - np.array([APART * k, 0.0, APART * level], np.float32)
            faces = number[triangles[mine[triangles].all(axis=1)]]
            levels.append(split(own, faces, colours[mine, 0] / np.float32(255.0), k))
        found.append(levels)
    return found


def kept_shapes(path: Path) -> list[list[Shape]]:
    """Return what :func:`read_shapes` does, from the cache if the file was read before."""

    def make() -> tuple[np.ndarray, ...]:
        found = read_shapes(path)
        arrays = (array for levels in found for shape in levels for array in vars(shape).values())
        return np.array([len(levels) for levels in found]), *arrays

    counts, *arrays = recall(["shapes of stones", content(path)], make)
    each = len(fields(Shape))
    shapes = iter([Shape(*arrays[k : k + each]) for k in range(0, len(arrays), each)])
    return [[next(shapes) for _ in range(count)] for count in counts.tolist()]


def split(vertices: np.ndarray, triangles: np.ndarray, openness: np.ndarray, k: int) -> Shape:
    """Return shape number ``k`` with a vertex for each side of a sharp edge."""
    corners = triangles.ravel()
    a, b, c = (vertices[triangles[:, j]].astype(np.float64) for j in range(3))
    area = np.cross(b - a, c - a)
    flat = area / np.maximum(np.linalg.norm(area, axis=1, keepdims=True), 1e-12)
    axis = np.abs(flat * (1.0, 1.3, 1.0)).argmax(axis=1)
    if k >= first_shape(STONE):
        # Small ones are rounded, and have one projection: they need no more vertices.
        normals = vertex_normals(vertices, triangles)[corners]
        axis[:] = 3
    else:
        # A corner's normal is the mean of those of the faces around it on its side of the edges.
        same = corners[:, None] == corners[None, :]
        face = np.repeat(np.arange(len(triangles)), 3)
        near = same & ((flat @ flat.T)[face][:, face] > CREASE)
        normals = near @ area[face]
        normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)

    if k >= first_shape(LOG):
        axis[:] = 4
    rows = np.column_stack([corners, np.repeat(axis, 3), np.round(normals * 64)])
    _, first, number = np.unique(rows, axis=0, return_index=True, return_inverse=True)
    points, side = vertices[corners[first]], np.repeat(axis, 3)[first]
    x, y, z = points.T

    # Level layers: t is the height wherever a side is not seen from above. A trunk's grain is long.
    s = np.choose(side, [z, x, x, x + 0.4 * y, 0.35 * x])
    t = np.choose(side, [y, z, y, z + 0.7 * y, 2.5 * (y + z)])
    return Shape(
        np.ascontiguousarray(points, np.float32),
        np.ascontiguousarray(normals[first], np.float32),
        np.ascontiguousarray(np.stack([s, t], axis=1), np.float32),
        np.ascontiguousarray(openness[corners[first]], np.float32),
        np.ascontiguousarray(number.reshape(-1, 3), np.int64),
    )
