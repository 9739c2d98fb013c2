"""Meshes that wait, compressed, until OpenGL takes them.

A vertex buffer is given its size before the first vertex is uploaded, and Mesa fills it with zeros
at once. So all meshes are made first, and those of a large world would need as much memory again as
the buffer that they go into. Compressed they need less than a fifth of that: first come all s, then
all t and so on, since what follows is then alike.
"""

import zlib
from dataclasses import dataclass

import numpy as np

from landscape.voxel.mesh import VERTEX, RegionMesh

LEVEL = 1  # of zlib, chosen: the fastest; the others save little more
LARGE = 1 << 23  # vertices, chosen: of a world whose meshes are packed
WORDS = VERTEX.itemsize // 4  # of a vertex: s, t, the colour, x, y, z


@dataclass(frozen=True)
class PackedMesh:
    """A mesh as zlib compresses it; ``size``, ``counts`` and ``box`` are those of the mesh."""

    size: int
    counts: np.ndarray
    box: tuple[np.ndarray, np.ndarray]
    data: bytes


def packed(mesh: RegionMesh | PackedMesh) -> PackedMesh:
    """Return a mesh compressed, unless it is so already."""
    if isinstance(mesh, PackedMesh):
        return mesh
    words = mesh.vertices.view(np.uint32).reshape(-1, WORDS)
    data = zlib.compress(words.T.tobytes(), LEVEL)
    return PackedMesh(mesh.size, mesh.counts, mesh.box, data)


def unpacked(mesh: RegionMesh | PackedMesh) -> RegionMesh:
    """Return a mesh as it was before it was compressed, if it was."""
    if isinstance(mesh, RegionMesh):
        return mesh
    words = np.frombuffer(zlib.decompress(mesh.data), np.uint32).reshape(WORDS, -1)
    return RegionMesh(np.ascontiguousarray(words.T).view(VERTEX).reshape(-1), mesh.counts)
