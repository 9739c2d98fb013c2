"""Meshes that are slow to make, in the cache (files/cache.py). No OpenGL."""

import json
from collections.abc import Callable, Iterable, Mapping

import numpy as np

from landscape.files.cache import recall
from landscape.geometry.mesh import Mesh

Key = tuple[str, ...]  # what a mesh is called by


def kept_meshes(
    parts: Iterable[bytes | str], make: Callable[[], Mapping[Key, Mesh]]
) -> dict[Key, Mesh]:
    """Return the meshes that ``make`` returns, by key, from the cache if they were made before.

    The meshes must depend only on ``parts`` and on code, as what
    :func:`recall` returns must.
    """
    table, *arrays = recall(parts, lambda: _flat(make()))
    left = iter(arrays)
    meshes: dict[Key, Mesh] = {}
    for key, units, coloured in json.loads(table.tobytes()):
        vertices = next(left)
        normals = next(left)
        triangles = next(left)
        coordinates = tuple(next(left) for _ in range(units))
        colors = next(left) if coloured else None
        meshes[tuple(key)] = Mesh(vertices, normals, triangles, coordinates, colors)
    return meshes


def _flat(meshes: Mapping[Key, Mesh]) -> tuple[np.ndarray, ...]:
    """Return a table of keys and numbers of arrays, as JSON in an array, and all the arrays."""
    table, arrays = [], []
    for key, mesh in meshes.items():
        table.append([key, len(mesh.coordinates), mesh.colors is not None])
        arrays += [mesh.vertices, mesh.normals, mesh.triangles, *mesh.coordinates]
        arrays += [mesh.colors] if mesh.colors is not None else []
    return np.frombuffer(json.dumps(table).encode(), np.uint8), *arrays
