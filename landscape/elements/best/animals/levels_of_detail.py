"""Levels of detail of an animal's mesh, by vertex clustering. No OpenGL here.

A level merges the vertices inside cubes of equal side, and is used while such a cube is smaller
than the error allowed in pixels. Not in the report.
"""

import math
from collections.abc import Callable, Sequence

import numpy as np

from landscape.geometry.clustering import clustered
from landscape.geometry.mesh import Mesh, gathered

# Chosen: sides of the cubes whose vertices are merged, on a mesh of -1..1; 0 merges none.
CUBES = (0.0, 0.01, 0.014, 0.02, 0.03, 0.04, 0.06, 0.08)
AT_MOST = 0.85  # chosen: a level has at most this fraction of the finer level's triangles
Levels = dict[float, Mesh]


def levels_of_detail(
    mesh: Mesh,
    lay: Callable[[Mesh], Mesh],
    cubes: Sequence[float],
    charts: np.ndarray | None = None,
) -> Levels:
    """Return a mesh's levels, ready to be drawn, by the side of the cubes that made them.

    ``lay`` gives a mesh its texture coordinates, unless it has them, in ``charts`` (n,). A level
    that saves too little is left out.
    """
    levels: Levels = {}
    most = math.inf
    for cube in cubes:
        level = clustered(mesh, cube, charts) if cube else mesh
        if len(level.triangles) <= most:
            levels[cube] = gathered(lay(level))
            most = AT_MOST * len(level.triangles)
    return levels


def packed(levels: Levels) -> tuple[np.ndarray, ...]:
    """Return levels of detail, of one texture unit, as arrays for the cache: see unpacked."""
    arrays = [np.array(list(levels))]
    for mesh in levels.values():
        colors = np.empty((0, 4), np.uint8) if mesh.colors is None else mesh.colors
        arrays += [mesh.vertices, mesh.normals, mesh.triangles, *mesh.coordinates, colors]
    return tuple(arrays)


def unpacked(arrays: Sequence[np.ndarray]) -> Levels:
    """Return the levels of detail that were packed: their cubes, then five arrays of each."""
    cubes, *rest = arrays
    levels: Levels = {}
    for cube, start in zip(cubes.tolist(), range(0, len(rest), 5), strict=True):
        vertices, normals, triangles, coordinates, colors = rest[start : start + 5]
        levels[cube] = Mesh(
            vertices, normals, triangles, (coordinates,), colors if len(colors) else None
        )
    return levels
