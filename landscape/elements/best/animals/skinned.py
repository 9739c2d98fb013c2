"""Meshes that have texture coordinates of their own, cut at the borders of charts. No OpenGL.

At such a border a vertex is there twice. Its normals are those of the surface before it was cut, so
that no seam shows.
"""

from typing import NamedTuple

import numpy as np

from landscape.elements.best.animals.serpent_skin import Strip, strip_of
from landscape.files.assets import Assets
from landscape.files.meshes import read_looks
from landscape.geometry.mesh import Mesh, centred, is_closed, vertex_normals


class Skinned(NamedTuple):
    """What is solid, and the membranes; ``closed`` says whether the solid has no hole."""

    flesh: Mesh
    membranes: Mesh
    closed: bool


def sewn(vertices: np.ndarray, triangles: np.ndarray) -> tuple[np.ndarray, bool]:
    """Return normals (n, 3) of a mesh that is cut, and whether it is closed but for the cuts."""
    places, own = np.unique(vertices, axis=0, return_inverse=True)
    own = own.reshape(-1)
    whole = own[triangles].astype(np.uint32)
    return np.ascontiguousarray(vertex_normals(places, whole)[own]), is_closed(whole)


def read_skinned(assets: Assets, name: str, key: str) -> Skinned | None:
    """Return a mesh file's parts, vertices in -1..1; None if it has no colours or coordinates.

    ``key`` names the setting in an error.
    """
    path = assets.path(name, key)
    looks = read_looks(path)
    if looks is None:
        return None
    vertices, triangles, colours, coordinates = looks
    vertices = centred(vertices)
    opaque = np.hstack([colours, np.full((len(colours), 1), 255, np.uint8)])
    sheet = (strip_of(coordinates) == Strip.FIN)[triangles].all(axis=1)

    def part(chosen: np.ndarray) -> tuple[Mesh, bool]:
        used, corners = np.unique(triangles[chosen], return_inverse=True)
        corners = np.ascontiguousarray(corners.reshape(-1, 3), np.uint32)
        normals, closed = sewn(vertices[used], corners)
        mesh = Mesh(
            np.ascontiguousarray(vertices[used]),
            normals,
            corners,
            (np.ascontiguousarray(coordinates[used]),),
            np.ascontiguousarray(opaque[used]),
        )
        return mesh, closed

    flesh, closed = part(~sheet)
    membranes, _ = part(sheet)
    return Skinned(flesh, membranes, closed)
